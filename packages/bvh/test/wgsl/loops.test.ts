import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, it } from 'vitest';

/** The function in a shader source, without what is before it. */
const loop = (file: string) => {
  const text = readFileSync(join(import.meta.dirname, '../../src/wgsl', file), 'utf8');
  return text.slice(text.indexOf('\nfn '));
};

// Two loops per layout, since a switch at run time costs registers: they must not drift apart.
it.each(['', 'wide/wide_'])('%sany_hit.wesl is closest_hit.wesl that ends at the first hit', (layout) => {
  const ended = loop(`${layout}closest_hit.wesl`)
    .replace('bvh_closest_hit', 'bvh_any_hit')
    .replaceAll('BVH_CLOSEST_', 'BVH_ANY_')
    .replace('-> BvhHit', '-> bool')
    .replace('  var hit = BvhHit(t_max, 0.0, 0.0, 0u, BVH_MISS);\n', '')
    .replaceAll('hit.t)', 't_max)')
    .replace('hit = candidate;', 'return true;')
    .replace('return hit;', 'return false;');
  expect(loop(`${layout}any_hit.wesl`)).toBe(ended);
});
