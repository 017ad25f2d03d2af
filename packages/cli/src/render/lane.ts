import type { Camera, Scene } from '@glanz/scene';
import type { Backend, OpenedGpu, RenderStatistics, Tracer } from '../backend';
import type { CliIo } from '../io';
import type { RenderCommandOptions } from '../options';
import type { Picture, PictureLayers } from '../output/picture';
import { writePicture, type WrittenFile } from '../output/write';
import { duration, rate, type ProgressReporter } from '../progress';
import { version } from '../version';
import { sceneKey, variantIndex, type SceneLoader } from './scene';
import { shotLabel, type Shot } from './shots';
import { cameraOf } from './views';

/** Milliseconds per stage. */
export interface RenderTimings {
  /** The model alone, even where it has waited for the GPU to say which formats it reads. */
  loadMs: number;
  /** Surroundings, made or read. */
  environmentMs: number;
  deviceMs: number;
  /** All of the preparation; its parts are in the statistics. */
  prepareMs: number;
  renderMs: number;
  readMs: number;
  writeMs: number;
  totalMs: number;
}

/** A picture that has been written. */
export interface RenderedShot {
  readonly files: readonly WrittenFile[];
  readonly samples: number;
  /** Relative error of the picture when it was last looked at; only with `--noise`. */
  readonly noise?: number;
  readonly samplesPerSecond: number;
  readonly camera: string;
  readonly environment: string;
  readonly adapter: { readonly name: string; readonly software: boolean };
  readonly timings: RenderTimings;
  readonly statistics: RenderStatistics;
  readonly warnings: readonly string[];
}

/** How pictures are made. */
export interface LaneContext {
  readonly io: CliIo;
  readonly backend: Backend;
  readonly progress: ProgressReporter;
  readonly loader: SceneLoader;
  readonly signal: AbortSignal;
  /** Whether a picture that is stopped is written as it is. */
  readonly keepPartial: boolean;
}

const MAX_WARNINGS = 5;
const LABELS = { bvh: 'build hierarchy', upload: 'upload', compile: 'compile kernels' } as const;

/**
 * One GPU, making one picture after another. Pictures of the same scene share a tracer: another variant or view is an edit, and
 * the film begins anew, so that its pixels are those of a tracer of its own.
 */
export class Lane {
  readonly #context: LaneContext;
  readonly #gpuName: string | undefined;
  #opened: OpenedGpu | undefined;
  #tracer: Tracer | undefined;
  #key = '';
  #toldOf: Scene | undefined;

  constructor(context: LaneContext, gpuName: string | undefined) {
    this.#context = context;
    this.#gpuName = gpuName;
  }

