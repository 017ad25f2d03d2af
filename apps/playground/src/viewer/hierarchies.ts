import type { Blas } from '@glanz/bvh';
import { BvhWorkers } from '@glanz/bvh/workers';
import type { HierarchyBuilder } from '@glanz/renderer';

/** Builds hierarchies on workers and remembers them by their positions: a scene that gets a texture or a floor is there at once. */
export function rememberingHierarchies(): HierarchyBuilder {
  // They warm up while the first model loads.
  const workers = BvhWorkers.create({ warmUp: true });
  const built = new WeakMap<Float32Array, Blas>();
  return {
    async buildBlas(mesh, options) {
      const known = built.get(mesh.positions);
      if (known) return known;
      const blas = await (await workers).buildBlas(mesh, options);
      built.set(mesh.positions, blas);
      return blas;
    },
  };
}
