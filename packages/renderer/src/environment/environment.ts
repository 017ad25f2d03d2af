import type { Environment, LatLongEnvironment } from '@glanz/scene';
import { ENVIRONMENT_ROW_START } from '../storage/layout';

/** What the GPU needs to know about the environment. */
export interface EnvironmentData {
  /** RGBA float pixels of the lat-long image, stride 4; absent for constant light. */
  readonly pixels?: { readonly width: number; readonly height: number; readonly data: Float32Array<ArrayBuffer> };
  /** Multiplies the pixels, or is the constant radiance itself. */
  readonly radiance: readonly [number, number, number];
  /** Cosine and sine of the rotation about +Y. */
  readonly rotation: readonly [number, number];
  readonly visible: boolean;
  /**
   * Importance cells, RGBA: distribution within the row, distribution of the rows, density over the unit square, and
   * where searches of both distributions begin, see {@link searchStarts}; absent when sampling by the BSDF alone is as
   * good.
   */
  readonly table?: { readonly width: number; readonly height: number; readonly data: Float32Array<ArrayBuffer> };
  /** Mean luminance over the sphere. */
  readonly meanLuminance: number;
  /** What the image gives at every rotation and intensity; absent for constant light. */
  readonly image?: PreparedImage;
}

/** What is computed from the texels of a lat-long image, and serves every rotation and intensity of it. */
interface PreparedImage {
  /** The texels as the scene has them. */
  readonly source: Float32Array;
  /** The importance cells, which an image without light does not use. */
  readonly table: EnvironmentData['table'];
  /** Mean luminance over the sphere at an intensity of 1. */
  readonly mean: number;
}

const MAX_CELLS = [ENVIRONMENT_ROW_START, 512] as const;

const luminance = (r: number, g: number, b: number) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** Pixels that are processed between two yields: about a millisecond. */
const STEP = 1 << 15;

/** Prepares an environment for the GPU. A constant one needs no table: BSDF sampling finds it everywhere. */
export function prepareEnvironment(environment: Environment | undefined): EnvironmentData {
  const steps = environmentSteps(environment);
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}

/** The same as {@link prepareEnvironment} in steps of a millisecond or so, for `inSlices` of `@glanz/scene`. */
export function* environmentSteps(environment: Environment | undefined): Generator<void, EnvironmentData> {
  if (!environment) return { radiance: [0, 0, 0], rotation: [1, 0], visible: true, meanLuminance: 0 };
  const visible = environment.visible ?? true;
  if (environment.type === 'constant') {
    return {
      radiance: environment.radiance,
      rotation: [1, 0],
      visible,
      meanLuminance: luminance(...environment.radiance),
    };
  }
  const { width, height, data } = environment;
  const pixels = new Float32Array(width * height * 4);
  for (let from = 0; from < width * height; from += STEP) {
    copyPixels(pixels, data, from, Math.min(width * height, from + STEP));
    yield;
  }
  const { table, mean } = yield* importance(environment, pixels);
  return placed(environment, { width, height, data: pixels }, { source: data, table, mean });
}

/** An image at the rotation and intensity of an environment. */
function placed(
  environment: LatLongEnvironment,
  pixels: EnvironmentData['pixels'] & object,
  image: PreparedImage,
): EnvironmentData {
  const { intensity = 1, rotation = 0, visible = true } = environment;
  return {
    pixels,
    radiance: [intensity, intensity, intensity],
    rotation: [Math.cos(rotation), Math.sin(rotation)],
    visible,
    ...(image.table && intensity > 0 ? { table: image.table } : {}),
    meanLuminance: image.mean * intensity,
    image,
  };
}

/** Rows and columns of an image that {@link roughEnvironment} looks at. */
const ROUGH = 32;

