import { loadPart } from '@glanz/wgsl';
import type { Camera } from '@glanz/scene';
import { TileGrid } from '../schedule/adaptive';
import { RenderError } from '../errors';
import type { GpuMemory } from '../storage/buffers';
import { inErrorScopes, withErrorScopes } from '../device/error-scopes';
import type { KernelCache } from '../integrator/kernel-cache';
import { readBuffer, readFloats } from '../storage/read-buffer';
import { forBands } from '../integrator/bands';
import type { Integrator } from '../integrator/integrator';
import { FILM_CHUNK, headEnd, headSamples } from '../schedule/sample-range';
import { renderGoal } from '../option-checks';
import type { FilmLayer, HistoryFrame, LightGroup, RenderOptions, RenderProgress } from '../options';
import type { Batch } from '../schedule/scheduler';
import { Sampling, type SamplingState } from '../schedule/sampling';
import { AovRecorder } from './aov-recorder';
import { FilmReader } from './film-reader';
import type { EditEffect, Move } from '../film/edit-effect';
import type { Film } from '../film/film';
import { FILM_SUMS, type FilmState } from '../film/film-state';
import { FrameHistory } from '../film/frame-history';
import { GroupSettings } from '../film/group-settings';
import type { GroupWeights } from '../film/layers';

/** What a {@link FilmSession} asks of the tracer that it belongs to. */
export interface FilmHost {
  readonly device: GPUDevice;
  readonly memory: GpuMemory;
  readonly cache: KernelCache;
  readonly integrator: Integrator;
  /** Names of the light groups that there are now, in the order of the film's light passes. */
  readonly groupNames: () => readonly string[];
  /** The frame uniforms for a film. */
  readonly packFrame: (film: Film) => ArrayBuffer;
  /** The camera that the film is seen through. */
  readonly camera: () => Camera;
  /** See `filmFingerprint`. */
  readonly fingerprint: () => string;
  /** Throws if the tracer was destroyed or its device lost. */
  readonly check: () => void;
  /** Settles when the pending edit is in place or undone; `undefined`: none is pending. */
  readonly ready: () => Promise<void> | undefined;
}

/** Words of the queue header that hold counts, in bytes: dropped samples. */
const BAD_SAMPLES = 12;
/** Bytes of the queue header. */
const COUNTERS = 32;

/** The film of a tracer, and all that adds samples to it, changes how it is put together, or copies it. */
export class FilmSession {
  readonly #host: FilmHost;
  readonly aovs: AovRecorder;
  readonly reader: FilmReader;
  readonly groups: GroupSettings;
  readonly #history = new FrameHistory();
  #film: Film;
  #sampling: Sampling | undefined;
  /** Counts restarts: what began before one must not go on after it. */
  #generation = 0;
  #rendering = false;
  /** Whether the GPU has refused a batch, so that samples are missing. */
  #broken = false;
  /** Rejects where the GPU refused to clear the film. */
  #cleared: Promise<void> = Promise.resolve();
  #frameDirty = true;
  #firstWeights: GroupWeights = [];
  /** Number of the film's first sample. */
  #first = 0;
  /** Whether `film_head` holds the first chunk, of which samples before the film are missing. */
  #headCopied = false;
  #badSamples = 0;

  constructor(host: FilmHost, film: Film) {
    this.#host = host;
    this.#film = film;
    this.groups = new GroupSettings(host.groupNames);
    const shared = {
      ...host,
      film: () => this.#film,
      first: () => this.#first,
      writeFrame: () => this.#writeFrame(),
      refused: () => this.#refused(),
    };
    this.aovs = new AovRecorder({
      ...shared,
      samples: () => this.samples,
      generation: () => this.#generation,
      ready: async () => {
        await this.#cleared;
        await host.ready();
        host.check();
      },
    });
    this.reader = new FilmReader({
      ...shared,
      next: () => this.#sampling?.state.sample ?? 0,
      firstWeights: () => this.#firstWeights,
      headCopied: () => this.#headCopied,
      cleared: () => this.#cleared,
    });
  }

