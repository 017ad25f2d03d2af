import { defaultParameters } from '@glanz/openpbr/parameters';
import type { PathTracer, PathTracerOptions } from '@glanz/renderer';
import { loadPart, type Camera, type Material, type SceneWarning } from '@glanz/scene';
import type { ToneMapOptions } from '@glanz/tonemap';
import { CanvasOutput } from './canvas-output';
import { readCamera } from './cameras';
import { convert, type Conversion, type FromThreeOptions } from './convert';
import { readEnvironment } from './environment';
import { ThreeError } from './error';
import { changedParameters, SceneFollower, type SceneEdits } from './scene-follower';
import type { ThreeCamera, ThreeObject } from './types';

/** Options for {@link ThreePathTracer.create}. */
export interface ThreePathTracerOptions extends FromThreeOptions, ToneMapOptions {
  /**
   * Default: one from `requestDevice()`, which {@link ThreePathTracer.destroy} destroys. Another one stays the caller's:
   * of `requestDevice()`, or that of three's WebGPU renderer, whose limits are WebGPU's defaults unless it was given
   * `requiredLimits`.
   */
  readonly device?: GPUDevice;
  /** {@link ThreePathTracer.render} draws there. A canvas without a context of another kind. Default: none. */
  readonly canvas?: HTMLCanvasElement | OffscreenCanvas;
  /** Film size in pixels. Default: the canvas's; without a canvas both are needed. */
  readonly width?: number;
  readonly height?: number;
  /**
   * What the tracer is made with, here and when a scene is rebuilt. Its `background` follows the scene by default: it is
   * `environment` where `scene.background` is `scene.environment`, and `transparent` otherwise.
   */
  readonly tracer?: Omit<PathTracerOptions, 'width' | 'height' | 'camera' | 'signal'>;
}

/** What {@link ThreePathTracer.update} has found and passed on. */
export interface ThreeChanges {
  readonly camera: boolean;
  /** Instances that moved, appeared, disappeared, or got another material. */
  readonly instances: number;
  /** Meshes whose vertices changed: written again, or posed. */
  readonly meshes: number;
  readonly materials: number;
  readonly lights: number;
  readonly environment: boolean;
  /** Why the scene was converted and prepared from scratch; then the numbers above are 0. */
  readonly rebuilt?: string;
}

const NOTHING: ThreeChanges = { camera: false, instances: 0, meshes: 0, materials: 0, lights: 0, environment: false };

/**
 * Path-traces a live scene of three.js: {@link update} finds what has changed since the last call and changes only
 * that. It does not import three.js.
 *
 * | changed in three | costs |
 * |---|---|
 * | the camera | `setCamera` |
 * | world matrices of meshes, matrices of an `InstancedMesh` or `BatchedMesh` | `setInstanceTransforms` of those that moved |
 * | `visible`, an object removed, or added again | `setVisibility` |
 * | numbers and colours of a material | `setMaterial` |
 * | another material that the scene has already | `setInstanceMaterial` |
 * | attributes with `needsUpdate`, bones, influences of morph targets | `replaceMesh` |
 * | lights but ambient ones | `setLight` |
 * | intensity, rotation about +Y and visibility of the environment | `adjustEnvironment` |
 * | another environment, ambient light | `setEnvironment` |
 *
 * The scene is converted and prepared from scratch for all else: objects, lights and materials that are new, textures,
 * `side`, `alphaTest`, `flatShading`, `vertexColors`, another number of instances or their colours, groups and draw
 * ranges, other attributes, and the first influence of a morph target. Until that is done the tracer goes on with what it
 * has.
 *
 * @example
 * const tracer = await ThreePathTracer.create(scene, camera, { canvas });
 * for (;;) {
 *   await tracer.update();
 *   await tracer.sample();
 *   tracer.render();
 * }
 */
