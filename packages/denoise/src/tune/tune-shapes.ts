import { makeStages, type ShaderStage } from '../chain';
import { checkOptions, isSoftware, readNetworks } from '../configure';
import { matricesFor, shapesOf } from '../layer-shapes';
import { DenoiseError } from '../error';
import { ALIGNMENT, COPY_DST, UNIFORM, lossOf } from '../gpu';
import { checkSize } from '../images';
import { candidateShapes, chooseShape } from '../kernels/choose-shape';
import {
  hasMatrices,
  tileHeight,
  type DeviceMatrices,
  type KernelFamily,
  type KernelShape,
  type ThreadShape,
} from '../kernels/shapes';
import { allocate } from '../memory';
import type { DenoiserOptions, LayerSize } from '../options';
import { pauses } from '../pace';
import { planLayer, type LayerPlan } from '../plan';
import { readyLayer, type ReadyLayer } from '../ready-layer';
import { CLOCK_CAPACITY, TuneClock, type Work } from './clock';

/** Options for {@link tuneShapes}: those of the denoiser that is to use the shapes, the size, and limits. */
export interface TuneOptions extends Omit<DenoiserOptions, 'shapeOf'> {
  /** Pixels of the images, 1 to 16384. */
  readonly width: number;
  /** Pixels of the images, 1 to 16384. */
  readonly height: number;
  /**
   * Milliseconds after which measuring stops; the remaining layers keep the default shape. The most expensive ones come
   * first. Default 900.
   */
  readonly maxMs?: number;
  /** Called after each layer with the part of the work of all layers that was measured, 0 to 1. */
  readonly onProgress?: (done: number) => void;
}

/**
 * Shapes by layer, channels and pixels: plain data, the same keys in the same order for a network and a size. Layers that
 * subgroup matrices compute fastest are left out.
 */
export type TunedShapes = Readonly<Record<string, KernelFamily>>;

/** Shapes that are measured of a layer. */
const CANDIDATES = 6;

// Browsers round timestamps to 65 µs or 100 µs: one measurement of 2 ms is off by 2 %, the mean of four of 4 ms by 0.4 %.
/** Milliseconds and repetitions of the measurements of all shapes. */
const FIRST = { milliseconds: 2, rounds: 2 } as const;
/** The same for the best of them. */
const FINAL = { milliseconds: 4, rounds: 4 } as const;

/** Layers that are compiled while another one is measured. */
const AHEAD = 3;

/** A shape that is faster than the usual one by less than this factor is not taken: that is noise. */
const MARGIN = 0.99;

const keyOf = ({ name, channels, upChannels, directChannels }: LayerSize, width: number, height: number): string =>
  `${name} ${upChannels}+${directChannels}>${channels} ${width}x${height}`;

/**
 * What {@link tuneShapes} found, for `DenoiserOptions.shapeOf`. Layers of other networks and sizes have the usual shape.
 *
 * @example
 * const denoiser = await Denoiser.create(device, weights, { shapeOf: shapesFrom(tuned) });
 */
export const shapesFrom =
  (tuned: TunedShapes): NonNullable<DenoiserOptions['shapeOf']> =>
  (layer, width, height) => {
    const key = keyOf(layer, width, height);
    return Object.hasOwn(tuned, key) ? tuned[key] : undefined;
  };

/** A shape of a layer, ready to be run. */
interface Trial {
  readonly shape: KernelShape;
  readonly layer: ReadyLayer;
  /** Milliseconds of a row of pixels, summed over the rounds of a comparison. */
  spent: number;
}

/** How much of a layer is run for one measurement. */
interface Portion {
  readonly rows: number;
  readonly repeats: number;
}

/** Ends where the time is over or the signal aborts. */
class Limit {
  readonly #end: number;
  readonly #signal: AbortSignal | undefined;
  readonly #stopped: Promise<'stopped'>;
  readonly #clear: () => void;

