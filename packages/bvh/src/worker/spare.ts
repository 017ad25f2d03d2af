/**
 * So long after it was left memory is held for the next build; garbage collectors take it between any two otherwise.
 */
export const HOLD_MS = 1000;

/** What one build leaves to the next: held for a second, afterwards for as long as nobody wants the memory. */
export class Spare<T extends object> {
  #left: WeakRef<T> | undefined;
  #timer: ReturnType<typeof setTimeout> | undefined;

  leave(what: T): void {
    this.clear();
    this.#left = new WeakRef(what);
    // The timer has it, and nobody else. It is let go too, as those of Node keep what they were given.
    this.#timer = setTimeout((_held: T) => (this.#timer = undefined), HOLD_MS, what);
    // In Node a timer would keep the process.
    (this.#timer as { unref?: () => void }).unref?.();
  }

  /** What was left, if it is still there. Nobody else gets it. */
  take(): T | undefined {
    const left = this.#left?.deref();
    this.clear();
    return left;
  }

  clear(): void {
    clearTimeout(this.#timer);
    this.#left = this.#timer = undefined;
  }
}
