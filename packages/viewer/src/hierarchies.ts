import type { Blas } from '@glanz/bvh';
import { BvhWorkers } from '@glanz/bvh/workers';
import type { HierarchyBuilder } from '@glanz/renderer';

/** Gives the hierarchy of a mesh that is deformed: one that is fitted to it, or else what `build` resolves to. */
export type RefitHierarchy = (
  mesh: Parameters<HierarchyBuilder['buildBlas']>[0],
  build: () => Promise<Blas>,
) => Promise<Blas>;

/**
 * Builds hierarchies on workers and remembers them by their vertices and triangles: a scene that gets a texture or a
 * floor, or comes back after the device was lost, is there at once.
 */
export class RememberingHierarchies implements HierarchyBuilder {
  // They warm up while the first model loads.
  readonly #workers = BvhWorkers.create({ warmUp: true });
  readonly #built = new WeakMap<Float32Array, WeakMap<Uint32Array, Blas>>();

  /** Set while meshes are deformed. */
  refit: RefitHierarchy | undefined;

  async buildBlas(...[mesh, options]: Parameters<HierarchyBuilder['buildBlas']>): Promise<Blas> {
    // Meshes may share vertices and differ in their triangles.
    const known = this.#built.get(mesh.positions)?.get(mesh.indices);
    if (known) return known;
    const build = async () => (await this.#workers).buildBlas(mesh, options);
    const blas = await (this.refit ? this.refit(mesh, build) : build());
    const built = this.#built.get(mesh.positions) ?? new WeakMap<Uint32Array, Blas>();
    this.#built.set(mesh.positions, built.set(mesh.indices, blas));
    return blas;
  }

  destroy(): void {
    void this.#workers.then((workers) => workers.destroy());
  }
}
