import { loadPart } from '@glanz/wgsl/error';
import { DenoiseError } from '../error';
import { INPUT, readNetwork, type Network } from '../network';
import type { DenoiserInput, DenoiserOptions } from '../options';
import { automaticScale } from './exposure';
import { concatenate, convolveChannel, pool, upsample, type Planes } from './layers';
import { decodeMain, encodeAlbedo, encodeMain, encodeNormal } from './transfer';

export type { Planes } from './layers';

/** Images in memory for {@link denoiseOnCpu}: row by row, the top row first. */
export interface CpuImages {
  /** Pixels. */
  readonly width: number;
  /** Pixels. */
  readonly height: number;
  /** Floats a pixel, of which the first three count: 3 (default) or more. */
  readonly pixelStride?: number;
  /** The image to denoise, for `hdr`, `ldr` and `srgb`. */
  readonly color?: ArrayLike<number>;
  /** Guide, linear, 0 to 1; the image to denoise, for `albedo`. */
  readonly albedo?: ArrayLike<number>;
  /** Guide, −1 to 1, 0 where there is no surface; the image to denoise, for `normal`. */
  readonly normal?: ArrayLike<number>;
  /** As in {@link DenoiseImages}. */
  readonly scale?: number;
}

/** Options for {@link denoiseOnCpu}. */
export interface CpuDenoiseOptions {
  /** What is denoised. Default `hdr`. */
  readonly input?: DenoiserInput;
  /** As in {@link DenoiserOptions}. */
  readonly prefilter?: DenoiserOptions['prefilter'];
  /**
   * Whether layers are computed in WebAssembly with SIMD, seven times as fast or more, where that is available and its
   * memory is (at most 1 GiB, beyond which the image is computed in tiles); no effect with `onLayer`. Results differ by
   * the rounding of sums, which are in single precision there and in double precision elsewhere. Default false.
   */
  readonly webAssembly?: boolean;
  /** Ends the work; the promise rejects with the signal's reason. */
  readonly signal?: AbortSignal;
  /**
   * Called with what each layer computes, before pooling; first with `input`, the encoded images. For looking for
   * differences between implementations. Networks that clean guides are not among them.
   */
  readonly onLayer?: (name: string, planes: Planes) => void;
}

/** Milliseconds between two returns to the event loop. */
const SLICE_MS = 12;

/** The images with guides that networks of their own have cleaned. */
async function withCleanGuides(
  images: CpuImages,
  { prefilter = {}, signal, webAssembly = false }: CpuDenoiseOptions,
): Promise<CpuImages> {
  let cleaned = images;
  for (const input of ['albedo', 'normal'] as const) {
    const weights = prefilter[input];
    if (weights)
      cleaned = {
        ...cleaned,
        [input]: await denoiseOnCpu(weights, images, { input, webAssembly, ...(signal ? { signal } : {}) }),
      };
  }
  return cleaned;
}

/** The image that is denoised and the guides, as the network's input wants them. */
function imagesOf(network: Network, input: DenoiserInput, images: CpuImages) {
  const main = images[input === 'albedo' || input === 'normal' ? input : 'color'];
  const all = [main, ...[images.albedo, images.normal].slice(0, network.channels / 3 - 1)];
  const { width, height, pixelStride = 3 } = images;
  if (!(Number.isInteger(width) && Number.isInteger(height) && width >= 1 && height >= 1))
    throw new DenoiseError('denoise/size', `Cannot denoise an image of ${width} × ${height} pixels.`);
  for (const [i, image] of all.entries())
    if (!image || image.length < width * height * pixelStride)
      throw new DenoiseError(
        'denoise/input',
        `The network takes ${network.channels} channels: image ${i + 1} of ${all.length} ${image ? `has ${image.length} numbers, not ${width * height * pixelStride}` : 'is missing'}.`,
      );
  return all as ArrayLike<number>[];
}

