import type { PathTracer } from '@glanz/renderer';
import { inSlices, sceneBoundsSteps, untilAborted, type Camera, type Scene } from '@glanz/scene';
import { checkedOption, checkedSetting } from './checks';
import type { Take } from './engine';
import { isAbort } from './errors';
import type { LoadStage } from './events';
import { fitCamera } from './fit-camera';
import { loadModel, type ModelSource } from './load';
import { withEnvironment } from './viewer-environment';
import type { linearColors, MaterialEdit } from './material-colors';
import type { BlobOptions, ViewerOptions } from './options';
import { plainScene } from './variants';
import { ViewerCamera } from './viewer-camera';

/** Options for {@link Viewer.load}. */
export interface LoadOptions {
  /** Aborts the load; it rejects with the signal's reason, and the former model stays. */
  readonly signal?: AbortSignal;
  /** The first view; default that of {@link ViewerOptions.camera}. `keep` stays where the user is. */
  readonly camera?: ViewerOptions['camera'] | 'keep';
  /** Look of a model that has several. Default: that of {@link ViewerOptions.variant} where the model has it. */
  readonly variant?: string;
}

/** Where the stages of a load begin and end in the whole, as shares; usual ones. */
const STAGES: Readonly<Record<LoadStage, readonly [number, number]>> = {
  read: [0, 0.3],
  decode: [0.3, 0.45],
  images: [0.45, 0.55],
  bvh: [0.55, 0.75],
  upload: [0.75, 0.85],
  compile: [0.85, 1],
};

/**
 * A path-traced image on a canvas: loads models, turns them by pointer and keys, refines the image when they
 * rest, sleeps out of sight, and survives the loss of the GPU. Made by {@link createViewer}.
 */
export class Viewer extends ViewerCamera {
  #loading: AbortController | undefined;
  #variant: string | undefined;
  #colors: Promise<{ readonly linearColors: typeof linearColors }> | undefined;

  /** @internal Use {@link createViewer}. */
  constructor(canvas: HTMLCanvasElement, options: ViewerOptions) {
    super(canvas, options);
    this.#variant = options.variant;
    options.signal?.addEventListener('abort', () => this.destroy(), { once: true });
  }

  /** Names of the model's variants. */
  get variants(): readonly string[] {
    return this.scene?.variants ?? [];
  }

