import { GltfError } from './error';
import type { Ktx2Decoder } from './images';

/** What is used of the Basis Universal transcoder. */
interface BasisModule {
  initializeBasis(): void;
  readonly KTX2File: new (bytes: Uint8Array) => Ktx2File;
}

interface Ktx2File {
  isValid(): boolean;
  getWidth(): number;
  getHeight(): number;
  startTranscoding(): boolean;
  getImageTranscodedSizeInBytes(level: number, layer: number, face: number, format: number): number;
  transcodeImage(target: Uint8Array, level: number, layer: number, face: number, format: number, alphaForOpaque: number, channel0: number, channel1: number): boolean;
  close(): void;
  delete(): void;
}

/** The transcoder's number for RGBA of 8 bits. */
const RGBA32 = 13;
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
  return async (bytes) => {
    // The length of the first level and the size stand in the header: a look spares the transcoder pictures that lie.
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    if (bytes.length < HEADER_BYTES + 24) throw broken('it is cut off');
    const [width, height] = [view.getUint32(20, true), view.getUint32(24, true)];
    if (width < 1 || height < 1 || width > 32768 || height > 32768) throw broken(`its size is ${width} × ${height}`);
    const [depth, layers, faces] = [28, 32, 36].map((at) => view.getUint32(at, true));
    if (depth !== 0 || layers !== 0 || faces !== 1) throw broken('it is no plain picture, but one with depth, layers or faces');
    if (4 * width * height > MOST_RATIO * bytes.length + 65536) throw broken(`it says that ${bytes.length} bytes hold ${width} × ${height} pixels`);
    ready ??= (async () => {
      const made = (typeof module === 'function' ? await (module as () => Promise<unknown>)() : module) as BasisModule;
      made.initializeBasis();
      return made;
    })();
    const { KTX2File } = await ready;
    const file = new KTX2File(bytes);
    try {
      if (!file.isValid() || file.getWidth() !== width || file.getHeight() !== height || !file.startTranscoding()) throw broken('it is no KTX2 picture of the Basis kinds');
      const size = file.getImageTranscodedSizeInBytes(0, 0, 0, RGBA32);
      if (size !== 4 * width * height) throw broken(`its pixels have ${size} bytes`);
      const data = new Uint8Array(size);
      if (!file.transcodeImage(data, 0, 0, 0, RGBA32, 0, -1, -1)) throw broken('it is broken');
      return { width, height, data };
    } catch (error) {
      throw error instanceof GltfError ? error : broken(`the transcoder fails: ${error instanceof Error ? error.message : String(error)}`);
    } finally {
      file.close();
      file.delete();
    }
  };
}
