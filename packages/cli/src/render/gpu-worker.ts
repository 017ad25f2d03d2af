import { isDeepStrictEqual } from 'node:util';
import { GlanzError, type Camera, type Scene } from '@glanz/scene';
import type {
  DenoiseQuality,
  Backend,
  FilmState,
  ImageDenoiser,
  OpenedGpu,
  PathTracerOptions,
  Tracer,
} from '../backend';
import { CliError } from '../errors';
import type { CliIo } from '../io';
import type { RenderCommandOptions } from '../options';
import type { OutputTarget } from '../output/formats';
import type { RenderedImage } from '../output/image';
import { isImage, writeImage, type WrittenFile } from '../output/write';
import { duration, rate, type ProgressReporter } from '../progress';
import { CheckpointFile } from './checkpoint-file';
import { GpuGoneError, RecoverableGpu } from './gpu';
import type { Job } from './queue';
import { imageAovs, readImage } from './read-image';
import type { RenderedShot, RenderTimings } from './results';
import { sceneKey, variantIndex, type PreparedScene, type SceneLoader } from './scene';
import { beginShot, type ShotInProgress, type Timed } from './shot-in-progress';
import { shotLabel, type Shot } from './shots';
import { MovingScene } from './moving-scene';
import { cameraOf } from '../views';

/** How images are made. */
export interface WorkerContext {
  readonly io: CliIo;
  readonly backend: Backend;
  readonly progress: ProgressReporter;
  readonly loader: SceneLoader;
  readonly signal: AbortSignal;
  /** Whether an image that is stopped is written as it is. */
  readonly keepPartial: boolean;
  /** Builds hierarchies, or reads those that were built before. Default: built on this thread. */
  readonly hierarchies?: PathTracerOptions['hierarchies'];
}

const MAX_WARNINGS = 5;
/** Milliseconds between two looks at whether a checkpoint is due. */
const TICK_MS = 1000;
/** No page has to stay responsive: longer submissions than the renderer's default, still far from any watchdog. */
const SUBMIT_MS = 200;
const LABELS = { bvh: 'build hierarchy', upload: 'upload', compile: 'compile kernels' } as const;

/**
 * One GPU, making one image after another. Images of the same scene share a tracer: another variant or view is an
 * edit, and the film restarts, so that its pixels are those of a tracer of its own. When the GPU is lost, the image
 * continues on a new device from its last checkpoint, with the same pixels as without the loss.
 */
export class GpuWorker {
  readonly #context: WorkerContext;
  readonly #gpu: RecoverableGpu;
  #tracer: Tracer | undefined;
  #denoiser: { readonly quality: DenoiseQuality; readonly made: ImageDenoiser } | undefined;
  /** The tracer's scene, where frames of a film are made. */
  #moving: MovingScene | undefined;
  #key = '';
  /** The camera that the tracer was made with. */
  #fittedFor: Camera | undefined;
  #warnedScene: Scene | undefined;

  constructor(context: WorkerContext, gpuName: string | undefined) {
    this.#context = context;
    this.#gpu = new RecoverableGpu(context, gpuName);
  }

  /** For messages. */
  get label(): string {
    return this.#gpu.label;
  }

  /** Whether it has ever had a device. */
  get everOpened(): boolean {
    return this.#gpu.everOpened;
  }

  /**
   * Makes and writes an image; undefined if it was stopped before there was anything to write.
   *
   * @param job Its film is where rendering begins, and where it stood if this throws.
   * @throws {GpuGoneError} when the GPU cannot be recovered
   */
  async render(job: Job): Promise<RenderedShot | undefined> {
    const { shot } = job;
    const making = await beginShot(job, this.#context, this.#gpu.losses);
    const { checkpoints } = making;
    this.#gpu.progressed();
    let reached = checkpoints.latest;
    for (;;) {
      try {
        return await this.#attempt(making);
      } catch (error) {
        await checkpoints.settled();
        const loss = await this.#gpu.lossBehind(error);
        this.#drop();
        const film = checkpoints.latest;
        if (film) job.film = film;
        if (!loss) {
          this.#gpu.forgive();
          throw await this.#withCheckpoint(error, making);
        }
        // Between two checkpoints there are batches, if not whole samples.
        if (film !== reached) this.#gpu.progressed();
        reached = film;
        try {
          await this.#gpu.replace(loss);
        } catch (cause) {
          throw await this.#withCheckpoint(cause, making);
        }
        this.#context.progress.warning(
          `${shotLabel(shot)}: the GPU was lost; going on from ${film && film.samples > 0 ? `sample ${film.samples}` : 'the first sample'} on a new device.`,
        );
      }
    }
  }

