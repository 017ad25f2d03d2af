import type { WgslModule } from '@glanz/wgsl';
import pages from '../storage/compact/compact_pages.wesl';
import triangles from '../storage/compact/compact_triangles.wesl';
import vertices from '../storage/compact/compact_vertices.wesl';
import type { KernelParts } from './pipelines';

/** By the name of the module in whose place they are. */
const READERS: ReadonlyMap<string, WgslModule> = new Map(
  Object.entries({ triangles, vertices, 'page-triangles': pages }).map(([name, module]) => [
    `renderer/${name}`,
    module,
  ]),
);

/**
 * A kernel that reads compact shapes: other functions read triangles and vertices, as words. Loaded where a scene needs
 * it.
 */
export function compactKernel(parts?: KernelParts): KernelParts {
  const swapped = new Map<WgslModule, WgslModule>();
  const swap = (module: WgslModule): WgslModule => {
    let found = swapped.get(module);
    if (!found) {
      // Readers need what the modules that they replace need.
      const deps = module.deps.map((dep) => ('flag' in dep ? { ...dep, module: swap(dep.module) } : swap(dep)));
      swapped.set(module, (found = { ...(READERS.get(module.name) ?? module), deps }));
    }
    return found;
  };
  const bind: KernelParts['bind'] = (groups) =>
    groups.map((group) => ({
      ...group,
      bindings: group.bindings.map((binding) =>
        binding.name === 'triangles' ? { ...binding, type: 'array<vec4u>' } : binding,
      ),
    }));
  return { ...parts, bind, swap };
}