/** What a first image needs of an environment: how bright it is on average, from some of its pixels. */
export function roughEnvironment(environment: Environment | undefined): EnvironmentData {
  if (environment?.type !== 'latlong') return prepareEnvironment(environment);
  const { width, height, data, intensity = 1, visible = true } = environment;
  let sum = 0;
  let solid = 0;
  for (let i = 0; i < ROUGH; i++) {
    const sine = Math.sin((Math.PI * (i + 0.5)) / ROUGH);
    for (let j = 0; j < ROUGH; j++) {
      const pixel = 3 * (Math.floor((height * (i + 0.5)) / ROUGH) * width + Math.floor((width * (j + 0.5)) / ROUGH));
      const [r, g, b] = data.subarray(pixel, pixel + 3) as unknown as [number, number, number];
      sum += sine * luminance(r, g, b);
      solid += sine;
    }
  }
  return {
    radiance: [intensity, intensity, intensity],
    rotation: [1, 0],
    visible,
    meanLuminance: (intensity * sum) / solid,
  };
}

function copyPixels(pixels: Float32Array, data: Float32Array, from: number, to: number): void {
  for (let i = from; i < to; i++) {
    for (let c = 0; c < 3; c++) {
      const value = data[3 * i + c] as number;
      // An image with broken pixels must not poison the film.
      pixels[4 * i + c] = value > 0 ? Math.min(value, 3e38) : 0;
    }
    pixels[4 * i + 3] = 1;
  }
}

/** Does something for each row, with a stop once in a while. */
function* eachRow(width: number, height: number, work: (y: number) => void): Generator<void> {
  const rows = Math.max(1, Math.floor(STEP / width));
  for (let y = 0; y < height; y++) {
    work(y);
    if (y % rows === rows - 1) yield;
  }
}

/**
 * Whether an environment has the texels of one that was prepared before. The array decides, not the numbers in it: they
 * must not change in place.
 */
export function hasSameTexels(
  before: EnvironmentData,
  environment: Environment | undefined,
): environment is LatLongEnvironment {
  const { pixels, image } = before;
  if (environment?.type !== 'latlong' || !image || environment.data !== image.source) return false;
  return environment.width === pixels?.width && environment.height === pixels.height;
}

/** The same image at another rotation or intensity, without reading its texels; `undefined` if it is another image. */
export function turnEnvironment(
  before: EnvironmentData,
  environment: Environment | undefined,
): EnvironmentData | undefined {
  if (!before.pixels || !before.image || !hasSameTexels(before, environment)) return undefined;
  return placed(environment, before.pixels, before.image);
}

/**
 * Luminance of the image, texel by texel; of a large one averaged over the cells of a coarser grid, as it is read:
 * bilinearly.
 */
function* cellLuminance(
  source: LatLongEnvironment,
  pixels: Float32Array,
): Generator<void, { width: number; height: number; values: Float64Array }> {
  const { width: w, height: h } = source;
  if (w <= MAX_CELLS[0] && h <= MAX_CELLS[1]) {
    const values = new Float64Array(w * h);
    yield* eachRow(w, h, (y) => {
      for (let i = y * w; i < (y + 1) * w; i++)
        values[i] = luminance(pixels[4 * i] as number, pixels[4 * i + 1] as number, pixels[4 * i + 2] as number);
    });
    return { width: w, height: h, values };
  }
  // The mean of a bilinear interpolant over a texel's square weighs the neighbours 1 : 6 : 1.
  const rows = new Float64Array(w * h);
  const own = (x: number, y: number) => {
    const i = 4 * (y * w + ((x + w) % w));
    return luminance(pixels[i] as number, pixels[i + 1] as number, pixels[i + 2] as number);
  };
  yield* eachRow(w, h, (y) => {
    for (let x = 0; x < w; x++) rows[y * w + x] = (own(x - 1, y) + 6 * own(x, y) + own(x + 1, y)) / 8;
  });
  const width = Math.min(w, MAX_CELLS[0]);
  const height = Math.min(h, MAX_CELLS[1]);
  const values = new Float64Array(width * height);
  const areas = new Float64Array(width * height);
  const row = (x: number, y: number) => rows[Math.min(Math.max(y, 0), h - 1) * w + x] as number;
  // Each texel gives to the cells it overlaps, so no bright texel is lost when the sizes do not divide.
  yield* eachRow(w, h, (y) => {
    const y0 = (y * height) / h;
    const y1 = ((y + 1) * height) / h;
    for (let x = 0; x < w; x++) {
      const value = (row(x, y - 1) + 6 * row(x, y) + row(x, y + 1)) / 8;
      const x0 = (x * width) / w;
      const x1 = ((x + 1) * width) / w;
      for (let cy = Math.floor(y0); cy < y1; cy++) {
        for (let cx = Math.floor(x0); cx < x1; cx++) {
          const area = (Math.min(y1, cy + 1) - Math.max(y0, cy)) * (Math.min(x1, cx + 1) - Math.max(x0, cx));
          values[cy * width + cx] = (values[cy * width + cx] as number) + value * area;
          areas[cy * width + cx] = (areas[cy * width + cx] as number) + area;
        }
      }
    }
  });
  for (let i = 0; i < values.length; i++) values[i] = (values[i] as number) / (areas[i] as number);
  return { width, height, values };
}

