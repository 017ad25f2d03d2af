import { abortError } from './aborts';

/** Runs one task at a time: a new one aborts the one that is running. */
export class LatestTask {
  #control: AbortController | undefined;

  /** Whether a task is running. */
  get running(): boolean {
    return this.#control !== undefined;
  }

  /**
   * Runs a task.
   *
   * @param reason Message of the error with which the former one is aborted.
   * @param signal Of the caller; aborts the task as well.
   * @param task Its signal also aborts when the task has failed, so that nothing goes on in the background.
   */
  async run<T>(reason: string, signal: AbortSignal | undefined, task: (signal: AbortSignal) => Promise<T>): Promise<T> {
    this.abort(reason);
    const control = (this.#control = new AbortController());
    try {
      return await task(signal ? AbortSignal.any([signal, control.signal]) : control.signal);
    } catch (error) {
      control.abort(error);
      throw error;
    } finally {
      if (this.#control === control) this.#control = undefined;
    }
  }

  /** Aborts the task that is running. */
  abort(reason?: string): void {
    this.#control?.abort(abortError(reason));
  }
}
