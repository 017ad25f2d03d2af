import type { DecodedImage, ImageDecoder, Ktx2Decoder, CompressedFormats } from './decoded-image';
import type { GltfImageConversion } from '@glanz/openpbr/gltf';
import {
  GlanzError,
  loadPart,
  type CompressedFormat,
  type Image,
  type SceneWarning,
  type Texture,
  type WrapMode,
} from '@glanz/scene';
import { namedImage } from './browser-images';
import type { DerivedImage } from './convert-image';
import { readUri } from './document';
import { GltfError } from './error';
import type { FittedImage } from './fit-images';
import type { HeldImages } from './held-images';
import type { GltfImage, GltfJson, GltfTexture } from './json';
import type { Budget } from './limits';
import { imageSize } from './image-header';
import { imageType, wrongType } from './image-type';
import type { Source } from './source';

/** The image of a texture: from an extension whose format can be read, else the texture's own `source`. */
function sourceOf(texture: GltfTexture | undefined, ktx2: boolean): number | undefined {
  const by = (name: string) => texture?.extensions?.[name]?.source;
  const plain = by('EXT_texture_avif') ?? by('EXT_texture_webp') ?? texture?.source;
  return ktx2 ? (by('KHR_texture_basisu') ?? plain) : (plain ?? by('KHR_texture_basisu'));
}

const WRAP: Readonly<Record<number, WrapMode>> = { 33071: 'clamp', 33648: 'mirror', 10497: 'repeat' };
const NEAREST = 9728;

/** An image of the scene: an image of the document, or one computed from several (undefined: absent). */
type SceneImage =
  | { readonly image: number }
  | { readonly sources: readonly (number | undefined)[]; readonly derived: DerivedImage };

const white = (): DecodedImage => ({ width: 1, height: 1, data: new Uint8Array([255, 255, 255, 255]) });

/** Max images that are read concurrently. Decoders limit themselves to their threads. */
const MAX_CONCURRENT = 16;

/** The textures that materials use, and their images. */
export class TextureTable {
  readonly textures: Texture[] = [];
  /** Images (by their index in the scene) that could not be decoded. */
  readonly failed = new Set<number>();
  /** Warnings by index of the document's image: at most one each. */
  readonly #notes = new Map<number, SceneWarning>();
  readonly #textureOf = new Map<string, number>();
  readonly #images: SceneImage[] = [];
  readonly #places = new Map<string, number>();
  /** Images of the document that are read as sRGB. */
  readonly #colors = new Set<number | undefined>();
  readonly #json: GltfJson;
  readonly #source: Source;
  readonly #warnings: SceneWarning[];
  readonly #ktx2: Ktx2Decoder | undefined;
  readonly #formats: () => Promise<readonly CompressedFormat[]>;

  constructor(
    json: GltfJson,
    source: Source,
    warnings: SceneWarning[],
    ktx2?: Ktx2Decoder,
    formats: CompressedFormats = [],
  ) {
    this.#json = json;
    this.#source = source;
    this.#warnings = warnings;
    this.#ktx2 = ktx2;
    let available: Promise<readonly CompressedFormat[]> | undefined;
    this.#formats = () => (available ??= typeof formats === 'function' ? formats() : Promise.resolve(formats));
  }