export class ThreePathTracer {
  readonly #scene: ThreeObject;
  readonly #options: ThreePathTracerOptions;
  readonly #device: GPUDevice;
  readonly #output: CanvasOutput | undefined;
  #camera: ThreeCamera;
  #conversion: Conversion;
  #follower: SceneFollower;
  #tracer: PathTracer;
  /** The camera that the tracer was given, as text. */
  #seen: string;
  #size: readonly [number, number];
  #background: 'environment' | 'transparent';
  #running: Promise<ThreeChanges> | undefined;
  #next: Promise<ThreeChanges> | undefined;
  #sampling: Promise<number> | undefined;
  readonly #ended = new AbortController();

  private constructor(
    scene: ThreeObject,
    camera: ThreeCamera,
    options: ThreePathTracerOptions,
    parts: {
      readonly device: GPUDevice;
      readonly output: CanvasOutput | undefined;
      readonly conversion: Conversion;
      readonly tracer: PathTracer;
      readonly size: readonly [number, number];
    },
  ) {
    this.#scene = scene;
    this.#camera = camera;
    this.#options = options;
    this.#device = parts.device;
    this.#output = parts.output;
    this.#conversion = parts.conversion;
    this.#follower = new SceneFollower(scene, parts.conversion);
    this.#tracer = parts.tracer;
    this.#size = parts.size;
    this.#background = options.tracer?.background ?? backgroundOf(parts.conversion);
    this.#seen = JSON.stringify(parts.conversion.scene.cameras[0]);
  }

  /**
   * Converts a scene as {@link fromThree} does and prepares it on the GPU.
   *
   * @param scene A `THREE.Scene`, or any object with visible triangles.
   * @param camera A `PerspectiveCamera`, `OrthographicCamera`, or one of `@glanz/three/compat`.
   * @param options `signal` ends the preparation with the signal's reason.
   * @throws {ThreeError} `three/not-three`, `three/no-triangles`, `three/camera`, `three/size`, `three/canvas`
   * @throws {DeviceError} without WebGPU, or where the GPU refuses: see `requestDevice` and `PathTracer.create`.
   * @throws {RenderError} `renderer/size`, `renderer/option`; {ToneMapError} for an unknown tone map or exposure.
   */
  static async create(
    scene: ThreeObject,
    camera: ThreeCamera,
    options: ThreePathTracerOptions = {},
  ): Promise<ThreePathTracer> {
    const { canvas, signal } = options;
    const size = [options.width ?? canvas?.width, options.height ?? canvas?.height] as [number, number];
    if (size.some((side) => !(Number.isInteger(side) && side >= 1)))
      throw new ThreeError(
        'three/size',
        `A film of ${size.join(' × ')} pixels cannot be made: pass a canvas with a size, or width and height.`,
      );
    const conversion = await convert(scene, camera, options);
    const shown = checkedCamera(conversion);
    const renderer = await loadRenderer();
    const device = options.device ?? (await renderer.requestDevice());
    let tracer: PathTracer | undefined;
    try {
      signal?.throwIfAborted();
      const [made, output] = await Promise.all([
        renderer.PathTracer.create(device, conversion.scene, {
          background: backgroundOf(conversion),
          ...options.tracer,
          width: size[0],
          height: size[1],
          camera: shown,
          ...(signal ? { signal } : {}),
        }).then((prepared) => (tracer = prepared)),
        canvas && CanvasOutput.create(canvas, device, options),
      ]);
      signal?.throwIfAborted();
      output?.resize(...size);
      return new ThreePathTracer(scene, camera, options, { device, output, conversion, tracer: made, size });
    } catch (error) {
      tracer?.destroy();
      if (!options.device) device.destroy();
      throw error;
    }
  }

  /**
   * The tracer that renders now: for its film, AOVs, statistics, and settings such as `setDepth`. A rebuild replaces it.
   * Edits of its scene are overwritten when {@link update} finds a change of the same thing.
   */
  get tracer(): PathTracer {
    return this.#tracer;
  }

