/** What the tree needs to know of lights. */
export interface TreeLights {
  /** Lowest and highest corner, stride 6. */
  readonly bounds: Float64Array;
  /** Unit vector that it shines along, stride 3. */
  readonly axes: Float64Array;
  /** Largest angle between the axis and a normal, radians: 0 for a flat light, π for one that shines all around. */
  readonly spreads: Float64Array;
  /** Angle from a normal up to which it shines, radians. */
  readonly reaches: Float64Array;
  /** Irradiance at a distance of 1 m, face to face: radiance × area, or radiant intensity. */
  readonly energies: Float64Array;
}

/** Numbers that bound some lights: lowest and highest corner, axis, then the four below. */
export const STRIDE = 13;
export const AXIS = 6;
export const SPREAD = 9;
export const REACH = 10;
export const ENERGY = 11;
/** Cosine of the spread. */
const COS = 12;

/** More than rounding moves a cosine. */
const CLEARLY = 1e-9;

/**
 * Bounds of lights and of sets of lights, in one array: the lights' own first, then places for sums. No objects, since
 * every level of the tree goes over all lights twice, in a scene's first moments, when nothing is compiled yet.
 */
export class BoundsStore {
  readonly values: Float64Array;

  constructor(count: number, sums: number) {
    this.values = new Float64Array(STRIDE * (count + sums));
  }

  /** Takes in the bounds of the lights from one index to another. */
  take(lights: TreeLights, from: number, to: number): void {
    const { values } = this;
    for (let i = from; i < to; i++) {
      for (let k = 0; k < 6; k++) values[STRIDE * i + k] = lights.bounds[6 * i + k] as number;
      for (let k = 0; k < 3; k++) values[STRIDE * i + AXIS + k] = lights.axes[3 * i + k] as number;
      values[STRIDE * i + SPREAD] = lights.spreads[i] as number;
      values[STRIDE * i + REACH] = lights.reaches[i] as number;
      values[STRIDE * i + ENERGY] = lights.energies[i] as number;
      values[STRIDE * i + COS] = Math.cos(lights.spreads[i] as number);
    }
  }

  copy(to: number, from: number): void {
    this.values.copyWithin(STRIDE * to, STRIDE * from, STRIDE * from + STRIDE);
  }

  /** Grows the bounds at `to` by those at `from`: the box around both, and the smallest cone around two. */
  unite(to: number, from: number): void {
    const v = this.values;
    const a = STRIDE * to;
    const b = STRIDE * from;
    if ((v[b] as number) < (v[a] as number)) v[a] = v[b] as number;
    if ((v[b + 1] as number) < (v[a + 1] as number)) v[a + 1] = v[b + 1] as number;
    if ((v[b + 2] as number) < (v[a + 2] as number)) v[a + 2] = v[b + 2] as number;
    if ((v[b + 3] as number) > (v[a + 3] as number)) v[a + 3] = v[b + 3] as number;
    if ((v[b + 4] as number) > (v[a + 4] as number)) v[a + 4] = v[b + 4] as number;
    if ((v[b + 5] as number) > (v[a + 5] as number)) v[a + 5] = v[b + 5] as number;
    v[a + ENERGY] = (v[a + ENERGY] as number) + (v[b + ENERGY] as number);
    if ((v[b + REACH] as number) > (v[a + REACH] as number)) v[a + REACH] = v[b + REACH] as number;
    const spreadA = v[a + SPREAD] as number,
      spreadB = v[b + SPREAD] as number;
    if (spreadA >= Math.PI) return;
    const ax = v[a + AXIS] as number,
      ay = v[a + AXIS + 1] as number,
      az = v[a + AXIS + 2] as number;
    const bx = v[b + AXIS] as number,
      by = v[b + AXIS + 1] as number,
      bz = v[b + AXIS + 2] as number;
    const cos = Math.min(1, Math.max(-1, ax * bx + ay * by + az * bz));
    // Most lights are flat, and within the cone of those before them.
    if (spreadB === 0 && cos > (v[a + COS] as number) + CLEARLY) return;
    const between = Math.acos(cos);
    if (Math.min(between + spreadB, Math.PI) <= spreadA) return;
    if (Math.min(between + spreadA, Math.PI) <= spreadB) {
      v.copyWithin(a + AXIS, b + AXIS, b + SPREAD + 1);
      v[a + COS] = v[b + COS] as number;
      return;
    }
    const spread = (spreadA + between + spreadB) / 2;
    // From a's axis towards b's: the part of b's across a's, where there is one.
    const x = bx - cos * ax,
      y = by - cos * ay,
      z = bz - cos * az;
    const length = Math.sqrt(x * x + y * y + z * z);
    if (spread >= Math.PI || length < 1e-9) {
      v[a + SPREAD] = Math.PI;
      v[a + COS] = -1;
      return;
    }
    const turn = spread - spreadA;
    const along = Math.cos(turn);
    const aside = Math.sin(turn) / length;
    v[a + AXIS] = along * ax + aside * x;
    v[a + AXIS + 1] = along * ay + aside * y;
    v[a + AXIS + 2] = along * az + aside * z;
    v[a + SPREAD] = spread;
    v[a + COS] = Math.cos(spread);
  }

  /** What it costs to have these lights in one node: energy, times where they are, times where they shine. */
  cost(at: number): number {
    const v = this.values;
    const a = STRIDE * at;
    const x = (v[a + 3] as number) - (v[a] as number);
    const y = (v[a + 4] as number) - (v[a + 1] as number);
    const z = (v[a + 5] as number) - (v[a + 2] as number);
    const spread = v[a + SPREAD] as number;
    const all = Math.min(spread + (v[a + REACH] as number), Math.PI);
    const sin = Math.sin(spread),
      cos = v[a + COS] as number;
    // Directions that the cone shines into, weighed by the cosine beyond its spread.
    const solidAngle =
      2 * Math.PI * (1 - cos) + (Math.PI / 2) * (2 * all * sin - Math.cos(spread - 2 * all) - 2 * spread * sin + cos);
    return (v[a + ENERGY] as number) * solidAngle * (x * y + y * z + z * x);
  }
}
