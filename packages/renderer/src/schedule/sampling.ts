import { loadPart } from '@glanz/wgsl';
import { FIRST_CHECK, nextCheck, TileGrid } from './adaptive';
import type { RenderProgress } from '../options';
import { renderLoop, type RenderLoop } from './render-loop';
import { Scheduler } from './scheduler';
import { headEnd } from './sample-range';

/** What a {@link Sampling} works on. */
export interface SamplingHost extends Pick<RenderLoop, 'queue' | 'submit' | 'room' | 'ready' | 'check'> {
  readonly width: number;
  readonly height: number;
  /** Paths that fit. */
  readonly capacity: number;
  /** From now on, place i of a batch is pixel `list[i]`; without a list pixel i. */
  readonly setPixels: (list: Uint32Array<ArrayBuffer> | undefined) => void;
  /** Sums over tiles, see `noiseMap`. */
  readonly measure: () => Promise<Float32Array>;
}

/** The state of a {@link Sampling}: with the film's sums, everything that is needed to continue it. */
export interface SamplingState {
  /** Number of the next sample of each tile, row by row; for the tiles under way it is `sample`. */
  readonly counts: Uint32Array<ArrayBuffer>;
  /** Tiles that are sampled together at the moment; `undefined`: all. */
  readonly tiles: Uint32Array<ArrayBuffer> | undefined;
  /** Number of the next sample of the pixels under way: in a film that begins at sample 0, how many they have. */
  readonly sample: number;
  /** Pixels under way, in their order, that have this sample too. */
  readonly pixel: number;
  /** Samples at which a noise target lets the pixels under way be judged next; 0 without one. */
  readonly until: number;
}

/** What one `render()` asks for. */
export interface SamplingGoal {
  /** Most samples per pixel. */
  readonly samples: number;
  /** Relative error to reach; without it every pixel gets all samples. */
  readonly noise: number | undefined;
  readonly budgetMs: number;
  readonly current: () => boolean;
}

/** The measured speed of a `render()`. */
interface Pace {
  readonly start: number;
  /** Paths so far. */
  traced: number;
  /** Paths to go for a noise target, as last estimated; `undefined` without one. */
  left: number | undefined;
  noise: number | undefined;
}

/**
 * The progress of a film: which tiles have how many samples, and the next batch. Tiles with equally many samples are
 * taken together, those with the fewest first, so that an unevenly sampled film can be evened out or continued. The
 * samples of a pixel depend on the request and the film, never on time.
 */
export class Sampling {
  readonly #host: SamplingHost;
  readonly #grid: TileGrid;
  /** Number of the first sample. */
  readonly #first: number;
  /** Number of the next sample of each tile, but for the tiles under way. */
  readonly #counts: Uint32Array<ArrayBuffer>;
  #scheduler: Scheduler;
  /** Tiles that the scheduler works on; `undefined`: all. */
  #under: readonly number[] | undefined;
  /** Samples to which a noise target drives the tiles under way before it looks at the noise again; 0 without one. */
  #until: number;

  /**
   * @param paths Paths a batch may begin with, from what was learned before.
   * @param state Of a film of the same size, to go on from.
   * @param first Number of the film's first sample.
   */
  constructor(host: SamplingHost, paths?: number, state?: SamplingState, first = 0) {
    this.#host = host;
    this.#first = first;
    this.#grid = new TileGrid(host.width, host.height);
    this.#counts = state ? state.counts.slice() : new Uint32Array(this.#grid.count).fill(first);
    this.#under = state?.tiles && [...state.tiles];
    this.#until = state?.until ?? 0;
    const list = this.#under && this.#grid.pixels(this.#under);
    host.setPixels(list);
    const options = { pixels: list?.length ?? host.width * host.height, capacity: host.capacity, budgetMs: 30 };
    this.#scheduler = new Scheduler(options, paths, state?.sample ?? first, state?.pixel);
  }

  /** Where the sampling stands once everything that was submitted by now is done. */
  get state(): SamplingState {
    const { samples: sample, pixel } = this.#scheduler;
    return {
      counts: this.#counts.slice(),
      tiles: this.#under && Uint32Array.from(this.#under),
      sample,
      pixel,
      until: this.#until,
    };
  }

  /** Completed samples of the pixels that have most. */
  get samples(): number {
    return Math.max(this.#scheduler.samples, this.#max()) - this.#first;
  }

  /** Highest number of the next sample of the tiles that are not under way. */
  #max(): number {
    return this.#under ? this.#counts.reduce((max, count) => Math.max(max, count), 0) : 0;
  }

  /** Paths that a batch may hold by now. */
  get paths(): number {
    return this.#scheduler.paths;
  }

