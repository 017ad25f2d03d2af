import { totalmem } from 'node:os';
import { GlanzError } from '@glanz/scene';
import type { FilmCodec, FilmState, Tracer } from '../backend';
import type { CliIo } from '../io';
import type { ProgressReporter } from '../progress';
import type { CheckpointFile } from './checkpoint-file';

/**
 * Bytes a second at which a film is copied from the GPU, on a slow machine. With {@link SHARE} this gives the interval
 * in which copying takes less than 1 % of the time: 5 s for 1024 × 768 pixels.
 */
const COPY_RATE = 1e9;
const SHARE = 100;
/** A save waits for the batches before it while the GPU works on; its duration is an upper bound of what it costs. */
const WAIT_SHARE = 10;
const SHORTEST_MS = 1000;
/** Between two writes of the file. */
const FILE_MS = 30_000;
/** Share of the machine's memory that a copy may take. */
const MEMORY_SHARE = 1 / 4;
/** Bytes a pixel of a film with one light group. */
const BYTES_PER_PIXEL = 64;

const bytesOf = ({ sums }: FilmState) => Object.values(sums).reduce((bytes, { byteLength }) => bytes + byteLength, 0);

/** What {@link Checkpoints} work with. */
export interface CheckpointContext {
  readonly io: CliIo;
  readonly progress: ProgressReporter;
  readonly codec: () => Promise<FilmCodec>;
  readonly pixels: number;
  /** Also written there, less often. */
  readonly file: CheckpointFile | undefined;
}

/**
 * Copies of the film of one image while it is rendered: the last one is kept in memory, and in a file if one is named.
 * Both happen while the GPU works on, at intervals that cost less than 1 % of the time.
 */
export class Checkpoints {
  readonly #context: CheckpointContext;
  #latest: FilmState | undefined;
  #saving: Promise<void> | undefined;
  #writing: Promise<void> | undefined;
  /** What is in the file. */
  #written: FilmState | undefined;
  #next: number;
  #interval: number;
  #nextWrite: number;
  #warned = false;
  /** Whether there is memory for a copy. */
  readonly #fits: boolean;

  /**
   * @param resumed What rendering begins with.
   * @param read What is in the file.
   */
  constructor(context: CheckpointContext, resumed: FilmState | undefined, read: FilmState | undefined) {
    this.#written = read;
    this.#context = context;
    this.#latest = resumed;
    const bytes = BYTES_PER_PIXEL * context.pixels;
    this.#interval = Math.max(SHORTEST_MS, this.#copyMs(bytes) * SHARE);
    this.#fits = bytes <= totalmem() * MEMORY_SHARE;
    if (!this.#fits && context.file)
      this.#warn(
        `a film of ${(bytes / 1e9).toFixed(0)} GB is too large to be copied on this machine: there will be no checkpoints.`,
      );
    const now = context.io.now();
    this.#next = now + this.#interval;
    this.#nextWrite = now + FILE_MS;
  }

  /** The last one. */
  get latest(): FilmState | undefined {
    return this.#latest;
  }

  /** Takes a checkpoint if it is time for one. Does not wait for it. */
  tick(tracer: Pick<Tracer, 'saveFilm'>): void {
    const { io } = this.#context;
    if (!this.#fits || this.#saving || io.now() < this.#next) return;
    const start = io.now();
    this.#saving = tracer
      .saveFilm()
      .then((state) => {
        this.#latest = state;
        this.#interval = Math.max(SHORTEST_MS, this.#copyMs(bytesOf(state)) * SHARE, (io.now() - start) * WAIT_SHARE);
        if (this.#context.file && io.now() >= this.#nextWrite) this.#write();
      })
      .catch((error: unknown) => this.#failed(error))
      .finally(() => {
        this.#next = io.now() + this.#interval;
        this.#saving = undefined;
      });
  }

  /** After rendering has begun again: intervals count from now. */
  restart(): void {
    this.#next = this.#context.io.now() + this.#interval;
  }

  /** Takes a checkpoint of a film at rest. */
  async save(tracer: Pick<Tracer, 'saveFilm'>): Promise<void> {
    await this.#saving;
    if (!this.#fits) return;
    try {
      this.#latest = await tracer.saveFilm();
    } catch (error) {
      this.#failed(error);
    }
  }

  /** Waits for what is under way. */
  async settled(): Promise<void> {
    await this.#saving;
    await this.#writing;
  }

  /** It fits nothing here. */
  forget(): void {
    this.#latest = undefined;
  }

  /** Writes the last one to the file, unless it is there. Gives the samples in the file; 0 without one. */
  async flush(): Promise<number> {
    await this.settled();
    if (this.#latest && this.#latest.samples > 0) this.#write();
    await this.#writing;
    return this.#written?.samples ?? 0;
  }

  #write(): void {
    const { io, file, codec } = this.#context;
    const state = this.#latest as FilmState;
    if (!file || this.#writing || this.#written === state) return;
    const start = io.now();
    this.#writing = file
      .write(state, codec)
      .then(() => void (this.#written = state))
      // The image is worth more than its checkpoint.
      .catch((error: unknown) => this.#warn(`${(error as Error).message} Rendering continues without.`))
      .finally(() => {
        // Packing and hashing take the thread about as long as copying does; the disk works beside it.
        this.#nextWrite =
          io.now() + Math.max(FILE_MS, 2 * SHARE * this.#copyMs(bytesOf(state)), (io.now() - start) * WAIT_SHARE);
        this.#writing = undefined;
      });
  }

  #failed(error: unknown): void {
    // A loss is found by rendering too.
    if (error instanceof GlanzError && error.code === 'renderer/device-lost') return;
    if (this.#context.file) this.#warn(`no checkpoint could be taken: ${(error as Error).message}`);
  }

  #warn(text: string): void {
    if (!this.#warned) this.#context.progress.warning(text);
    this.#warned = true;
  }

  #copyMs(bytes: number): number {
    return (1000 * bytes) / COPY_RATE;
  }
}