  /**
   * Loads a model and shows it. Until it is ready the former one stays, and it stays where this fails. A load that
   * comes later aborts this one. An environment that cannot be fetched or read does not fail the load: the studio
   * lights the model, and the `warning` event says why.
   *
   * @returns The scene as it was loaded.
   * @throws {GltfError} {FormatError} for files that cannot be read; {ViewerError} `viewer/no-model`,
   * `viewer/destroyed`; {DeviceError} {RenderError} for what the GPU cannot do. The `error` event has them too.
   * @throws the signal's reason, or an `AbortError`, when aborted.
   * @example
   * await viewer.load('chair.glb');
   * input.onchange = () => viewer.load(input.files);
   */
  async load(source: ModelSource, options: LoadOptions = {}): Promise<Scene> {
    this.check();
    this.#loading?.abort(new DOMException('another model was asked for', 'AbortError'));
    const loading = (this.#loading = new AbortController());
    const signal = options.signal ? AbortSignal.any([options.signal, loading.signal]) : loading.signal;
    const started = performance.now();
    const onProgress = ({ stage, done }: { stage: LoadStage; done: number }) => {
      const [from, to] = STAGES[stage];
      if (!signal.aborted)
        this.emit('progress', { stage, done, total: from + (to - from) * Math.min(1, Math.max(0, done)) });
    };
    try {
      signal.throwIfAborted();
      const scene = await untilAborted(this.#prepare(source, options, signal, onProgress), signal);
      this.emit('load', { scene, milliseconds: performance.now() - started });
      return scene;
    } catch (error) {
      // What is still on its way is of no use.
      loading.abort(error);
      if (!isAbort(error)) this.fail(error, () => void this.load(source, options).catch(() => undefined));
      throw error;
    } finally {
      if (this.#loading === loading) this.#loading = undefined;
    }
  }

  /** Name of the variant that is shown; `undefined`: the model's own materials. */
  get variant(): string | undefined {
    return this.#variant;
  }

  /**
   * Shows one of the model's variants, or its own materials.
   * @returns When the image shows it.
   * @throws {RenderError} `renderer/variant` if it has no such variant; {ViewerError} `viewer/no-scene`.
   */
  async setVariant(variant: string | undefined): Promise<void> {
    await this.edit((tracer) => tracer.setVariant(variant), { key: 'variant' });
    this.#variant = variant;
  }

  /**
   * Changes parameters of a material; see `PathTracer.setMaterial`. Several calls before the next frame add up. Colours
   * are linear Rec.709, or CSS colours as text, which are converted from sRGB: a name, `#rgb`, `#rrggbb`, `rgb()` or
   * `hsl()`. Of a call that is refused nothing is stored.
   * @returns When the image shows it.
   * @throws {RenderError} `renderer/material`; {ToneMapError} `tonemap/color` for what is no CSS colour; {ViewerError}
   * `viewer/no-scene`.
   * @example
   * await viewer.setMaterial('seat', { base_color: 'rebeccapurple', specular_roughness: 0.2 });
   */
  setMaterial(nameOrIndex: string | number, parameters: MaterialEdit): Promise<void> {
    this.theScene();
    if (Object.values(parameters).some((value) => typeof value === 'string'))
      this.#colors ??= import('./material-colors');
    const colors = this.#colors;
    // Once the module has been asked for, all edits wait for it, so that they stay in their order.
    const set = (tracer: PathTracer, edit: object) =>
      colors
        ? colors.then((module) => tracer.setMaterial(nameOrIndex, module.linearColors(nameOrIndex, edit)))
        : tracer.setMaterial(nameOrIndex, edit);
    return this.engine.edit(`material ${nameOrIndex}`, set, parameters);
  }

  /**
   * Changes the scene by any method of the tracer, between two frames, so that a slow GPU skips edits rather than
   * images. Edits survive a loss of the device.
   *
   * @param options `key`: of several edits with one key that wait, the last one counts.
   * @returns When the image shows it.
   * @example
   * await viewer.edit((tracer) => tracer.setVisibility('lid', false), { key: 'lid' });
   */
  edit(change: (tracer: PathTracer) => void | Promise<void>, options: { readonly key?: string } = {}): Promise<void> {
    this.theScene();
    return this.engine.edit(options.key ?? Symbol('edit'), change);
  }

  /** Draws the image again as it is, after a change that needs no new samples (`tracer.setLightGroup()`). */
  redraw(): void {
    this.engine.redraw();
  }

  /**
   * The image as a file, at the screen's size or any other, with the viewer's target samples unless others are asked
   * for. Where the image on the screen is or will be the one that is asked for, it is used; otherwise the scene and the
   * view at the time of the call are rendered separately, on a path tracer of their own, and the screen's image keeps
   * its samples.
   *
   * @throws {ViewerError} `viewer/no-scene`, `viewer/option`, `viewer/blob` where the browser cannot write this type or
   * size.
   * @throws {DeviceError} `renderer/limit`, `renderer/out-of-memory` for a size that the GPU cannot hold;
   * `renderer/device-lost`
   * @throws the signal's reason, when aborted; an `AbortError` when the viewer is destroyed.
   * @example
   * const blob = await viewer.toBlob({ width: 3840, height: 2160, samples: 1024, onProgress: ({ share }) => (bar.value
   * = share) });
   */
  async toBlob(options: BlobOptions = {}): Promise<Blob> {
    this.theScene();
    const { imageBlob } = await import('./save-image');
    this.check();
    return imageBlob(this, this.engine, options, { checkedOption, checkedSetting });
  }

  /** Frees everything, the device too. Idempotent. The canvas can serve another viewer. */
  override destroy(): void {
    this.#loading?.abort(new DOMException('the viewer was destroyed', 'AbortError'));
    super.destroy();
  }

  /** Reads a model and has it shown. */
  async #prepare(
    source: ModelSource,
    options: LoadOptions,
    signal: AbortSignal,
    onProgress: (progress: { stage: LoadStage; done: number }) => void,
  ): Promise<Scene> {
    const { decoders, createWorker } = this.options;
    const reading = loadModel(source, {
      signal,
      decoders,
      createWorker,
      compressedFormats: () => this.engine.compressedFormats(),
      onProgress,
    });
    const [scene, prepare] = await Promise.all([reading, this.environment.fetch(signal), this.engine.connect()]);
    signal.throwIfAborted();
    const { lit, warning, adopt } = await prepare(scene);
    // Each iterates over all vertices.
    const camera = await inSlices(this.cameraSteps(scene, options.camera ?? this.options.camera ?? 'auto'), { signal });
    const bounds = await inSlices(sceneBoundsSteps(scene), { signal });
    const wanted = options.variant ?? this.options.variant;
    const variant = wanted !== undefined && scene.variants?.includes(wanted) ? wanted : undefined;
    await this.engine.show(
      (former) =>
        this.#take(former, {
          scene,
          shown: withEnvironment(scene, lit),
          camera: fitCamera(camera, this.aspect),
          variant,
        }),
      {
        signal,
        onProgress,
        onTaken: () => {
          this.loaded = scene;
          this.#variant = variant;
          adopt();
          if (warning) this.warn(warning);
          this.beginAt(camera, bounds);
        },
      },
    );
    return scene;
  }

  /** A scene as it was loaded, or as it was edited until its tracer was lost; its variant is applied on top. */
  #take(
    former: PathTracer | undefined,
    first: {
      readonly scene: Scene;
      readonly shown: Scene;
      readonly camera: Camera;
      readonly variant: string | undefined;
    },
  ): Take {
    const variant = former ? this.#variant : first.variant;
    const groups = former?.lightGroups ?? [];
    return {
      scene: former ? plainScene(former.scene, first.scene, variant) : first.shown,
      camera: former?.camera ?? first.camera,
      ready: async (tracer) => {
        if (variant !== undefined) await tracer.setVariant(variant);
        for (const { name, intensity, color } of groups) {
          if (intensity !== 1 || color.some((value) => value !== 1))
            await tracer.setLightGroup(name, { intensity, color });
        }
      },
    };
  }
}

/**
 * Makes a canvas show path-traced models. Returns at once; the GPU is asked for meanwhile, and `load()` waits for it.
 *
 * @param canvas One that has no context yet, or had a viewer before. Its size is that of its CSS box.
 * @throws {ViewerError} `viewer/option` for options out of their ranges, `viewer/no-canvas` for what is no canvas;
 * through `load()`: `viewer/no-canvas` for one that has another context. {ToneMapError} `tonemap/unknown`.
 * {DeviceError} through `load()`: `renderer/no-webgpu`, …
 * @example
 * const viewer = createViewer(document.querySelector('canvas'), { samples: 200 });
 * viewer.on('converged', ({ samples }) => console.log(samples));
 * await viewer.load('chair.glb');
 */
export function createViewer(canvas: HTMLCanvasElement, options: ViewerOptions = {}): Viewer {
  return new Viewer(canvas, options);
}
