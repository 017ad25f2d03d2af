import { compressedBytes, type CompressedFormat, type CompressedImage } from '@glanz/scene';
import { GltfError } from './error';
import type { Ktx2Decoder } from './decoded-image';
import { imageOfPixels } from './lazy-pixels';

/** What is used of the Basis Universal transcoder. */
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

/** The transcoder's numbers: RGBA of 8 bits, and what GPUs read. */
const RGBA32 = 13;
const TARGETS: Readonly<Record<CompressedFormat, number>> = {
  'bc7-rgba-unorm': 6,
  'astc-4x4-unorm': 10,
  'etc2-rgba8unorm': 1,
};
const HEADER_BYTES = 80;

const broken = (what: string) => new GltfError('gltf/picture', `The KTX2 picture cannot be decoded: ${what}.`);

/** A picture of one colour packs well, but not better than this: bytes of pixels for one of the file. */
const MOST_RATIO = 2048;

/**
 * A decoder of KTX2 pictures (`KHR_texture_basisu`) on the Basis Universal transcoder, which has a global or exported
 * `BASIS` function: `await BASIS({ wasmBinary })` gives the module.
 *
 * @param module The module, or what fetches it; it is asked for at the first picture.
 * @throws {GltfError} `gltf/picture` (from the decoder) for what is no such picture; a load then goes on without it.
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
      // GPUs take blocks only where the picture is made of whole ones.
      const format = width % 4 || height % 4 ? undefined : formatFor(file, formats);
      if (!format) return { width, height, data: pixels(file) };
      const compressed = compress(file, width, height, format);
      return imageOfPixels({ width, height, compressed }, () => reading(basis, bytes, width, height, pixels));
    });
  };
}

/** The length of the first level and the size stand in the header: a look spares the transcoder pictures that lie. */
function checkHeader(bytes: Uint8Array): { readonly width: number; readonly height: number } {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < HEADER_BYTES + 24) throw broken('it is cut off');
  const [width, height] = [view.getUint32(20, true), view.getUint32(24, true)];
  if (width < 1 || height < 1 || width > 32768 || height > 32768) throw broken(`its size is ${width} × ${height}`);
  const [depth, layers, faces] = [28, 32, 36].map((at) => view.getUint32(at, true));
  if (depth !== 0 || layers !== 0 || faces !== 1)
    throw broken('it is no plain picture, but one with depth, layers or faces');
  if (4 * width * height > MOST_RATIO * bytes.length + 65536)
    throw broken(`it says that ${bytes.length} bytes hold ${width} × ${height} pixels`);
  return { width, height };
}

/** Opens a picture for as long as it is read. */
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
      throw broken('it is no KTX2 picture of the Basis kinds');
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

/** Both kinds of Basis pictures have a format that they become without loss; it comes first where it is to be had. */
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
      // The smaller ones are for speed: a picture is as good as its first.
      if (level === 0) throw error;
      break;
    }
  }
  return { format, levels };
}