  /** Makes and writes a picture; undefined if it was stopped before there was anything to write. */
  async render(shot: Shot): Promise<RenderedShot | undefined> {
    const { io, backend, progress, loader, signal, keepPartial } = this.#context;
    const { options } = shot;
    const start = io.now();
    const timings: RenderTimings = { loadMs: 0, environmentMs: 0, deviceMs: 0, prepareMs: 0, renderMs: 0, readMs: 0, writeMs: 0, totalMs: 0 };
    const timed = async <T>(key: keyof RenderTimings, run: () => Promise<T>): Promise<T> => {
      const from = io.now();
      try {
        return await run();
      } finally {
        timings[key] += io.now() - from;
      }
    };
    progress.stage('load model');
    const { scene, environment, warnings } = await timed('loadMs', () => loader.load(options, signal, async () => backend.compressedFormats(await this.#device(timed)), (run) => timed('environmentMs', run)));
    // A model whose pictures can stay packed asks the GPU what it reads: until it runs, nothing is loaded.
    timings.loadMs -= timings.deviceMs + timings.environmentMs;
    const camera = await cameraOf(shot.view, scene, options.width / options.height, io.cwd);
    const variant = variantIndex(scene, shot.variant);
    if (this.#toldOf !== scene) for (const warning of warnings.slice(0, MAX_WARNINGS)) progress.warning(warning);
    if (this.#toldOf !== scene && warnings.length > MAX_WARNINGS) progress.warning(`and ${warnings.length - MAX_WARNINGS} more; --json lists them all.`);
    this.#toldOf = scene;
    signal.throwIfAborted();
    await this.#device(timed);
    signal.throwIfAborted();
    const { adapterName, software } = this.#opened as OpenedGpu;
    const tracer = await timed('prepareMs', () => this.#prepared(options, scene, camera, variant));

    let noise: number | undefined;
    await timed('renderMs', async () => {
      // Nobody is looking at a canvas here: larger submissions than in a page, still far from any watchdog.
      for await (const state of tracer.render({ samples: options.samples, ...(options.noise === undefined ? {} : { noise: options.noise }), signal, maxSubmitMs: 200 })) {
        noise = state.noise ?? noise;
        progress.samples(state);
      }
    });
    const { samples } = tracer;
    if (samples === 0 || (signal.aborted && !keepPartial)) return undefined;
    progress.stage('write');
    const picture = await timed('readMs', () => readPicture(tracer, options, samples));
    const files: WrittenFile[] = [];
    for (const target of shot.outputs) files.push(await timed('writeMs', () => writePicture(picture, target, options, io.cwd)));
    timings.totalMs = io.now() - start;
    const { statistics } = tracer;
    const samplesPerSecond = timings.renderMs > 0 ? samples / (timings.renderMs / 1000) : 0;
    const names = files.map(({ path }) => path).join(', ');
    progress.line(`${names}: ${options.width}×${options.height}, ${samples}${signal.aborted && options.noise === undefined ? ` of ${options.samples}` : ''} ${options.samples === 1 ? 'sample' : 'samples'} at ${rate(samplesPerSecond)}/s, ${duration(timings.totalMs)} in all`);
    if (statistics.badSamples > 0) progress.warning(`${shotLabel(shot)}: ${statistics.badSamples} samples were not numbers and were left out; please report the model.`);
    return { files, samples, ...(noise === undefined ? {} : { noise }), samplesPerSecond, camera: camera.name || camera.type, environment, adapter: { name: adapterName, software }, timings, statistics, warnings };
  }

  async #device(timed: <T>(key: keyof RenderTimings, run: () => Promise<T>) => Promise<T>): Promise<GPUDevice> {
    const { backend, progress } = this.#context;
    if (!this.#opened) {
      progress.stage('start GPU');
      this.#opened = await timed('deviceMs', () => backend.openGpu(this.#gpuName));
      progress.line(`${this.#opened.software ? 'no GPU: rendering on the processor, ' : ''}${this.#opened.adapterName}`);
    }
    return this.#opened.device;
  }

  /** A tracer of the scene with an empty film, at the camera, in the variant. */
  async #prepared(options: RenderCommandOptions, scene: Scene, camera: Camera, variant: number | undefined): Promise<Tracer> {
    const { backend, progress, signal } = this.#context;
    const { device } = this.#opened as OpenedGpu;
    const { width, height, depth, seed, quality, transparent } = options;
    const key = JSON.stringify([sceneKey(options), width, height, depth, seed, quality, transparent]);
    if (this.#tracer && key === this.#key) {
      await this.#tracer.setVariant(variant);
      await this.#tracer.setCamera(camera);
      this.#tracer.reset();
      return this.#tracer;
    }
    this.#tracer?.destroy();
    this.#tracer = undefined;
    this.#tracer = await backend.createTracer(device, scene, {
      width,
      height,
      maxDepth: depth,
      seed,
      camera,
      ...quality,
      background: transparent ? 'transparent' : 'environment',
      signal,
      onProgress: ({ stage, done }) => progress.stage(LABELS[stage], done),
    });
    this.#key = key;
    if (variant !== undefined) await this.#tracer.setVariant(variant);
    return this.#tracer;
  }

  /** Gives the GPU back. */
  close(): void {
    this.#tracer?.destroy();
    this.#opened?.device.destroy();
    this.#tracer = this.#opened = undefined;
  }
}

async function lightLayers(tracer: Tracer): Promise<PictureLayers['lights']> {
  const groups = tracer.lightGroups;
  if (groups.length < 2) return [];
  return Promise.all(groups.map(async ({ name }) => ({ name, data: await tracer.readLightGroup(name) })));
}

async function readPicture(tracer: Tracer, options: RenderCommandOptions, samples: number): Promise<Picture> {
  const { width, height, outputs } = options;
  const beauty = await tracer.read('beauty');
  const base = { width, height, beauty, samples, software: `Glanz ${version()}` };
  if (!outputs.some(({ format }) => format === 'exr')) return base;
  return {
    ...base,
    layers: {
      albedo: await tracer.read('albedo'),
      normal: await tracer.read('normal'),
      position: await tracer.read('position'),
      variance: await tracer.read('variance'),
      lights: await lightLayers(tracer),
      depth: await tracer.read('depth'),
      objectId: await tracer.read('objectId'),
      materialId: await tracer.read('materialId'),
    },
  };
}
