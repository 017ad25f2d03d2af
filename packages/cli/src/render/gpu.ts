import { GlanzError } from '@glanz/scene';
import type { Backend, OpenedGpu } from '../backend';
import { CliError } from '../errors';
import type { CliIo } from '../io';
import type { ProgressReporter } from '../progress';

/**
 * A GPU that cannot be recovered: it was lost several times without progress, or gives no new device. Code `cli/gpu-lost`,
 * exit status 5.
 */
export class GpuGoneError extends CliError {
  /** Whether it gives devices, and loses each: what was rendered may be the cause. */
  readonly givesDevices: boolean;

  constructor(message: string, givesDevices: boolean, cause: unknown) {
    super('cli/gpu-lost', message, { cause });
    this.givesDevices = givesDevices;
  }
}

/** Milliseconds before each attempt to get a device after a loss. Drivers that restart need a few seconds. */
const BACK_OFF = [0, 300, 1000, 3000, 10_000];
/** Milliseconds that the report of a loss may come after the error that it caused. */
const LATE_NEWS = 100;

/** What a {@link RecoverableGpu} works with. */
export interface GpuContext {
  readonly io: CliIo;
  readonly backend: Backend;
  readonly progress: ProgressReporter;
  readonly signal: AbortSignal;
}

/** What people can do about a GPU that is gone. */
export const GPU_ADVICE =
  'Often it ran out of memory, its driver crashed or was updated, or the machine was suspended: close other programs that use it, try a smaller --size, update the driver, or choose another one with --gpu (see glanz --list-gpus; --gpu software uses the processor).';

/**
 * A GPU by name, with its device: opened when it is first needed, watched, and opened again after a loss.
 * Each device comes from a new adapter, since a loss makes the old one useless.
 */
export class RecoverableGpu {
  readonly #context: GpuContext;
  readonly #name: string | undefined;
  #opened: OpenedGpu | undefined;
  #lost: GPUDeviceLostInfo | undefined;
  #failures: Error[] = [];
  /** Losses and refused devices since there was progress. */
  #tries = 0;
  #losses = 0;
  #adapterName: string | undefined;
  /** What the last device said of its adapter. */
  #adapter: string | undefined;

  constructor(context: GpuContext, name: string | undefined) {
    this.#context = context;
    this.#name = name;
  }

  /** The device and what it is called, once {@link open} has been called. */
  get opened(): OpenedGpu | undefined {
    return this.#opened;
  }

  /** Whether there has been a device at all. */
  get everOpened(): boolean {
    return this.#adapterName !== undefined;
  }

  /** Losses so far. */
  get losses(): number {
    return this.#losses;
  }

  /** For messages. */
  get label(): string {
    return this.#adapterName ?? this.#name ?? 'GPU';
  }

  /** The device; a new one if there is none. @throws {DeviceError} if there is no such GPU. */
  async open(): Promise<OpenedGpu> {
    if (this.#opened) return this.#opened;
    const failures: Error[] = [];
    const opened = await this.#context.backend.openGpu(this.#name, (error) => failures.push(error));
    this.#failures = failures;
    this.#lost = undefined;
    this.#opened = opened;
    this.#adapterName = opened.adapterName;
    const { vendor = '', device = '', description = '' } = opened.device.adapterInfo ?? {};
    const adapter = `${vendor} ${device} ${description}`.trim();
    if (this.#adapter !== undefined && adapter !== this.#adapter)
      this.#context.progress.warning(`another GPU takes over: ${adapter}.`);
    this.#adapter = adapter;
    void opened.device.lost.then((info) => {
      if (this.#opened === opened) this.#lost = info;
    });
    return opened;
  }

  /**
   * Throws what the device has reported since the last call outside of any call of the renderer: memory that it did not
   * have, work that it refused. An image after that may lack something.
   *
   * @throws {DeviceError} `renderer/out-of-memory`, `renderer/gpu-error`
   */
  check(): void {
    const [first] = this.#failures.splice(0);
    if (first) throw first;
  }

  /** Forgets what the device has reported; its image has failed. */
  forgive(): void {
    this.#failures.length = 0;
  }

  /** Rendering has come further than at the last loss. */
  progressed(): void {
    this.#tries = 0;
  }

  /** The loss that caused an error; `undefined` if the device is as well as before. */
  async lossBehind(error: unknown): Promise<GPUDeviceLostInfo | undefined> {
    const opened = this.#opened;
    if (!opened) return undefined;
    const typed = error instanceof GlanzError;
    if (this.#lost || (typed && !error.code.startsWith('renderer/'))) return this.#lost;
    if (typed && error.code === 'renderer/device-lost')
      return { reason: 'unknown', message: error.message } as GPUDeviceLostInfo;
    const late = new AbortController();
    await Promise.race([opened.device.lost, this.#context.io.wait(LATE_NEWS, late.signal)]);
    late.abort();
    return this.#lost;
  }

  /**
   * Takes a new device after a loss, with pauses that grow from one attempt to the next.
   *
   * @throws {GpuGoneError} after as many attempts as there are pauses
   * @throws the reason of the signal
   */
  async replace(loss: GPUDeviceLostInfo): Promise<void> {
    const { io, progress, signal } = this.#context;
    const label = this.label;
    this.#losses++;
    this.close();
    let cause: unknown = loss;
    let why = loss.message.replace(/\s+/g, ' ').trim() || loss.reason;
    for (let givesDevices = true; ; givesDevices = false) {
      if (this.#tries >= BACK_OFF.length) throw this.#gone(label, why, givesDevices, cause);
      const pause = BACK_OFF[this.#tries++] as number;
      progress.stage('wait for the GPU');
      if (pause > 0) await io.wait(pause, signal);
      signal.throwIfAborted();
      try {
        await this.open();
        return;
      } catch (error) {
        if (!(error instanceof GlanzError)) throw error;
        cause = error;
        why = error.message.replace(/[.\s]+$/, '');
      }
    }
  }

  #gone(label: string, why: string, givesDevices: boolean, cause: unknown): GpuGoneError {
    const times = this.#losses === 1 ? 'once' : `${this.#losses} times`;
    const what = givesDevices
      ? `was lost ${times}, the last time without progress in between`
      : `was lost and gives no new device after ${BACK_OFF.length} attempts`;
    return new GpuGoneError(`The GPU "${label}" ${what} (${why}). ${GPU_ADVICE}`, givesDevices, cause);
  }

  /** Gives the device back. */
  close(): void {
    this.#opened?.device.destroy();
    this.#opened = undefined;
    this.#lost = undefined;
  }
}
