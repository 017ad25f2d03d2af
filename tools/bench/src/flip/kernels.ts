/** A filter along one axis: taps at −radius … radius. */
export interface Taps {
  readonly radius: number;
  readonly weights: Float64Array;
}

function sampled(radius: number, f: (offset: number) => number): Taps {
  return { radius, weights: Float64Array.from({ length: 2 * radius + 1 }, (_, i) => f(i - radius)) };
}

const sum = (values: Float64Array) => values.reduce((total, value) => total + value, 0);

/**
 * A term of a contrast sensitivity function in space: `weight` × a Gaussian, in taps that are applied along both axes.
 */
export interface SensitivityTerm {
  readonly weight: number;
  readonly taps: Taps;
}

/** a and b of `a √(π/b) exp(−π² x² / b)`, x in degrees: two terms for each of the three channels. */
const SENSITIVITY = [
  [[1, 0.0047]],
  [[1, 0.0053]],
  [
    [34.1, 0.04],
    [13.5, 0.025],
  ],
] as const;

/**
 * The contrast sensitivity of the eye to the channels achromatic, red–green, blue–yellow. The terms of each sum to 1.
 */
export function sensitivityFilters(pixelsPerDegree: number): SensitivityTerm[][] {
  const radius = Math.ceil(3 * Math.sqrt(0.04 / (2 * Math.PI ** 2)) * pixelsPerDegree);
  return SENSITIVITY.map((terms) => {
    const parts = terms.map(([a, b]) => {
      const taps = sampled(radius, (offset) => Math.exp((-(Math.PI ** 2) * (offset / pixelsPerDegree) ** 2) / b));
      return { weight: a * Math.sqrt(Math.PI / b), taps, total: sum(taps.weights) };
    });
    const whole = parts.reduce((total, part) => total + part.weight * part.total ** 2, 0);
    return parts.map(({ weight, taps, total }) => ({
      weight: (weight * total ** 2) / whole,
      taps: { radius, weights: taps.weights.map((w) => w / total) },
    }));
  });
}

/**
 * Along one axis: a Gaussian, its slope and its curvature, the latter two with positive and negative taps that sum to
 * ±1.
 */
export interface FeatureFilters {
  readonly blur: Taps;
  readonly edge: Taps;
  readonly point: Taps;
}

/** Detectors of edges and points as wide as the eye's own. */
export function featureFilters(pixelsPerDegree: number): FeatureFilters {
  const sigma = 0.5 * 0.082 * pixelsPerDegree;
  const radius = Math.ceil(3 * sigma);
  const gauss = (x: number) => Math.exp(-(x * x) / (2 * sigma * sigma));
  const balanced = ({ weights }: Taps): Taps => {
    const positive = sum(weights.map((w) => Math.max(w, 0)));
    const negative = -sum(weights.map((w) => Math.min(w, 0)));
    return { radius, weights: weights.map((w) => w / (w > 0 ? positive : negative)) };
  };
  const blur = sampled(radius, gauss);
  const total = sum(blur.weights);
  return {
    blur: { radius, weights: blur.weights.map((w) => w / total) },
    edge: balanced(sampled(radius, (x) => -x * gauss(x))),
    point: balanced(sampled(radius, (x) => ((x * x) / (sigma * sigma) - 1) * gauss(x))),
  };
}

/** Filters a plane along x with one set of taps and along y with another; what lies outside repeats the edge. */
export function filterPlane(
  plane: Float64Array,
  width: number,
  height: number,
  alongX: Taps,
  alongY: Taps,
): Float64Array {
  const rows = new Float64Array(plane.length);
  const { radius } = alongX;
  const padded = new Float64Array(width + 2 * radius);
  for (let y = 0; y < height; y++) {
    const [from, to] = [y * width, (y + 1) * width];
    padded.fill(plane[from]!, 0, radius);
    padded.set(plane.subarray(from, to), radius);
    padded.fill(plane[to - 1]!, radius + width);
    for (let x = 0; x < width; x++) {
      let value = 0;
      for (let k = 0; k <= 2 * radius; k++) value += alongX.weights[k]! * padded[x + k]!;
      rows[from + x] = value;
    }
  }
  const out = new Float64Array(plane.length);
  for (let y = 0; y < height; y++) {
    for (let k = -alongY.radius; k <= alongY.radius; k++) {
      const weight = alongY.weights[k + alongY.radius]!;
      const from = Math.min(Math.max(y + k, 0), height - 1) * width;
      for (let x = 0; x < width; x++) out[y * width + x]! += weight * rows[from + x]!;
    }
  }
  return out;
}
