import type { Scene } from '@glanz/scene';
import { LoadWorker } from './load-scene';
import type { ModelRequest } from './load-messages';

/** A file of the user's, posed repeatedly by a worker that stays. */
export class Poser {
  readonly request: ModelRequest & { readonly kind: 'files' };
  readonly #worker = new LoadWorker();

  constructor(request: ModelRequest & { readonly kind: 'files' }) {
    this.request = request;
  }

  /**
   * The model without its images, in the pose of an animation; one question at a time.
   *
   * @param animation Its index; null: at rest.
   * @param time Seconds from its beginning.
   */
  pose(animation: number | null, time: number): Promise<Scene> {
    const { animation: _a, time: _t, ...rest } = this.request;
    return this.#worker.ask({ ...rest, shapesOnly: true, ...(animation === null ? {} : { animation, time }) });
  }

  destroy(): void {
    this.#worker.destroy();
  }
}
