import type { TreeLights } from '../src/lights/light-bounds';
import { LIGHT_TREE_DISTANT, LIGHT_TREE_LEAF, LIGHT_TREE_NODE, type LightTree } from '../src/lights/light-tree';

/** Random numbers in [0, 1) by Mulberry32. */
export function random(seed: number): () => number {
  let a = seed;
  return () => {
    a = (a + 0x6d2b79f5) | 0;
    let t = Math.imul(a ^ (a >>> 15), 1 | a);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** A uniform unit vector. */
export function randomUnit(next: () => number): [number, number, number] {
  const z = 2 * next() - 1;
  const phi = 2 * Math.PI * next();
  const r = Math.sqrt(1 - z * z);
  return [r * Math.cos(phi), r * Math.sin(phi), z];
}

/** Lights of all kinds in a cube of edge 2 around the origin: flat, cones, all around. */
export function randomLights(count: number, seed: number): TreeLights {
  const next = random(seed);
  const lights: TreeLights = {
    bounds: new Float64Array(6 * count),
    axes: new Float64Array(3 * count),
    spreads: new Float64Array(count),
    reaches: new Float64Array(count),
    energies: new Float64Array(count),
  };
  for (let i = 0; i < count; i++) {
    lights.axes.set(randomUnit(next), 3 * i);
    for (let k = 0; k < 3; k++) {
      const low = 2 * next() - 1;
      lights.bounds[6 * i + k] = low;
      lights.bounds[6 * i + 3 + k] = low + 0.2 * next() ** 4;
    }
    const kind = Math.floor(3 * next());
    lights.spreads[i] = [0, 0.5 * next(), Math.PI][kind]!;
    lights.reaches[i] = kind === 1 ? next() : Math.PI / 2;
    lights.energies[i] = 0.01 + next() ** 3;
  }
  return lights;
}

/** The nodes of a tree, as objects. */
export function treeNodes({ count, values, kinds, links }: LightTree) {
  const { center, radius, axis, cosSpread, cosReach, energy, stride } = LIGHT_TREE_NODE;
  return Array.from({ length: count }, (_, node) => {
    const at = (place: number) => values[stride * node + place]!;
    const leaf = (kinds[node]! & LIGHT_TREE_LEAF) !== 0;
    return {
      center: [at(center), at(center + 1), at(center + 2)] as const,
      radius: at(radius),
      axis: [at(axis), at(axis + 1), at(axis + 2)] as const,
      cosSpread: at(cosSpread),
      cosReach: at(cosReach),
      energy: at(energy),
      distant: (kinds[node]! & LIGHT_TREE_DISTANT) !== 0,
      light: leaf ? links[node] : undefined,
      child: leaf ? undefined : links[node],
    };
  });
}
