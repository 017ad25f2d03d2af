import type { PickResult } from '@glanz/renderer';
import type { BlobOptions, ModelSource, Orbit, PlayOptions, Viewer, ViewerEvents } from '@glanz/viewer';
import type { ReflectedProperties } from './attributes';
import type { HotspotView } from './hotspots';

/**
 * Events of the element: `CustomEvent`s that do not bubble; `detail` is that of the viewer's event of the same name.
 */
export interface GlanzViewerEventMap {
  /** The model that `src` names, or that `show()` was given, is loaded. */
  load: CustomEvent<ViewerEvents['load']>;
  /** Loading progresses. `totalProgress`: share of the whole load, 0..1. */
  progress: CustomEvent<ViewerEvents['progress'] & { readonly totalProgress: number }>;
  /** Something failed: `message` in one line, `code`, and `retry` where trying again can help. */
  error: CustomEvent<ViewerEvents['error']>;
  /**
   * An environment cannot be fetched or read, and the model is shown without it; the image cannot be denoised, and is
   * shown with its noise; or the GPU is not available yet. `message` in one line, and `code`.
   */
  warning: CustomEvent<Omit<ViewerEvents['warning'], 'error'> & { readonly error: unknown }>;
  /** The image has one more sample per pixel. */
  sample: CustomEvent<ViewerEvents['sample']>;
  /** The image is finished: `samples` or `noise` is reached. */
  converged: CustomEvent<ViewerEvents['converged']>;
  /** The camera moved, by the user or by the page. */
  'camera-change': CustomEvent<ViewerEvents['camera-change']>;
  /** The GPU was lost; the element requests another device. */
  'device-lost': CustomEvent<ViewerEvents['device-lost']>;
  /** Another GPU device renders after a loss. */
  'device-restored': CustomEvent<ViewerEvents['device-restored']>;
  /** The poster went. */
  'poster-dismissed': CustomEvent<undefined>;
  /** The files of the model have been read; it is prepared for the GPU now. */
  preload: CustomEvent<undefined>;
  /** The model is seen, without a poster before it, or it is not seen any more. */
  'model-visibility': CustomEvent<{ readonly visible: boolean }>;
  /** Another environment lights the model, or the same one another model. */
  'environment-change': CustomEvent<undefined>;
  /**
   * Frames have another size: smaller ones while the view moves. `reportedDpr`: pixels of the screen per CSS pixel;
   * `renderedDpr`: those of the frame.
   */
  'render-scale': CustomEvent<{
    readonly reportedDpr: number;
    readonly renderedDpr: number;
    readonly pixelWidth: number;
    readonly pixelHeight: number;
  }>;
  /** An animation plays from now on. */
  play: CustomEvent<ViewerEvents['play']>;
  /** The animation has been paused. */
  pause: CustomEvent<ViewerEvents['pause']>;
  /** The animation begins again; `count`: how often it has played. */
  loop: CustomEvent<ViewerEvents['loop']>;
  /** The animation has played as often as `play()` was asked to. */
  finished: CustomEvent<ViewerEvents['finished']>;
  /** The variant that `variant-name` names is shown. */
  'variant-applied': CustomEvent<{ readonly variantName: string | null }>;
}

/** Options for `toBlob` of the element: the viewer's options, or model-viewer's names for them. */
export interface ElementBlobOptions extends BlobOptions {
  readonly mimeType?: string;
  readonly qualityArgument?: number;
}

/**
 * The element `<glanz-viewer>`. Made by markup, or by `document.createElement('glanz-viewer')`, after
 * `defineGlanzViewer()`. Setting a property to what it cannot be (NaN, an infinity, another type, a number out of
 * range) throws an `ElementError` `element/property`; a text in markup that its attribute does not take is reported by
 * the `error` event as `element/attribute`, and the default is used.
 */
export interface GlanzViewerElement extends HTMLElement, ReflectedProperties {
  /**
   * The viewer behind it, for all that has no attribute; `undefined` while the element is out of the page, or waits to
   * be seen.
   */
  readonly viewer: Viewer | undefined;
  /**
   * Factor of the image's brightness, as in model-viewer.
   * @deprecated Use `exposureEv`, the factor's base-2 logarithm. Supported until the next minor version.
   */
  exposure: number | null;
  /** Whether the model that `src` names is loaded. */
  readonly loaded: boolean;
  /** Names of the model's variants. */
  readonly availableVariants: readonly string[];
  /** Names of the model's animations. */
  readonly availableAnimations: readonly string[];
  /** Whether no animation plays. */
  readonly paused: boolean;
  /** Seconds of the animation that `animation-name` names, or else of the first one; 0 without one. */
  readonly duration: number;
  /** Seconds from the start of the animation; set, it poses the model, whether an animation plays or not. */
  currentTime: number;
  /** Factor of the animation's speed; below 0 it plays backwards. Default 1. */
  timeScale: number;
  /**
   * Plays the animation that `animation-name` names, or else the first one, from its current time: endlessly, or
   * `repetitions` times, with every second repetition backwards with `pingpong`. Does nothing before the `load` event.
   */
  play(options?: PlayOptions): void;
  /** Stops the animation where it is; the image of that pose is then refined to its end. */
  pause(): void;
  /** Shows a model that has no address: a file, files, or a scene. Stays until `src` changes. */
  show(source: ModelSource): Promise<void>;
  /**
   * The image as a file; see `Viewer.toBlob`.
   * @throws {ElementError} `element/no-model` where no model was requested; the errors of loading the model.
   */
  toBlob(options?: ElementBlobOptions): Promise<Blob>;
  /** The orbit of the camera around its target. */
  getCameraOrbit(): Orbit | undefined;
  /** Vertical field of view, degrees. */
  getFieldOfView(): number;
  /** Is where it was going. */
  jumpCameraToGoal(): void;
  /** Frames the model again according to the attributes. */
  updateFraming(): void;
  /** Shows the model under the poster, which `reveal="manual"` waits for. */
  dismissPoster(): void;
  /** Shows the poster again. */
  showPoster(): void;
  /** Where the hotspot of a slot is. */
  queryHotspot(slot: string): HotspotView | undefined;
  /** Moves a hotspot: `data-position` and `data-normal` of the element in its slot. */
  updateHotspot(hotspot: { readonly name: string; readonly position?: string; readonly normal?: string }): void;
  /** What lies under a point of the window, CSS pixels. */
  pick(clientX: number, clientY: number): PickResult | undefined;
  addEventListener<K extends keyof GlanzViewerEventMap>(
    type: K,
    listener: (event: GlanzViewerEventMap[K]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject,
    options?: boolean | AddEventListenerOptions,
  ): void;
}

/** Constructor of {@link GlanzViewerElement}. */
export interface GlanzViewerConstructor {
  new (): GlanzViewerElement;
}
