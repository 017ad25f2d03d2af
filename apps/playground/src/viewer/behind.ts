import type { Camera, Environment } from '@glanz/scene';
import { srgbEncode } from '@glanz/tonemap';
import type { Behind as SavedBehind } from '../output/save';
import type { State } from '../state/state';
import type { Backdrop } from './backdrop';

const codes = (rgb: readonly [number, number, number]) =>
  rgb.map((v) => Math.round(255 * srgbEncode(Math.max(0, Math.min(1, v))))) as unknown as readonly [
    number,
    number,
    number,
  ];

/** What the page puts behind an image whose own background is empty: one colour, a blurred environment, or nothing. */
export class Behind {
  readonly #stage: HTMLElement;
  readonly #canvas: HTMLCanvasElement;
  #backdrop: Backdrop | undefined;
  /** For images that are not on the screen: it keeps the blurred environment from frame to frame. */
  #aside: Backdrop | undefined;
  #asked = 0;

  constructor(stage: HTMLElement, canvas: HTMLCanvasElement) {
    this.#stage = stage;
    this.#canvas = canvas;
  }

  draw(state: State, environment: () => Environment | undefined, camera: () => Camera, aspect: number): void {
    const { background } = state;
    this.#stage.classList.toggle('transparent', background === 'transparent');
    this.#stage.style.background = background === 'color' ? `rgb(${codes(state.backgroundColor).join(' ')})` : '';
    if (background !== 'blurred') {
      this.#backdrop?.hide();
      return;
    }
    cancelAnimationFrame(this.#asked);
    this.#asked = requestAnimationFrame(() => void this.#draw(state, environment(), camera(), aspect));
  }

  async #draw(
    { backgroundBlur, exposure, toneMap }: State,
    environment: Environment | undefined,
    camera: Camera,
    aspect: number,
  ): Promise<void> {
    const { Backdrop } = await import('./backdrop');
    this.#backdrop ??= new Backdrop(this.#canvas);
    this.#backdrop.draw(environment, backgroundBlur, camera, aspect, { exposure, toneMap });
  }

  /** What an image of another shape than the screen's has behind it. */
  async rendered(
    state: State,
    environment: Environment | undefined,
    camera: Camera,
    aspect: number,
  ): Promise<SavedBehind | undefined> {
    if (state.background !== 'blurred') return this.saved(state);
    const { Backdrop } = await import('./backdrop');
    const backdrop = (this.#aside ??= new Backdrop(document.createElement('canvas')));
    const { backgroundBlur, exposure, toneMap } = state;
    backdrop.draw(environment, backgroundBlur, camera, aspect, { exposure, toneMap });
    return backdrop.image && { image: backdrop.image };
  }

  /** What a saved image has behind it. */
  saved({ background, backgroundColor }: State): SavedBehind | undefined {
    if (background === 'color') return { color: codes(backgroundColor) };
    const image = background === 'blurred' ? this.#backdrop?.image : undefined;
    return image && { image };
  }
}
