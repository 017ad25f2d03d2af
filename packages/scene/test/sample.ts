import { createScene, defaultMaterial, type Scene } from '../src/index';

/** Two skew triangles, one of them mirrored, turned and moved, and a vertex far off that no triangle uses. */
export function sample(): Scene {
  const scene = createScene();
  scene.meshes.push({
    name: 'a',
    positions: new Float32Array([0, 0, 0, 2, 0.5, 0, 0, 1, 3, 900, 900, 900]),
    indices: new Uint32Array([0, 1, 2]),
  });
  scene.materials.push(defaultMaterial());
  scene.instances.push({
    name: 'one',
    mesh: 0,
    material: 0,
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  });
  scene.instances.push({
    name: 'two',
    mesh: 0,
    material: 0,
    transform: [0, -2, 0, 0, 1, 0, 0.5, 0, 0, 0, 1, 0, 5, 1, -2, 1],
  });
  return scene;
}

/** World positions of all used vertices, by plain matrix products. */
export const points = (scene: Scene) =>
  scene.instances.flatMap(({ mesh, transform: m }) =>
    [...scene.meshes[mesh]!.indices].map((i) => {
      const p = scene.meshes[mesh]!.positions.subarray(3 * i, 3 * i + 3);
      return [0, 1, 2].map((r) => m[r]! * p[0]! + m[4 + r]! * p[1]! + m[8 + r]! * p[2]! + m[12 + r]!);
    }),
  );
