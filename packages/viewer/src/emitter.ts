/** Options for {@link Emitter.on}. */
export interface ListenOptions {
  /** Calls the listener for the next event only. Default false. */
  readonly once?: boolean;
  /** Removes the listener when it aborts. */
  readonly signal?: AbortSignal;
}

/** Typed events. `Events` maps the name of an event to the type of its detail. */
export class Emitter<Events extends object> {
  #listeners: Map<keyof Events, Set<(detail: never) => void>> | undefined = new Map();

  /**
   * Adds a listener. Where one throws, the others are still called, and its error is an uncaught error of the
   * page.
   *
   * @returns A function that removes the listener.
   */
  on<K extends keyof Events>(type: K, listener: (detail: Events[K]) => void, options: ListenOptions = {}): () => void {
    const { once = false, signal } = options;
    const called = (detail: Events[K]) => {
      if (once) off();
      listener(detail);
    };
    const off = () => {
      this.#listeners?.get(type)?.delete(called);
      signal?.removeEventListener('abort', off);
    };
    if (!this.#listeners || signal?.aborted) return off;
    const set = this.#listeners.get(type) ?? new Set();
    this.#listeners.set(type, set.add(called as (detail: never) => void));
    signal?.addEventListener('abort', off);
    return off;
  }

  /** Whether an event has listeners. */
  has(type: keyof Events): boolean {
    return (this.#listeners?.get(type)?.size ?? 0) > 0;
  }

  /** Calls the listeners of an event, in the order in which they were added. */
  emit<K extends keyof Events>(type: K, detail: Events[K]): void {
    // A copy: a listener may add or remove others.
    for (const listener of Array.from(this.#listeners?.get(type) ?? [])) {
      try {
        (listener as (detail: Events[K]) => void)(detail);
      } catch (error) {
        // The loop must continue; the page's own error handlers receive it.
        queueMicrotask(() => {
          throw error;
        });
      }
    }
  }

  /** Removes all listeners; those that are added later are never called. */
  close(): void {
    this.#listeners = undefined;
  }
}
