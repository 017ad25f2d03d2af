import type { Camera, Environment } from '@glanz/scene';
import { srgbEncode } from '@glanz/tonemap';
import type { SavedBackdrop } from '../output/save';
import type { State } from '../state/state';
import type { BlurredEnvironment } from './blurred-environment';

const codes = (rgb: readonly [number, number, number]) =>
  rgb.map((v) => Math.round(255 * srgbEncode(Math.max(0, Math.min(1, v))))) as unknown as readonly [
    number,
    number,
    number,
  ];

/**
 * What the page shows behind an image whose own background is empty: one colour, a blurred environment, or nothing.
 */
export class Backdrop {
  readonly #stage: HTMLElement;
  readonly #canvas: HTMLCanvasElement;
  #blurred: BlurredEnvironment | undefined;
  /** For images that are not on the screen: it keeps the blurred environment from frame to frame. */
  #offscreen: BlurredEnvironment | undefined;
  #requested = 0;

  constructor(stage: HTMLElement, canvas: HTMLCanvasElement) {
    this.#stage = stage;
    this.#canvas = canvas;
  }

  draw(state: State, environment: () => Environment | undefined, camera: () => Camera, aspect: number): void {
    const { background } = state;
    this.#stage.classList.toggle('transparent', background === 'transparent');
    this.#stage.style.background = background === 'color' ? `rgb(${codes(state.backgroundColor).join(' ')})` : '';
    if (background !== 'blurred') {
      this.#blurred?.hide();
      return;
    }
    cancelAnimationFrame(this.#requested);
    this.#requested = requestAnimationFrame(() => void this.#draw(state, environment(), camera(), aspect));
  }

  async #draw(
    { backgroundBlur, exposure, toneMap }: State,
    environment: Environment | undefined,
    camera: Camera,
    aspect: number,
  ): Promise<void> {
    const { BlurredEnvironment } = await import('./blurred-environment');
    this.#blurred ??= new BlurredEnvironment(this.#canvas);
    this.#blurred.draw(environment, backgroundBlur, camera, aspect, { exposure, toneMap });
  }

  /** The backdrop of an image of another shape than the screen's. */
  async rendered(
    state: State,
    environment: Environment | undefined,
    camera: Camera,
    aspect: number,
  ): Promise<SavedBackdrop | undefined> {
    if (state.background !== 'blurred') return this.saved(state);
    const { BlurredEnvironment } = await import('./blurred-environment');
    const blurred = (this.#offscreen ??= new BlurredEnvironment(document.createElement('canvas')));
    const { backgroundBlur, exposure, toneMap } = state;
    blurred.draw(environment, backgroundBlur, camera, aspect, { exposure, toneMap });
    return blurred.image && { image: blurred.image };
  }

  /** The backdrop of a saved image. */
  saved({ background, backgroundColor }: State): SavedBackdrop | undefined {
    if (background === 'color') return { color: codes(backgroundColor) };
    const image = background === 'blurred' ? this.#blurred?.image : undefined;
    return image && { image };
  }
}
