import type { DecodedImage, ImageDecoder, Ktx2Decoder, CompressedFormats } from './decoded-image';
import type { GltfPictureConversion } from '@glanz/openpbr/gltf';
import {
  GlanzError,
  type CompressedFormat,
  type Image,
  type SceneWarning,
  type Texture,
  type WrapMode,
} from '@glanz/scene';
import { namedImage } from './browser-images';
import { convertImage, type DerivedPicture } from './convert-image';
import { readUri } from './document';
import { GltfError } from './error';
import type { GltfImage, GltfJson, GltfTexture } from './json';
import type { Budget } from './limits';
import { pictureSize } from './picture-header';
import { pictureType, wrongType } from './picture-type';
import type { Source } from './source';

/** The picture behind a texture: a better one where the document offers it and it can be read, else the plain one. */
function sourceOf(texture: GltfTexture | undefined, ktx2: boolean): number | undefined {
  const by = (name: string) => texture?.extensions?.[name]?.source;
  const plain = by('EXT_texture_avif') ?? by('EXT_texture_webp') ?? texture?.source;
  return ktx2 ? (by('KHR_texture_basisu') ?? plain) : (plain ?? by('KHR_texture_basisu'));
}

const WRAP: Readonly<Record<number, WrapMode>> = { 33071: 'clamp', 33648: 'mirror', 10497: 'repeat' };
const NEAREST = 9728;

/** A picture of the scene: one of the document's, or one made of some (none where the document has none). */
type Picture =
  { readonly image: number } | { readonly sources: readonly (number | undefined)[]; readonly derived: DerivedPicture };

const white = (): DecodedImage => ({ width: 1, height: 1, data: new Uint8Array([255, 255, 255, 255]) });

/** Pictures that are read at the same time. Decoders do not begin more than they have threads for. */
const AT_A_TIME = 16;

