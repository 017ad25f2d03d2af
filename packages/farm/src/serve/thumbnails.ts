/** How many are kept: more than the page shows. */
const KEPT = 64;

/** Small images of files that never change, made one after another and kept in memory. */
export class Thumbnails {
  readonly #make: ((file: string) => Promise<Uint8Array>) | undefined;
  readonly #kept = new Map<string, Promise<Uint8Array | undefined>>();
  #last: Promise<unknown> = Promise.resolve();

  /** @param make Makes a small image of a file. */
  constructor(make: ((file: string) => Promise<Uint8Array>) | undefined) {
    this.#make = make;
  }

  /** The thumbnail of a file; `undefined` where none can be made, and the image is shown instead. */
  async of(file: string): Promise<Uint8Array | undefined> {
    const make = this.#make;
    if (!make) return undefined;
    let thumbnail = this.#kept.get(file);
    if (!thumbnail) {
      thumbnail = this.#last.then(() => make(file)).catch(() => undefined);
      this.#last = thumbnail;
      this.#kept.set(file, thumbnail);
      for (const oldest of this.#kept.keys()) {
        if (this.#kept.size <= KEPT) break;
        this.#kept.delete(oldest);
      }
    }
    return thumbnail;
  }
}