  /** Renders on the device there is, from the last checkpoint to the end. */
  async #attempt(making: ShotInProgress): Promise<RenderedShot | undefined> {
    const { io, signal, keepPartial, progress } = this.#context;
    const { shot, timings, timed, checkpoints, file } = making;
    const { options } = shot;
    const { scene, environment, warnings } = await this.#load(options, timings, timed);
    const camera = await cameraOf(shot.view, scene, options.width / options.height, io.cwd);
    const variant = variantIndex(scene, shot.variant);
    this.#warn(scene, warnings);
    signal.throwIfAborted();
    await this.#device(timed);
    signal.throwIfAborted();
    const { adapterName, software } = this.#gpu.opened as OpenedGpu;
    const tracer = await timed('prepareMs', () => this.#prepared(options, scene, camera, variant));
    // Before the samples: what is missing shows at once.
    const denoiser = await timed('prepareMs', () => this.#denoiserOf(options));
    await this.#restore(tracer, making);
    await timed('renderMs', () => (shot.motion ? this.#expose(tracer, scene, shot) : this.#sample(tracer, making)));
    const { samples } = tracer;
    if (signal.aborted && file && samples > 0) {
      await checkpoints.save(tracer);
      if ((await checkpoints.flush()) > 0)
        progress.line(`${file.path}: ${samples} samples; the same command continues from there`);
    }
    if (samples === 0 || (signal.aborted && !keepPartial)) return undefined;
    const denoised = await timed('denoiseMs', () => this.#denoised(denoiser, tracer, shot));
    progress.stage('write');
    const image = shot.outputs.some(isImage)
      ? await timed('readMs', () => readImage(tracer, options, samples, denoised))
      : undefined;
    const film = shot.outputs.some(({ format }) => format === 'film')
      ? await timed('readMs', () => tracer.saveFilm({ beauty: !shot.isPart }))
      : undefined;
    await this.#flushed();
    const files: WrittenFile[] = [];
    const { settings } = options;
    const display = { ...options, transparent: settings.background === 'transparent' };
    for (const target of shot.outputs)
      files.push(
        await timed('writeMs', () =>
          isImage(target)
            ? writeImage(image as RenderedImage, target, display, io.cwd)
            : this.#writeFilm(film as FilmState, target, shot),
        ),
      );
    await checkpoints.settled();
    if (!signal.aborted) await file?.remove();
    timings.totalMs = io.now() - making.start;
    const { statistics } = tracer;
    const samplesPerSecond =
      timings.renderMs > 0 ? Math.max(0, samples - making.resumed) / (timings.renderMs / 1000) : 0;
    const gpuLosses = this.#gpu.losses - making.lossesBefore;
    const names = shot.label ?? files.map(({ path }) => path).join(', ');
    progress.line(
      `${names}: ${options.width}×${options.height}, ${samples}${signal.aborted && settings.noise === undefined ? ` of ${settings.samples}` : ''} ${settings.samples === 1 ? 'sample' : 'samples'} at ${rate(samplesPerSecond)}/s, ${denoised ? `denoised (${denoised.quality}), ` : ''}${duration(timings.totalMs)} in all`,
    );
    if (statistics.badSamples > 0)
      progress.warning(
        `${shotLabel(shot)}: ${statistics.badSamples} samples were not numbers and were left out; please report the model.`,
      );
    const { noise, resumed } = making;
    return {
      files,
      samples,
      resumedSamples: resumed,
      gpuLosses,
      ...(noise === undefined ? {} : { noise }),
      ...(denoised ? { denoised: denoised.quality } : {}),
      samplesPerSecond,
      camera: camera.name || camera.type,
      environment,
      adapter: { name: adapterName, software },
      timings,
      statistics,
      warnings,
    };
  }

  async #load(options: RenderCommandOptions, timings: RenderTimings, timed: Timed): Promise<PreparedScene> {
    const { backend, progress, loader, signal } = this.#context;
    progress.stage('load model');
    const { deviceMs, environmentMs } = timings;
    const prepared = await timed('loadMs', () =>
      loader.load(
        options,
        signal,
        async () => backend.compressedFormats(await this.#device(timed)),
        (run) => timed('environmentMs', run),
      ),
    );
    // A model whose images can stay packed asks the GPU what it reads: until it runs, nothing is loaded.
    timings.loadMs -= timings.deviceMs - deviceMs + (timings.environmentMs - environmentMs);
    return prepared;
  }

  #warn(scene: Scene, warnings: readonly string[]): void {
    const { progress } = this.#context;
    if (this.#warnedScene === scene) return;
    this.#warnedScene = scene;
    for (const warning of warnings.slice(0, MAX_WARNINGS)) progress.warning(warning);
    if (warnings.length > MAX_WARNINGS)
      progress.warning(`and ${warnings.length - MAX_WARNINGS} more; --json lists them all.`);
  }

  async #restore(tracer: Tracer, { checkpoints, file, read, shot }: ShotInProgress): Promise<void> {
    const film = checkpoints.latest;
    if (!film) return;
    try {
      await tracer.restoreFilm(film);
    } catch (error) {
      if (!(error instanceof GlanzError) || error.code !== 'renderer/film-state') throw error;
      if (file && film === read)
        throw new CliError(
          'cli/checkpoint',
          `The checkpoint "${file.path}" belongs to another image: ${error.message} Repeat the command that wrote it, or set another file with --checkpoint.`,
          { cause: error, location: { file: file.path } },
        );
      // Another GPU may read other formats of textures, which makes it another scene.
      this.#context.progress.warning(
        `${shotLabel(shot)}: starts from the first sample, since this GPU cannot continue the samples of another.`,
      );
      checkpoints.forget();
      tracer.reset();
    }
  }

  async #sample(tracer: Tracer, making: ShotInProgress): Promise<void> {
    const { progress, signal } = this.#context;
    const {
      shot: { options },
      checkpoints,
    } = making;
    const { samples, noise } = options.settings;
    checkpoints.restart();
    // A sample of a large image may take longer than the interval.
    const timer = setInterval(() => checkpoints.tick(tracer), TICK_MS);
    try {
      for await (const state of tracer.render({
        samples,
        ...(noise === undefined ? {} : { noise }),
        signal,
        maxSubmitMs: SUBMIT_MS,
      })) {
        making.noise = state.noise ?? making.noise;
        progress.samples(state);
        this.#gpu.check();
        checkpoints.tick(tracer);
      }
    } finally {
      clearInterval(timer);
    }
    await checkpoints.settled();
  }

  /** A frame of a film, from its first sample: a lost GPU costs a frame. */
  async #expose(tracer: Tracer, scene: Scene, shot: Shot): Promise<void> {
    this.#moving ??= new MovingScene(tracer, scene);
    for await (const state of this.#moving.expose(shot, this.#context, SUBMIT_MS)) {
      this.#context.progress.samples(state);
      this.#gpu.check();
    }
  }