  /** See `PathTracer.history`. */
  get history(): HistoryFrame | undefined {
    return this.#history.previous;
  }

  /** Kernels that record other AOVs have come. */
  restartAovs(): void {
    this.aovs.restart();
    this.#frameDirty = true;
  }

  get film(): Film {
    return this.#film;
  }

  /** See `PathTracer.samples`. */
  get samples(): number {
    return this.#sampling?.samples ?? 0;
  }

  /** Samples that were dropped, as of the last read. */
  get badSamples(): number {
    return this.#badSamples;
  }

  /**
   * Starts the film again, for what the frame uniforms and the light groups are now; or goes on with other uniforms.
   *
   * @param effect What has changed.
   * @param first Number of its first sample; default: the same as before.
   * @param moves Instances that have moved.
   * @param reuses Whether it reuses light samples of the frame before.
   */
  restart(effect: EditEffect, first = this.#first, moves?: readonly Move[], reuses = false): void {
    this.#frameDirty = true;
    if (effect === 'keeps') return;
    const { device, integrator } = this.#host;
    const { width, height } = this.#film;
    this.#history.restart(effect, this.samples, { camera: this.#host.camera(), width, height }, moves);
    this.#generation++;
    integrator.firstSample = this.#first = first;
    integrator.reuse?.restart(reuses);
    this.#headCopied = false;
    this.#broken = false;
    this.aovs.restart();
    this.#firstWeights = this.groups.weights;
    // Keeps what was learned about the GPU's speed.
    if (this.#sampling) this.#sampling = this.#newSampling(this.#sampling.paths);
    const { verified } = inErrorScopes(device, 'clearing the film', () => {
      integrator.writeGroups(this.#firstWeights, this.#firstWeights);
      const encoder = device.createCommandEncoder({ label: 'glanz reset' });
      this.#film.clear(encoder);
      device.queue.submit([encoder.finish()]);
    });
    this.#watch(verified);
    this.#cleared = verified;
  }

  /** After a refused batch samples are missing: the next render begins again. */
  #watch(verified: Promise<void>): void {
    const generation = this.#generation;
    verified.catch(() => {
      this.#refused();
      if (this.#host.memory.destroyed) return;
      this.aovs.restart();
      if (generation === this.#generation) this.#broken = true;
    });
  }

  /** Bind groups that were refused must not be used again, nor uniforms relied on that were perhaps not written. */
  #refused(): void {
    if (this.#host.memory.destroyed) return;
    this.#host.integrator.rebind();
    this.#frameDirty = true;
  }

  /** Ends a running render. */
  end(): void {
    this.#generation++;
  }

  /** Share of the film's width and height that is rendered, see `PathTracer.setRenderScale`. Restart afterwards. */
  set renderScale(scale: number) {
    this.#film.scale = scale;
    this.#host.integrator.rebind('film');
  }

  /** Replaces the film and frees the old one. */
  replace(film: Film): void {
    this.#film.destroy();
    this.#film = film;
    this.#sampling = undefined;
    this.#host.integrator.useFilm(film);
  }

  /** See `PathTracer.render`. */
  async *render(options: RenderOptions): AsyncGenerator<RenderProgress, void, undefined> {
    const { samples, noise, maxSubmitMs } = renderGoal(options);
    if (this.#rendering) throw new RenderError('renderer/busy', 'This tracer is rendering: finish or abort that.');
    if (this.#first > 0 && noise !== undefined)
      throw new RenderError('renderer/samples', `A noise target needs a film from sample 0, not ${this.#first}.`);
    this.#rendering = true;
    try {
      if (this.#broken) this.restart('invalidates');
      const generation = this.#generation;
      const sampling = (this.#sampling ??= this.#newSampling());
      yield* sampling.render({
        samples,
        noise,
        budgetMs: maxSubmitMs,
        current: () => generation === this.#generation && !options.signal?.aborted,
      });
    } finally {
      this.#rendering = false;
    }
  }

  /** See `PathTracer.read`. */
  async read(layer: FilmLayer): Promise<Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>> {
    const { device, integrator } = this.#host;
    await this.#cleared;
    if (layer === 'variance') return this.reader.variance();
    if (layer !== 'beauty') return this.aovs.read(layer);
    const [pixels, counters] = await Promise.all([
      readFloats(device, this.#film.beauty, this.#film.pixels * 16),
      readBuffer(device, integrator.buffers.queues, COUNTERS),
    ]);
    this.#count(counters);
    return pixels;
  }

  /** See `PathTracer.readLightGroup`. */
  async readGroup(name: string): Promise<Float32Array<ArrayBuffer>> {
    const pass = this.groups.lightPass(name);
    const weight = this.groups.weights[pass] as GroupWeights[number];
    const [total, block, moment] = await Promise.all(this.reader.copy('film_total', 'film_block', 'film_moment'));
    const { groupLayer } = await loadPart('film-data', import('../film/film-data'));
    return groupLayer(total as Float32Array, block as Float32Array, moment as Float32Array, pass, weight);
  }

  /** See `PathTracer.setLightGroup`. */
  async setGroup(name: string, settings: Partial<Pick<LightGroup, 'intensity' | 'color'>>): Promise<void> {
    const undo = this.groups.set(name, settings);
    try {
      await this.#relight();
    } catch (error) {
      undo();
      this.#host.integrator.rebind();
      this.#host.integrator.writeGroups(this.groups.weights, this.#firstWeights);
      throw error;
    }
  }

  /** See `PathTracer.saveFilm`. */
  async save(beauty = true): Promise<FilmState> {
    const { device, integrator, fingerprint } = this.#host;
    // All copies are submitted in one turn, behind the batches that the sampling counts as given out.
    const sampling = (this.#sampling ??= this.#newSampling()).state;
    const { width, height, lightPasses } = this.#film;
    const weights = { first: this.#firstWeights, last: this.groups.weights };
    const first = this.#first;
    // What is saved may have to be restored where nothing can be fetched.
    import('../film/film-data').catch(() => {});
    const head = { width, height, lightPasses, weights, sampling, fingerprint: fingerprint() };
    const [counters, part, ...sums] = await Promise.all([
      readBuffer(device, integrator.buffers.queues, COUNTERS),
      this.reader.head(sampling.sample),
      ...this.reader.copy(...FILM_SUMS.slice(0, beauty ? 4 : 3)),
    ]);
    this.#count(counters);
    const end = Math.max(
      sampling.sample,
      sampling.tiles ? sampling.counts.reduce((max, count) => Math.max(max, count), 0) : 0,
    );
    const parts = part ? [{ chunk: Math.floor(first / FILM_CHUNK), sums: part }] : [];
    const named = Object.fromEntries(
      FILM_SUMS.map((name, i) => [name, sums[i] ?? new Float32Array(4 * width * height)]),
    ) as FilmState['sums'];
    return { ...head, samples: end - first, ranges: [[first, end]], badSamples: this.#badSamples, parts, sums: named };
  }

  /** See `PathTracer.restoreFilm`. */
  async restore(state: FilmState): Promise<void> {
    const { device, integrator, memory, fingerprint, check } = this.#host;
    const { filmStateFault } = await loadPart('film-data', import('../film/film-data'));
    check();
    const film = this.#film;
    const { width, height, lightPasses } = film;
    const first = state.ranges[0]?.[0] ?? 0;
    const chunks =
      headSamples(first) > 0 && state.sampling.sample >= headEnd(first) ? [Math.floor(first / FILM_CHUNK)] : [];
    const tiles = new TileGrid(width, height).count;
    const fault = filmStateFault(state, { width, height, lightPasses, fingerprint: fingerprint() }, tiles, chunks);
    if (fault) throw new RenderError('renderer/film-state', `The saved film cannot be resumed here: ${fault}.`);
    this.restart('invalidates', first);
    const { verified } = inErrorScopes(device, 'the saved film', () => {
      this.#sampling = this.#newSampling(this.#sampling?.paths, state.sampling);
      this.#firstWeights = state.weights.first;
      integrator.writeGroups(this.groups.weights, this.#firstWeights);
      for (const name of FILM_SUMS) memory.write(film.buffer(name) as GPUBuffer, state.sums[name]);
      for (const { sums } of state.parts) memory.write(film.head, sums);
      this.#headCopied = state.parts.length > 0;
      memory.write(integrator.buffers.queues, Uint32Array.of(state.badSamples), BAD_SAMPLES);
    });
    this.#watch(verified);
    this.#badSamples = state.badSamples;
    await verified;
    // The light groups were set otherwise when it was saved.
    if (JSON.stringify(this.groups.weights) !== JSON.stringify(state.weights.last)) await this.#relight();
    await device.queue.onSubmittedWorkDone();
    check();
  }

  /** Composes the beauty again from the film's sums, as the light groups are set. */
  async #relight(): Promise<void> {
    const { cache, device, integrator, memory } = this.#host;
    const kernel = await cache.kernel('relight', integrator.kernels.features);
    if (memory.destroyed) return;
    await withErrorScopes(device, 'the light groups', () => {
      integrator.writeGroups(this.groups.weights, this.#firstWeights);
      forBands(this.#film.pixels, (batch) => integrator.submitPixels('relight', kernel, batch));
    });
  }

  #newSampling(paths?: number, state?: SamplingState): Sampling {
    const { device, integrator, check, ready } = this.#host;
    const film = this.#film;
    const host = {
      width: film.width,
      height: film.height,
      capacity: Math.floor(integrator.limit / integrator.pathsPerSample),
      queue: device.queue,
      submit: (batch: Batch) => {
        const { verified } = inErrorScopes(device, 'a batch of paths', () => {
          this.#writeFrame();
          if (batch.sampleOffset >= headEnd(this.#first)) this.#copyHead();
          integrator.submit(batch, this.aovs.recording(batch));
        });
        this.#watch(verified);
        const sound = Promise.all([this.#cleared, verified]).then(() => {});
        // Of several refused batches the loop reports the first.
        sound.catch(() => {});
        return sound;
      },
      room: (requested: number) =>
        Math.floor(integrator.room(requested * integrator.pathsPerSample) / integrator.pathsPerSample),
      ready,
      check,
      setPixels: (list: Uint32Array<ArrayBuffer> | undefined) => film.setPixels(list),
      measure: () => this.reader.measureNoise(),
    };
    return new Sampling(host, paths, state, this.#first);
  }

  /** Keeps the sums of a first chunk that is not whole apart, before other chunks are added to them. */
  #copyHead(): void {
    if (this.#headCopied || headSamples(this.#first) === 0) return;
    this.#headCopied = true;
    const encoder = this.#host.device.createCommandEncoder({ label: 'glanz film head' });
    this.#film.copyHead(encoder);
    this.#host.device.queue.submit([encoder.finish()]);
  }

  #writeFrame(): void {
    if (!this.#frameDirty) return;
    const { integrator, packFrame, camera } = this.#host;
    integrator.writeFrame(packFrame(this.#film));
    const { AOV_MOTION, LIGHT_REUSE } = integrator.kernels.features.flags;
    if (AOV_MOTION || LIGHT_REUSE)
      integrator.writeHistory(this.#history.pack(camera(), this.#film.width, this.#film.height));
    this.#frameDirty = false;
  }

  #count(counters: ArrayBuffer): void {
    this.#badSamples = new Uint32Array(counters)[BAD_SAMPLES / 4] as number;
  }
}