  get device(): GPUDevice {
    return this.#device;
  }

  /** What of the scene is not supported, as of the last conversion. */
  get warnings(): readonly SceneWarning[] {
    return this.#conversion.scene.warnings;
  }

  /** Completed samples per pixel. */
  get samples(): number {
    return this.#tracer.samples;
  }

  /** Pixels of the film. */
  get width(): number {
    return this.#tracer.width;
  }

  /** See {@link width}. */
  get height(): number {
    return this.#tracer.height;
  }

  /** The camera that is followed. Another one is looked through from the next {@link update} on. */
  get camera(): ThreeCamera {
    return this.#camera;
  }

  set camera(camera: ThreeCamera) {
    this.#camera = camera;
  }

  /** Whether {@link destroy} was called. */
  get destroyed(): boolean {
    return this.#ended.signal.aborted;
  }

  /**
   * Finds what has changed in the scene and its camera, and passes it on; see {@link ThreePathTracer} for what that
   * costs. Compares synchronously where no earlier update runs; calls that come while one runs share the one that
   * follows it. The camera never waits for another update.
   *
   * @returns When the image shows it, what it was.
   * @throws {ThreeError} `three/camera`, `three/no-triangles`, `three/destroyed`
   * @throws {RenderError} and {DeviceError} as the edits of `PathTracer` do.
   */
  async update(): Promise<ThreeChanges> {
    this.#check();
    const moved = this.#updateCamera();
    const changes = await (this.#running
      ? (this.#next ??= this.#running
          .catch(() => undefined)
          .then(() => {
            this.#next = undefined;
            return this.#begin();
          }))
      : this.#begin());
    const camera = (await moved) || changes.camera;
    return camera === changes.camera ? changes : { ...changes, camera };
  }

  /**
   * As {@link update}, for the camera only.
   *
   * @returns Whether it has moved, when the image shows it.
   * @throws {ThreeError} `three/camera`, `three/destroyed`; {RenderError} `renderer/camera`
   */
  async updateCamera(): Promise<boolean> {
    this.#check();
    return this.#updateCamera();
  }

  #begin(): Promise<ThreeChanges> {
    const running = this.#apply().finally(() => {
      if (this.#running === running) this.#running = undefined;
    });
    this.#running = running;
    return running;
  }

  async #updateCamera(): Promise<boolean> {
    const camera = this.#cameraNow();
    const seen = JSON.stringify(camera);
    if (seen === this.#seen) return false;
    this.#seen = seen;
    await this.#tracer.setCamera(camera);
    return true;
  }

  #cameraNow(): Camera {
    this.#camera.updateMatrixWorld();
    const { warnings } = this.#conversion.scene;
    const known = warnings.length;
    const camera = readCamera(this.#camera, this.#conversion.scene);
    if (camera) warnings.length = known;
    else throw noCamera();
    return camera;
  }

  async #apply(): Promise<ThreeChanges> {
    this.#check();
    const edits = this.#follower.detect();
    if (edits.rebuild !== undefined) {
      await this.#rebuild();
      return { ...NOTHING, rebuilt: edits.rebuild };
    }
    const tracer = this.#tracer;
    const work: Promise<unknown>[] = [
      ...edits.meshes.map(({ index, mesh }) => tracer.replaceMesh(index, mesh)),
      ...(edits.shown.length > 0 ? [tracer.setVisibility(edits.shown, true)] : []),
      ...(edits.hidden.length > 0 ? [tracer.setVisibility(edits.hidden, false)] : []),
      ...edits.assigned.map(({ instance, material }) => tracer.setInstanceMaterial(instance, material)),
      tracer.setInstanceTransforms(edits.transforms.map(({ instance, transform }) => [instance, transform])),
      ...edits.lights.map(({ index, light }) => tracer.setLight(index, light)),
    ];
    if (edits.environment) work.push(this.#updateEnvironment(edits).then(() => this.#updateBackground()));
    const textured = this.#updateMaterials(edits, work);
    await Promise.all([textured, ...work]);
    const rebuilt = await textured;
    if (rebuilt !== undefined) {
      await this.#rebuild();
      return { ...NOTHING, rebuilt };
    }
    return {
      camera: false,
      instances: edits.shown.length + edits.hidden.length + edits.assigned.length + edits.transforms.length,
      meshes: edits.meshes.length,
      materials: edits.materials.length,
      lights: edits.lights.length,
      environment: edits.environment !== undefined,
    };
  }

  /** @returns Why the scene has to be prepared again: a material has changed by more than numbers. */
  async #updateMaterials({ materials }: SceneEdits, work: Promise<unknown>[]): Promise<string | undefined> {
    const { scene } = this.#conversion;
    let rebuild: string | undefined;
    for (const entry of materials) {
      const before = scene.materials[entry.index] as Material;
      const after = await this.#conversion.materials.convert(entry);
      const fixed = ({ textures, double_sided, opacity_threshold }: Material) =>
        JSON.stringify([textures, double_sided, opacity_threshold]);
      if (fixed(before) !== fixed(after)) rebuild ??= `material "${after.name}" has other textures or sides`;
      const changed = changedParameters(before.parameters, after.parameters, defaultParameters());
      scene.materials[entry.index] = after;
      if (rebuild === undefined && Object.keys(changed).length > 0) {
        const edit = this.#tracer.setMaterial(entry.index, changed);
        // Errors are thrown where all edits are awaited.
        edit.catch(() => undefined);
        work.push(edit);
      }
    }
    await Promise.all(work);
    return rebuild;
  }

  async #updateEnvironment({ environment: how, ambience }: SceneEdits): Promise<void> {
    const { scene, textures } = this.#conversion;
    const root = this.#scene as unknown as Record<string, unknown>;
    const before = scene.environment;
    if (how === 'adjust' && before?.type === 'latlong') {
      const { y } = (root['environmentRotation'] as { readonly y: number } | undefined) ?? { y: 0 };
      const adjusted = {
        intensity: (root['environmentIntensity'] as number | undefined) ?? 1,
        rotation: y,
        visible: root['background'] === root['environment'],
      };
      scene.environment = { ...before, ...adjusted };
      return this.#tracer.adjustEnvironment(adjusted);
    }
    const environment = await readEnvironment(this.#scene, ambience, scene, textures);
    if (environment) scene.environment = environment;
    else delete scene.environment;
    return this.#tracer.setEnvironment(environment);
  }

  #updateBackground(): void {
    const background = this.#options.tracer?.background ?? backgroundOf(this.#conversion);
    if (background === this.#background) return;
    this.#background = background;
    this.#tracer.setBackground(background);
  }

  async #rebuild(): Promise<void> {
    const conversion = await convert(this.#scene, this.#camera, { ...this.#options, signal: this.#ended.signal });
    const camera = checkedCamera(conversion);
    // What is compared from now on is what was converted.
    const follower = new SceneFollower(this.#scene, conversion);
    const [width, height] = this.#size;
    const renderer = await loadRenderer();
    const tracer = await renderer.PathTracer.create(this.#device, conversion.scene, {
      background: backgroundOf(conversion),
      ...this.#options.tracer,
      width,
      height,
      camera,
      signal: this.#ended.signal,
    });
    if (this.destroyed) {
      tracer.destroy();
      throw destroyed();
    }
    const before = this.#tracer;
    const { renderScale } = before;
    if (this.#size[0] !== width || this.#size[1] !== height) await tracer.resize(...this.#size);
    if (renderScale !== 1) tracer.setRenderScale(renderScale);
    [this.#tracer, this.#conversion, this.#follower] = [tracer, conversion, follower];
    this.#background = this.#options.tracer?.background ?? backgroundOf(conversion);
    this.#seen = JSON.stringify(camera);
    before.destroy();
    await this.#updateCamera();
  }

  /**
   * Adds a sample to each pixel. Calls that overlap share one.
   *
   * @param options `samples`: how many, default 1. `maxSubmitMs`: see `RenderOptions`. `signal` ends it early.
   * @returns Samples that the film has then; fewer than requested where an edit has restarted it.
   * @throws {ThreeError} `three/destroyed`; {DeviceError} `renderer/device-lost`, `renderer/out-of-memory`,
   * `renderer/gpu-error`
   */
  sample(
    options: { readonly samples?: number; readonly maxSubmitMs?: number; readonly signal?: AbortSignal } = {},
  ): Promise<number> {
    return (this.#sampling ??= this.#sample(options).finally(() => (this.#sampling = undefined)));
  }

  async #sample({ samples = 1, ...rest }: Parameters<ThreePathTracer['sample']>[0] & object): Promise<number> {
    this.#check();
    const tracer = this.#tracer;
    try {
      for await (const progress of tracer.render({ ...rest, samples: tracer.samples + samples })) void progress;
    } catch (error) {
      // A tracer that a rebuild has replaced was destroyed on purpose.
      if (tracer === this.#tracer && !this.destroyed) throw error;
    }
    return this.#tracer.samples;
  }

  /**
   * Draws the film, as it is now, to the canvas.
   *
   * @throws {ThreeError} `three/canvas` without a canvas, `three/destroyed`
   */
  render(): void {
    this.#check();
    if (!this.#output)
      throw new ThreeError('three/canvas', 'There is no canvas to draw to: pass one to ThreePathTracer.create().');
    this.#output.draw(this.#tracer.beautyBuffer, [this.width, this.height]);
  }

  /**
   * Changes exposure and tone map of the canvas. The film stays.
   *
   * @returns When {@link render} uses them.
   * @throws {ThreeError} `three/canvas` without a canvas; {ToneMapError} for an unknown tone map or exposure.
   */
  async setView(view: ToneMapOptions): Promise<void> {
    if (!this.#output)
      throw new ThreeError('three/canvas', 'There is no canvas to draw to: pass one to ThreePathTracer.create().');
    await this.#output.setView(view);
  }

  /**
   * Changes the size of film and canvas, pixels, and restarts the film.
   *
   * @throws {RenderError} `renderer/size`; {DeviceError} `renderer/out-of-memory`, `renderer/limit`: the size stays.
   */
  async resize(width: number, height: number): Promise<void> {
    this.#check();
    await this.#tracer.resize(width, height);
    this.#size = [width, height];
    this.#output?.resize(width, height);
  }

  /** Frees all GPU memory, and the device unless it was passed in. Idempotent; running calls end. */
  destroy(): void {
    if (this.destroyed) return;
    this.#ended.abort(destroyed());
    this.#output?.destroy();
    this.#tracer.destroy();
    if (!this.#options.device) this.#device.destroy();
  }

  #check(): void {
    this.#ended.signal.throwIfAborted();
  }
}

const destroyed = () => new ThreeError('three/destroyed', 'This ThreePathTracer has been destroyed: create another.');

/** Pages convert, and rasterise, without it. */
const loadRenderer = () => loadPart('renderer', import('@glanz/renderer'));

/** Where three shows no environment, or another background, the image is transparent. */
const backgroundOf = ({ scene }: Conversion) => (scene.environment?.visible === true ? 'environment' : 'transparent');

const noCamera = () =>
  new ThreeError(
    'three/camera',
    'The camera cannot be path-traced: pass a PerspectiveCamera, an OrthographicCamera or an EquirectCamera.',
  );

function checkedCamera({ scene }: Conversion): Camera {
  const [camera] = scene.cameras;
  if (!camera) throw noCamera();
  return camera;
}