  async #writeFilm(film: FilmState, { path, format, bits }: OutputTarget, shot: Shot): Promise<WrittenFile> {
    const { io, backend } = this.#context;
    const file = new CheckpointFile(path, shot, io.cwd);
    const written = await file.write(film, () => backend.filmCodec(), {
      withBeauty: !shot.isPart,
      hashed: shot.isPart === true,
    });
    return { path, format, bits, ...written };
  }

  /** Throws what the device has had to say of the work so far, before anything is written. */
  async #flushed(): Promise<void> {
    await (this.#gpu.opened as OpenedGpu).device.queue.onSubmittedWorkDone();
    // Errors arrive as events, after the promise.
    await new Promise((done) => setImmediate(done));
    this.#gpu.check();
  }

  /** The error to end with, after the last checkpoint has been written. */
  async #withCheckpoint(error: unknown, { checkpoints, file }: ShotInProgress): Promise<unknown> {
    const samples = await checkpoints.flush();
    const kept = `${samples} samples are in "${file?.path}": the same command continues from there.`;
    if (!(error instanceof GpuGoneError)) {
      if (samples > 0) this.#context.progress.line(kept);
      return error;
    }
    const rest =
      samples > 0
        ? kept
        : file
          ? 'There was no checkpoint yet.'
          : 'With --checkpoint FILE, a later run continues from the last samples.';
    return new GpuGoneError(`${error.message} ${rest}`, error.givesDevices, error.cause);
  }

  async #device(timed: Timed): Promise<GPUDevice> {
    const { progress } = this.#context;
    if (!this.#gpu.opened) {
      progress.stage('start GPU');
      const { software, adapterName } = await timed('deviceMs', () => this.#gpu.open());
      progress.line(`${software ? 'no GPU: rendering on the CPU, ' : ''}${adapterName}`);
    }
    return (this.#gpu.opened as unknown as OpenedGpu).device;
  }

  /** A tracer of the scene with an empty film, at the camera, in the variant. */
  async #prepared(
    options: RenderCommandOptions,
    scene: Scene,
    camera: Camera,
    variant: number | undefined,
  ): Promise<Tracer> {
    const { backend, progress, signal, hierarchies } = this.#context;
    const { device } = this.#gpu.opened as OpenedGpu;
    const { width, height } = options;
    const { samples: _samples, noise: _noise, ...settings } = options.settings;
    const aovs = imageAovs(options);
    const key = JSON.stringify([sceneKey(options), width, height, settings, aovs]);
    // Textures lose levels by what the first camera shows of them: another camera needs a tracer of its own.
    const fits = settings.memory === undefined && !this.#tracer?.statistics.memory.reducedTextures.length;
    if (this.#tracer && key === this.#key && (fits || isDeepStrictEqual(camera, this.#fittedFor))) {
      await this.#tracer.setVariant(variant);
      await this.#tracer.setCamera(camera);
      this.#tracer.reset({ firstSample: options.samplesFrom });
      return this.#tracer;
    }
    this.#drop();
    this.#tracer = await backend.createTracer(device, scene, {
      width,
      height,
      camera,
      ...settings,
      aovs,
      signal,
      ...(hierarchies ? { hierarchies } : {}),
      onProgress: ({ stage, done }) => progress.stage(LABELS[stage], done),
      onWarning: ({ message }) => progress.warning(message),
    });
    this.#key = key;
    this.#fittedFor = camera;
    if (options.samplesFrom > 0) this.#tracer.reset({ firstSample: options.samplesFrom });
    if (variant !== undefined) await this.#tracer.setVariant(variant);
    return this.#tracer;
  }

  /**
   * The denoised image, also of samples that Ctrl-C has ended; undefined if none is asked for, or if Ctrl-C ends the
   * denoising.
   */
  async #denoised(
    denoiser: ImageDenoiser | undefined,
    tracer: Tracer,
    shot: Shot,
  ): Promise<{ readonly data: Float32Array; readonly quality: DenoiseQuality } | undefined> {
    const { denoise: quality } = shot.options;
    if (!denoiser || !quality) return undefined;
    const { progress, signal } = this.#context;
    progress.stage('denoise');
    const stop = signal.aborted ? new AbortController().signal : signal;
    try {
      return { data: await denoiser.denoise(tracer, stop), quality };
    } catch (error) {
      if (!stop.aborted || error !== stop.reason) throw error;
      progress.warning(`${shotLabel(shot)}: stopped while it was denoised; it is written with its noise.`);
      return undefined;
    }
  }

  /** The denoiser that the image asks for, kept for the next one. */
  async #denoiserOf({ denoise }: RenderCommandOptions): Promise<ImageDenoiser | undefined> {
    if (denoise === undefined || this.#denoiser?.quality === denoise) return denoise && this.#denoiser?.made;
    this.#denoiser?.made.destroy();
    this.#denoiser = undefined;
    const { backend, signal } = this.#context;
    const made = await backend.createDenoiser((this.#gpu.opened as OpenedGpu).device, denoise, signal);
    this.#denoiser = { quality: denoise, made };
    return made;
  }

  /** The next image gets a tracer of its own. */
  #drop(): void {
    this.#tracer?.destroy();
    this.#tracer = this.#moving = undefined;
    this.#denoiser?.made.destroy();
    this.#denoiser = undefined;
  }

  /** Gives the GPU back. */
  close(): void {
    this.#drop();
    this.#gpu.close();
  }
}
