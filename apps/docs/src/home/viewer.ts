import type { Scene } from '@glanz/scene';
import { createViewer, type Viewer } from '@glanz/viewer';
import type { HomeModelName } from './models';

/** Models are made by code, each fetched when it is asked for. */
const MAKERS: Readonly<Record<HomeModelName, () => Promise<Scene>>> = {
  armchair: async () => (await import('@glanz/models/armchair')).createArmchair(),
  buttons: async () => (await import('@glanz/models/button-panel')).createButtonPanel(),
  whisky: async () => (await import('@glanz/models/tumbler')).createTumbler(),
};

/** How a model is shown. */
interface Look {
  /** Edges of paths: through glass they are longer. */
  readonly maxDepth: number;
  /** How far the view turns to the left, right, up and down, radians: models stand between softboxes. */
  readonly turn: readonly [number, number, number, number];
}

const LOOKS: Readonly<Record<HomeModelName, Look>> = {
  armchair: { maxDepth: 8, turn: [0.35, 0.9, 0.4, 0.1] },
  buttons: { maxDepth: 8, turn: [0.5, 0.6, 0.15, 0.1] },
  whisky: { maxDepth: 20, turn: [0.9, 0.9, 0.35, 0.1] },
};

/** Pixels that the page path-traces at most; a larger canvas is scaled up. */
const MAX_PIXELS = 960 * 600;

/** What the viewer reports to its page. */
export interface HomeReports {
  /** Samples of the image that is shown; `moved`: not from where its poster was made. */
  readonly onImage: (samples: number, moved: boolean) => void;
  readonly onError: (code: string, message: string) => void;
  readonly signal: AbortSignal;
}

/** The home page's viewer: shows models by name. It destroys itself when the signal aborts. */
export class HomeViewer {
  readonly #viewer: Viewer;
  #moved = false;

  constructor(canvas: HTMLCanvasElement, { onImage, onError, signal }: HomeReports) {
    this.#viewer = createViewer(canvas, {
      environment: 'none',
      maxPixels: MAX_PIXELS,
      // The page scrolls by wheel and by finger.
      controls: { zoom: false, pan: false, focus: false, orbitSensitivity: 0.5 },
      signal,
    });
    canvas.style.touchAction = 'pan-y';
    this.#viewer.on('camera-change', ({ source }) => {
      if (source === 'user') this.#moved = true;
    });
    this.#viewer.on('sample', ({ samples }) => onImage(samples, this.#moved));
    this.#viewer.on('frame', ({ preview }) => {
      if (preview && this.#moved) onImage(0, true);
    });
    this.#viewer.on('error', ({ code, message }) => onError(code, message));
  }

  /**
   * Shows a model from its own camera.
   *
   * @throws what `Viewer.load` throws; an `AbortError` where another one was asked for meanwhile
   */
  async show(name: HomeModelName): Promise<void> {
    const scene = await MAKERS[name]();
    const { maxDepth, turn } = LOOKS[name];
    this.#viewer.orbitLimits = {};
    this.#viewer.maxDepth = maxDepth;
    this.#moved = false;
    await this.#viewer.load(scene);
    const { theta, phi } = this.#viewer.orbit!;
    const [left, right, up, down] = turn;
    this.#viewer.orbitLimits = { theta: [theta - left, theta + right], phi: [phi - up, phi + down] };
  }
}
