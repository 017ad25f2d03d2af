import type { Instance, Scene } from './scene';
import type { Mesh } from './mesh';
import { STEP, type Steps } from './slices';
import { RUN, usedVertices, type UsedVertices } from './used-vertices';

type Vector = readonly [number, number, number];

/** What {@link extentSteps} finds out about a scene, kept for other directions. */
export interface ExtentCache {
  /** Used vertices by mesh, each found once. */
  readonly vertices: Map<Mesh, UsedVertices>;
  /**
   * Bounds in the world of each {@link GROUP} consecutive instances, enlarged by their rounding errors: min xyz, max xyz.
   */
  boxes?: Float64Array;
}

/** Instances that share a box. */
const GROUP = 16;
/** Runs of vertices, or groups of instances, visited between two yields. */
const STEP_RUNS = STEP / RUN;
/** Well above the relative rounding error of a few operations in doubles. */
const SLACK = 2 ** -44;

/**
 * How far the visible triangles' vertices extend in world space along each of several directions: the largest dot
 * product of the direction and (vertex − `center`); −∞ without vertices. Exact, in doubles. Vertices are skipped only
 * where their bounding box extends no farther than a vertex already found, so that of many instances only those at the
 * border of the scene are measured vertex by vertex.
 */
export function* extentSteps(
  scene: Scene,
  directions: readonly Vector[],
  center: Vector,
  cache: ExtentCache,
): Steps<Float64Array> {
  const { instances, meshes } = scene;
  const boxes = (cache.boxes ??= yield* boxSteps(scene, cache));
  const extents = new Float64Array(directions.length).fill(-Infinity);
  const row = new Float64Array(4);
  const groups = boxes.length / 6;
  for (const [i, direction] of directions.entries()) {
    const [x, y, z] = direction;
    const slack = SLACK * Math.hypot(...center) * Math.hypot(x, y, z);
    const bound = Float64Array.of(x, y, z, slack - x * center[0] - y * center[1] - z * center[2]);
    let extent = -Infinity;
    // Start where the bounds extend farthest, so that most of the rest is skipped.
    let first = 0;
    for (let group = 0; group < groups; group++)
      if (farthest(bound, boxes, 6 * group) > farthest(bound, boxes, 6 * first)) first = group;
    for (let next = -1; next < groups; next++) {
      if (next % STEP_RUNS === 0) yield;
      const group = next < 0 ? first : next;
      if (farthest(bound, boxes, 6 * group) <= extent) continue;
      for (const { mesh: index, transform, visible } of instances.slice(GROUP * group, GROUP * (group + 1))) {
        const mesh = meshes[index];
        const vertices = mesh && cache.vertices.get(mesh);
        if (visible === false || !vertices) continue;
        setRow(row, direction, transform, center);
        const runs = vertices.boxes.length / 6 - 1;
        if (farthest(row, vertices.boxes, 6 * runs) <= extent) continue;
        for (let from = 0; from < runs; from += STEP_RUNS) {
          extent = reachOfRuns(extent, row, mesh.positions, vertices, from, Math.min(runs, from + STEP_RUNS));
          if (from > 0) yield;
        }
      }
    }
    extents[i] = extent;
  }
  return extents;
}

/** Finds the boxes of groups of instances. */
function* boxSteps({ instances, meshes }: Scene, cache: ExtentCache): Steps<Float64Array> {
  const boxes = new Float64Array(6 * Math.ceil(instances.length / GROUP)).map((_, i) =>
    i % 6 < 3 ? Infinity : -Infinity,
  );
  // By index: iterators of entries make an array for each of perhaps a million.
  for (let i = 0; i < instances.length; i++) {
    const { mesh: index, transform: m, visible } = instances[i] as Instance;
    if (i % 4096 === 4095) yield;
    const mesh = meshes[index];
    if (visible === false || !mesh) continue;
    let vertices = cache.vertices.get(mesh);
    if (!vertices) cache.vertices.set(mesh, (vertices = yield* usedVertices(mesh)));
    const own = vertices.boxes;
    const from = own.length - 6,
      to = 6 * Math.floor(i / GROUP);
    if (own[from] === Infinity) continue;
    for (let r = 0; r < 3; r++) {
      let low = m[12 + r] as number,
        high = low,
        size = Math.abs(low);
      for (let k = 0; k < 3; k++) {
        const p = (m[4 * k + r] as number) * (own[from + k] as number),
          q = (m[4 * k + r] as number) * (own[from + 3 + k] as number);
        low += p < q ? p : q;
        high += p < q ? q : p;
        size += Math.abs(p) + Math.abs(q);
      }
      size *= SLACK;
      boxes[to + r] = Math.min(boxes[to + r] as number, low - size);
      boxes[to + 3 + r] = Math.max(boxes[to + 3 + r] as number, high + size);
    }
  }
  return boxes;
}

/** The affine function of an object-space vertex that gives its extent: three factors and a constant. */
function setRow(row: Float64Array, [x, y, z]: Vector, m: ArrayLike<number>, center: Vector): void {
  for (let k = 0; k < 3; k++)
    row[k] = x * (m[4 * k] as number) + y * (m[4 * k + 1] as number) + z * (m[4 * k + 2] as number);
  row[3] =
    x * ((m[12] as number) - center[0]) + y * ((m[13] as number) - center[1]) + z * ((m[14] as number) - center[2]);
}

/**
 * Upper bound on the extent of vertices within a box. Rounds as {@link reach} does, thus never below a vertex in it.
 */
function farthest(row: Float64Array, boxes: Float32Array | Float64Array, at: number): number {
  const a = row[0] as number,
    b = row[1] as number,
    c = row[2] as number;
  return (
    a * (boxes[at + (a > 0 ? 3 : 0)] as number) +
    b * (boxes[at + (b > 0 ? 4 : 1)] as number) +
    c * (boxes[at + (c > 0 ? 5 : 2)] as number) +
    (row[3] as number)
  );
}

function reachOfRuns(
  extent: number,
  row: Float64Array,
  positions: Float32Array,
  vertices: UsedVertices,
  from: number,
  to: number,
): number {
  for (let run = from; run < to; run++) {
    if (farthest(row, vertices.boxes, 6 * run) <= extent) continue;
    extent = reach(extent, row, positions, vertices, run * RUN, Math.min(vertices.used.length, (run + 1) * RUN));
  }
  return extent;
}

function reach(
  extent: number,
  row: Float64Array,
  positions: Float32Array,
  { used }: UsedVertices,
  from: number,
  to: number,
): number {
  const a = row[0] as number,
    b = row[1] as number,
    c = row[2] as number,
    d = row[3] as number;
  for (let i = from, v = 3 * from; i < to; i++, v += 3) {
    if (used[i] === 0) continue;
    const value =
      a * (positions[v] as number) + b * (positions[v + 1] as number) + c * (positions[v + 2] as number) + d;
    if (value > extent) extent = value;
  }
  return extent;
}