  /**
   * Index of the scene's texture for one of the document, read as `colorSpace`; undefined, with a warning, if it has no
   * image.
   */
  get(index: number, colorSpace: 'srgb' | 'linear', path: string): number | undefined {
    return this.#once(`${index} ${colorSpace}`, () => {
      const image = this.#imageOf(index, path);
      if (colorSpace === 'srgb') this.#colors.add(image);
      return image === undefined ? undefined : this.#add(index, colorSpace, this.#place(String(image), { image }));
    });
  }

  /**
   * Index of a texture whose image is computed from several of the document, with the sampler of the first. Undefined,
   * with a warning, if none of them has an image.
   */
  derive(
    { key, sources, convert }: GltfImageConversion,
    colorSpace: 'srgb' | 'linear',
    path: string,
  ): number | undefined {
    const [first] = sources;
    if (!first) return undefined;
    return this.#once(`${first.index} ${colorSpace} ${key} ${sources.map(({ index }) => index)}`, () => {
      const images = sources.map(({ index }) => this.#imageOf(index, path));
      if (colorSpace === 'srgb') images.forEach((image) => this.#colors.add(image));
      if (images.every((image) => image === undefined)) return undefined;
      return this.#add(
        first.index,
        colorSpace,
        this.#place(`${colorSpace} ${key} ${images}`, { sources: images, derived: { colorSpace, convert } }),
      );
    });
  }

  #once(key: string, make: () => number | undefined): number | undefined {
    const known = this.#textureOf.get(key);
    if (known !== undefined) return known;
    const made = make();
    if (made !== undefined) this.#textureOf.set(key, made);
    return made;
  }

  #imageOf(index: number, path: string): number | undefined {
    const texture = this.#json.textures?.[index];
    const image = sourceOf(texture, this.#ktx2 !== undefined);
    if (texture && image !== undefined && this.#json.images?.[image]) return image;
    const why = texture
      ? image === undefined
        ? 'has no image in a supported format'
        : `names image ${image}, which does not exist`
      : 'does not exist';
    this.#warnings.push({
      code: 'gltf/texture',
      message: `${this.#source.name}: texture ${index} ${why}; it is left out.`,
      path,
    });
    return undefined;
  }

  #place(key: string, entry: SceneImage): number {
    const known = this.#places.get(key);
    if (known !== undefined) return known;
    const at = this.#images.push(entry) - 1;
    this.#places.set(key, at);
    return at;
  }

  #add(index: number, colorSpace: 'srgb' | 'linear', image: number): number {
    const texture = this.#json.textures?.[index];
    const sampler = texture?.sampler === undefined ? undefined : this.#json.samplers?.[texture.sampler];
    const made: Texture = {
      image,
      color_space: colorSpace,
      wrap_u: WRAP[sampler?.wrapS ?? 10497] ?? 'repeat',
      wrap_v: WRAP[sampler?.wrapT ?? 10497] ?? 'repeat',
      filter: sampler?.magFilter === NEAREST ? 'nearest' : 'linear',
    };
    if (texture?.name !== undefined) made.name = texture.name;
    return this.textures.push(made) - 1;
  }

  /** Number of images in use. */
  get imageCount(): number {
    return this.#images.length;
  }

  #nameOf(index: number): string {
    const image = this.#json.images?.[index] as GltfImage;
    return image.name ?? (image.uri === undefined ? `image ${index}` : String(image.uri).slice(0, 80));
  }

  /**
   * Reads, decodes and holds one of the document's images; undefined, with a warning, for one that cannot be decoded.
   * @throws {GltfError} as {@link readImages}.
   */
  async readImage(
    index: number,
    decode: ImageDecoder,
    viewBytes: (index: number) => Uint8Array<ArrayBuffer>,
    budget: Budget,
    held: HeldImages,
    signal: AbortSignal | undefined,
  ): Promise<FittedImage | undefined> {
    signal?.throwIfAborted();
    const image = this.#json.images?.[index] as GltfImage;
    const bytes =
      image.uri === undefined ? viewBytes(image.bufferView ?? -1) : await readUri(image.uri, this.#source, signal);
    try {
      const type = imageType(bytes);
      const declared = wrongType(image, type);
      if (declared !== undefined)
        this.#notes.set(index, {
          code: 'gltf/image',
          message: `${this.#source.name}: image ${index} ("${this.#nameOf(index)}") is declared as ${declared}, but its bytes are ${type}; it is read as ${type}.`,
          path: `/images/${index}`,
        });
      if (type === 'image/ktx2' && !this.#ktx2)
        throw new GltfError(
          'gltf/missing-decoder',
          `${this.#source.name} has KTX2 images: pass decoders.ktx2; the package "three" contains the transcoder.`,
          { location: { file: this.#source.name, path: `/images/${index}` } },
        );
      // Before a decoder allocates anything.
      const declaredSize = imageSize(bytes, type);
      if (declaredSize) budget.take(4 * declaredSize.width * declaredSize.height, `/images/${index}`);
      return await held.decode(declaredSize ? 4 * declaredSize.width * declaredSize.height : 0, async () => {
        signal?.throwIfAborted();
        const decoded =
          type === 'image/ktx2'
            ? await (this.#ktx2 as Ktx2Decoder)(bytes, await this.#formats())
            : await decode(bytes, type);
        if (!declaredSize) budget.take(4 * decoded.width * decoded.height, `/images/${index}`);
        return held.hold(decoded, this.#colors.has(index) ? 'srgb' : 'linear');
      });
    } catch (error) {
      signal?.throwIfAborted();
      // Other codes report that a decoder could not be started: this is not the image's fault.
      if (error instanceof GlanzError && error.code !== 'gltf/ktx2') throw error;
      this.#notes.set(index, {
        code: 'gltf/image',
        message: `${this.#source.name}: image ${index} ("${this.#nameOf(index)}") cannot be decoded and is left out: ${error instanceof Error ? error.message.split('\n')[0] : String(error)}.`,
        path: `/images/${index}`,
      });
      return undefined;
    }
  }

  /**
   * Reads and decodes the images in use, several concurrently. Adds those that cannot be decoded to {@link failed},
   * with a warning.
   * @param viewBytes Returns the bytes of a buffer view.
   * @param budget Charged with the bytes of each image.
   * @param held Holds what was decoded.
   * @throws {GltfError} `gltf/missing-resource` for a file that does not exist, `gltf/too-large` for images that cannot be
   * held.
   */
  async readImages(
    decode: ImageDecoder,
    viewBytes: (index: number) => Uint8Array<ArrayBuffer>,
    budget: Budget,
    held: HeldImages,
    signal: AbortSignal | undefined,
    onImage: () => void,
  ): Promise<Image[]> {
    const read = (index: number) => this.readImage(index, decode, viewBytes, budget, held, signal);
    const shown = this.shownImages;
    // The first reads start synchronously, so that decoders work on their own threads while geometry is read here.
    const decoding = new Map<number | undefined, Promise<FittedImage | undefined>>();
    for (const [at, index] of shown.entries()) {
      const before = decoding.get(shown[at - MAX_CONCURRENT]);
      // An error rejects the image's own promise only; the next image is still read.
      const promise = before
        ? before.then(
            () => read(index),
            () => read(index),
          )
        : read(index);
      promise.catch(() => undefined);
      decoding.set(index, promise);
    }
    const images: { readonly name: string; readonly of: Pick<FittedImage, 'image'> }[] = [];
    for (const entry of this.#images) {
      if ('image' in entry) {
        const decoded = await decoding.get(entry.image);
        if (!decoded) this.failed.add(images.length);
        images.push({ name: this.#nameOf(entry.image), of: decoded ?? { image: white() } });
      } else {
        // Few documents need it.
        const { convertImage } = await loadPart('convert-image', import('./convert-image'));
        const sources = await Promise.all(entry.sources.map((index) => decoding.get(index)));
        const name = entry.sources.flatMap((index) => (index === undefined ? [] : [this.#nameOf(index)])).join(' + ');
        const { derived } = entry;
        // Pixels are read before the next await: from then on, an image may be reduced and its bitmap closed.
        const made = convertImage(
          sources.map((source) => source?.image ?? white()),
          derived,
          signal,
        );
        images.push({ name, of: await held.hold(await made, derived.colorSpace) });
      }
      onImage();
    }
    // Each may have lost levels for the sake of those after it.
    return images.map(({ name, of }) => namedImage(name, of.image));
  }

  /** The document's images that materials use. */
  get shownImages(): number[] {
    const all = this.#images.flatMap((entry) =>
      'image' in entry ? [entry.image] : entry.sources.filter((index) => index !== undefined),
    );
    return [...new Set(all)];
  }

  /** Warnings about images, in the document's order. */
  get imageWarnings(): readonly SceneWarning[] {
    return [...this.#notes].sort(([a], [b]) => a - b).map(([, warning]) => warning);
  }
}
