/**
 * Milliseconds for which memory is retained for the next build; otherwise it is often collected between two builds.
 */
export const RETAIN_MS = 1000;

/** An object kept for the next build: by a strong reference for a second, then by a weak one. */
export class Retained<T extends object> {
  #kept: WeakRef<T> | undefined;
  #timer: ReturnType<typeof setTimeout> | undefined;

  keep(what: T): void {
    this.clear();
    this.#kept = new WeakRef(what);
    // Only the timer refers to it. The timer is dropped too, as Node's timers keep their arguments.
    this.#timer = setTimeout((_held: T) => (this.#timer = undefined), RETAIN_MS, what);
    // In Node a timer would keep the process alive.
    (this.#timer as { unref?: () => void }).unref?.();
  }

  /** Takes the object out, if it still exists. */
  take(): T | undefined {
    const kept = this.#kept?.deref();
    this.clear();
    return kept;
  }

  clear(): void {
    clearTimeout(this.#timer);
    this.#kept = this.#timer = undefined;
  }
}