/** The encoded images, with zeros to the right and below up to multiples of 16. */
function encode(sources: readonly ArrayLike<number>[], images: CpuImages, input: DenoiserInput, scale: number): Planes {
  const { width, height, pixelStride = 3 } = images;
  const paddedWidth = Math.ceil(width / 16) * 16;
  const paddedHeight = Math.ceil(height / 16) * 16;
  const data = new Float32Array(3 * sources.length * paddedWidth * paddedHeight);
  const coders = [(v: number) => encodeMain(v, input, scale), encodeAlbedo, encodeNormal];
  for (const [i, source] of sources.entries())
    for (let c = 0; c < 3; c++)
      for (let y = 0; y < height; y++)
        for (let x = 0; x < width; x++)
          data[((3 * i + c) * paddedHeight + y) * paddedWidth + x] = coders[i]!(
            source[(y * width + x) * pixelStride + c]!,
          );
  return { channels: 3 * sources.length, width: paddedWidth, height: paddedHeight, data };
}

/** Evaluates a network in plain loops, in slices of time. */
async function evaluate(network: Network, first: Planes, { signal, onLayer }: CpuDenoiseOptions): Promise<Planes> {
  const outputs: Planes[] = [];
  const outputOf = (source: number) => (source === INPUT ? first : outputs[source]!);
  let since = performance.now();
  for (const layer of network.layers) {
    const direct = outputOf(layer.direct);
    const source = layer.up === undefined ? direct : concatenate(upsample(outputOf(layer.up)), direct);
    const size = source.width * source.height;
    const result = new Float32Array(layer.channels * size);
    for (let channel = 0; channel < layer.channels; channel++) {
      convolveChannel(layer, channel, source, result.subarray(channel * size, (channel + 1) * size));
      if (performance.now() - since < SLICE_MS) continue;
      await new Promise((resolve) => setTimeout(resolve));
      signal?.throwIfAborted();
      since = performance.now();
    }
    const planes = { ...source, channels: layer.channels, data: result };
    onLayer?.(layer.name, planes);
    outputs.push(layer.pool ? pool(planes) : planes);
  }
  return outputs.at(-1)!;
}

/**
 * Denoises an image on the CPU, on the calling thread, in slices of about 12 ms, or 6 ms in WebAssembly: what
 * {@link Denoiser} computes, for machines without a GPU and for tests. By a network of base size 128 × 128 pixels take
 * some 2 s, with `webAssembly` 0.3 s.
 *
 * @param weights The whole content of a .tza file.
 * @returns As many floats a pixel as the input; those beyond the third are copied.
 * @throws {DenoiseError} `denoise/weights`, `denoise/size`, `denoise/input` where an image is missing or too short.
 * @example
 * const images = { width, height, color, albedo, normal };
 * const clean = await denoiseOnCpu(weights, images, { webAssembly: true });
 */
export async function denoiseOnCpu(
  weights: Uint8Array | ArrayBuffer,
  images: CpuImages,
  options: CpuDenoiseOptions = {},
): Promise<Float32Array<ArrayBuffer>> {
  const { input = 'hdr', signal, onLayer } = options;
  const network = readNetwork(weights);
  const sources = imagesOf(network, input, await withCleanGuides(images, options));
  const { width, height, pixelStride = 3 } = images;
  const main = sources[0]!;
  const scale = input === 'hdr' ? (images.scale ?? automaticScale(main, width, height, pixelStride)) : 1;
  const first = encode(sources, images, input, scale);
  onLayer?.('input', first);
  signal?.throwIfAborted();
  const fast = options.webAssembly && !onLayer && (await loadPart('in-wasm', import('./in-wasm')));
  const last =
    (fast && (await fast.evaluateInWasm(network, first, signal))) || (await evaluate(network, first, options));
  const output = new Float32Array(width * height * pixelStride);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++)
      for (let c = 0; c < pixelStride; c++) {
        const at = (y * width + x) * pixelStride + c;
        output[at] = c < 3 ? decodeMain(last.data[(c * last.height + y) * last.width + x]!, input, scale) : main[at]!;
      }
  return output;
}
