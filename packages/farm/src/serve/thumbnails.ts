/** How many are kept: more than the page shows. */
const KEPT = 64;

/** Small images of files that never change, made one after another and kept in memory. */
export class Thumbnails {
  readonly #make: (file: string) => Promise<Uint8Array>;
  readonly #kept = new Map<string, Promise<Uint8Array>>();
  #last: Promise<unknown> = Promise.resolve();

  /** @param make Makes a small image of a file. */
  constructor(make: (file: string) => Promise<Uint8Array>) {
    this.#make = make;
  }

  /** The thumbnail of a file. Rejects where none can be made; the next call tries again. */
  async of(file: string): Promise<Uint8Array> {
    let thumbnail = this.#kept.get(file);
    if (!thumbnail) {
      const making = this.#last.then(() => this.#make(file));
      thumbnail = making;
      this.#last = making.catch(() => {
        if (this.#kept.get(file) === making) this.#kept.delete(file);
      });
      this.#kept.set(file, thumbnail);
      for (const oldest of this.#kept.keys()) {
        if (this.#kept.size <= KEPT) break;
        this.#kept.delete(oldest);
      }
    }
    return thumbnail;
  }
}
