type Apply = (merged: object) => void | Promise<void> | undefined;

interface Waiting {
  readonly apply: Apply;
  readonly value: object;
  readonly done: ((error?: unknown) => void)[];
}

/** Edits that wait for their turn. Of several with one key the last one counts; the fields of their values add up. */
export class Edits {
  readonly #waiting = new Map<unknown, Waiting>();

  get size(): number {
    return this.#waiting.size;
  }

  /** @returns When it, or a later one with its key, has taken effect. */
  add(key: unknown, apply: Apply, value: object = {}): Promise<void> {
    return new Promise((resolve, reject) => {
      const former = this.#waiting.get(key);
      const done = [...(former?.done ?? []), (error?: unknown) => (error === undefined ? resolve() : reject(error as Error))];
      this.#waiting.set(key, { apply, value: { ...former?.value, ...value }, done });
    });
  }

  /** Applies all in the order they first came. @returns Whether there were any. */
  apply(finished: () => void): boolean {
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const { apply, value, done } of waiting) {
      const settle = (error?: unknown) => {
        for (const tell of done) tell(error);
        finished();
      };
      try {
        Promise.resolve(apply(value)).then(() => settle(), settle);
      } catch (error) {
        settle(error);
      }
    }
    return waiting.length > 0;
  }

  /** Forgets all; whoever waits for them is told why. */
  clear(reason: unknown): void {
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const { done } of waiting) for (const tell of done) tell(reason);
  }
}
