import type { CompressedFormat, Image, Scene, Texture } from '@glanz/scene';
import { DeviceError } from '../errors';
import { isSoftware } from '../device/software';

/** Formats of texture arrays; images that come in blocks keep them. */
export type TextureFormat =
  | 'rgba8unorm'
  | 'rgba8unorm-srgb'
  | 'rgba16float'
  | CompressedFormat
  | `${CompressedFormat}-srgb`;

const FEATURES: Readonly<Record<CompressedFormat, GPUFeatureName>> = {
  'astc-4x4-unorm': 'texture-compression-astc',
  'bc7-rgba-unorm': 'texture-compression-bc',
  'etc2-rgba8unorm': 'texture-compression-etc2',
};

/**
 * The compressed texture formats that a device supports, the best first, for loaders that keep images compressed. None
 * for software adapters: their drivers decompress images, so no memory is saved, and on some CPUs SwiftShader reads
 * zeros from them.
 *
 * @example
 * const scene = await loadGltf('lamp.gltf', { decoders, compressedFormats: compressedFormats(device) });
 */
export function compressedFormats(device: {
  readonly features: Pick<ReadonlySet<string>, 'has'>;
  readonly adapterInfo?: GPUAdapterInfo;
}): CompressedFormat[] {
  if (device.adapterInfo && isSoftware(device.adapterInfo)) return [];
  return (Object.keys(FEATURES) as CompressedFormat[]).filter((format) => device.features.has(FEATURES[format]));
}

/** One texture array on the GPU: images of one size and format. */
export interface TextureArray {
  readonly width: number;
  readonly height: number;
  readonly format: TextureFormat;
  /** Levels that the images bring along; `undefined` where they are made on the GPU, all of them. */
  readonly levels: number | undefined;
  /** Indices of scene images, one a layer. */
  readonly layers: number[];
}

/** Bytes of a texel; a byte where sixteen share a block. */
export const texelBytes = (format: TextureFormat) =>
  format === 'rgba16float' ? 8 : format.startsWith('rgba8') ? 4 : 1;

/** Bytes of a texture array with its levels. */
export const arrayBytes = ({ width, height, layers, format, levels }: TextureArray): number =>
  Math.ceil((width * height * layers.length * texelBytes(format) * (levels === 1 ? 3 : 4)) / 3);

/** Texture array, sampler, and the WGSL expression of `uv` at which they are read. */
export type Sampling = readonly [array: number, sampler: number, uv: string];

/** How a scene's textures lie on the GPU. */
export interface TexturePlan {
  readonly arrays: readonly TextureArray[];
  /** Distinct samplers, as descriptors. */
  readonly samplers: readonly GPUSamplerDescriptor[];
  /** Distinct ways to read a texel; a shader case each. */
  readonly samplings: readonly Sampling[];
  /** For each scene texture that is used: its sampling case, its layer and the size of its image there. */
  readonly placements: ReadonlyMap<
    number,
    { readonly sampling: number; readonly layer: number; readonly width: number; readonly height: number }
  >;
}

const addressMode = { repeat: 'repeat', mirror: 'mirror-repeat', clamp: 'clamp-to-edge' } as const;
/** The same, in the shader. */
const WRAPPED = { repeat: 'fract(uv)', mirror: 'abs(uv - 2.0 * round(0.5 * uv))', clamp: 'uv' } as const;

function formatOf(image: Image, texture: Texture, compressed: readonly CompressedFormat[]): TextureFormat {
  // Pixels that nobody has asked for yet would be unpacked, which takes time and memory.
  const isFloat = !image.bitmap && !image.compressed && image.data instanceof Float32Array;
  const format = compressedOf(image, compressed)?.format ?? (isFloat ? 'rgba16float' : 'rgba8unorm');
  return texture.color_space === 'srgb' && format !== 'rgba16float' ? `${format}-srgb` : format;
}

