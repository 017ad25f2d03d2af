import { isSoftware, warmUp, type HierarchyBuilder, type PathTracer } from '@glanz/renderer';
import { untilAborted } from '@glanz/scene';
import { destroyed } from './errors';
import { LatestTask } from './latest-task';

/** The making of a scene's tracer: one at a time, the last one asked for. */
export class Preparation {
  readonly #ended: () => void;
  readonly #warming = new AbortController();
  readonly #task = new LatestTask();
  #destroyed = false;

  /** @param ended Called when a tracer is ready, or has failed, and no other is being made. */
  constructor(ended: () => void) {
    this.#ended = ended;
  }

  /** Whether a tracer is being made. */
  get running(): boolean {
    return this.#task.running;
  }

  /**
   * Does ahead, until the first tracer is asked for, what would delay that one, see `warmUp` of the renderer.
   *
   * @param requested Undefined: unless the adapter is software, whose CPU is busy enough.
   */
  warmUp(device: GPUDevice, hierarchies: HierarchyBuilder, requested: boolean | undefined): void {
    const { adapterInfo } = device as { readonly adapterInfo?: GPUAdapterInfo };
    if (this.#warming.signal.aborted || !(requested ?? !(adapterInfo && isSoftware(adapterInfo)))) return;
    void warmUp(device, { hierarchies, signal: this.#warming.signal });
  }

  /**
   * Makes a tracer. One that is being made already is given up at once; what still comes of it is freed.
   *
   * @param make Starts at once; its signal says that it is not wanted any more.
   * @param take Gets the tracer while this still counts as running, so that no code runs in between.
   * @param signal Of the caller.
   * @throws what `make` throws; an `AbortError` where another one is asked for meanwhile; the signal's reason;
   * {ViewerError} `viewer/destroyed`.
   */
  async run<T extends { readonly tracer: PathTracer }>(
    make: (signal: AbortSignal) => Promise<T>,
    take: (made: T) => void,
    signal?: AbortSignal,
  ): Promise<T> {
    this.#warming.abort();
    try {
      return await this.#task.run('another scene was requested', signal, async (either) => {
        if (this.#destroyed) throw destroyed();
        const made = await untilAborted(make(either), either, ({ tracer }) => tracer.destroy());
        take(made);
        return made;
      });
    } finally {
      if (!this.running) this.#ended();
    }
  }

  /** Gives up what is being made, and all that would be. */
  destroy(): void {
    this.#destroyed = true;
    this.#warming.abort();
    this.#task.abort();
  }
}
