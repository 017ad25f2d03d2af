import { createViewer, type PreviewMode, type Viewer } from '@glanz/viewer';
import { createLiveScene } from './scenes';

/** Pixels of each image at most: both share a GPU. */
const MAX_PIXELS = 480 * 360;

/** The two ways to show a view that moves, in the order of the canvases. */
const MODES = ['raw', 'filtered'] as const satisfies readonly PreviewMode[];

/** One of the two images. */
export interface MovingImage {
  /** Whether its view moves. */
  readonly moving: boolean;
  /** Whether it is denoised, in space or with the frames before. */
  readonly denoised: boolean;
  /** Samples per pixel at rest. */
  readonly samples: number;
}

/** What the pair reports to its page, and how it ends. */
export interface MovingPairOptions {
  /** `index`: of the canvas. */
  readonly onImage: (index: number, image: MovingImage) => void;
  readonly onError: (code: string, message: string) => void;
  /** Ends both. */
  readonly signal: AbortSignal;
}

/** A push-button on two canvases with the same camera: its frames as they are sampled, and filtered. */
export class MovingPair {
  readonly #viewers: readonly Viewer[];

  constructor(canvases: readonly HTMLCanvasElement[], { onImage, onError, signal }: MovingPairOptions) {
    this.#viewers = MODES.map((preview, i) =>
      createViewer(canvases[i]!, {
        maxPixels: MAX_PIXELS,
        preview,
        // The page scrolls by wheel and by finger.
        controls: { zoom: false, pan: false, focus: false },
        signal,
      }),
    );
    for (const [i, viewer] of this.#viewers.entries()) {
      canvases[i]!.style.touchAction = 'pan-y';
      viewer.on('camera-change', ({ orbit, source }) => {
        if (source === 'api') return;
        for (const other of this.#viewers) if (other !== viewer) other.setOrbit(orbit, { immediate: true });
      });
      viewer.on('frame', ({ preview, denoised }) => {
        if (preview) onImage(i, { moving: true, denoised, samples: 0 });
      });
      viewer.on('sample', ({ samples, denoised }) => onImage(i, { moving: false, denoised, samples }));
      viewer.on('error', ({ code, message }) => onError(code, message));
    }
  }

  /** @throws what `Viewer.load` throws */
  async load(): Promise<void> {
    // One after the other: both at once would compile the same kernels at the same time.
    for (const viewer of this.#viewers) {
      await viewer.load(createLiveScene('push-button'));
      const { theta, phi } = viewer.orbit!;
      // The model stands between softboxes.
      viewer.orbitLimits = { theta: [theta - 0.8, theta + 0.8], phi: [phi - 0.3, phi + 0.2] };
    }
  }
}
