import { GltfError } from './error';

/** How much a document may ask for. What goes beyond is refused with `gltf/too-large`, before it is allocated. */
export interface GltfLimits {
  /** Bytes of geometry after unpacking, all meshes together. Default 4 GiB. */
  readonly geometryBytes?: number | undefined;
  /** Bytes of decoded pictures (4 a pixel), all together. Default 4 GiB. */
  readonly imageBytes?: number | undefined;
  /** Places of meshes. Default 4,194,304. */
  readonly instances?: number | undefined;
  /** Bytes of the document and the files it names, together. Default 4 GiB. */
  readonly fileBytes?: number | undefined;
}

export const DEFAULT_LIMITS = { geometryBytes: 2 ** 32, imageBytes: 2 ** 32, instances: 2 ** 22, fileBytes: 2 ** 32 } as const;

/** An amount that is used up piece by piece. */
export class Budget {
  readonly #file: string;
  readonly #name: keyof GltfLimits;
  readonly #limit: number;
  #used = 0;

  constructor(file: string, name: keyof GltfLimits, limits: GltfLimits | undefined) {
    this.#file = file;
    this.#name = name;
    this.#limit = limits?.[name] ?? DEFAULT_LIMITS[name];
  }

  /**
   * @param path What needs it, as a JSON pointer.
   * @throws {GltfError} `gltf/too-large`
   */
  take(amount: number, path: string): void {
    this.#used += amount;
    if (this.#used > this.#limit) {
      throw new GltfError('gltf/too-large', `${this.#file}: ${path} brings the file to ${this.#used} of limits.${this.#name}, where ${this.#limit} are allowed: raise the limit if you trust the file.`, { location: { file: this.#file, path } });
    }
  }
}
