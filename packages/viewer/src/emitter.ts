/** Options for {@link Emitter.on}. */
export interface ListenOptions {
  /** Hear the next event only. Default false. */
  readonly once?: boolean;
  /** Stops listening when it aborts. */
  readonly signal?: AbortSignal;
}

/** Typed events. `Events` maps names to what listeners are given. */
export class Emitter<Events extends object> {
  readonly #listeners = new Map<keyof Events, Set<(detail: never) => void>>();

  /**
   * Listens. One listener that throws does not keep others from hearing: its error goes to the console's uncaught
   * errors.
   *
   * @returns What stops listening.
   */
  on<K extends keyof Events>(type: K, listener: (detail: Events[K]) => void, options: ListenOptions = {}): () => void {
    const { once = false, signal } = options;
    if (signal?.aborted) return () => undefined;
    const off = () => {
      this.#listeners.get(type)?.delete(heard);
      signal?.removeEventListener('abort', off);
    };
    const heard = (detail: Events[K]) => {
      if (once) off();
      listener(detail);
    };
    const set = this.#listeners.get(type) ?? new Set();
    this.#listeners.set(type, set.add(heard as (detail: never) => void));
    signal?.addEventListener('abort', off);
    return off;
  }

  /** Whether anybody listens. */
  protected heard(type: keyof Events): boolean {
    return (this.#listeners.get(type)?.size ?? 0) > 0;
  }

  protected emit<K extends keyof Events>(type: K, detail: Events[K]): void {
    // Those that are there now: a listener may add or remove some.
    for (const listener of Array.from(this.#listeners.get(type) ?? [])) {
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

  protected silence(): void {
    this.#listeners.clear();
  }
}
