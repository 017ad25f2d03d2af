import { GpuClock } from '../gpu-clock';
import type { Contestant } from './contestant';

/** Submissions that the clock can hold, with some room. */
const SUBMISSIONS = 1900;

/** Milliseconds that a calibration should last at least. */
const CALIBRATION_MS = 120;

/** What one unit of a contestant's work costs. */
export interface UnitCost {
  readonly gpuMs: number;
  readonly submissions: number;
}

/** Times contestants by the GPU's own clock, or by the wall where the device has no timestamps. */
export class GpuTime {
  readonly #device: GPUDevice;
  readonly #clock: GpuClock | undefined;
  /** What the clock itself adds to each submission, milliseconds. */
  #perSubmission = 0;

  private constructor(device: GPUDevice) {
    this.#device = device;
    this.#clock = GpuClock.create(device);
  }

  static async create(device: GPUDevice): Promise<GpuTime> {
    const time = new GpuTime(device);
    if (time.#clock) {
      const empty = 256;
      const costs: number[] = [];
      for (let i = 0; i < 3; i++) {
        const { busy } = await time.#clock.measure(async () => {
          for (let j = 0; j < empty; j++) device.queue.submit([]);
          await device.queue.onSubmittedWorkDone();
        });
        costs.push(busy / empty);
      }
      // In favour of those who submit often.
      time.#perSubmission = Math.max(...costs.slice(1));
    }
    return time;
  }

  /** Whether times are the GPU's own. */
  get stamped(): boolean {
    return this.#clock !== undefined;
  }

  /** Runs and times some work of at most {@link SUBMISSIONS} submissions. */
  async measure(
    work: () => Promise<void>,
  ): Promise<{ readonly gpuMs: number; readonly wallMs: number; readonly submissions: number }> {
    await this.#device.queue.onSubmittedWorkDone();
    const start = performance.now();
    if (!this.#clock) {
      await work();
      const wallMs = performance.now() - start;
      return { gpuMs: wallMs, wallMs, submissions: 0 };
    }
    let wallMs = 0;
    const { busy, submissions } = await this.#clock.measure(async () => {
      await work();
      wallMs = performance.now() - start;
    });
    return { gpuMs: Math.max(busy - submissions * this.#perSubmission, 0), wallMs, submissions };
  }

  /** What a unit costs in the long run; the contestant must be warm. */
  async unitCost(contestant: Contestant): Promise<UnitCost> {
    for (let units = 1; ;) {
      const { gpuMs, submissions } = await this.measure(() => contestant.advance(units));
      const perUnit = submissions / units;
      const max = Math.max(units, Math.floor(SUBMISSIONS / Math.max(perUnit, 1e-9)));
      if (gpuMs >= CALIBRATION_MS || units >= Math.min(max, 100_000))
        return { gpuMs: gpuMs / units, submissions: perUnit };
      units = Math.min(
        max,
        Math.max(2 * units, Math.min(8 * units, Math.ceil((1.2 * CALIBRATION_MS * units) / Math.max(gpuMs, 0.01)))),
      );
    }
  }

  /** Whether so much work can be timed as it runs. */
  holds(units: number, { submissions }: UnitCost): boolean {
    return units * submissions <= SUBMISSIONS;
  }

  /** The most units that can be timed as they run, at least one. */
  max({ submissions }: UnitCost): number {
    return Math.max(1, Math.floor(SUBMISSIONS / Math.max(submissions, 1e-9)));
  }

  destroy(): void {
    this.#clock?.destroy();
  }
}
