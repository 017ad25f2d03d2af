import { GltfError } from './error';

/** How much a document may ask for. What goes beyond is refused with `gltf/too-large`, before it is allocated. */
export interface GltfLimits {
  /**
   * Bytes of geometry after unpacking, all meshes together. Default 256 MiB and 128 for each byte of the file, 4 GiB at
   * most.
   */
  readonly geometryBytes?: number | undefined;
  /**
   * Bytes of decoded pictures (4 a pixel), all together. Default 512 MiB and 512 for each byte of the file, 4 GiB at
   * most.
   */
  readonly imageBytes?: number | undefined;
  /** Places of meshes. Default 1,048,576. */
  readonly instances?: number | undefined;
  /** Bytes of the document and the files it names, together. Default 4 GiB. */
  readonly fileBytes?: number | undefined;
}

export const DEFAULT_LIMITS = {
  geometryBytes: 2 ** 32,
  imageBytes: 2 ** 32,
  instances: 2 ** 20,
  fileBytes: 2 ** 32,
} as const;

/** What a small file may ask for, and what more each of its bytes brings: formats pack well, but not without bounds. */
const GROWTH: Partial<Record<keyof GltfLimits, { readonly base: number; readonly factor: number }>> = {
  geometryBytes: { base: 2 ** 28, factor: 128 },
  imageBytes: { base: 2 ** 29, factor: 512 },
};

/** An amount that is used up piece by piece. */
export class Budget {
  readonly #file: string;
  readonly #name: keyof GltfLimits;
  readonly #limit: number;
  #used = 0;

  /** @param fileBytes Of the document and what it names: a default limit is no more than such a file can need. */
  constructor(file: string, name: keyof GltfLimits, limits: GltfLimits | undefined, fileBytes = Infinity) {
    this.#file = file;
    this.#name = name;
    const { base, factor } = GROWTH[name] ?? { base: Infinity, factor: 1 };
    this.#limit = limits?.[name] ?? Math.min(DEFAULT_LIMITS[name], base + factor * fileBytes);
  }

  /** What may still be taken. */
  get left(): number {
    return Math.max(0, this.#limit - this.#used);
  }

  /** As {@link take}, but nothing is used up. */
  check(amount: number, path: string): void {
    this.take(amount, path);
    this.#used -= amount;
  }

  /**
   * @param path What needs it, as a JSON pointer.
   * @throws {GltfError} `gltf/too-large`
   */
  take(amount: number, path: string): void {
    this.#used += amount;
    if (this.#used > this.#limit) {
      throw new GltfError(
        'gltf/too-large',
        `${this.#file}: ${path} brings the file to ${this.#used} of limits.${this.#name}, where ${this.#limit} are allowed: raise the limit if you trust the file.`,
        { location: { file: this.#file, path } },
      );
    }
  }
}
