import type { TriangleMesh } from '../blas';
import { GROUP_MAX } from '../build/agglomerate';
import { buildBalanced } from '../build/balanced';
import type { BuildSettings } from '../build/builder';
import { cutCell, cutCells, type Clusters } from '../build/clusters';
import { Gatherer, NONE, type Sorted } from '../build/gather';
import { CLUSTER_DEPTH, Insides } from '../build/insides';
import { encloseNodes, Levels } from '../build/levels';
import { MortonSort } from '../build/morton';
import { NodeWriter } from '../build/node-writer';
import { PrimitiveMaker } from '../build/primitives';
import { crown, STEP, type Steps, type TriangleTree } from '../build/steps';
import { BLAS_MAX_DEPTH, LEAF, LEFT, NODE_WORDS, PARENT, RIGHT } from '../layout';
import type { Team } from './team';
import { shareCrown, shareLevels, shareRotations } from './together-upper';

const DIGIT = 10;
const DIGITS = 1 << DIGIT;

function finish<T>(steps: Steps<T>): T {
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}

/** Hands out what it was given, in that order. */
const prepared = (floats: readonly Float32Array[], words: readonly Uint32Array[]) => {
  const f = [...floats], w = [...words];
  return { float32: () => f.shift() as Float32Array<ArrayBuffer>, uint32: () => w.shift() as Uint32Array<ArrayBuffer> };
};

/**
 * The tree of `balanced`, bit for bit, by two workers: each does its half of the triangles, of the sorting, of the clusters
 * and of the upper levels.
 *
 * @param mesh With arrays that both see.
 * @returns The tree, to the first; undefined to the second.
 * @throws {BvhError} as `buildBlas`; `bvh/worker` where the other one has given up.
 */
export function buildTogether(mesh: TriangleMesh, count: number, settings: BuildSettings, team: Team): TriangleTree | undefined {
  const { index } = team;
  const { maxLeaf, bins } = settings;
  const pairs = maxLeaf > 1;
  // Where the second one begins, at a border of the steps in which one worker would do all.
  const half = (length: number) => Math.min(length, Math.ceil(Math.ceil(length / STEP) / 2) * STEP);
  const range = (length: number, middle: number) => (index === 0 ? ([0, middle] as const) : ([middle, length] as const));

  // Triangles to primitives.
  const boxes = team.float32(6 * count), triangles = team.uint32(count);
  const [from, to] = range(count, half(count));
  const maker = new PrimitiveMaker(mesh, to - from, pairs, prepared([boxes.subarray(6 * from)], [triangles.subarray(from)]));
  for (let at = from; at < to; at += STEP) maker.add(at, Math.min(to, at + STEP));
  const made = team.meet([maker.count, maker.triangleCount, ...maker.bounds]);
  const bounds = maker.bounds.map((_, k) => (k < 3 ? Math.min : Math.max)(made[0][2 + k] as number, made[1][2 + k] as number));
  const total = (made[0][0] as number) + (made[1][0] as number), triangleCount = (made[0][1] as number) + (made[1][1] as number);
  // Little work, or all on one spot: not worth sharing.
  if (total < 4 * STEP) return index === 0 ? finish(buildBalanced(mesh, count, settings)) : undefined;

  // Codes, and the sort by three digits.
  maker.bounds.set(bounds);
  let order = team.uint32(total), codes = team.uint32(total), order2 = team.uint32(total), codes2 = team.uint32(total);
  const offset = index === 0 ? 0 : (made[0][0] as number);
  const none = new Uint32Array(0);
  new MortonSort(maker, prepared([], [order.subarray(offset), codes.subarray(offset), none, none])).encode(0, maker.count);
  if (index === 1) for (let i = offset; i < total; i++) order[i] = (order[i] as number) + from;
  team.meet();
  const histograms = [team.uint32(DIGITS), team.uint32(DIGITS)] as const;
  const [first, end] = range(total, total >>> 1);
  for (let pass = 0; pass < 3; pass++) {
    const own = histograms[index] as Uint32Array, shift = pass * DIGIT;
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
      const code = codes[i] as number, digit = (code >>> shift) & (DIGITS - 1);
      const place = starts[digit] as number;
      starts[digit] = place + 1;
      codes2[place] = code;
      order2[place] = order[i] as number;
    }
    team.meet();
    [order, order2] = [order2, order];
    [codes, codes2] = [codes2, codes];
  }

  // Into that order, with pairs; the second half moves up to the first.
  const sorted = { boxes: team.float32(6 * total), names: team.uint32(2 * total) };
  const [g0, g1] = range(total, half(total));
  const gatherer = new Gatherer({ boxes, triangles, count: g1 - g0, bounds }, order.subarray(g0), codes.subarray(g0), pairs, prepared([sorted.boxes.subarray(6 * g0)], [sorted.names.subarray(2 * g0)]));
  for (let at = 0; at < g1 - g0; at += STEP) gatherer.add(at, Math.min(g1 - g0, at + STEP));
  const gathered = team.meet([gatherer.count]);
  const [left, right] = [gathered[0][0] as number, gathered[1][0] as number];
  if (index === 0 && left < half(total)) {
    const behind = half(total);
    for (const [array, stride] of [[sorted.boxes, 6], [sorted.names, 2], [codes, 1]] as const) array.copyWithin(stride * left, stride * behind, stride * (behind + right));
  }
  team.meet();
  const primitives: Sorted = { ...sorted, codes, count: left + right };

  // Clusters, each those of its half; their starts each for itself, what is found out about them for both.
  const starts = index === 0 ? order2 : codes2;
  const { middle, count: clusterCount } = shareCells(primitives, starts, team);
  const clusters: Clusters = { primitives, starts, count: clusterCount, boxes: team.float32(6 * clusterCount), weights: team.uint32(clusterCount), references: team.uint32(clusterCount) };
  const { references } = clusters;
  const writer = writerOver(team.memory.nodes, primitives.count);
  const leaves = team.uint32(triangleCount);
  const insides = new Insides(clusters, writer, leaves, maxLeaf);
  const [c0, c1] = range(clusterCount, middle);
  // As if each cluster before had all the nodes that it can have.
  writer.count = clusters.count - 1 + (starts[c0] as number) - c0;
  for (let i = 0; i < (starts[c0] as number); i++) insides.end += primitives.names[2 * i + 1] === NONE ? 1 : 2;
  const begun = writer.count;
  insides.build(c0, c1);
  const ends = team.meet([writer.count, begun]);
  const nodeCount = (ends[0][0] as number) + (ends[1][0] as number) - (ends[1][1] as number);
  if (index === 1) moveDown(writer, begun, begun - (ends[0][0] as number), references, c0, c1);
  writer.count = nodeCount;

  const depth = BLAS_MAX_DEPTH - CLUSTER_DEPTH;
  const upper = writerOver(team.memory.upper, clusters.count);
  shareLevels(new Levels(upper, clusters, depth, bins), upper, team);
  shareRotations(upper, team);
  const rotated = shareCrown(upper, clusters, writer, depth, team);
  if (index === 1) return undefined;
  if (rotated > depth) {
    upper.count = 0;
    const levels = new Levels(upper, clusters, depth, bins);
    while (levels.step(Infinity));
    encloseNodes(upper, 0, upper.count);
    finish(crown(upper, clusters, writer));
  }
  // Slices have memory of their own again.
  return { nodes: writer.nodes.slice(0, writer.count * NODE_WORDS), nodeCount: writer.count, triangleIndices: leaves.slice(), bounds };
}