/** The blocks of an image that stays in blocks on this device. */
function compressedOf({ compressed, width, height }: Image, formats: readonly CompressedFormat[]): Image['compressed'] {
  return compressed && formats.includes(compressed.format) && width % 4 === 0 && height % 4 === 0
    ? compressed
    : undefined;
}

/**
 * Sorts images into arrays of one size and format. Where the scene has more sizes than the device has texture slots,
 * the arrays with the fewest texels move into the nearest larger size of the same format; only those images are
 * resampled.
 *
 * @param used Indices of scene textures that materials refer to.
 * @param slots Texture arrays the shading kernel may bind.
 * @param compressed Compressed formats that the device reads. Images in blocks cannot be resampled: where there are
 * more sizes than slots, or one is too large, all of them are unpacked.
 * @throws {DeviceError} `renderer/limit` when even that does not fit.
 */
export function planTextures(
  scene: Scene,
  used: Iterable<number>,
  slots: number,
  limits: TextureLimits,
  compressed: readonly CompressedFormat[] = [],
): TexturePlan {
  const textures = [...new Set(used)].sort((a, b) => a - b);
  const drafts = draftArrays(scene, textures, limits, compressed);
  const kept = drafts.filter((draft) => draft.levels !== undefined);
  if (
    kept.length > 0 &&
    (drafts.length > slots || kept.some(({ width, height }) => Math.max(width, height) > limits.maxTextureDimension2D))
  )
    return planTextures(scene, textures, slots, limits);
  mergeArrays(drafts, slots, limits);
  return placeTextures(scene, textures, drafts, compressed);
}

interface TextureLimits {
  readonly maxTextureDimension2D: number;
  readonly maxTextureArrayLayers: number;
}

interface Draft extends TextureArray {
  width: number;
  height: number;
}

function draftArrays(
  scene: Scene,
  textures: readonly number[],
  limits: TextureLimits,
  compressed: readonly CompressedFormat[],
): Draft[] {
  const drafts: Draft[] = [];
  for (const index of textures) {
    const texture = scene.textures[index] as Texture;
    const image = scene.images[texture.image] as Image;
    const format = formatOf(image, texture, compressed);
    const levels = compressedOf(image, compressed)?.levels.length;
    const shrink =
      levels !== undefined
        ? 1
        : Math.max(1, image.width / limits.maxTextureDimension2D, image.height / limits.maxTextureDimension2D);
    const width = Math.max(1, Math.floor(image.width / shrink));
    const height = Math.max(1, Math.floor(image.height / shrink));
    let draft = drafts.find(
      (d) =>
        d.width === width &&
        d.height === height &&
        d.format === format &&
        d.levels === levels &&
        (d.layers.includes(texture.image) || d.layers.length < limits.maxTextureArrayLayers),
    );
    if (!draft) drafts.push((draft = { width, height, format, levels, layers: [] }));
    if (!draft.layers.includes(texture.image)) draft.layers.push(texture.image);
  }
  return drafts;
}

function mergeArrays(drafts: Draft[], slots: number, limits: TextureLimits): void {
  while (drafts.length > slots) {
    const order = [...drafts].sort(
      (a, b) => a.width * a.height * a.layers.length - b.width * b.height * b.layers.length,
    );
    const merged = order.some((small) => {
      const larger = drafts
        .filter(
          (d) =>
            d !== small &&
            d.format === small.format &&
            d.layers.length + small.layers.length <= limits.maxTextureArrayLayers,
        )
        .sort((a, b) => distance(small, a) - distance(small, b))[0];
      if (!larger) return false;
      larger.width = Math.max(larger.width, small.width);
      larger.height = Math.max(larger.height, small.height);
      for (const layer of small.layers) if (!larger.layers.includes(layer)) larger.layers.push(layer);
      drafts.splice(drafts.indexOf(small), 1);
      return true;
    });
    if (!merged)
      throw new DeviceError(
        'renderer/limit',
        `The scene's textures need ${drafts.length} texture arrays, but this device binds only ${slots} (maxSampledTexturesPerShaderStage).`,
      );
  }
}

