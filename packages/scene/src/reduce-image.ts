import type { Steps } from './slices';
import type { CompressedImage, Image } from './texture';
import { levelSize } from './texture-levels';

type Pixels = Image['data'];

const srgbToLinear = (c: number) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);

/** Codes as numbers that may be averaged. */
const decodingTable = (isSrgb: boolean) =>
  Float32Array.from({ length: 256 }, (_, code) => (isSrgb ? srgbToLinear(code / 255) : code / 255));

/** Intervals of the table that an encoder begins its search with. */
const STEPS = 4096;

/** Rounds a linear number to the nearest code of sRGB. */
function srgbEncoder(): (value: number) => number {
  // From `limits[code]` on, the next code is nearer.
  const limits = Float64Array.from({ length: 256 }, (_, code) => srgbToLinear((code + 0.5) / 255));
  const guess = new Uint8Array(STEPS + 1);
  for (let step = 0, code = 0; step <= STEPS; step++) {
    while (code < 255 && (limits[code] as number) <= step / STEPS) code++;
    guess[step] = code;
  }
  return (value) => {
    let code = guess[Math.floor(STEPS * value)] as number;
    while (code < 255 && (limits[code] as number) <= value) code++;
    return code;
  };
}

/** What a row or column of the source adds to those of the target: to `to`, and the rest to the next one. */
function overlaps(from: number, to: number): { readonly target: Int32Array; readonly weight: Float64Array } {
  const target = new Int32Array(from);
  const weight = new Float64Array(from);
  for (let i = 0; i < from; i++) {
    const [begin, end] = [(i * to) / from, ((i + 1) * to) / from];
    target[i] = Math.floor(begin);
    weight[i] = Math.min(end, Math.floor(begin) + 1) - begin;
  }
  return { target, weight };
}

/** Source rows between two yields: about a megabyte. */
const STEP_TEXELS = 1 << 16;

/** Averages the pixels of an image in boxes, each as large as a pixel of the result. */
function* boxFilter(
  data: Pixels,
  [width, height]: readonly [number, number],
  [toWidth, toHeight]: readonly [number, number],
  isSrgb: boolean,
): Steps<Pixels> {
  const isFloat = data instanceof Float32Array;
  const color = decodingTable(isSrgb);
  const plain = decodingTable(false);
  const encode = isSrgb ? srgbEncoder() : undefined;
  const out = new (data.constructor as new (length: number) => Pixels)(4 * toWidth * toHeight);
  const columns = overlaps(width, toWidth);
  const rows = overlaps(height, toHeight);
  const row = new Float64Array(4 * (toWidth + 1));
  let sums = new Float64Array(4 * toWidth);
  let next = new Float64Array(4 * toWidth);
  const share = toWidth / width;
  const finish = (y: number) => {
    for (let i = 0, to = 4 * toWidth * y; i < sums.length; i++, to++) {
      const value = sums[i] as number;
      out[to] = isFloat ? value : encode && (i & 3) !== 3 ? encode(Math.min(1, value)) : Math.round(255 * value);
    }
    [sums, next] = [next, sums];
    next.fill(0);
  };
  const rowsAStep = Math.max(1, Math.floor(STEP_TEXELS / width));
  for (let y = 0; y < height; y++) {
    row.fill(0);
    for (let x = 0, at = 4 * y * width; x < width; x++, at += 4) {
      const to = 4 * (columns.target[x] as number);
      const a = columns.weight[x] as number;
      let r = data[at] as number;
      let g = data[at + 1] as number;
      let b = data[at + 2] as number;
      let o = data[at + 3] as number;
      if (!isFloat) {
        r = color[r] as number;
        g = color[g] as number;
        b = color[b] as number;
        o = plain[o] as number;
      }
      row[to] = (row[to] as number) + a * r;
      row[to + 1] = (row[to + 1] as number) + a * g;
      row[to + 2] = (row[to + 2] as number) + a * b;
      row[to + 3] = (row[to + 3] as number) + a * o;
      const rest = share - a;
      if (rest < 1e-9) continue;
      row[to + 4] = (row[to + 4] as number) + rest * r;
      row[to + 5] = (row[to + 5] as number) + rest * g;
      row[to + 6] = (row[to + 6] as number) + rest * b;
      row[to + 7] = (row[to + 7] as number) + rest * o;
    }
    const a = rows.weight[y] as number;
    const rest = toHeight / height - a;
    for (let i = 0; i < sums.length; i++) sums[i] = (sums[i] as number) + a * (row[i] as number);
    if (rest >= 1e-9) for (let i = 0; i < next.length; i++) next[i] = (next[i] as number) + rest * (row[i] as number);
    const target = rows.target[y] as number;
    if (y === height - 1 || rows.target[y + 1] !== target) finish(target);
    if (y % rowsAStep === rowsAStep - 1) yield;
  }
  return out;
}

/** Levels of a compressed image that can be dropped: smaller ones are stored, in whole blocks. */
export function droppableBlocks({ width, height, compressed }: Pick<Image, 'width' | 'height' | 'compressed'>): number {
  let level = 0;
  const isWhole = (size: number) => size % 4 === 0;
  while (compressed && level + 1 < compressed.levels.length && levelSize(width, height, level + 1).every(isWhole))
    level++;
  return level;
}

/** Reads the image's pixels, without keeping them in it. Refers to nothing else of the image, such as its blocks. */
function pixelReader(image: Image): () => Pixels {
  const property = Object.getOwnPropertyDescriptor(image, 'data') as PropertyDescriptor;
  return () => Object.defineProperty({} as { data: Pixels }, 'data', { ...property }).data;
}

/**
 * An image without its largest levels: the mean of 2 × 2 pixels for each level, of the area of a pixel where sizes are
 * odd. Colours of sRGB textures are averaged as linear light, alpha and all others as they are. Compressed images
 * lose stored levels and stay compressed, if `blocks` is true; their pixels are computed when they are asked for.
 *
 * @param level How many times width and height are halved (rounded down, at least 1).
 * @param blocks Whether the result keeps the blocks of a compressed image; see {@link droppableBlocks}.
 * @returns Steps for `inSlices` or `finish`. The image itself does not change, and pixels that it has not read yet are
 * not kept in it.
 * @example
 * const half = await inSlices(reduceImageSteps(image, 1, 'srgb'));
 */
export function* reduceImageSteps(
  image: Image,
  level: number,
  colorSpace: 'srgb' | 'linear',
  blocks = false,
): Steps<Image> {
  const { name, width, height, compressed } = image;
  const size = levelSize(width, height, level);
  const pixels = pixelReader(image);
  const filter = () => boxFilter(pixels(), [width, height], size, colorSpace === 'srgb');
  const reduced = { name, width: size[0], height: size[1] };
  if (!blocks || !compressed) return { ...reduced, data: yield* filter() };
  const kept: CompressedImage = { format: compressed.format, levels: compressed.levels.slice(level) };
  return lazyPixels({ ...reduced, compressed: kept }, () => {
    const steps = filter();
    let step = steps.next();
    while (!step.done) step = steps.next();
    return step.value;
  });
}

/** Adds pixels that are computed on the first access. */
function lazyPixels(image: Omit<Image, 'data'>, read: () => Pixels): Image {
  return Object.defineProperty(image, 'data', {
    get(this: Image) {
      const value = read();
      Object.defineProperty(this, 'data', { value, writable: true, enumerable: true, configurable: true });
      return value;
    },
    enumerable: true,
    configurable: true,
  }) as Image;
}
