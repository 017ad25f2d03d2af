import type { Image, Scene, Texture, TextureBinding, WrapMode } from '@glanz/scene';
import { fromHalf } from './half';
import type { ThreeTexture } from './types';

/** Constants of three, by their numbers, which have been the same since there are textures. */
const WRAPS: Readonly<Record<number, WrapMode>> = { 1000: 'repeat', 1001: 'clamp', 1002: 'mirror' };
const NEAREST = 1003;
const HALF_FLOAT = 1016;

/** Gives the pixels of a texture's image: for images that only the host can read. */
export type ReadImage = (
  image: unknown,
  texture: object,
) => Promise<Pick<Image, 'width' | 'height' | 'data'> | undefined>;

interface Raw {
  readonly data: ArrayLike<number>;
  readonly width: number;
  readonly height: number;
}

const isRaw = (image: unknown): image is Raw =>
  typeof image === 'object' && image !== null && ArrayBuffer.isView((image as { data?: unknown }).data);

/** RGBA floats of raw data of 1 to 4 channels, integers as fractions. */
export function floatsOf({ data, width, height }: Raw, type: number): Float32Array<ArrayBuffer> {
  const channels = Math.round(data.length / (width * height));
  const whole =
    data instanceof Uint8Array || data instanceof Uint8ClampedArray
      ? 255
      : data instanceof Uint16Array && type !== HALF_FLOAT
        ? 65535
        : 1;
  const valueOf =
    type === HALF_FLOAT && data instanceof Uint16Array
      ? (code: number) => fromHalf(code)
      : (value: number) => value / whole;
  const out = new Float32Array(width * height * 4);
  for (let i = 0; i < width * height; i++) {
    for (let k = 0; k < 4; k++)
      out[4 * i + k] =
        k < channels
          ? valueOf(data[channels * i + k] as number)
          : k === 3
            ? 1
            : channels === 1
              ? valueOf(data[i] as number)
              : 0;
  }
  return out;
}

/** The scene's textures and images, each once. */
export class Textures {
  readonly #scene: Scene;
  readonly #read: ReadImage | undefined;
  readonly #textures = new Map<string, number>();
  readonly #images = new Map<unknown, Promise<number | undefined>>();

  constructor(scene: Scene, read: ReadImage | undefined) {
    this.#scene = scene;
    this.#read = read;
  }

  /**
   * Index of a texture as it is read in a colour space; `undefined`, with a warning, where its image cannot be had.
   */
  async get(texture: ThreeTexture, colorSpace: Texture['color_space']): Promise<number | undefined> {
    const key = `${texture.uuid} ${colorSpace}`;
    const known = this.#textures.get(key);
    if (known !== undefined) return known;
    const image = await this.#image(texture);
    if (image === undefined) return undefined;
    const again = this.#textures.get(key);
    if (again !== undefined) return again;
    const made: Texture = {
      image,
      color_space: colorSpace,
      wrap_u: WRAPS[texture.wrapS] ?? 'clamp',
      wrap_v: WRAPS[texture.wrapT] ?? 'clamp',
      ...(texture.name ? { name: texture.name } : {}),
      ...(texture.magFilter === NEAREST ? { filter: 'nearest' as const } : {}),
    };
    const index = this.#scene.textures.push(made) - 1;
    this.#textures.set(key, index);
    return index;
  }

  /** A texture of an image that is made here. */
  add(image: Image, like: ThreeTexture, colorSpace: Texture['color_space']): number {
    return (
      this.#scene.textures.push({
        image: this.#scene.images.push(image) - 1,
        color_space: colorSpace,
        wrap_u: WRAPS[like.wrapS] ?? 'clamp',
        wrap_v: WRAPS[like.wrapT] ?? 'clamp',
      }) - 1
    );
  }

  /** The image of a texture. */
  async imageOf(texture: ThreeTexture): Promise<Image | undefined> {
    const index = await this.#image(texture);
    return index === undefined ? undefined : this.#scene.images[index];
  }

  /** Pixels of an image that becomes no texture, as they are in memory; `undefined` where they cannot be had. */
  pixelsOf(source: unknown, texture: ThreeTexture): Promise<Pick<Image, 'width' | 'height' | 'data'> | undefined> {
    return this.#readImage(texture, source).catch(() => undefined);
  }

  #image(texture: ThreeTexture): Promise<number | undefined> {
    const source = texture.source?.data ?? texture.image;
    const known = this.#images.get(source);
    if (known) return known;
    const made = this.#readImage(texture, source)
      .then(
        (image) =>
          image
            ? this.#scene.images.push({
                ...(texture.name ? { name: texture.name } : { name: `image ${this.#scene.images.length}` }),
                ...image,
              } as Image) - 1
            : undefined,
        () => undefined,
      )
      .then((index) => {
        if (index === undefined)
          this.#scene.warnings.push({
            code: 'three/image',
            message: `The image of texture "${texture.name || texture.uuid}" cannot be read (compressed, on the GPU only, not loaded yet, or from another origin): it is left out.`,
          });
        return index;
      });
    this.#images.set(source, made);
    return made;
  }

  async #readImage(texture: ThreeTexture, source: unknown): Promise<Omit<Image, 'name'> | undefined> {
    const given = await this.#read?.(source, texture);
    if (given) return given;
    if (isRaw(source)) {
      const { width, height, data } = source;
      if ((data instanceof Uint8Array || data instanceof Uint8ClampedArray) && data.length === width * height * 4)
        return { width, height, data: new Uint8Array(data) };
      if (data instanceof Uint8Array || data instanceof Uint8ClampedArray)
        return {
          width,
          height,
          data: Uint8Array.from(floatsOf(source, texture.type), (value) => Math.round(255 * value)),
        };
      return { width, height, data: floatsOf(source, texture.type) };
    }
    if (typeof createImageBitmap === 'undefined' || !source) return undefined;
    const bitmap = await createImageBitmap(source as ImageBitmapSource, {
      premultiplyAlpha: 'none',
      colorSpaceConversion: 'none',
    });
    const { width, height } = bitmap;
    const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    if (!context || width * height === 0) return undefined;
    context.drawImage(bitmap, 0, 0);
    return {
      width,
      height,
      data: context.getImageData(0, 0, width, height).data as Uint8ClampedArray<ArrayBuffer>,
      bitmap,
    };
  }
}

/**
 * Maps the mesh's coordinates, which are turned over with `flipped`, to the place in an image whose first row is at
 * the top: through the texture's own matrix, and turned over if three turns the image over.
 */
export function uvTransformOf(texture: ThreeTexture, flipped: boolean): TextureBinding['transform'] {
  if (texture.matrixAutoUpdate) texture.updateMatrix();
  const e = texture.matrix.elements as ArrayLike<number>;
  const n = (i: number) => e[i] as number;
  // u' = a u + c v + x, v' = b u + d v + y, with v = 1 − v of the mesh where it is flipped.
  const [a, c, x] = flipped ? [n(0), -n(3), n(6) + n(3)] : [n(0), n(3), n(6)];
  const [b0, d0, y0] = flipped ? [n(1), -n(4), n(7) + n(4)] : [n(1), n(4), n(7)];
  const [b, d, y] = texture.flipY ? [-b0, -d0, 1 - y0] : [b0, d0, y0];
  const near = (value: number, target: number) => Math.abs(value - target) < 1e-9;
  return near(a, 1) && near(b, 0) && near(c, 0) && near(d, 1) && near(x, 0) && near(y, 0)
    ? undefined
    : [a, b, c, d, x, y];
}
