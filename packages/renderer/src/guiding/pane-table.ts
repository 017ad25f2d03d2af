import type { Instance, Material, Mesh, Scene } from '@glanz/scene';
import type { EnvironmentData } from '../environment/environment';
import { PANE_BINS, PANE_COLUMNS, PANE_ROWS, PANE_WIDTH } from './pane_constants.wesl';

/** The share of directions that are chosen towards light that panes reflect. */
const REFLECTED = 0.2;
/** The environment is read by so many cells in a row, and half as many rows. */
const CELLS = 128;
/** A plane of panes has this share of their area at least. */
const MIN_AREA = 0.2;
/** Slopes of the normals that a light is reflected by: of a plane, and those that a normal map adds. */
const SLOPES = [0, 0.01, 0.02] as const;
const MAPPED_SLOPES = [0.03, 0.04, 0.06, 0.08] as const;
/** Bins, triangles and texels of a step. */
const BINS = 64;
const TRIANGLES = 1 << 13;
const TEXELS = 1 << 15;
/** Normals of each slope. */
const AROUND = 8;

type Vector = readonly [number, number, number];

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/**
 * The table of a guide towards light of the environment that panes reflect to matte surfaces: light samples do not find
 * it, and continuations seldom meet a small light. A bin's probability follows the root of the second moment of the
 * light that comes from it, if it is a pane all over.
 *
 * @param panes Instances of thin walls. Flat ones count; others are left to the surfaces' own samples.
 * @returns The numbers of guide.wesl for one leaf, in rows of `width`; in steps of about a millisecond.
 */
export function* paneTableSteps(
  scene: Pick<Scene, 'meshes' | 'materials'>,
  panes: readonly Instance[],
  environment: Pick<EnvironmentData, 'table' | 'rotation'>,
): Generator<void, { readonly table: Float32Array<ArrayBuffer>; readonly width: number }> {
  const table = new Float32Array(PANE_WIDTH * Math.ceil((2 + PANE_BINS) / PANE_WIDTH));
  table[0] = 1;
  const mapped = panes.some(({ material }) => (scene.materials[material] as Material).textures?.geometry_normal);
  const slopes = mapped ? [...SLOPES, ...MAPPED_SLOPES] : SLOPES;
  const normals = (yield* planesOf(scene, panes)).flatMap((plane) => tilted(plane, slopes));
  const bright = yield* brightness(environment);
  const moments = new Float64Array(PANE_BINS);
  for (let bin = 0; bin < PANE_BINS; bin++) {
    if (bin % BINS === 0) yield;
    const from = middleOf(bin);
    for (const normal of normals) {
      const k = 2 * dot(from, normal);
      moments[bin]! += bright([from[0] - k * normal[0], from[1] - k * normal[1], from[2] - k * normal[2]]);
    }
  }
  const total = moments.reduce((sum, moment) => sum + Math.sqrt(moment), 0);
  let below = 0;
  moments.forEach((moment, bin) => {
    if (total > 0) below += (REFLECTED * Math.sqrt(moment)) / total;
    table[2 + bin] = below;
  });
  return { table, width: PANE_WIDTH };
}

/** The middle of a bin of guide_bins.wesl. */
function middleOf(bin: number): Vector {
  const x = (2 * (Math.floor(bin / PANE_COLUMNS) + 0.5)) / PANE_ROWS - 1;
  const around = (((bin % PANE_COLUMNS) + 0.5) / PANE_COLUMNS - 0.5) * 2 * Math.PI;
  const r = Math.sqrt(1 - x * x);
  return [x, r * Math.cos(around), r * Math.sin(around)];
}

