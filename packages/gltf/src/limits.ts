import { GltfError } from './error';

/** Limits on what a document may allocate. They are checked before each allocation and throw `gltf/too-large`. */
export interface GltfLimits {
  /**
   * Max bytes of decompressed geometry, all meshes together. Default 256 MiB plus 128 for each byte of the file, max
   * 4 GiB.
   */
  readonly geometryBytes?: number | undefined;
  /**
   * Max bytes of decoded images (4 per pixel), all together, as the file has them: `imageBudgetMiB` says how much of them
   * is held. Default 512 MiB plus 512 for each byte of the file, max 64 GiB.
   */
  readonly imageBytes?: number | undefined;
  /** Max instances. Default 1,048,576. */
  readonly instances?: number | undefined;
  /** Max bytes of the document and the files it names, together. Default 4 GiB. */
  readonly fileBytes?: number | undefined;
}

export const DEFAULT_LIMITS = {
  geometryBytes: 2 ** 32,
  imageBytes: 2 ** 36,
  instances: 2 ** 20,
  fileBytes: 2 ** 32,
} as const;

/** Default limits grow with the file: `base` bytes plus `factor` for each byte, more than any format compresses. */
const GROWTH: Partial<Record<keyof GltfLimits, { readonly base: number; readonly factor: number }>> = {
  geometryBytes: { base: 2 ** 28, factor: 128 },
  imageBytes: { base: 2 ** 29, factor: 512 },
};

/** Tracks how much of a limit has been used. */
export class Budget {
  readonly #file: string;
  readonly #name: keyof GltfLimits;
  readonly #limit: number;
  #used = 0;

  /** @param fileBytes Bytes of the document and the files it names; the default limits depend on them. */
  constructor(file: string, name: keyof GltfLimits, limits: GltfLimits | undefined, fileBytes = Infinity) {
    this.#file = file;
    this.#name = name;
    const { base, factor } = GROWTH[name] ?? { base: Infinity, factor: 1 };
    this.#limit = limits?.[name] ?? Math.min(DEFAULT_LIMITS[name], base + factor * fileBytes);
  }

  /** The amount that is left. */
  get left(): number {
    return Math.max(0, this.#limit - this.#used);
  }

  /** As {@link take}, without using it. */
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