/** The textures that materials have asked for, with their pictures read as they are needed. */
export class TextureTable {
  readonly textures: Texture[] = [];
  /** Pictures (as the scene counts them) that could not be decoded. */
  readonly failed = new Set<number>();
  /** What is wrong with pictures that have been read: one warning each. */
  readonly #notes = new Map<number, SceneWarning>();
  readonly #wanted = new Map<string, number>();
  readonly #pictures: Picture[] = [];
  readonly #places = new Map<string, number>();
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
    let told: Promise<readonly CompressedFormat[]> | undefined;
    this.#formats = () => (told ??= typeof formats === 'function' ? formats() : Promise.resolve(formats));
  }

  /**
   * The scene's texture for one of the document's, read as `colorSpace`; undefined (with a warning) if there is none.
   */
  get(index: number, colorSpace: 'srgb' | 'linear', path: string): number | undefined {
    return this.#once(`${index} ${colorSpace}`, () => {
      const image = this.#imageOf(index, path);
      return image === undefined ? undefined : this.#add(index, colorSpace, this.#place(String(image), { image }));
    });
  }

  /**
   * A texture whose picture is made of the document's; it is read as the first of them is. Undefined (with a warning)
   * if there is none.
   */
  derive(
    { key, sources, convert }: GltfPictureConversion,
    colorSpace: 'srgb' | 'linear',
    path: string,
  ): number | undefined {
    const [first] = sources;
    if (!first) return undefined;
    return this.#once(`${first.index} ${colorSpace} ${key} ${sources.map(({ index }) => index)}`, () => {
      const images = sources.map(({ index }) => this.#imageOf(index, path));
      if (images.every((image) => image === undefined)) return undefined;
      return this.#add(
        first.index,
        colorSpace,
        this.#place(`${colorSpace} ${key} ${images}`, { sources: images, derived: { colorSpace, convert } }),
      );
    });
  }

  #once(key: string, make: () => number | undefined): number | undefined {
    const known = this.#wanted.get(key);
    if (known !== undefined) return known;
    const made = make();
    if (made !== undefined) this.#wanted.set(key, made);
    return made;
  }

  #imageOf(index: number, path: string): number | undefined {
    const texture = this.#json.textures?.[index];
    const image = sourceOf(texture, this.#ktx2 !== undefined);
    if (texture && image !== undefined && this.#json.images?.[image]) return image;
    const why = texture
      ? image === undefined
        ? 'has no picture in a format that is read'
        : `names image ${image}, which does not exist`
      : 'does not exist';
    this.#warnings.push({
      code: 'gltf/texture',
      message: `${this.#source.name}: texture ${index} ${why}; it is left out.`,
      path,
    });
    return undefined;
  }

  #place(key: string, picture: Picture): number {
    const known = this.#places.get(key);
    if (known !== undefined) return known;
    const at = this.#pictures.push(picture) - 1;
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

  /** How many pictures have been asked for. */
  get imageCount(): number {
    return this.#pictures.length;
  }

  #nameOf(index: number): string {
    const image = this.#json.images?.[index] as GltfImage;
    return image.name ?? (image.uri === undefined ? `image ${index}` : String(image.uri).slice(0, 80));
  }

  /**
   * Reads and decodes one of the document's pictures; undefined, with a warning, for one that cannot be decoded.
   * @throws {GltfError} as {@link readImages}.
   */
  async readImage(
    index: number,
    decode: ImageDecoder,
    viewBytes: (index: number) => Uint8Array<ArrayBuffer>,
    budget: Budget,
    signal: AbortSignal | undefined,
  ): Promise<DecodedImage | undefined> {
    signal?.throwIfAborted();
    const image = this.#json.images?.[index] as GltfImage;
    const bytes =
      image.uri === undefined ? viewBytes(image.bufferView ?? -1) : await readUri(image.uri, this.#source, signal);
    try {
      const type = pictureType(bytes);
      const declared = wrongType(image, type);
      if (declared !== undefined)
        this.#notes.set(index, {
          code: 'gltf/image',
          message: `${this.#source.name}: image ${index} ("${this.#nameOf(index)}") says that it is ${declared}, but its bytes are ${type}; the bytes count.`,
          path: `/images/${index}`,
        });
      if (type === 'image/ktx2' && !this.#ktx2)
        throw new GltfError(
          'gltf/missing-decoder',
          `${this.#source.name} has pictures in KTX2: pass decoders.ktx2, for which the package "three" has the transcoder.`,
          { location: { file: this.#source.name, path: `/images/${index}` } },
        );
      // Before a decoder allocates anything.
      const said = pictureSize(bytes, type);
      if (said) budget.take(4 * said.width * said.height, `/images/${index}`);
      const decoded =
        type === 'image/ktx2'
          ? await (this.#ktx2 as Ktx2Decoder)(bytes, await this.#formats())
          : await decode(bytes, type);
      if (!said) budget.take(4 * decoded.width * decoded.height, `/images/${index}`);
      return decoded;
    } catch (error) {
      // A decoder that does not start is of another package.
      if (error instanceof GlanzError && error.code !== 'gltf/picture') throw error;
      this.#notes.set(index, {
        code: 'gltf/image',
        message: `${this.#source.name}: image ${index} ("${this.#nameOf(index)}") cannot be decoded and is left out: ${error instanceof Error ? error.message.split('\n')[0] : String(error)}.`,
        path: `/images/${index}`,
      });
      return undefined;
    }
  }

  /**
   * Reads and decodes the pictures asked for, some at a time. One that cannot be decoded goes into {@link failed}, with
   * a warning.
   * @param viewBytes Bytes of a buffer view.
   * @param budget Told the bytes of each picture.
   * @throws {GltfError} `gltf/missing-resource` for a file that is not there.
   */
  async readImages(
    decode: ImageDecoder,
    viewBytes: (index: number) => Uint8Array<ArrayBuffer>,
    budget: Budget,
    signal: AbortSignal | undefined,
    onImage: () => void,
  ): Promise<Image[]> {
    const read = (index: number) => this.readImage(index, decode, viewBytes, budget, signal);
    const wanted = this.shownImages;
    // The first ones begin before this returns, so that decoders, which have threads of their own, are at work while
    // geometry is read.
    const decoding = new Map<number, Promise<DecodedImage | undefined>>();
    for (const [at, index] of wanted.entries()) {
      const before = decoding.get(wanted[at - AT_A_TIME] ?? -1);
      // Whoever waits for one hears of its error; the others go on.
      const promise = before
        ? before.then(
            () => read(index),
            () => read(index),
          )
        : read(index);
      promise.catch(() => undefined);
      decoding.set(index, promise);
    }
    const images: Image[] = [];
    for (const picture of this.#pictures) {
      if ('image' in picture) {
        const decoded = await decoding.get(picture.image);
        if (!decoded) this.failed.add(images.length);
        images.push(namedImage(this.#nameOf(picture.image), decoded ?? white()));
      } else {
        const sources: DecodedImage[] = [];
        for (const index of picture.sources)
          sources.push((index === undefined ? undefined : await decoding.get(index)) ?? white());
        const name = picture.sources.flatMap((index) => (index === undefined ? [] : [this.#nameOf(index)])).join(' + ');
        images.push({ name, ...(await convertImage(sources, picture.derived, signal)) });
      }
      onImage();
    }
    return images;
  }

  /** The document's images that materials show. */
  get shownImages(): number[] {
    const all = this.#pictures.flatMap((picture) =>
      'image' in picture ? [picture.image] : picture.sources.filter((index) => index !== undefined),
    );
    return [...new Set(all)];
  }

  /** Warnings about the pictures that have been read, in their order. */
  get pictureWarnings(): readonly SceneWarning[] {
    return [...this.#notes].sort(([a], [b]) => a - b).map(([, warning]) => warning);
  }
}
