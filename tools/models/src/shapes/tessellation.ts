/** How finely curved shapes are cut into triangles, in the way CAD exporters put it. Lengths are millimetres. */
export interface Tessellation {
  /** Largest distance between a curve and its chord, mm. */
  readonly deviation: number;
  /** Largest angle between neighbouring chords, radians. */
  readonly angle: number;
}

/** Chords for an arc: as many as the stricter of the two limits asks for, at least one. */
export function arcSegments(radius: number, angle: number, { deviation, angle: step }: Tessellation): number {
  const sweep = Math.abs(angle);
  if (sweep === 0 || radius <= 0) return 1;
  const byDeviation = radius > deviation ? sweep / (2 * Math.acos(1 - deviation / radius)) : 1;
  // A hair of tolerance keeps rounding from adding a chord.
  return Math.max(1, Math.ceil(Math.max(byDeviation, sweep / step) - 1e-9));
}

/** Chords for a full circle: a multiple of 4, so that quadrants agree, at least 8. */
export function circleSegments(radius: number, tessellation: Tessellation): number {
  return Math.max(8, 4 * arcSegments(radius, Math.PI / 2, tessellation));
}

/** Whether a rounding, tooth or thread of this size is too small to be worth triangles. */
export function isNegligible(size: number, { deviation }: Tessellation): boolean {
  return size < 3.5 * deviation;
}
