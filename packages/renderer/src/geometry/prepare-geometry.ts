import { DynamicTlas } from '@glanz/bvh/dynamic-tlas';
import type { Mesh, Scene } from '@glanz/scene';
import { layOutGeometry, type Geometry } from './geometry';
import { buildHierarchies, instanceTreesOnGpu, type HierarchyOptions } from './hierarchies';
import type { Hierarchy } from './hierarchy';
import { isShown, tlasInstances } from './placement';

/** Meshes that visible instances use, in order. */
function usedMeshes(scene: Scene): number[] {
  const used: boolean[] = [];
  for (const instance of scene.instances) used[instance.mesh] ||= isShown(scene, instance);
  return [...scene.meshes.keys()].filter((index) => used[index]);
}

/** The meshes in use that have no hierarchy yet. */
export function missingMeshes(scene: Scene, blas: readonly (Hierarchy | undefined)[]): number[] {
  return usedMeshes(scene).filter((index) => !blas[index]);
}

/**
 * Builds the hierarchies that are missing.
 *
 * @param blas Hierarchies that are there already, by mesh.
 */
export async function prepareHierarchies(
  scene: Scene,
  options: HierarchyOptions = {},
  blas: readonly (Hierarchy | undefined)[] = [],
): Promise<(Hierarchy | undefined)[]> {
  const all = scene.meshes.map((_, i) => blas[i]);
  const missing = missingMeshes(scene, all);
  const built = await buildHierarchies(
    missing.map((index) => scene.meshes[index] as Mesh),
    options,
  );
  missing.forEach((index, i) => (all[index] = built[i]));
  return all;
}

/**
 * Builds all hierarchies in use and lays the shapes out. Where that fails after meshes were built on the GPU, their
 * memory is the caller's to free.
 *
 * @throws {RenderError} `renderer/no-triangles` if nothing can be seen.
 */
export async function prepareGeometry(scene: Scene, options: HierarchyOptions = {}): Promise<Geometry> {
  const [blas, build] = await Promise.all([
    prepareHierarchies(scene, options),
    instanceTreesOnGpu(options, scene.instances.length),
  ]);
  const tlas = build && (await DynamicTlas.create(tlasInstances(scene, blas), build));
  return layOutGeometry(scene, blas, options.compact, tlas);
}