/**
 * Where the search for a number in a distribution begins (the guide table of Chen and Asau 1974, "On Generating Random
 * Variates from an Empirical Distribution"): of each of 2ⁿ equal bins of 0 to 1, as many as there are cells or fewer,
 * the first cell that ends above the bin's lower edge. A power of two, since a number times that is exact: shaders find
 * the same bin.
 */
function searchStarts(ends: Float32Array): Uint32Array {
  const bins = 2 ** Math.floor(Math.log2(ends.length));
  const starts = new Uint32Array(bins);
  let cell = 0;
  for (let bin = 0; bin < bins; bin++) {
    while (cell < ends.length - 1 && (ends[cell] as number) <= bin / bins) cell++;
    starts[bin] = cell;
  }
  return starts;
}

/**
 * The distribution over cells. Densities are lowered by the mean radiance (MIS compensation, Karlík et al. 2019): what
 * BSDF sampling finds well anyway is left to it.
 */
function* importance(
  source: LatLongEnvironment,
  pixels: Float32Array,
): Generator<void, { table?: EnvironmentData['table'] & object; mean: number }> {
  const { width, height, values } = yield* cellLuminance(source, pixels);
  let sum = 0;
  let solid = 0;
  const sines = Array.from(
    { length: height },
    (_, y) => Math.cos((y * Math.PI) / height) - Math.cos(((y + 1) * Math.PI) / height),
  );
  yield* eachRow(width, height, (y) => {
    for (let x = 0; x < width; x++) sum += (values[y * width + x] as number) * (sines[y] as number);
    solid += (sines[y] as number) * width;
  });
  const mean = sum / solid;
  const weights = new Float64Array(width * height);
  let total = 0;
  yield* eachRow(width, height, (y) => {
    for (let x = 0; x < width; x++)
      total += weights[y * width + x] = Math.max((values[y * width + x] as number) - mean, 0) * (sines[y] as number);
  });
  if (!(total > 0 && total < Infinity)) return { mean };
  const data = new Float32Array(width * height * 4);
  const columns = new Float32Array(width);
  const rows = new Float32Array(height);
  let above = 0;
  yield* eachRow(width, height, (y) => {
    const row = weights.subarray(y * width, (y + 1) * width);
    const rowTotal = row.reduce((a, b) => a + b, 0);
    above += rowTotal;
    let before = 0;
    for (let x = 0; x < width; x++) {
      const i = 4 * (y * width + x);
      before += row[x] as number;
      data[i] = columns[x] = rowTotal > 0 ? before / rowTotal : 1;
      data[i + 1] = rows[y] = above / total;
      data[i + 2] = ((row[x] as number) / total) * width * height;
    }
    searchStarts(columns).forEach((start, bin) => (data[4 * (y * width + bin) + 3] = start));
  });
  searchStarts(rows).forEach((start, bin) => (data[4 * bin * width + 3]! += ENVIRONMENT_ROW_START * start));
  return { table: { width, height, data }, mean };
}