/** The index of an equal item, which is added where there is none. */
function indexIn<T>(list: T[], item: T): number {
  const text = JSON.stringify(item);
  const at = list.findIndex((one) => JSON.stringify(one) === text);
  return at < 0 ? list.push(item) - 1 : at;
}

function placeTextures(
  scene: Scene,
  textures: readonly number[],
  drafts: readonly Draft[],
  compressed: readonly CompressedFormat[],
): TexturePlan {
  const samplers: GPUSamplerDescriptor[] = [];
  const samplings: Sampling[] = [];
  const placements = new Map<number, { sampling: number; layer: number; width: number; height: number }>();
  for (const index of textures) {
    const texture = scene.textures[index] as Texture;
    const format = formatOf(scene.images[texture.image] as Image, texture, compressed);
    const array = drafts.findIndex((d) => d.format === format && d.layers.includes(texture.image));
    const { layers, width, height } = drafts[array] as Draft;
    const { filter = 'linear', wrap_u: u = 'repeat', wrap_v: v = 'repeat' } = texture;
    // A stage binds 16 samplers, fewer than there are ways to wrap and filter. The nearest texel has no neighbours to
    // blend with at the edges, so that the shader can wrap.
    const near = filter === 'nearest';
    const sampler = indexIn(samplers, {
      addressModeU: addressMode[near ? 'clamp' : u],
      addressModeV: addressMode[near ? 'clamp' : v],
      magFilter: filter,
      minFilter: filter,
      mipmapFilter: filter,
    });
    const uv = near ? `vec2f(${WRAPPED[u]}.x, ${WRAPPED[v]}.y)` : 'uv';
    const sampling = indexIn(samplings, [array, sampler, uv]);
    placements.set(index, { sampling, layer: layers.indexOf(texture.image), width, height });
  }
  return { arrays: drafts, samplers, samplings, placements };
}

const distance = (a: { width: number; height: number }, b: { width: number; height: number }) =>
  Math.abs(Math.log(a.width / b.width)) +
  Math.abs(Math.log(a.height / b.height)) +
  (b.width * b.height < a.width * a.height ? 100 : 0);

/** Bilinear resampling of RGBA pixels to another size, in the codes' own space. */
export function resizePixels<
  T extends Uint8Array<ArrayBuffer> | Uint8ClampedArray<ArrayBuffer> | Float32Array<ArrayBuffer>,
>(data: T, width: number, height: number, toWidth: number, toHeight: number): T {
  const out = new (data.constructor as new (n: number) => T)(toWidth * toHeight * 4);
  const round = data instanceof Float32Array ? 0 : 0.5;
  for (let y = 0; y < toHeight; y++) {
    const sy = Math.min(Math.max(((y + 0.5) * height) / toHeight - 0.5, 0), height - 1);
    const y0 = Math.floor(sy);
    const y1 = Math.min(y0 + 1, height - 1);
    for (let x = 0; x < toWidth; x++) {
      const sx = Math.min(Math.max(((x + 0.5) * width) / toWidth - 0.5, 0), width - 1);
      const x0 = Math.floor(sx);
      const x1 = Math.min(x0 + 1, width - 1);
      for (let c = 0; c < 4; c++) {
        const top =
          (data[4 * (y0 * width + x0) + c] as number) * (1 - sx + x0) +
          (data[4 * (y0 * width + x1) + c] as number) * (sx - x0);
        const bottom =
          (data[4 * (y1 * width + x0) + c] as number) * (1 - sx + x0) +
          (data[4 * (y1 * width + x1) + c] as number) * (sx - x0);
        out[4 * (y * toWidth + x) + c] = top * (1 - sy + y0) + bottom * (sy - y0) + round;
      }
    }
  }
  return out;
}
