import type { PathTracer } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';
import type { State, Values } from '../state/state';
import { placedTransform } from './placement';

const same = (a: ArrayLike<number>, b: ArrayLike<number>) =>
  a === b || (a.length === b.length && Array.prototype.every.call(a, (value, i) => value === b[i]));
const alike = (a: unknown, b: unknown) => JSON.stringify(a) === JSON.stringify(b);

/**
 * A scene in another pose of the same model, which brings no images: places, shapes, lights, cameras and the values
 * of materials are the pose's, everything else stays.
 *
 * @returns Undefined where the two are not made of the same parts: parts appear and vanish.
 */
export function posedScene(scene: Scene, pose: Scene): Scene | undefined {
  const counts = ({ instances, meshes, materials, lights, cameras }: Scene) =>
    [instances, meshes, materials, lights, cameras].map((list) => list.length);
  if (!alike(counts(scene), counts(pose))) return undefined;
  if (
    !scene.instances.every(
      ({ mesh, material }, i) => mesh === pose.instances[i]?.mesh && material === pose.instances[i]?.material,
    )
  )
    return undefined;
  return {
    ...scene,
    instances: scene.instances.map((instance, i) => ({
      ...instance,
      transform: pose.instances[i]?.transform ?? instance.transform,
    })),
    // One that has not changed stays the one that a hierarchy is there for.
    meshes: scene.meshes.map((mesh, i) =>
      same(mesh.positions, pose.meshes[i]?.positions ?? []) ? mesh : (pose.meshes[i] ?? mesh),
    ),
    materials: scene.materials.map((material, i) => ({
      ...material,
      parameters: pose.materials[i]?.parameters ?? material.parameters,
    })),
    lights: pose.lights,
    cameras: pose.cameras,
  };
}

/**
 * Brings a tracer from whatever pose it is in to that of a scene; values that the user has edited stay the user's, and
 * parts that the user has moved are moved from where the pose has them.
 */
export async function applyPose(
  tracer: PathTracer,
  scene: Scene,
  { materials, moves }: Pick<State, 'materials' | 'moves'>,
): Promise<void> {
  const shown = tracer.scene;
  for (const [i, mesh] of scene.meshes.entries())
    if (!same(mesh.positions, shown.meshes[i]?.positions ?? [])) await tracer.replaceMesh(i, mesh);
  const moved = [...scene.instances.keys()]
    .map((i) => [i, placedTransform(scene, i, moves)] as const)
    .filter(([i, transform]) => !same(transform, shown.instances[i]?.transform ?? []));
  await tracer.setInstanceTransforms(moved);
  for (const [i, light] of scene.lights.entries()) if (!alike(light, shown.lights[i])) await tracer.setLight(i, light);
  for (const [i, material] of scene.materials.entries()) {
    const requested: Values = { ...material.parameters, ...materials[i] };
    if (!alike({ ...shown.materials[i]?.parameters, ...requested }, shown.materials[i]?.parameters))
      await tracer.setMaterial(i, requested);
  }
}
