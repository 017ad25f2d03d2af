import { isLoss } from './aborts';

type Apply = (merged: object) => void | Promise<void> | undefined;

/** One call of an edit. */
interface Call {
  readonly apply: Apply;
  readonly value: object;
  readonly resolve: () => void;
  readonly reject: (error: unknown) => void;
}

/** Edits that wait for their turn. Of several with one key the last one counts; the fields of their values add up. */
export class Edits {
  readonly #waiting = new Map<unknown, readonly Call[]>();

  get size(): number {
    return this.#waiting.size;
  }

  /**
   * @returns When it, or a later one with its key, has taken effect.
   * @throws what `apply` throws. Others with its key that wait with it still take effect.
   */
  add(key: unknown, apply: Apply, value: object = {}): Promise<void> {
    return new Promise((resolve, reject) =>
      this.#waiting.set(key, [...(this.#waiting.get(key) ?? []), { apply, value, resolve, reject }]),
    );
  }

  /**
   * Applies all in the order they first came.
   * @param begun Gets a promise for each, which resolves when it has taken effect, was refused, or waits again.
   */
  apply(begun: (effect: Promise<void>) => void): void {
    const waiting = [...this.#waiting];
    this.#waiting.clear();
    for (const [key, calls] of waiting) begun(this.#run(key, calls));
  }

  /** Drops all; their promises reject with the reason. */
  clear(reason: unknown): void {
    const waiting = [...this.#waiting.values()].flat();
    this.#waiting.clear();
    for (const { reject } of waiting) reject(reason);
  }

  async #run(key: unknown, calls: readonly Call[]): Promise<void> {
    const last = calls[calls.length - 1] as Call;
    try {
      await last.apply(Object.assign({}, ...calls.map(({ value }) => value)) as object);
      for (const { resolve } of calls) resolve();
      return;
    } catch (error) {
      if (isLoss(error)) return this.#again(key, calls);
      if (calls.length === 1) return last.reject(error);
    }
    // One of them was refused, which is no fault of the others.
    for (const call of calls) {
      try {
        await call.apply(call.value);
        call.resolve();
      } catch (error) {
        if (isLoss(error)) this.#again(key, [call]);
        else call.reject(error);
      }
    }
  }

  /** Ahead of what has come since. */
  #again(key: unknown, calls: readonly Call[]): void {
    this.#waiting.set(key, [...calls, ...(this.#waiting.get(key) ?? [])]);
  }
}
