import { wgslModule, type WgslModule } from '@glanz/wgsl/module';
import { checkedStackSize } from './stack-size';

/** The hit that a ray queries: the nearest one, or whether there is any. */
export type BvhQuery = 'closest' | 'any';

/**
 * A traversal with a stack of so many entries, in text that the composer adds: `BVH_CLOSEST_STACK` or `BVH_ANY_STACK`,
 * and `…_GUARD`, whether the stack may be too small for the trees after all. Hits are lost then, but rays come to an
 * end.
 *
 * @param types What the host's functions and the traversal are about.
 * @param max Entries that are enough for all trees.
 * @throws {BvhError} `bvh/options`
 */
export function withStack(
  traversal: WgslModule,
  types: WgslModule,
  query: BvhQuery,
  size: number,
  max: number,
): WgslModule {
  const name = `BVH_${query.toUpperCase()}`;
  const stack = wgslModule(
    `bvh/${query}-stack`,
    `const ${name}_STACK=${checkedStackSize(size, max)}u;const ${name}_GUARD=${size < max};`,
  );
  return wgslModule(`${traversal.name}-with-stack`, '', [types, stack, traversal]);
}
