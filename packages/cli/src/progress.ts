import { styleText } from 'node:util';
import type { CliIo } from './io';
import { visible } from './visible';

/** Minutes and seconds, or hours and minutes, for people. */
export function duration(milliseconds: number): string {
  if (!Number.isFinite(milliseconds)) return '–';
  const seconds = Math.max(0, Math.ceil(milliseconds / 1000));
  const two = (n: number) => String(n).padStart(2, '0');
  return seconds < 3600
    ? `${Math.floor(seconds / 60)}:${two(seconds % 60)}`
    : `${Math.floor(seconds / 3600)}:${two(Math.floor(seconds / 60) % 60)}:${two(seconds % 60)}`;
}

/** Three significant digits, without an exponent. */
export function rate(value: number): string {
  if (!(value > 0) || !Number.isFinite(value)) return '0';
  return value >= 100 ? String(Math.round(value)) : value.toPrecision(3);
}

/** How rendering stands. Structurally the renderer's `RenderProgress`. */
export interface SampleProgress {
  readonly samples: number;
  readonly targetSamples: number;
  readonly elapsedMs: number;
  readonly remainingMs: number;
  readonly samplesPerSecond: number;
  /** Relative error, towards a noise target. */
  readonly noise?: number;
}

/** In a log: this many seconds between lines at first, then growing in proportion to the time passed. */
const LOG_SECONDS = 5;
const LOG_GROWTH = 1.5;
/** On a terminal: redraw at most this often. */
const REDRAW_MS = 80;

/**
 * Shows how far things are: one line that is rewritten on a terminal, a line now and then in a log, nothing if quiet.
 */
export class ProgressReporter {
  readonly #io: CliIo;
  readonly #quiet: boolean;
  /** Stands before everything while one of several images is made. */
  prefix = '';
  /** Several images are made at a time: only lines that stay make sense. */
  shared = false;
  #shown = false;
  #lastDraw = -Infinity;
  #nextLog = 0;
  #stage = '';

  constructor(io: CliIo, quiet: boolean) {
    this.#io = io;
    this.#quiet = quiet;
  }

  /** A stage before rendering; `done` 0..1 if it is known. */
  stage(label: string, done?: number): void {
    if (this.#quiet || this.shared) return;
    if (this.#io.interactive) {
      if (label === this.#stage && this.#io.now() - this.#lastDraw < REDRAW_MS) return;
      this.#draw(
        `${this.prefix}${this.#style('cyan', label)}${done === undefined || done === 0 ? ' …' : ` ${Math.floor(done * 100)} %`}`,
      );
    } else if (label !== this.#stage) this.#io.stderr(`${this.prefix}${label}\n`);
    this.#stage = label;
  }

  /** Samples so far. */
  samples(progress: SampleProgress): void {
    if (this.#quiet || this.shared) return;
    const { samples, targetSamples, samplesPerSecond, elapsedMs, remainingMs } = progress;
    const now = this.#io.now();
    const last = remainingMs === 0 || samples >= targetSamples;
    const what =
      progress.noise === undefined
        ? `${samples}/${targetSamples} samples`
        : `${samples} samples · noise ${(100 * progress.noise).toFixed(2)} %`;
    const figures = `${what} · ${rate(samplesPerSecond)} samples/s · ${duration(remainingMs)} left`;
    if (!this.#io.interactive) {
      if (this.#stage !== 'render') this.#nextLog = 0;
      this.#stage = 'render';
      if (elapsedMs < this.#nextLog && !last) return;
      this.#nextLog = Math.max(elapsedMs + LOG_SECONDS * 1000, elapsedMs * LOG_GROWTH);
      this.#io.stderr(`${this.prefix}render ${figures}\n`);
      return;
    }
    if (now - this.#lastDraw < REDRAW_MS && !last && this.#stage === 'render') return;
    this.#stage = 'render';
    const plain = ` ${this.prefix}${figures}`;
    const width = Math.min(30, this.#io.columns() - plain.length - 2);
    // Towards a noise target, time measures the progress.
    const share =
      progress.noise === undefined ? samples / targetSamples : elapsedMs / Math.max(elapsedMs + remainingMs, 1);
    const filled = Math.round(Math.min(share, 1) * width);
    const bar =
      width >= 8 ? this.#style('cyan', '━'.repeat(filled)) + this.#style('dim', '─'.repeat(width - filled)) : '';
    this.#draw(bar + (bar ? plain : plain.trimStart().slice(0, Math.max(10, this.#io.columns() - 1))));
  }

  /** A line that stays. Control characters in it are made visible. */
  line(text: string): void {
    this.#print(visible(text));
  }

  /** A warning, as a line that stays. */
  warning(text: string): void {
    this.#print(`${this.#style('yellow', 'warning:')} ${visible(text)}`);
  }

  /** Takes the rewritten line away. */
  clear(): void {
    if (this.#shown) this.#io.stderr('\r\x1b[2K');
    this.#shown = false;
  }

  #print(text: string): void {
    if (this.#quiet) return;
    this.clear();
    this.#io.stderr(`${text}\n`);
  }

  #draw(text: string): void {
    this.#lastDraw = this.#io.now();
    this.#io.stderr(`\r\x1b[2K${text}`);
    this.#shown = true;
  }

  #style(format: 'cyan' | 'dim' | 'yellow', text: string): string {
    return this.#io.color ? styleText(format, text) : text;
  }
}
