import { Session, type Profiler } from 'node:inspector';

/** What {@link OperationCounter.measure} gives. */
export interface Measured<T> {
  /** Blocks of source text that were entered: functions, branches, and bodies of loops once per turn. */
  readonly operations: number;
  readonly result: T;
}

/**
 * Counts the blocks of JavaScript that run in some files, by V8's precise coverage. The count depends on the code and
 * its input alone, not on the machine. Built-in functions count nothing, however long they take.
 *
 * Functions that ran before the counter was made may be counted by their calls alone: make it before the code runs.
 * There is one counter per thread at a time.
 */
export class OperationCounter {
  readonly #session = new Session();
  readonly #files: RegExp;
  #busy = false;

  /** @param files Matches the addresses of the files whose operations count. */
  constructor(files: RegExp) {
    this.#files = files;
    this.#session.connect();
    this.#session.post('Profiler.enable');
    this.#session.post('Profiler.startPreciseCoverage', { callCount: true, detailed: true });
  }

  #take(): number {
    let taken: readonly Profiler.ScriptCoverage[] = [];
    // The inspector answers a session of its own thread before post() returns.
    this.#session.post('Profiler.takePreciseCoverage', (error, { result }) => {
      if (error) throw error;
      taken = result;
    });
    let operations = 0;
    for (const { url, functions } of taken) {
      if (!this.#files.test(url)) continue;
      for (const { ranges } of functions) for (const { count } of ranges) operations += count;
    }
    return operations;
  }

  /** Runs something and counts, one thing at a time. @throws What it throws. */
  async measure<T>(run: () => T | Promise<T>): Promise<Measured<T>> {
    if (this.#busy) throw new Error('OperationCounter: one measurement has to end before the next begins.');
    this.#busy = true;
    try {
      this.#take();
      const result = await run();
      return { operations: this.#take(), result };
    } finally {
      this.#busy = false;
    }
  }

  /** Ends counting. */
  end(): void {
    this.#session.post('Profiler.stopPreciseCoverage');
    this.#session.disconnect();
  }
}
