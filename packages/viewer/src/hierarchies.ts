import type { Blas } from '@glanz/bvh';
import { BvhWorkers } from '@glanz/bvh/workers';
import type { HierarchyBuilder } from '@glanz/renderer';

/**
 * Builds hierarchies on workers and remembers them by their vertices and triangles: a scene that gets a texture or a
 * floor, or comes back after the device was lost, is there at once.
 */
export class RememberingHierarchies implements HierarchyBuilder {
  // They warm up while the first model loads.
  readonly #workers = BvhWorkers.create({ warmUp: true });
  readonly #built = new WeakMap<Float32Array, WeakMap<Uint32Array, Blas>>();

  async buildBlas(...[mesh, options]: Parameters<HierarchyBuilder['buildBlas']>): Promise<Blas> {
    // Meshes may share vertices and differ in their triangles.
    const known = this.#built.get(mesh.positions)?.get(mesh.indices);
    if (known) return known;
    const blas = await (await this.#workers).buildBlas(mesh, options);
    const built = this.#built.get(mesh.positions) ?? new WeakMap<Uint32Array, Blas>();
    this.#built.set(mesh.positions, built.set(mesh.indices, blas));
    return blas;
  }

  destroy(): void {
    void this.#workers.then((workers) => workers.destroy());
  }
}
