import { createScene, type Mesh, type Scene } from '@glanz/scene';

/**
 * One mesh: an undulating grid of 2 × 2 metres with normals, which shares its vertices.
 *
 * @param triangles How many; the grid has the next number of whole rows.
 */
export function undulatingGrid(triangles: number): Mesh {
  const cells = Math.max(1, Math.round(Math.sqrt(triangles / 2)));
  const side = cells + 1;
  const positions = new Float32Array(3 * side * side);
  const normals = new Float32Array(3 * side * side);
  const indices = new Uint32Array(6 * cells * cells);
  for (let j = 0, at = 0, q = 0; j < side; j++) {
    const z = (2 * j) / cells - 1;
    for (let i = 0; i < side; i++, at += 3) {
      const x = (2 * i) / cells - 1;
      const [large, fine] = [5 * x + 2 * z, 40 * z - 11 * x];
      const y = 0.12 * Math.sin(large) * Math.cos(4 * z) + 0.006 * Math.sin(fine);
      const dx = 0.6 * Math.cos(large) * Math.cos(4 * z) - 0.066 * Math.cos(fine);
      const dz =
        0.24 * Math.cos(large) * Math.cos(4 * z) - 0.48 * Math.sin(large) * Math.sin(4 * z) + 0.24 * Math.cos(fine);
      const length = Math.sqrt(dx * dx + 1 + dz * dz);
      positions[at] = x;
      positions[at + 1] = y;
      positions[at + 2] = z;
      normals[at] = -dx / length;
      normals[at + 1] = 1 / length;
      normals[at + 2] = -dz / length;
      if (i === cells || j === cells) continue;
      const a = j * side + i;
      indices[q++] = a;
      indices[q++] = a + side;
      indices[q++] = a + 1;
      indices[q++] = a + 1;
      indices[q++] = a + side;
      indices[q++] = a + side + 1;
    }
  }
  return { name: 'grid', positions, normals, indices };
}

/** The grid under a sky and a sun, seen from above one of its edges. */
export function gridScene(triangles: number): Scene {
  const [sin, cos] = [Math.sin(0.6), Math.cos(0.6)];
  return {
    ...createScene('grid'),
    meshes: [undulatingGrid(triangles)],
    materials: [{ name: 'clay', parameters: { base_color: [0.6, 0.45, 0.3], specular_roughness: 0.4 } }],
    instances: [{ name: 'grid', mesh: 0, material: 0, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }],
    environment: { type: 'constant', radiance: [0.3, 0.4, 0.6] },
    lights: [{ type: 'directional', name: 'sun', direction: [0.8, -0.6, 0], color: [1, 0.9, 0.8], intensity: 3 }],
    cameras: [
      {
        type: 'perspective',
        name: 'camera',
        transform: [1, 0, 0, 0, 0, cos, -sin, 0, 0, sin, cos, 0, 0, 1.6, 2.2, 1],
        yfov: 0.75,
      },
    ],
  };
}
