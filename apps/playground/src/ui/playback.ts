import type { Context } from './context';
import { element } from './elements';
import { sliderField, type Field } from './fields';
import { icon } from './icons';

/** A page that slept continues where it stopped. */
const LONGEST_STEP = 0.25;

/** Plays the chosen animation, or shows a moment of it: a button and a slider. */
export class Playback {
  readonly element = element('div', { class: 'playback', hidden: true });
  readonly #context: Context;
  readonly #button = element('button', { type: 'button', id: 'play', class: 'quiet square', 'aria-pressed': 'false' });
  #slider: Field<number> | undefined;
  #duration = 0;
  #playing = false;

  constructor(context: Context) {
    this.#context = context;
    this.#button.addEventListener('click', () => this.toggle());
    context.store.subscribe(({ time }, before) => {
      if (time !== before.time) this.#slider?.set(time);
    });
    this.#mark();
  }

  /** @param duration Seconds of the chosen animation; undefined where there is none. */
  show(duration: number | undefined): void {
    const { store } = this.#context;
    this.element.hidden = duration === undefined;
    if (duration === undefined) this.#stop();
    else if (this.#slider === undefined || duration !== this.#duration) {
      this.#duration = Math.max(duration, 0.001);
      this.#slider = sliderField({
        id: 'time',
        label: 'Time',
        unit: 's',
        value: store.state.time,
        range: [0, this.#duration],
        onInput: (time) => {
          this.#stop();
          store.set({ time }, { label: 'Time' });
          void this.#context.pose();
        },
      });
      this.element.replaceChildren(this.#button, this.#slider.element);
    }
  }

  toggle(): void {
    if (this.#playing) this.#stop();
    else if (!this.element.hidden) {
      this.#playing = true;
      this.#mark();
      void this.#run();
    }
  }

  /** A pose after the other, each as soon as the one before it is on the screen. */
  async #run(): Promise<void> {
    const { store, pose } = this.#context;
    const { clip } = store.state;
    let last = performance.now();
    while (this.#playing && store.state.clip === clip) {
      const now = performance.now();
      const time = (store.state.time + Math.min(LONGEST_STEP, (now - last) / 1000)) % this.#duration;
      last = now;
      store.set({ time });
      if (!(await pose())) break;
      await new Promise((resolve) => requestAnimationFrame(resolve));
    }
    this.#stop();
  }

  #stop(): void {
    this.#playing = false;
    this.#mark();
  }

  #mark(): void {
    this.#button.setAttribute('aria-pressed', String(this.#playing));
    this.#button.setAttribute('aria-label', this.#playing ? 'Stop the animation' : 'Play the animation');
    this.#button.title = this.#button.getAttribute('aria-label') ?? '';
    this.#button.replaceChildren(icon(this.#playing ? 'pause' : 'play'));
  }
}
