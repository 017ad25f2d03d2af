import type { ModelRequest } from '../input/load-messages';
import type { Opened } from '../input/opening';
import { Poser } from '../input/poser';
import type { State } from '../state/state';
import type { EffectsHost } from './effects';
import { applyPose, posedScene } from './pose';

/** What poses change. */
export interface PosingHost {
  readonly effects: EffectsHost;
  readonly opened: () => Opened | undefined;
  /** The model that is shown has another pose: its shapes, and nothing else, are other ones. */
  readonly setPosed: (opened: Opened) => void;
  /** Loads the model again. */
  readonly load: (request: ModelRequest, state: State) => Promise<void>;
}

/** Brings models into the pose of their animation that the page's state says. */
export class Posing {
  readonly #host: PosingHost;
  #poser: Poser | undefined;
  #running: Promise<boolean> | undefined;

  constructor(host: PosingHost) {
    this.#host = host;
  }

  /** @returns Whether there is a model to pose, and it has been. */
  async pose(): Promise<boolean> {
    // The last one that was asked for counts.
    if (this.#running) await this.#running;
    return (this.#running ??= this.#poseNow().finally(() => (this.#running = undefined)));
  }

  async #poseNow(): Promise<boolean> {
    const { effects, load } = this.#host;
    const opened = this.#host.opened();
    const request = opened?.request;
    if (!opened || request?.kind !== 'files') return false;
    if (this.#poser?.request !== request) {
      this.#poser?.destroy();
      this.#poser = new Poser(request);
    }
    try {
      const { clip, time } = effects.state();
      const pose = await this.#poser.pose(clip, time);
      if (this.#host.opened() !== opened) return false;
      const scene = posedScene(opened.scene, pose);
      if (!scene) {
        const { animation: _a, time: _t, ...rest } = request;
        await load(clip === null ? rest : { ...rest, animation: clip, time }, effects.state());
        return true;
      }
      this.#host.setPosed({ ...opened, scene });
      await effects.session.edit('pose', (tracer) => applyPose(tracer, scene, effects.state()));
      return true;
    } catch (error) {
      effects.onError(error);
      return false;
    }
  }
}
