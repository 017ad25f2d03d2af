import { GROUP_MAX } from '../builders/agglomerate';
import { cutCell, cutCells, type Clusters } from '../builders/clusters';
import { NONE, type Sorted } from '../builders/gather';
import { ClusterTrees } from '../builders/cluster-trees';
import { NodeWriter } from '../builders/node-writer';
import { LEAF, LEFT, NODE_WORDS, PARENT, RIGHT } from '../layout';
import type { Team } from './team';

/** Clusters that a worker takes at a time: about a millisecond. */
const CHUNK = 256;

/** The trees in the clusters, before their nodes are moved together. */
export interface Inner {
  readonly clusters: Clusters;
  readonly writer: NodeWriter;
  /** Triangles in leaf order. */
  readonly leaves: Uint32Array;
  /** The end of the nodes that are in their final positions. */
  readonly end: number;
  /** The chunk from which on there are gaps, and for each chunk where its nodes begin and end. */
  readonly apart: number;
  readonly borders: Uint32Array;
  /** How many nodes there are with those over the clusters. */
  readonly nodeCount: number;
}

/**
 * Cuts primitives into clusters and builds the trees inside, as `cutClusters` and `ClusterTrees` do. The first worker
 * takes clusters from the front, the second from the back, until they meet.
 */
export function shareClusterTrees(primitives: Sorted, triangleCount: number, maxLeaf: number, team: Team): Inner {
  const { names } = primitives;
  const { starts, count } = shareCells(primitives, team);
  const clusters: Clusters = {
    primitives,
    starts,
    count,
    boxes: team.float32(6 * count),
    weights: team.uint32(count),
    references: team.uint32(count),
  };
  const writer = writerOver(team.memory.nodes, primitives.count);
  const leaves = team.uint32(triangleCount);
  const trees = new ClusterTrees(clusters, writer, leaves, maxLeaf);
  const chunks = Math.ceil(count / CHUNK),
    borders = team.uint32(2 * chunks);
  writer.count = count - 1;
  let done = 0;
  for (let leavesEnd = triangleCount; team.take(2) < chunks; done++) {
    const chunk = team.index === 0 ? done : chunks - 1 - done;
    const from = chunk * CHUNK,
      to = Math.min(count, from + CHUNK);
    if (team.index === 1) {
      // As if each cluster before had the maximum number of nodes.
      borders[2 * chunk] = writer.count = count - 1 + (starts[from] as number) - from;
      for (let i = starts[from] as number; i < (starts[to] as number); i++)
        leavesEnd -= names[2 * i + 1] === NONE ? 1 : 2;
      trees.end = leavesEnd;
    }
    trees.build(from, to);
    if (team.index === 1) borders[2 * chunk + 1] = writer.count;
  }
  const [first] = team.meet([done, writer.count]);
  const apart = first[0] as number,
    end = first[1] as number;
  let nodeCount = end;
  for (let chunk = apart; chunk < chunks; chunk++)
    nodeCount += (borders[2 * chunk + 1] as number) - (borders[2 * chunk] as number);
  return { clusters, writer, leaves, end, apart, borders, nodeCount };
}

/**
 * Copies the nodes in the clusters to their final positions in new memory, with room for the others before them.
 * Updates the `references`, which must not be read meanwhile.
 */
export function placeClusterTrees({
  clusters: { references, count },
  writer,
  end,
  apart,
  borders,
  nodeCount,
}: Inner): NodeWriter {
  const placed = new NodeWriter(nodeCount);
  const { nodes, words } = placed;
  const before = (count - 1) * NODE_WORDS;
  nodes.set(writer.nodes.subarray(before, end * NODE_WORDS), before);
  placed.count = end;
  for (let chunk = apart; 2 * chunk < borders.length; chunk++) {
    const from = borders[2 * chunk] as number,
      to = borders[2 * chunk + 1] as number,
      by = from - placed.count;
    const first = placed.count * NODE_WORDS;
    nodes.set(writer.nodes.subarray(from * NODE_WORDS, to * NODE_WORDS), first);
    placed.count = to - by;
    if (by === 0) continue;
    for (let base = first; base < placed.count * NODE_WORDS; base += NODE_WORDS) {
      for (const word of [LEFT, RIGHT])
        if ((words[base + word] as number) < LEAF) words[base + word] = (words[base + word] as number) - by;
      words[base + PARENT] = (words[base + PARENT] as number) - by;
    }
    for (let cluster = chunk * CHUNK; cluster < Math.min(count, (chunk + 1) * CHUNK); cluster++)
      if ((references[cluster] as number) < LEAF) references[cluster] = (references[cluster] as number) - by;
  }
  return placed;
}

/** A writer over shared memory. */
export const writerOver = (buffer: SharedArrayBuffer, capacity: number) =>
  new NodeWriter(capacity, buffer as ArrayBufferLike as ArrayBuffer);

/** Cuts clusters; each worker those of about half of the primitives. */
function shareCells({ codes, count }: Sorted, team: Team): Pick<Clusters, 'starts' | 'count'> {
  // There are fewer clusters than primitives; the position of the second worker's is known once the first has cut its
  // own.
  const all = team.uint32(count + 1),
    behindMiddle = team.uint32(count + 1),
    own = team.index === 0 ? all : behindMiddle;
  // The border of cells closest to the middle, and the ranges still to be cut there.
  const ends = [count];
  let border = 0;
  for (let end = count; end - border > GROUP_MAX; end = ends[ends.length - 1] as number) {
    const cut = cutCell(codes, border, end);
    if (cut <= count / 2) border = cut;
    else ends.push(cut);
  }
  const cells =
    team.index === 0
      ? cutCells(codes, GROUP_MAX, own, [count], 0, border)
      : cutCells(codes, GROUP_MAX, own, ends, border, count);
  const [before, behind] = team.meet([cells]);
  const middle = before[0] as number;
  if (team.index === 1) all.set(own.subarray(0, cells + 1), middle);
  team.meet();
  return { starts: all, count: middle + (behind[0] as number) };
}
