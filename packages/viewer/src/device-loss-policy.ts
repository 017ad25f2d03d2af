import { ViewerError } from './errors';

const WINDOW_MS = 60_000;
const MAX_LOSSES = 3;

/** Decides whether another device is requested after a loss: not where the GPU fails repeatedly. */
export class DeviceLossPolicy {
  #times: number[] = [];

  /**
   * Waits before the next attempt, longer each time.
   *
   * @throws {ViewerError} `viewer/device-lost` after three losses within a minute.
   */
  async next(now = performance.now()): Promise<void> {
    this.#times = [...this.#times.filter((time) => now - time < WINDOW_MS), now];
    if (this.#times.length > MAX_LOSSES)
      throw new ViewerError(
        'viewer/device-lost',
        'The GPU was lost repeatedly. Show a smaller model or image, or close other programs.',
      );
    await new Promise((resolve) => setTimeout(resolve, 200 * this.#times.length ** 2));
  }

  /** Forgets the losses so far. */
  reset(): void {
    this.#times = [];
  }
}
