import type { TriangleMesh } from '../layout';
import { Gatherer, type Sorted } from '../builders/gather';
import { MortonSort } from '../builders/morton';
import { PrimitiveMaker } from '../builders/primitives';
import type { Memory } from '../builders/scratch';
import { STEP } from '../builders/steps';
import type { Team } from './team';

const DIGIT = 10;
const DIGITS = 1 << DIGIT;

/** An allocator that returns given arrays, in order. */
const prepared = (floats: readonly Float32Array[], words: readonly Uint32Array[]): Memory => {
  const f = [...floats],
    w = [...words];
  return { float32: () => f.shift() as Float32Array<ArrayBuffer>, uint32: () => w.shift() as Uint32Array<ArrayBuffer> };
};

/** Where the second worker's half begins, at a border of a single worker's steps. */
const half = (length: number) => Math.min(length, Math.ceil(Math.ceil(length / STEP) / 2) * STEP);

/** Triangles as primitives; each step's begin at the index of its first triangle, with gaps between steps. */
interface Parts {
  readonly boxes: Float32Array;
  readonly triangles: Uint32Array;
  /** Primitives of each step. */
  readonly counts: Uint32Array;
  /** Of all. */
  readonly count: number;
  readonly triangleCount: number;
  /** Box of all: min xyz, max xyz. */
  readonly bounds: Float64Array;
}

/** How many entries must have been copied for the triangles before `end`; positions come first. */
function needed({ positions, indices }: TriangleMesh, end: number, { memory }: Team): number {
  const copied = ({ buffer, length }: Float32Array | Uint32Array | Uint16Array, upTo = length) =>
    buffer === (memory.mesh as unknown) ? Math.min(length, upTo) : 0;
  if (!indices) return copied(positions, 9 * end);
  // 16-bit indices are widened before the first triangle.
  return copied(positions) + copied(indices, indices instanceof Uint16Array ? undefined : 3 * end);
}

/** Makes primitives of a mesh's triangles, as `PrimitiveMaker` does; the mesh may still be being copied. */
export function sharePrimitives(mesh: TriangleMesh, count: number, pairs: boolean, team: Team): Parts {
  team.copied(needed(mesh, 0, team));
  const boxes = team.float32(6 * count),
    triangles = team.uint32(count),
    counts = team.uint32(Math.ceil(count / STEP));
  const maker = new PrimitiveMaker(mesh, count, pairs, prepared([boxes], [triangles]));
  let own = 0;
  for (let step = team.take(0); step < counts.length; step = team.take(0)) {
    const from = (maker.count = step * STEP),
      to = Math.min(count, from + STEP);
    team.copied(needed(mesh, to, team));
    maker.add(from, to);
    own += counts[step] = maker.count - from;
  }
  const made = team.meet([own, maker.triangleCount, ...maker.bounds]);
  const sum = (k: number) => (made[0][k] as number) + (made[1][k] as number);
  const bounds = maker.bounds.map((_, k) =>
    (k < 3 ? Math.min : Math.max)(made[0][2 + k] as number, made[1][2 + k] as number),
  );
  return { boxes, triangles, counts, count: sum(0), triangleCount: sum(1), bounds };
}

/** Sorts primitives along a space-filling curve and copies them into that order, as `MortonSort` and `Gatherer` do. */
export function shareSorting(parts: Parts, pairs: boolean, team: Team): Sorted {
  const { index } = team;
  const { boxes, triangles, counts, count, bounds } = parts;

  let order = team.uint32(count),
    codes = team.uint32(count),
    order2 = team.uint32(count),
    codes2 = team.uint32(count);
  const none = new Uint32Array(0);
  for (let step = 0, place = 0, next = team.take(1); step < counts.length; place += counts[step++] as number) {
    if (step !== next) continue;
    const from = step * STEP,
      own = counts[step] as number;
    const sort = new MortonSort(
      { boxes: boxes.subarray(6 * from), triangles, count: own, bounds },
      prepared([], [order.subarray(place), codes.subarray(place), none, none]),
    );
    sort.encode(0, own);
    for (let i = place; i < place + own; i++) order[i] = (order[i] as number) + from;
    next = team.take(1);
  }
  team.meet();

  const histograms = [team.uint32(DIGITS), team.uint32(DIGITS)] as const;
  const middle = count >>> 1;
  const [first, end] = index === 0 ? [0, middle] : [middle, count];
  for (let pass = 0; pass < 3; pass++) {
    const own = histograms[index] as Uint32Array,
      shift = pass * DIGIT;
    own.fill(0);
    for (let i = first; i < end; i++) {
      const digit = ((codes[i] as number) >>> shift) & (DIGITS - 1);
      own[digit] = (own[digit] as number) + 1;
    }
    team.meet();
    const starts = new Uint32Array(DIGITS);
    for (let digit = 0, sum = 0; digit < DIGITS; digit++) {
      starts[digit] = sum + (index === 0 ? 0 : (histograms[0][digit] as number));
      sum += (histograms[0][digit] as number) + (histograms[1][digit] as number);
    }
    for (let i = first; i < end; i++) {
      const code = codes[i] as number,
        digit = (code >>> shift) & (DIGITS - 1);
      const place = starts[digit] as number;
      starts[digit] = place + 1;
      codes2[place] = code;
      order2[place] = order[i] as number;
    }
    team.meet();
    [order, order2] = [order2, order];
    [codes, codes2] = [codes2, codes];
  }

  // Pairs leave a gap: the second half moves up to the first.
  const sorted = { boxes: team.float32(6 * count), names: team.uint32(2 * count) };
  const [from, to] = index === 0 ? [0, half(count)] : [half(count), count];
  const gatherer = new Gatherer(
    { boxes, triangles, count: to - from, bounds },
    order.subarray(from),
    codes.subarray(from),
    pairs,
    prepared([sorted.boxes.subarray(6 * from)], [sorted.names.subarray(2 * from)]),
  );
  for (let at = 0; at < to - from; at += STEP) gatherer.add(at, Math.min(to - from, at + STEP));
  const gathered = team.meet([gatherer.count]);
  const [left, right] = [gathered[0][0] as number, gathered[1][0] as number];
  if (index === 0 && left < half(count)) {
    const behind = half(count);
    for (const [array, stride] of [
      [sorted.boxes, 6],
      [sorted.names, 2],
      [codes, 1],
    ] as const)
      array.copyWithin(stride * left, stride * behind, stride * (behind + right));
  }
  team.meet();
  return { ...sorted, codes, count: left + right };
}
