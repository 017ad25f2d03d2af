/** Watches whether an element can be seen: in the window, in a tab that is shown. */
export class Visibility {
  readonly #listeners = new AbortController();
  readonly #observer: IntersectionObserver;
  #inView = true;
  #changed: () => void;

  constructor(element: Element, changed: () => void) {
    this.#changed = changed;
    document.addEventListener('visibilitychange', () => this.#changed(), { signal: this.#listeners.signal });
    this.#observer = new IntersectionObserver((entries) => {
      const seen = entries[entries.length - 1]?.isIntersecting ?? true;
      if (seen === this.#inView) return;
      this.#inView = seen;
      this.#changed();
    });
    this.#observer.observe(element);
  }

  get visible(): boolean {
    return this.#inView && document.visibilityState !== 'hidden';
  }

  destroy(): void {
    this.#changed = () => undefined;
    this.#listeners.abort();
    this.#observer.disconnect();
  }
}

/** The next turn of the event loop. */
export const soon = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 0));

/**
 * The next frame of the screen, or a while later where none comes: a page may be hidden between the question and the
 * answer.
 */
export function nextFrame(): Promise<void> {
  return new Promise((resolve) => {
    const late = setTimeout(() => {
      cancelAnimationFrame(frame);
      resolve();
    }, 250);
    const frame = requestAnimationFrame(() => {
      clearTimeout(late);
      resolve();
    });
  });
}
