import type { SessionStatus } from '../viewer/session';
import { byId } from './elements';
import { spokenRate, spokenTime } from './figures';

const STAGES: Readonly<Record<string, string>> = {
  make: 'Generating model',
  read: 'Reading model',
  decode: 'Decoding model',
  images: 'Decoding images',
  bvh: 'Building hierarchy',
  upload: 'Uploading',
  compile: 'Compiling',
};

/** The state of the render, in a line under the image and in attributes of its canvas. */
export class StatusLine {
  readonly #canvas: HTMLCanvasElement;
  readonly #done = byId<HTMLProgressElement>('done');
  readonly #text = byId('status');

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
  }

  /** A model is being prepared; `done` is the progress of the stage, 0..1. */
  prepare(stage: string, done?: number): void {
    byId('preparing').hidden = false;
    byId('preparing-text').textContent = STAGES[stage] ?? stage;
    const bar = byId<HTMLProgressElement>('preparing-bar');
    if (done === undefined) bar.removeAttribute('value');
    else bar.value = done;
  }

  prepared(): void {
    byId('preparing').hidden = true;
  }

  show({ state, samples, target, samplesPerSecond, remainingMs, noise, active, denoised }: SessionStatus): void {
    const { dataset } = this.#canvas;
    dataset['state'] = state;
    dataset['samples'] = String(samples);
    dataset['target'] = String(target);
    this.#done.value = target > 0 ? Math.min(1, samples / target) : 0;
    this.#done.hidden = state !== 'rendering' && state !== 'paused';
    dataset['denoised'] = String(denoised);
    const how = denoised ? ' · denoised' : '';
    const count = `${samples} of ${target} samples${how}`;
    const calm =
      noise === undefined
        ? ''
        : ` · noise ${(100 * noise).toPrecision(2)} %${active < 1 ? `, ${Math.round(100 * active)} % noisy` : ''}`;
    const left = samplesPerSecond > 0 ? ` · ${spokenRate(samplesPerSecond)} · ${spokenTime(remainingMs)} left` : '';
    // Other states have none.
    const texts: Partial<Record<typeof state, string>> = {
      moving: 'Preview',
      rendering: count + left + calm,
      paused: `${count} · paused`,
      done: `${samples} sample${samples > 1 ? 's' : ''} · done${how}${calm}`,
      recovering: 'Waiting for GPU',
      failed: 'Stopped',
    };
    this.#text.textContent = texts[state] ?? '';
  }
}