/** A writer over shared memory; everywhere but here it has memory of its own. */
const writerOver = (buffer: SharedArrayBuffer, capacity: number) => new NodeWriter(capacity, buffer as ArrayBufferLike as ArrayBuffer);

/**
 * Cuts clusters, each those of about a half.
 *
 * @param starts Gets where one's own begin, at their places among all. There are fewer clusters than primitives.
 * @returns Where the second one's begin, and how many there are.
 */
function shareCells({ codes, count }: Sorted, starts: Uint32Array, team: Team): { readonly middle: number; readonly count: number } {
  // The border of cells that lies next to the middle, and what is still to be cut there.
  const ends = [count];
  let border = 0;
  for (let end = count; end - border > GROUP_MAX; end = ends[ends.length - 1] as number) {
    const cut = cutCell(codes, border, end);
    if (cut <= count / 2) border = cut;
    else ends.push(cut);
  }
  const cells = team.index === 0 ? cutCells(codes, GROUP_MAX, starts, [count], 0, border) : cutCells(codes, GROUP_MAX, starts, ends, border, count);
  const [before, behind] = team.meet([cells]);
  const middle = before[0] as number;
  if (team.index === 1) starts.copyWithin(middle, 0, cells + 1);
  return { middle, count: middle + (behind[0] as number) };
}

/** Moves the nodes from `begun` on, and all that names them, down by some places. */
function moveDown({ nodes, words, count }: NodeWriter, begun: number, by: number, references: Uint32Array, c0: number, c1: number): void {
  if (by === 0) return;
  for (let base = begun * NODE_WORDS; base < count * NODE_WORDS; base += NODE_WORDS) {
    for (const word of [LEFT, RIGHT]) if ((words[base + word] as number) < LEAF) words[base + word] = (words[base + word] as number) - by;
    words[base + PARENT] = (words[base + PARENT] as number) - by;
  }
  nodes.copyWithin((begun - by) * NODE_WORDS, begun * NODE_WORDS, count * NODE_WORDS);
  for (let cluster = c0; cluster < c1; cluster++) if ((references[cluster] as number) < LEAF) references[cluster] = (references[cluster] as number) - by;
}
