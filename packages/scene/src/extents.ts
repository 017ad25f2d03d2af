import type { Mesh } from './mesh';
import type { Scene } from './scene';
import { STEP, type Steps } from './slices';
import { RUN, usedVertices, type UsedVertices } from './used-vertices';

type Vector = readonly [number, number, number];

/** Used vertices by mesh, each found once. */
export type FoundVertices = Map<Mesh, UsedVertices>;

/** Runs of vertices visited between two yields. */
const STEP_RUNS = STEP / RUN;
/** Instances visited between two yields. */
const STEP_INSTANCES = STEP / 16;

/**
 * How far the visible triangles' vertices extend in world space along each of several directions: the largest dot
 * product of the direction and (vertex − `center`); −∞ without vertices. Exact, in doubles. Vertices are skipped only
 * where their bounding box extends no farther than a vertex already found, so that of many instances only those at the
 * border of the scene are measured vertex by vertex.
 */
export function* extentSteps(
  { instances, meshes }: Scene,
  directions: readonly Vector[],
  center: Vector,
  found: FoundVertices,
): Steps<Float64Array> {
  const extents = new Float64Array(directions.length).fill(-Infinity);
  const row = new Float64Array(4);
  const visible = function* () {
    let seen = 0;
    for (const { mesh: index, transform, visible } of instances) {
      if (++seen % STEP_INSTANCES === 0) yield;
      const mesh = meshes[index];
      if (visible === false || !mesh) continue;
      let vertices = found.get(mesh);
      if (!vertices) found.set(mesh, (vertices = yield* usedVertices(mesh)));
      if (vertices.first >= 0) yield { mesh, vertices, transform };
    }
  };
  // Start with one vertex of each instance, so that the second pass can skip whatever lies inside of these.
  for (const part of visible()) {
    if (!part) yield;
    else {
      const { mesh, vertices, transform } = part;
      directions.forEach((direction, i) => {
        setRow(row, direction, transform, center);
        extents[i] = reach(extents[i] as number, row, mesh.positions, vertices, vertices.first, vertices.first + 1);
      });
    }
  }
  for (const part of visible()) {
    if (!part) {
      yield;
      continue;
    }
    const { mesh, vertices, transform } = part;
    const runs = vertices.boxes.length / 6 - 1;
    for (let i = 0; i < directions.length; i++) {
      setRow(row, directions[i] as Vector, transform, center);
      if (farthest(row, vertices.boxes, 6 * runs) <= (extents[i] as number)) continue;
      for (let from = 0; from < runs; from += STEP_RUNS) {
        extents[i] = reachOfRuns(
          extents[i] as number,
          row,
          mesh.positions,
          vertices,
          from,
          Math.min(runs, from + STEP_RUNS),
        );
        if (from > 0) yield;
      }
    }
  }
  return extents;
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
function farthest(row: Float64Array, boxes: Float32Array, at: number): number {
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
