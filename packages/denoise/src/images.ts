import { DenoiseError } from './error';
import { ALIGNMENT, STORAGE, type Window } from './gpu';
import type { Network } from './network';
import type { DenoiseImages, DenoiserInput, ImageBuffer } from './options';

/** A caller's image: what to bind, and how shaders find pixels in it. */
export interface BoundImage {
  readonly window: Window;
  /** Floats before the first pixel, from pixel to pixel, from row to row; 1 where there is a fourth float. */
  readonly layout: readonly [base: number, pixel: number, row: number, alpha: number];
}

/** The caller's images, checked. */
export interface BoundImages {
  readonly width: number;
  readonly height: number;
  readonly main: BoundImage;
  readonly albedo: BoundImage | undefined;
  readonly normal: BoundImage | undefined;
  readonly output: BoundImage;
  readonly scale: number | undefined;
}

const MAX_SIZE = 16384;

/** @throws {DenoiseError} `denoise/size`. */
export function checkSize(width: number, height: number): void {
  for (const size of [width, height])
    if (!(Number.isInteger(size) && size >= 1 && size <= MAX_SIZE))
      throw new DenoiseError(
        'denoise/size',
        `Cannot denoise ${width} × ${height} pixels: width and height are whole numbers from 1 to ${MAX_SIZE}.`,
      );
}

function bindImage(
  name: string,
  image: GPUBuffer | ImageBuffer,
  width: number,
  height: number,
  limit: number,
  alpha: boolean,
): BoundImage {
  const {
    buffer,
    offset = 0,
    pixelStride = 4,
    rowStride = width * pixelStride,
  } = 'buffer' in image ? image : { buffer: image };
  if (!(buffer.usage & STORAGE))
    throw new DenoiseError('denoise/input', `"${name}" has a buffer without the usage STORAGE.`);
  const whole = [offset / 4, pixelStride, rowStride].every((value) => Number.isInteger(value) && value >= 0);
  if (!(whole && pixelStride >= 3 && rowStride >= width * pixelStride))
    throw new DenoiseError(
      'denoise/input',
      `"${name}" cannot have the offset ${offset}, pixelStride ${pixelStride} and rowStride ${rowStride}: the offset is a multiple of 4, a pixel has 3 floats or more, and a row ${width} pixels.`,
    );
  // Of the last pixel no more has to be there than is used: images may lie between each other.
  const floats = (height - 1) * rowStride + (width - 1) * pixelStride + (alpha && pixelStride >= 4 ? 4 : 3);
  if (offset + 4 * floats > buffer.size)
    throw new DenoiseError(
      'denoise/input',
      `"${name}" needs ${offset + 4 * floats} bytes for ${width} × ${height} pixels; its buffer has ${buffer.size}.`,
    );
  const from = Math.floor(offset / ALIGNMENT) * ALIGNMENT;
  const size = offset - from + 4 * floats;
  if (size > limit)
    throw new DenoiseError(
      'denoise/limit',
      `"${name}" takes ${size} bytes, and the device binds ${limit} at most. Request a device with a larger maxStorageBufferBindingSize.`,
    );
  return {
    window: { buffer, offset: from, size },
    layout: [(offset - from) / 4, pixelStride, rowStride, pixelStride >= 4 ? 1 : 0],
  };
}

/**
 * Checks the images against what a network takes.
 *
 * @throws {DenoiseError} `denoise/size`, `denoise/input`, `denoise/limit`, `denoise/option`.
 */
export function bindImages(
  network: Network,
  input: DenoiserInput,
  images: DenoiseImages,
  limits: GPUSupportedLimits,
): BoundImages {
  const { width, height, scale } = images;
  checkSize(width, height);
  if (scale !== undefined && !(scale > 0 && scale < Infinity))
    throw new DenoiseError('denoise/option', `The scale ${scale} is not a positive number.`);
  const guide = input === 'albedo' || input === 'normal';
  const limit = limits.maxStorageBufferBindingSize;
  const bind = (name: 'color' | 'albedo' | 'normal' | 'output', channels: number, alpha = false) => {
    if (network.channels < channels) return undefined;
    const image = images[name];
    if (!image)
      throw new DenoiseError(
        'denoise/input',
        `"${name}" is missing: the network takes ${network.channels} channels. Pass it, or use the weights of a network without it.`,
      );
    return bindImage(name, image, width, height, limit, alpha);
  };
  const output = bind('output', 3, true)!;
  const main = bind(guide ? input : 'color', 3, output.layout[3] === 1)!;
  const albedo = bind('albedo', 6);
  const normal = bind('normal', 9);
  for (const [name, image] of Object.entries({ main, albedo, normal }))
    if (image?.window.buffer === output.window.buffer)
      throw new DenoiseError(
        'denoise/input',
        `"output" has the buffer of ${name === 'main' ? 'the image to denoise' : `"${name}"`}: pass another one.`,
      );
  return { width, height, main, albedo, normal, output, scale: input === 'hdr' ? scale : 1 };
}