/** Normals of the planes that most of the panes lie in. */
function* planesOf({ meshes }: Pick<Scene, 'meshes'>, panes: readonly Instance[]): Generator<void, Vector[]> {
  const planes: { readonly normal: Vector; area: number }[] = [];
  let total = 0;
  for (const { mesh, transform: m } of panes) {
    const { positions, indices } = meshes[mesh] as Mesh;
    for (let t = 0; t + 2 < indices.length; t += 3) {
      if (t % (3 * TRIANGLES) === 0) yield;
      const [a, b, c] = [0, 1, 2].map((k) => 3 * (indices[t + k] as number)) as [number, number, number];
      const edge = (to: number): Vector => {
        const [x, y, z] = [0, 1, 2].map((r) => positions[to + r]! - positions[a + r]!) as [number, number, number];
        const row = (r: number) => m[r]! * x + m[4 + r]! * y + m[8 + r]! * z;
        return [row(0), row(1), row(2)];
      };
      const face = cross(edge(b), edge(c));
      const area = Math.hypot(...face);
      if (!(area > 0)) continue;
      const normal: Vector = [face[0] / area, face[1] / area, face[2] / area];
      total += area;
      const plane = planes.find((one) => Math.abs(dot(one.normal, normal)) > 0.999);
      if (plane) plane.area += area;
      // Of a curved pane every triangle would be a plane of its own.
      else if (planes.length < 64) planes.push({ normal, area });
    }
  }
  return planes.filter(({ area }) => area >= MIN_AREA * total).map(({ normal }) => normal);
}

/** Unit normals around one. */
function tilted(normal: Vector, slopes: readonly number[]): Vector[] {
  const axis = cross(normal, Math.abs(normal[1]) < 0.5 ? [0, 1, 0] : [1, 0, 0]);
  const length = Math.hypot(...axis);
  const a: Vector = [axis[0] / length, axis[1] / length, axis[2] / length];
  const b = cross(normal, a);
  return slopes.flatMap((slope) =>
    Array.from({ length: AROUND }, (_, k): Vector => {
      const turn = (2 * Math.PI * k) / AROUND + 100 * slope;
      const [u, v] = [slope * Math.cos(turn), slope * Math.sin(turn)];
      const norm = 1 / Math.hypot(1, slope);
      const part = (r: 0 | 1 | 2) => norm * (normal[r] + u * a[r] + v * b[r]);
      return [part(0), part(1), part(2)];
    }),
  );
}

/**
 * The squared radiance of the environment in a direction, up to a factor: the highest of the cell there and those
 * around it, since it is interpolated; 0 below the square of the mean.
 */
function* brightness({
  table,
  rotation,
}: Pick<EnvironmentData, 'table' | 'rotation'>): Generator<void, (towards: Vector) => number> {
  if (!table) return () => 0;
  const { width, height, data } = table;
  const [columns, rows] = [Math.min(CELLS, width), Math.min(CELLS / 2, height)];
  const cells = new Float64Array(columns * rows);
  let mean = 0;
  const rowsOfStep = Math.ceil(TEXELS / width);
  for (let y = 0; y < height; y++) {
    if (y % rowsOfStep === 0) yield;
    // The density over the unit square is that of the sphere times the sine.
    const sine = Math.sin(((y + 0.5) / height) * Math.PI);
    const row = Math.floor((y * rows) / height) * columns;
    for (let x = 0; x < width; x++) {
      const density = data[4 * (y * width + x) + 2] as number;
      cells[row + Math.floor((x * columns) / width)]! += (density / sine) ** 2;
      mean += density / (width * height);
    }
  }
  // Of an evenly bright sphere the radiance is π / 2 times the mean density.
  const threshold = (((2 * mean) / Math.PI) ** 2 * (width * height)) / cells.length;
  const dilated = cells.map((_, i) => {
    let highest = 0;
    for (let y = Math.max(0, Math.floor(i / columns) - 1); y < Math.min(rows, Math.floor(i / columns) + 2); y++)
      for (let x = -1; x <= 1; x++)
        highest = Math.max(highest, cells[y * columns + ((i + x + columns) % columns)] as number);
    return highest > threshold ? highest : 0;
  });
  const [cosine, sine] = rotation;
  return ([x, y, z]) => {
    const around = Math.atan2(sine * x + cosine * z, cosine * x - sine * z) / (2 * Math.PI) + 0.5;
    const row = Math.min(Math.floor((Math.acos(Math.max(-1, Math.min(1, y))) / Math.PI) * rows), rows - 1);
    return dilated[row * columns + Math.min(Math.floor(around * columns), columns - 1)] as number;
  };
}
