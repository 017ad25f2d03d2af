import { linearToHuntLab, linearToYcxcz, srgbToLinear, ycxczToLinear } from './colour';
import { featureFilters, filterPlane, sensitivityFilters } from './kernels';

/** Options for {@link flip}. */
export interface FlipOptions {
  /** How large pixels appear. Default: 67.02, a 0.7 m wide display of 3840 pixels seen from 0.7 m. */
  readonly pixelsPerDegree?: number;
}

/** The outcome of {@link flip}. */
export interface FlipResult {
  /** Mean of the map: 0 where nobody sees a difference, at most 1. */
  readonly mean: number;
  /** A value for each pixel, 0..1, top row first. */
  readonly map: Float32Array;
}

const DEFAULT_PIXELS_PER_DEGREE = 0.7 * (3840 / 0.7) * (Math.PI / 180);
/** Exponents of the colour and the feature difference. */
const [QC, QF] = [0.7, 0.5];
/** Colour differences up to the share PC of the largest one use the range up to PT. */
const [PC, PT] = [0.4, 0.95];

type Planes = readonly [Float64Array, Float64Array, Float64Array];

function opponentPlanes(srgb: ArrayLike<number>, pixels: number): Planes {
  const planes = [new Float64Array(pixels), new Float64Array(pixels), new Float64Array(pixels)] as const;
  const linear = (code: number) => srgbToLinear(Math.min(Math.max(code, 0), 1));
  for (let i = 0; i < pixels; i++) {
    const value = linearToYcxcz(linear(srgb[3 * i]!), linear(srgb[3 * i + 1]!), linear(srgb[3 * i + 2]!));
    for (let c = 0; c < 3; c++) planes[c]![i] = value[c]!;
  }
  return planes;
}

/** What the eye resolves of an image, in the space in which differences are measured. */
function perceived(planes: Planes, width: number, height: number, pixelsPerDegree: number): Planes {
  const filters = sensitivityFilters(pixelsPerDegree);
  const filtered = planes.map((plane, channel) => {
    const sum = new Float64Array(plane.length);
    for (const { weight, taps } of filters[channel]!)
      filterPlane(plane, width, height, taps, taps).forEach((value, i) => (sum[i]! += weight * value));
    return sum;
  });
  const out = planes.map((plane) => new Float64Array(plane.length)) as unknown as Planes;
  const clamp = (x: number) => Math.min(Math.max(x, 0), 1);
  for (let i = 0; i < planes[0].length; i++) {
    const [r, g, b] = ycxczToLinear(filtered[0]![i]!, filtered[1]![i]!, filtered[2]![i]!);
    const lab = linearToHuntLab(clamp(r), clamp(g), clamp(b));
    for (let c = 0; c < 3; c++) out[c]![i] = lab[c]!;
  }
  return out;
}

const hyab = (dL: number, da: number, db: number) => Math.abs(dL) + Math.hypot(da, db);

function largestColourDifference(): number {
  const green = linearToHuntLab(0, 1, 0),
    blue = linearToHuntLab(0, 0, 1);
  return hyab(green[0] - blue[0], green[1] - blue[1], green[2] - blue[2]) ** QC;
}

/** Strength of edges and points at each pixel. */
function features(
  achromatic: Float64Array,
  width: number,
  height: number,
  pixelsPerDegree: number,
): { readonly edge: Float64Array; readonly point: Float64Array } {
  const { blur, edge, point } = featureFilters(pixelsPerDegree);
  const plane = achromatic.map((y) => (y + 16) / 116);
  const strength = (taps: typeof edge) => {
    const x = filterPlane(plane, width, height, taps, blur);
    const y = filterPlane(plane, width, height, blur, taps);
    return x.map((value, i) => Math.hypot(value, y[i]!));
  };
  return { edge: strength(edge), point: strength(point) };
}

/** What the eye gets from an image, see {@link seen}. */
export interface SeenImage {
  readonly width: number;
  readonly height: number;
  /** Hunt-adjusted CIELAB of what it resolves. */
  readonly lab: Planes;
  readonly edge: Float64Array;
  readonly point: Float64Array;
}

/**
 * The half of {@link flip} that concerns one image, for those that are compared with many.
 *
 * @param image RGB, stride 3, as displayed: sRGB codes 0..1, top row first.
 */
export function seen(
  image: ArrayLike<number>,
  width: number,
  height: number,
  { pixelsPerDegree = DEFAULT_PIXELS_PER_DEGREE }: FlipOptions = {},
): SeenImage {
  const pixels = width * height;
  if (image.length !== 3 * pixels) throw new RangeError(`flip: images must have 3 × ${width} × ${height} values`);
  const planes = opponentPlanes(image, pixels);
  return {
    width,
    height,
    lab: perceived(planes, width, height, pixelsPerDegree),
    ...features(planes[0], width, height, pixelsPerDegree),
  };
}

/**
 * The difference that a person notices who flips between two images at the same place: ꟻLIP for displayed (LDR)
 * images, after Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "ꟻLIP: A Difference Evaluator
 * for Alternating Images", 2020. Symmetric in the two.
 *
 * @param reference RGB, stride 3, as displayed: sRGB codes 0..1, top row first.
 * @param test As `reference`.
 */
export function flip(
  reference: ArrayLike<number>,
  test: ArrayLike<number>,
  width: number,
  height: number,
  options: FlipOptions = {},
): FlipResult {
  return flipOfSeen(seen(reference, width, height, options), seen(test, width, height, options));
}

/** {@link flip} of two images of the same size. */
export function flipOfSeen(a: SeenImage, b: SeenImage): FlipResult {
  const pixels = a.width * a.height;
  const largest = largestColourDifference();
  const knee = PC * largest;
  const map = new Float32Array(pixels);
  let sum = 0;
  for (let i = 0; i < pixels; i++) {
    const difference =
      hyab(a.lab[0][i]! - b.lab[0][i]!, a.lab[1][i]! - b.lab[1][i]!, a.lab[2][i]! - b.lab[2][i]!) ** QC;
    const colour =
      difference < knee ? (difference * PT) / knee : PT + ((difference - knee) / (largest - knee)) * (1 - PT);
    const feature =
      (Math.max(Math.abs(a.edge[i]! - b.edge[i]!), Math.abs(a.point[i]! - b.point[i]!)) / Math.SQRT2) ** QF;
    const value = Math.min(Math.max(colour, 0), 1) ** (1 - Math.min(feature, 1));
    map[i] = value;
    sum += value;
  }
  return { mean: sum / pixels, map };
}
