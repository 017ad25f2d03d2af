import { compressedBytes, type CompressedFormat, type CompressedImage } from '@glanz/scene';
import { GltfError } from './error';
import type { Ktx2Decoder } from './decoded-image';
import { imageOfPixels } from './lazy-pixels';

/** The parts of the Basis Universal transcoder that are used. */
interface BasisModule {
  initializeBasis(): void;
  readonly KTX2File: new (bytes: Uint8Array) => Ktx2File;
}

interface Ktx2File {
  isValid(): boolean;
  getWidth(): number;
  getHeight(): number;
  getLevels(): number;
  isUASTC(): boolean;
  startTranscoding(): boolean;
  getImageTranscodedSizeInBytes(level: number, layer: number, face: number, format: number): number;
  transcodeImage(
    target: Uint8Array,
    level: number,
    layer: number,
    face: number,
    format: number,
    alphaForOpaque: number,
    channel0: number,
    channel1: number,
  ): boolean;
  close(): void;
  delete(): void;
}

/** The transcoder's format numbers: RGBA with 8 bits, and compressed texture formats. */
const RGBA32 = 13;
const TARGETS: Readonly<Record<CompressedFormat, number>> = {
  'bc7-rgba-unorm': 6,
  'astc-4x4-unorm': 10,
  'etc2-rgba8unorm': 1,
};
const HEADER_BYTES = 80;

const broken = (what: string) => new GltfError('gltf/ktx2', `The KTX2 image cannot be decoded: ${what}.`);

/** Pixel bytes per file byte that no valid file exceeds: even an image of one colour does not compress better. */
const MAX_RATIO = 2048;

/**
 * A decoder of KTX2 images (`KHR_texture_basisu`) that uses the Basis Universal transcoder. The transcoder has a global
 * or exported function `BASIS`: `await BASIS({ wasmBinary })` returns the module.
 *
 * @param module The module, or a function that fetches it; it is called for the first image.
 * @throws {GltfError} `gltf/ktx2` (from the decoder) for invalid images; a load continues without the image.
 * @example
 * loadGltf('a.glb', { decoders: { ktx2: ktx2Decoder(() => BASIS({ wasmBinary })) } });
 */
export function ktx2Decoder(module: (() => Promise<unknown>) | object): Ktx2Decoder {
  let ready: Promise<BasisModule> | undefined;
  return async (bytes, formats = []) => {
    const { width, height } = checkHeader(bytes);
    ready ??= (async () => {
      const made = (typeof module === 'function' ? await (module as () => Promise<unknown>)() : module) as BasisModule;
      made.initializeBasis();
      return made;
    })();
    const basis = await ready;
    return reading(basis, bytes, width, height, (file) => {
      const pixels = (from: Ktx2File) => transcode(from, 0, RGBA32, 4 * width * height);
      // Compressed textures must consist of whole blocks.
      const format = width % 4 || height % 4 ? undefined : formatFor(file, formats);
      if (!format) return { width, height, data: pixels(file) };
      const compressed = compress(file, width, height, format);
      return imageOfPixels({ width, height, compressed }, () => reading(basis, bytes, width, height, pixels));
    });
  };
}

/** Checks the size in the header against the file's length, before the transcoder allocates memory. */
function checkHeader(bytes: Uint8Array): { readonly width: number; readonly height: number } {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < HEADER_BYTES + 24) throw broken('it is cut off');
  const [width, height] = [view.getUint32(20, true), view.getUint32(24, true)];
  if (width < 1 || height < 1 || width > 32768 || height > 32768) throw broken(`its size is ${width} × ${height}`);
  const [depth, layers, faces] = [28, 32, 36].map((at) => view.getUint32(at, true));
  if (depth !== 0 || layers !== 0 || faces !== 1)
    throw broken('it is not a plain 2D image: it has depth, layers or faces');
  if (4 * width * height > MAX_RATIO * bytes.length + 65536)
    throw broken(`its header claims that ${bytes.length} bytes hold ${width} × ${height} pixels`);
  return { width, height };
}

/** Opens an image, reads it, and frees it. */
function reading<T>(
  { KTX2File }: BasisModule,
  bytes: Uint8Array,
  width: number,
  height: number,
  read: (file: Ktx2File) => T,
): T {
  const file = new KTX2File(bytes);
  try {
    if (!file.isValid() || file.getWidth() !== width || file.getHeight() !== height || !file.startTranscoding())
      throw broken('it is not a KTX2 image in a Basis Universal format');
    return read(file);
  } catch (error) {
    throw error instanceof GltfError
      ? error
      : broken(`the transcoder fails: ${error instanceof Error ? error.message : String(error)}`);
  } finally {
    file.close();
    file.delete();
  }
}

function transcode(file: Ktx2File, level: number, target: number, expected: number): Uint8Array<ArrayBuffer> {
  const size = file.getImageTranscodedSizeInBytes(level, 0, 0, target);
  if (size !== expected) throw broken(`level ${level} has ${size} bytes instead of ${expected}`);
  const data = new Uint8Array(size);
  if (!file.transcodeImage(data, level, 0, 0, target, 0, -1, -1)) throw broken('it is broken');
  return data;
}

/** The format into which the image is transcoded without loss, if the GPU supports it; else the best of `formats`. */
function formatFor(file: Ktx2File, formats: readonly CompressedFormat[]): CompressedFormat | undefined {
  const own = file.isUASTC() ? 'astc-4x4-unorm' : 'etc2-rgba8unorm';
  return formats.includes(own) ? own : formats[0];
}

function compress(file: Ktx2File, width: number, height: number, format: CompressedFormat): CompressedImage {
  const count = Math.min(Math.max(1, file.getLevels()), 1 + Math.floor(Math.log2(Math.max(width, height))));
  const levels: Uint8Array<ArrayBuffer>[] = [];
  for (let level = 0; level < count; level++) {
    try {
      levels.push(
        transcode(
          file,
          level,
          TARGETS[format],
          compressedBytes(Math.max(1, width >> level), Math.max(1, height >> level)),
        ),
      );
    } catch (error) {
      // Smaller mip levels are optional: only a broken first level makes the image unusable.
      if (level === 0) throw error;
      break;
    }
  }
  return { format, levels };
}
