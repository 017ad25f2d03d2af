import { createScene, type Mesh, type Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';

/**
 * A sphere of radius 1 about the origin: rings of quads from pole to pole,
 * smooth normals.
 */
export function sphere(rings = 48): Mesh {
  const columns = 2 * rings;
  const positions = new Float32Array((rings + 1) * (columns + 1) * 3);
  const indices: number[] = [];
  for (let i = 0, at = 0; i <= rings; i++) {
    const theta = (Math.PI * i) / rings;
    for (let j = 0; j <= columns; j++) {
      const phi = (2 * Math.PI * j) / columns;
      positions.set(
        [
          Math.sin(theta) * Math.sin(phi),
          Math.cos(theta),
          Math.sin(theta) * Math.cos(phi),
        ],
        3 * at,
      );
      const below = at + columns + 1;
      // Counter-clockwise from outside; the quads at the poles are triangles.
      if (i < rings && j < columns) {
        if (i > 0) indices.push(at, below, at + 1);
        if (i < rings - 1) indices.push(at + 1, below, below + 1);
      }
      at++;
    }
  }
  return {
    name: 'sphere',
    positions,
    normals: positions.slice(),
    indices: Uint32Array.from(indices),
  };
}

/** Three spheres on a table: one mesh with three instances. */
export function createSpheres(): Scene {
  const scene = createScene('Spheres');
  scene.materials = [
    {
      name: 'table',
      parameters: { base_color: [0.32, 0.32, 0.33], specular_roughness: 0.45 },
    },
    {
      name: 'plastic',
      parameters: { base_color: [0.75, 0.1, 0.03], specular_roughness: 0.15 },
    },
    {
      name: 'gold',
      parameters: {
        base_metalness: 1,
        base_color: [0.944, 0.776, 0.373],
        specular_roughness: 0.22,
      },
    },
    {
      name: 'clay',
      parameters: {
        base_color: [0.12, 0.3, 0.5],
        base_diffuse_roughness: 1,
        specular_weight: 0,
      },
    },
  ];
  const table = Float32Array.of(
    -300,
    -1,
    300,
    300,
    -1,
    300,
    300,
    -1,
    -300,
    -300,
    -1,
    -300,
  );
  scene.meshes = [
    sphere(),
    {
      name: 'table',
      positions: table,
      indices: Uint32Array.of(0, 1, 2, 0, 2, 3),
    },
  ];
  scene.instances = [
    {
      name: 'table',
      mesh: 1,
      material: 0,
      transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    },
    ...['plastic', 'gold', 'clay'].map((name, i) => ({
      name,
      mesh: 0,
      material: i + 1,
      transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2.15 * (i - 1), 0, 0, 1],
    })),
  ];
  scene.cameras = [
    {
      type: 'perspective',
      name: 'front',
      yfov: 0.42,
      transform: [
        1, 0, 0, 0, 0, 0.96, -0.28, 0, 0, 0.28, 0.96, 0, 0, 2.85, 10.6, 1,
      ],
    },
  ];
  scene.environment = studioEnvironment();
  return scene;
}
