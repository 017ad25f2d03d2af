import { createScene, type Material, type Mesh, type PerspectiveCamera, type Scene } from '@glanz/scene';

type Point = readonly [number, number, number];

/** A flat quadrilateral, counter-clockwise from the side that counts as front. */
function quads(name: string, list: readonly (readonly [Point, Point, Point, Point])[]): Mesh {
  const positions = Float32Array.from(list.flat(2));
  const indices = Uint32Array.from(list.flatMap((_, i) => [0, 1, 2, 0, 2, 3].map((corner) => 4 * i + corner)));
  return { name, positions, indices };
}

/** A block that stands on the floor, turned about +y; its six faces look outwards. */
function block(name: string, x: number, z: number, size: number, height: number, turn: number): Mesh {
  const [c, s] = [Math.cos(turn) * size * 0.5, Math.sin(turn) * size * 0.5];
  const foot: (readonly [number, number])[] = [
    [x - c + s, z + s + c],
    [x + c + s, z - s + c],
    [x + c - s, z - s - c],
    [x - c - s, z + s - c],
  ];
  const at = (i: number, y: number): Point => [foot[i % 4]![0], y, foot[i % 4]![1]];
  const sides = [0, 1, 2, 3].map((i) => [at(i, 0), at(i + 1, 0), at(i + 1, height), at(i, height)] as const);
  return quads(name, [
    ...sides,
    [at(0, height), at(1, height), at(2, height), at(3, height)],
    [at(3, 0), at(2, 0), at(1, 0), at(0, 0)],
  ]);
}

const matt = (name: string, base_color: readonly [number, number, number]): Material => ({
  name,
  parameters: { base_color, specular_weight: 0 },
});

/**
 * The Cornell box (Goral et al. 1984) in OpenPBR terms: a room one metre wide, open to the front, with a red wall on
 * the left, a green one on the right, two blocks and a light in the ceiling. 36 triangles, all matt. The camera looks
 * in along −z.
 */
export function createCornellBox(): Scene {
  const scene = createScene('Cornell box');
  const h = 0.5;
  const [l, r, b, t] = [-h, h, 0, 1];
  const room: readonly (readonly [Mesh, Material])[] = [
    [
      quads('Floor, ceiling and back wall', [
        [
          [l, b, h],
          [r, b, h],
          [r, b, -h],
          [l, b, -h],
        ],
        [
          [l, t, -h],
          [r, t, -h],
          [r, t, h],
          [l, t, h],
        ],
        [
          [l, b, -h],
          [r, b, -h],
          [r, t, -h],
          [l, t, -h],
        ],
      ]),
      matt('white', [0.73, 0.73, 0.73]),
    ],
    [
      quads('Left wall', [
        [
          [l, b, h],
          [l, b, -h],
          [l, t, -h],
          [l, t, h],
        ],
      ]),
      matt('red', [0.63, 0.065, 0.05]),
    ],
    [
      quads('Right wall', [
        [
          [r, b, -h],
          [r, b, h],
          [r, t, h],
          [r, t, -h],
        ],
      ]),
      matt('green', [0.14, 0.45, 0.091]),
    ],
    [block('Short block', 0.17, 0.2, 0.3, 0.3, -0.29), matt('white', [0.73, 0.73, 0.73])],
    [block('Tall block', -0.17, -0.15, 0.3, 0.6, 0.32), matt('white', [0.73, 0.73, 0.73])],
    [
      quads('Light', [
        [
          [-0.12, t - 1e-3, -0.1],
          [0.12, t - 1e-3, -0.1],
          [0.12, t - 1e-3, 0.1],
          [-0.12, t - 1e-3, 0.1],
        ],
      ]),
      {
        name: 'light',
        parameters: {
          base_color: [0, 0, 0],
          specular_weight: 0,
          emission_color: [1, 0.72, 0.42],
          emission_luminance: 17,
        },
      },
    ],
  ];
  for (const [mesh, material] of room) {
    let index = scene.materials.findIndex(({ name }) => name === material.name);
    if (index < 0) index = scene.materials.push(material) - 1;
    scene.instances.push({
      name: mesh.name,
      mesh: scene.meshes.push(mesh) - 1,
      material: index,
      transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    });
  }
  const camera: PerspectiveCamera = {
    type: 'perspective',
    name: 'Front',
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.5, 1.95, 1],
    yfov: (39.3 * Math.PI) / 180,
    aspect: 1,
  };
  scene.cameras.push(camera);
  return scene;
}