  constructor(milliseconds: number, signal: AbortSignal | undefined) {
    this.#end = performance.now() + milliseconds;
    this.#signal = signal;
    let stop!: () => void;
    this.#stopped = new Promise((resolve) => (stop = () => resolve('stopped')));
    const timer = milliseconds === Infinity ? undefined : setTimeout(stop, milliseconds);
    signal?.addEventListener('abort', stop);
    this.#clear = () => {
      clearTimeout(timer);
      signal?.removeEventListener('abort', stop);
    };
  }

  /** @throws The signal's reason where it has aborted. */
  get reached(): boolean {
    this.#signal?.throwIfAborted();
    return performance.now() >= this.#end;
  }

  /** What the promise gives; `undefined` where the limit comes first. */
  async within<T>(promise: Promise<T>): Promise<T | undefined> {
    const first = await Promise.race([promise, this.#stopped]);
    this.#signal?.throwIfAborted();
    return first === 'stopped' ? undefined : (first as T);
  }

  clear(): void {
    this.#clear();
  }
}

/** Measures the layers of one network. */
class Tuner {
  readonly #device: GPUDevice;
  readonly #clock: TuneClock;
  readonly #limit: Limit;
  readonly #buffers: readonly GPUBuffer[];
  readonly #own: GPUBuffer[] = [];
  readonly #rows: GPUBuffer;
  readonly #submitMs: number;
  readonly #pause = pauses();
  /** Multiply-adds a millisecond, by the layer before; low at first. */
  #speed = 1e5;
  #ended = false;

  constructor(device: GPUDevice, clock: TuneClock, limit: Limit, buffers: readonly GPUBuffer[], submitMs: number) {
    this.#device = device;
    this.#clock = clock;
    this.#limit = limit;
    this.#buffers = buffers;
    this.#submitMs = submitMs;
    this.#rows = device.createBuffer({ label: 'denoise tune', size: ALIGNMENT, usage: UNIFORM | COPY_DST });
    this.#own.push(this.#rows);
  }

  /** Frees its buffers; what drivers still compile comes to nothing. */
  destroy(): void {
    this.#ended = true;
    for (const buffer of this.#own) buffer.destroy();
  }

  /** Compiles the candidates of a layer, all at once; those that a driver refuses are left out. */
  async compile(
    { kernels }: ShaderStage,
    plan: LayerPlan,
    software: boolean,
    matrices: DeviceMatrices | undefined,
  ): Promise<Trial[]> {
    const { layer, width, height, direct, up, result } = plan;
    const { maxStorageBufferBindingSize } = this.#device.limits;
    const compiled: Promise<Trial | undefined>[] = [];
    const multiplied = matrices?.shapeOf(layer);
    const shapes: KernelShape[] = candidateShapes(layer, width, height, software, CANDIDATES);
    for (const shape of multiplied ? [multiplied, ...shapes] : shapes) {
      const planned = planLayer(layer, shape, direct, up, result, maxStorageBufferBindingSize);
      if (!planned) continue;
      const begun = kernels.convolution(planned).then(
        (kernel) => {
          // The limit may have ended all of this while the driver worked.
          if (this.#ended) return undefined;
          const ready = readyLayer(this.#device, kernels, kernel, planned, this.#buffers, this.#rows, this.#own);
          return { shape, layer: ready, spent: 0 };
        },
        () => undefined,
      );
      compiled.push(begun);
      await this.#pause();
      if (this.#ended) break;
    }
    return (await Promise.all(compiled)).filter((trial) => trial !== undefined);
  }

  /** The shape that is fastest for the layer; `undefined` where the time did not suffice. */
  async best(trials: readonly Trial[]): Promise<KernelShape | undefined> {
    const [usual] = trials;
    if (!usual) return undefined;
    await this.#learn(usual);
    if (!(await this.#compare(trials, FIRST))) return undefined;
    const others = trials.filter((trial) => trial !== usual).sort((a, b) => a.spent - b.spent);
    const finalists = [usual, ...others.slice(0, 2)];
    if (!(await this.#compare(finalists, FINAL))) return undefined;
    const fastest = finalists.reduce((a, b) => (b.spent < a.spent ? b : a));
    return (fastest.spent < MARGIN * usual.spent ? fastest : usual).shape;
  }

  /** What of a layer takes so many milliseconds. */
  #portion({ layer: { plan } }: Trial, milliseconds: number): Portion {
    const work = milliseconds * this.#speed;
    const costOfRow = plan.costOfRow / tileHeight(plan.shape);
    const rows = Math.min(plan.height, Math.max(16, 16 * Math.floor(work / costOfRow / 16)));
    return { rows, repeats: rows < plan.height ? 1 : Math.max(1, Math.floor(work / (costOfRow * plan.height))) };
  }

  /** Finds the speed at which the layer is computed. */
  async #learn(trial: Trial): Promise<void> {
    const aim = Math.min(FIRST.milliseconds, this.#submitMs);
    // Ten times more each: from a CPU's speed to that of the largest GPU.
    for (let i = 0; i < 8 && !this.#limit.reached; i++) {
      const portion = this.#portion(trial, aim);
      const [milliseconds = 0] = await this.#clock.measure([workOf(trial, portion)]);
      const { plan } = trial.layer;
      const work = (plan.costOfRow / tileHeight(plan.shape)) * portion.rows * portion.repeats;
      this.#speed = Math.min(10 * this.#speed, work / Math.max(milliseconds, 1e-3));
      if (milliseconds > aim / 3) return;
    }
  }

  /** Measures shapes one after the other, several times; `false` where the time did not suffice. */
  async #compare(trials: readonly Trial[], { milliseconds, rounds }: typeof FIRST | typeof FINAL): Promise<boolean> {
    const aim = Math.min(milliseconds, this.#submitMs);
    const portion = this.#portion(trials[0]!, aim);
    const together = Math.max(1, Math.min(CLOCK_CAPACITY, Math.floor(this.#submitMs / aim)));
    for (const trial of trials) trial.spent = 0;
    for (let round = 0; round < rounds; round++)
      for (let i = 0; i < trials.length; i += together) {
        if (this.#limit.reached) return false;
        const some = trials.slice(i, i + together);
        const times = await this.#clock.measure(some.map((trial) => workOf(trial, portion)));
        for (const [k, trial] of some.entries()) trial.spent += times[k]! / rowsOf(trial, portion) / portion.repeats;
      }
    return !this.#limit.reached;
  }
}

/** Rows of workgroups that a portion takes; no more than a binding has room for. */
const groupsOf = ({ layer: { plan, strips } }: Trial, { rows }: Portion): number =>
  Math.min(strips[0]!.strip.toRow, Math.ceil(rows / tileHeight(plan.shape)));

/** Rows of pixels of the layer that are computed. */
const rowsOf = (trial: Trial, portion: Portion): number =>
  Math.min(trial.layer.plan.height, groupsOf(trial, portion) * tileHeight(trial.shape));

const workOf =
  (trial: Trial, portion: Portion): Work =>
  (pass) => {
    const { kernel, plan, strips } = trial.layer;
    pass.setPipeline(kernel.pipeline);
    pass.setBindGroup(0, strips[0]!.group!, [0]);
    for (let i = 0; i < portion.repeats; i++)
      pass.dispatchWorkgroups(plan.workgroups[0], groupsOf(trial, portion), plan.workgroups[2]);
  };

/** The family that has this shape for the layer. */
const familyOf = ({ groups: _, ...family }: ThreadShape): KernelFamily => family;

/**
 * Measures on the device which shapes compute a network's layers fastest for images of a size: how threads share the work
 * of a layer. Results of a denoiser do not depend on shapes, but for the choice between subgroup matrices and threads,
 * which round differently. By default they are chosen by a model that is fitted to one
 * large GPU (H100), and can be further from the best on others.
 *
 * Takes the memory of a denoiser for this size while it runs, and frees everything at its end. What it returns is plain
 * data: store it, by the adapter's description, and pass it to {@link shapesFrom}.
 *
 * @param weights As for `Denoiser.create`.
 * @throws {DenoiseError} `denoise/weights`, `denoise/option`, `denoise/size`, `denoise/memory`, `denoise/limit`,
 * `denoise/device`; the signal's reason where it aborts.
 * @example
 * const tuned = await tuneShapes(device, weights, { width: 1920, height: 1080 });
 * const denoiser = await Denoiser.create(device, weights, { shapeOf: shapesFrom(tuned) });
 */
export async function tuneShapes(
  device: GPUDevice,
  weights: Uint8Array | ArrayBuffer,
  { width, height, maxMs = 900, signal, onProgress, ...options }: TuneOptions,
): Promise<TunedShapes> {
  signal?.throwIfAborted();
  checkOptions(options);
  if (!(maxMs > 0)) throw new DenoiseError('denoise/option', `maxMs ${maxMs} is not a positive number.`);
  checkSize(width, height);
  const limit = new Limit(maxMs, signal);
  const lost = lossOf(device);
  const { storage = 'f16', maxMemory = 2 ** 30, maxSubmitMs = 8 } = options;
  const software = isSoftware(device);
  const stages = makeStages(device, readNetworks(weights, options), storage);
  const matrices = await matricesFor(device, options);
  const memory = await allocate(
    device,
    stages.map(({ network }) => network),
    0,
    {
      width,
      height,
      maxMemory,
      texelBytes: storage === 'f16' ? 8 : 16,
      maxBinding: device.limits.maxStorageBufferBindingSize,
      shapeOf: shapesOf(device, undefined, undefined),
    },
  );
  const clock = new TuneClock(device, lost);
  const tuner = new Tuner(device, clock, limit, memory.buffers, Math.min(maxSubmitMs, 12));
  const tuned: Record<string, KernelFamily> = {};
  try {
    const layers = new Map<string, { readonly stage: ShaderStage; readonly plan: LayerPlan }>();
    for (const [i, stage] of stages.entries())
      for (const plan of memory.parts[i]!.plan.layers) {
        // The last layer writes into an image, and has one shape.
        if (!plan.result) continue;
        const key = keyOf(plan.layer, plan.width, plan.height);
        layers.set(key, { stage, plan });
        if (!matrices?.shapeOf(plan.layer))
          tuned[key] ??= familyOf(chooseShape(plan.layer, plan.width, plan.height, software));
      }
    const costOf = ({ plan }: { readonly plan: LayerPlan }) => plan.costOfRow * plan.workgroups[1];
    const order = [...layers].sort(([, a], [, b]) => costOf(b) - costOf(a));
    const total = order.reduce((sum, [, layer]) => sum + costOf(layer), 0);
    let done = 0;
    // While a layer is measured, the driver compiles the next ones.
    const compiled: Promise<Trial[]>[] = [];
    for (const [i, [key, layer]] of order.entries()) {
      while (compiled.length < Math.min(order.length, i + 1 + AHEAD)) {
        const [, { stage, plan }] = order[compiled.length]!;
        const begun = tuner.compile(stage, plan, software, matrices);
        begun.catch(() => undefined);
        compiled.push(begun);
      }
      const trials = await limit.within(compiled[i]!);
      const best = trials && (await tuner.best(trials));
      if (!best) break;
      if (!hasMatrices(best)) tuned[key] = familyOf(best);
      done += costOf(layer);
      onProgress?.(done / total);
    }
    signal?.throwIfAborted();
    return tuned;
  } finally {
    limit.clear();
    tuner.destroy();
    clock.destroy();
    for (const { kernels } of stages) kernels.destroy();
    for (const buffer of memory.buffers) buffer.destroy();
  }
}
