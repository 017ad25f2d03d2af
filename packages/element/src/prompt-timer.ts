const INPUTS = ['pointerdown', 'wheel', 'keydown', 'touchstart'] as const;

/**
 * Shows the prompt of an element once, where there is no input for a while after its model is there.
 */
export class PromptTimer {
  readonly #host: HTMLElement;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #end: (() => void) | undefined;
  #seen = false;

  constructor(host: HTMLElement) {
    this.#host = host;
    for (const type of INPUTS)
      host.addEventListener(
        type,
        () => {
          this.#seen = true;
          this.stop();
        },
        { passive: true },
      );
  }

  /** The model is there, and can be moved. */
  start(): void {
    const host = this.#host;
    this.stop();
    if (
      this.#seen ||
      host.getAttribute('interaction-prompt') !== 'auto' ||
      !host.hasAttribute('camera-controls') ||
      matchMedia('(prefers-reduced-motion: reduce)').matches
    )
      return;
    const threshold = Number(host.getAttribute('interaction-prompt-threshold') ?? 3000);
    this.#timer = setTimeout(
      async () => {
        const { showPrompt } = await import('./prompt');
        if (this.#seen || !host.isConnected) return;
        this.#seen = true;
        this.#end = showPrompt(host, host.getAttribute('interaction-prompt-style') !== 'basic');
      },
      threshold >= 0 ? threshold : 3000,
    );
  }

  /** No prompt, for now. */
  stop(): void {
    clearTimeout(this.#timer);
    this.#end?.();
    this.#end = undefined;
  }
}
