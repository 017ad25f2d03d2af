import type { FilmState } from '../backend';
import type { Shot } from './shots';

/** An image to make, and how far it is. */
export interface Job {
  readonly shot: Shot;
  /** Its film when a GPU was lost and not recovered. */
  film?: FilmState;
  /** GPUs that gave devices and lost each of them on this image. */
  lostGpus: number;
}

/** Images that wait for a GPU. A worker that takes one says later that it is done, or gives it back. */
export class JobQueue {
  readonly #waiting: Job[];
  readonly #idle: (() => void)[] = [];
  #busy = 0;
  #closed = false;

  constructor(shots: readonly Shot[]) {
    this.#waiting = shots.map((shot) => ({ shot, lostGpus: 0 }));
  }

  /**
   * The next image; `undefined` when all are made. While others work it waits: one of their GPUs may be lost, and its
   * image comes back.
   */
  async take(): Promise<Job | undefined> {
    while (!this.#closed) {
      const job = this.#waiting.shift();
      if (job) {
        this.#busy++;
        return job;
      }
      if (this.#busy === 0) return undefined;
      await new Promise<void>((wake) => this.#idle.push(wake));
    }
    return undefined;
  }

  /** An image is made, or has failed. */
  done(): void {
    this.#busy--;
    this.#wake();
  }

  /** An image goes to the next that asks. */
  giveBack(job: Job): void {
    this.#waiting.unshift(job);
    this.done();
  }

  /** Nothing is given out any more. */
  close(): void {
    this.#closed = true;
    this.#wake();
  }

  /** Jobs that were not taken. */
  rest(): Job[] {
    return this.#waiting.splice(0);
  }

  #wake(): void {
    for (const wake of this.#idle.splice(0)) wake();
  }
}
