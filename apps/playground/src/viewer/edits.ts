type Apply = (merged: object) => void | Promise<void> | undefined;

/** Edits that wait for their turn. Of several with one key the last one counts; the fields of their values add up. */
export class Edits {
  readonly #waiting = new Map<string, { readonly apply: Apply; readonly value: object }>();

  get size(): number {
    return this.#waiting.size;
  }

  add(key: string, apply: Apply, value: object = {}): void {
    this.#waiting.set(key, { apply, value: { ...this.#waiting.get(key)?.value, ...value } });
  }

  /** Applies all in the order they first came. @returns Whether there were any. */
  apply(onError: (error: unknown) => void): boolean {
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const { apply, value } of waiting) {
      try {
        Promise.resolve(apply(value)).catch(onError);
      } catch (error) {
        onError(error);
      }
    }
    return waiting.length > 0;
  }

  /** Forgets all but some. */
  clear(keep: (key: string) => boolean): void {
    for (const key of this.#waiting.keys()) if (!keep(key)) this.#waiting.delete(key);
  }
}