  /** Works towards a goal. */
  async *render({ samples, ...rest }: SamplingGoal): AsyncGenerator<RenderProgress, void, undefined> {
    const goal = { ...rest, samples: this.#first + samples };
    // Until the noise is known, so is not how long it takes.
    const pace: Pace = {
      start: performance.now(),
      traced: 0,
      left: goal.noise === undefined ? undefined : Infinity,
      noise: undefined,
    };
    // A sample that was cut off in the middle of the image is completed first: lists change between samples only.
    if (this.#scheduler.partial) yield* this.#run(this.#scheduler.samples + 1, goal, pace);
    // No batch contains samples from both sides of the end of a first chunk that is not whole: see `FilmSession`.
    const head = Math.min(headEnd(this.#first), goal.samples);
    if (this.#scheduler.samples < head) yield* this.#run(head, goal, pace);
    // Noise is looked at after the same numbers of samples, wherever an earlier render() was cut off.
    if (goal.noise === undefined) this.#until = 0;
    const until = Math.min(this.#until, goal.samples);
    if (this.#scheduler.samples < until) yield* this.#run(until, goal, pace);
    // Where all pixels have equally many samples, and shall get as many, there are no tiles to choose.
    if (goal.noise === undefined && !this.#under) {
      if (goal.current() && this.#scheduler.samples < goal.samples) yield* this.#run(goal.samples, goal, pace);
      return;
    }
    while (goal.current()) {
      this.#settle();
      let tiles: readonly number[] = [...this.#counts.keys()];
      if (goal.noise !== undefined && this.#counts.every((count) => count >= FIRST_CHECK)) {
        const { noiseMap, noisyTiles, samplesLeft } = await loadPart('noise-target', import('./noise-target'));
        const map = noiseMap(await this.#host.measure());
        if (!goal.current()) return;
        tiles = noisyTiles(map.tiles, this.#grid.columns, goal.noise);
        pace.noise = map.whole;
        pace.left = samplesLeft(
          tiles,
          map.tiles,
          goal.noise,
          goal.samples,
          (tile) => this.#counts[tile] as number,
          (tile) => this.#grid.pixelsIn(tile),
          nextCheck,
        );
      }
      tiles = tiles.filter((tile) => (this.#counts[tile] as number) < goal.samples);
      if (tiles.length === 0) {
        if (pace.noise !== undefined) yield this.#progress(goal, pace, 0);
        return;
      }
      const [min, next = Infinity] = [...new Set(tiles.map((tile) => this.#counts[tile] as number))].sort(
        (a, b) => a - b,
      ) as [number, number?];
      this.#take(
        tiles.filter((tile) => this.#counts[tile] === min),
        min,
      );
      this.#until = goal.noise === undefined ? 0 : Math.min(next, nextCheck(min));
      yield* this.#run(Math.min(goal.samples, goal.noise === undefined ? next : this.#until), goal, pace);
    }
  }

  /** Drives the tiles under way to a number of samples. */
  async *#run(target: number, goal: SamplingGoal, pace: Pace): AsyncGenerator<RenderProgress, void, undefined> {
    const scheduler = this.#scheduler;
    scheduler.budget = goal.budgetMs;
    let done = scheduler.samples;
    for await (const samples of renderLoop({ ...this.#host, scheduler, target, current: goal.current })) {
      const paths = (samples - done) * scheduler.pixels;
      done = samples;
      pace.traced += paths;
      if (pace.left !== undefined) pace.left = Math.max(0, pace.left - paths);
      yield this.#progress(goal, pace, scheduler.pixels / this.#pixels, samples);
    }
  }

  get #pixels(): number {
    return this.#host.width * this.#host.height;
  }

  #progress(goal: SamplingGoal, { start, traced, left, noise }: Pace, active: number, samples = 0): RenderProgress {
    const elapsedMs = performance.now() - start;
    const rest = left ?? this.#missing(goal.samples);
    return {
      // The scheduler is ahead by what is on its way.
      samples: Math.max(samples - this.#first, this.#max() - this.#first, 0) || this.samples,
      targetSamples: goal.samples - this.#first,
      elapsedMs,
      remainingMs: rest === 0 ? 0 : traced > 0 ? (rest * elapsedMs) / traced : Infinity,
      samplesPerSecond: (1000 * traced) / elapsedMs / this.#pixels,
      active,
      ...(noise === undefined ? {} : { noise }),
    };
  }

  /** Writes the scheduler's progress into the counts. */
  #settle(): void {
    if (this.#under) for (const tile of this.#under) this.#counts[tile] = this.#scheduler.samples;
    else this.#counts.fill(this.#scheduler.samples);
  }

  #take(tiles: readonly number[], samples: number): void {
    const all = tiles.length === this.#grid.count;
    const same = all
      ? this.#under === undefined
      : this.#under?.length === tiles.length && this.#under.every((tile, i) => tile === tiles[i]);
    if (same) return;
    this.#under = all ? undefined : tiles;
    const list = all ? undefined : this.#grid.pixels(tiles);
    this.#host.setPixels(list);
    this.#scheduler = this.#scheduler.continued(list?.length ?? this.#pixels, samples);
  }

  /** Samples still missing to an even image. */
  #missing(target: number): number {
    if (!this.#under) return Math.max(0, target - this.#scheduler.samples) * this.#scheduler.pixels;
    const under = new Set(this.#under);
    return this.#counts.reduce(
      (sum, count, tile) =>
        sum + Math.max(0, target - (under.has(tile) ? this.#scheduler.samples : count)) * this.#grid.pixelsIn(tile),
      0,
    );
  }
}
