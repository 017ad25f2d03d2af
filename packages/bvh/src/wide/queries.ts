import type { TriangleMesh } from '../layout';
import { intersectTriangle, prepareRay, RAY_NUMBERS } from '../cpu/triangle';
import type { Hit, Ray } from '../cpu/queries';
import { WIDE_NODE, WIDE_STACK_SIZE, WIDE_WORDS, WIDTH } from './layout';
import type { WideBlas } from './widen';

/** Traverses the tree as the WGSL twin does. */
function search(
  { nodes, triangleIndices, bounds }: WideBlas,
  { positions, indices }: TriangleMesh,
  { origin, direction, tMin = 0, tMax = Infinity }: Ray,
  any: boolean,
): Hit | undefined {
  if (triangleIndices.length === 0) return undefined;
  const ray = new Float64Array(RAY_NUMBERS),
    hit = new Float64Array(3);
  prepareRay(ray, origin, direction, bounds);
  const floats = new Float32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  let found: Hit | undefined;
  let end = tMax;
  // Nodes first and which of them: the highest bit is the next.
  const firsts = new Uint32Array(WIDE_STACK_SIZE),
    masks = new Uint32Array(WIDE_STACK_SIZE),
    inner = new Uint8Array(WIDE_STACK_SIZE);
  const octant =
    ((ray[3] as number) >= 0 ? 4 : 0) | ((ray[4] as number) >= 0 ? 2 : 0) | ((ray[5] as number) >= 0 ? 1 : 0);
  let top = 0,
    first = 0,
    mask = 1 << octant,
    kinds = 0;
  for (;;) {
    if (mask === 0) {
      if (top === 0) return found;
      first = firsts[--top] as number;
      mask = masks[top] as number;
      kinds = inner[top] as number;
    }
    const bit = 31 - Math.clz32(mask);
    mask ^= 1 << bit;
    if (mask !== 0) {
      firsts[top] = first;
      masks[top] = mask;
      inner[top++] = kinds;
    }
    const below = kinds & ((1 << (bit ^ octant)) - 1);
    const at = WIDE_WORDS * (first + bitCount(below));
    const byte = (i: number) => ((nodes[at + (i >> 2)] as number) >>> (8 * (i & 3))) & 255;
    first = nodes[at + 4] as number;
    kinds = byte(15);
    mask = 0;
    let nearest = end;
    for (let slot = 0; slot < WIDTH; slot++) {
      const kind = byte(24 + slot);
      if (kind === 0) continue;
      let near = tMin,
        far = nearest;
      for (let k = 0; k < 3; k++) {
        const step = 2 ** (byte(12 + k) - 127),
          low = floats[at + k] as number;
        const a = (low + byte(32 + 8 * k + slot) * step - (ray[15 + k] as number)) * (ray[3 + k] as number);
        const b = (low + byte(56 + 8 * k + slot) * step - (ray[18 + k] as number)) * (ray[3 + k] as number);
        near = Math.max(near, Math.min(a, b));
        far = Math.min(far, Math.max(a, b));
      }
      if (!(near <= far + Math.abs(far) * 2 ** -50)) continue;
      if (kind >= WIDE_NODE) {
        mask |= 1 << (slot ^ octant);
        continue;
      }
      const start = (nodes[at + 5] as number) + (kind & 31);
      for (let i = start; i < start + (kind >> 5); i++) {
        const triangle = triangleIndices[i] as number;
        const corner = (c: number) => 3 * (indices ? (indices[3 * triangle + c] as number) : 3 * triangle + c);
        if (!intersectTriangle(ray, positions, corner(0), corner(1), corner(2), hit)) continue;
        const t = hit[0] as number;
        if (!(t > tMin && t < end)) continue;
        end = nearest = t;
        found = { t, u: hit[1] as number, v: hit[2] as number, triangle };
        if (any) return found;
      }
    }
  }
}

function bitCount(bits: number): number {
  let count = 0;
  for (let rest = bits; rest !== 0; rest &= rest - 1) count++;
  return count;
}

/**
 * The nearest triangle that a ray meets, from the wide layout: what `closestHit` finds. In double precision,
 * watertight.
 */
export function closestHitWide(blas: WideBlas, mesh: TriangleMesh, ray: Ray): Hit | undefined {
  return search(blas, mesh, ray, false);
}

/** Whether a ray meets any triangle, from the wide layout. */
export function anyHitWide(blas: WideBlas, mesh: TriangleMesh, ray: Ray): boolean {
  return search(blas, mesh, ray, true) !== undefined;
}
