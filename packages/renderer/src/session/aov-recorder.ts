import { loadPart } from '@glanz/wgsl';
import { inErrorScopes } from '../device/error-scopes';
import { RenderError } from '../errors';
import { AOV_BUFFERS, AOV_PLACES, type AovBuffer } from '../film/aovs';
import type { Film } from '../film/film';
import type { AovBatch, Integrator } from '../integrator/integrator';
import type { AovName, FilmAov } from '../options';
import type { Batch } from '../schedule/scheduler';
import { readBuffer } from '../storage/read-buffer';
import { AovProgress } from './aov-progress';

/** The film that an {@link AovRecorder} belongs to, and what it goes through. */
export interface AovHost {
  readonly device: GPUDevice;
  readonly integrator: Integrator;
  readonly film: () => Film;
  /** Number of the film's first sample, and how many it has. */
  readonly first: () => number;
  readonly samples: () => number;
  /** Counts restarts of the film. */
  readonly generation: () => number;
  /** Settles when batches may be submitted. @throws if the tracer was destroyed or its device lost */
  readonly ready: () => Promise<void>;
  /** Writes the frame uniforms, if they have changed. */
  readonly writeFrame: () => void;
  /** The GPU has refused a batch: bind groups and uniforms must not be relied on. */
  readonly refused: () => void;
}

const NOTHING: AovBatch = { begin: 0, end: 0, only: false };

/** Records the AOVs of a film's samples, and gives them out. */
export class AovRecorder {
  readonly #host: AovHost;
  #progress: AovProgress;

  constructor(host: AovHost) {
    this.#host = host;
    this.#progress = new AovProgress(host.first(), host.film().pixels);
  }

  /** The buffers hold nothing of the film. */
  restart(): void {
    this.#progress = new AovProgress(this.#host.first(), this.#host.film().pixels);
  }

  /** See `PathTracer.aov`. */
  aov(name: AovName): FilmAov {
    const { buffer: bufferName, ...place } = AOV_PLACES[name];
    const buffer = this.#host.film().buffer(bufferName);
    if (!buffer) throw this.#missing(name);
    return { buffer, ...place, samples: this.#progress.samples };
  }

  /** What a batch of the film, which is about to be submitted, records. */
  recording(batch: Batch): AovBatch {
    const { integrator, film } = this.#host;
    // Batches over some of the pixels, which are noisier than others, come after those that matter here.
    const taken = integrator.kernels.features.flags.AOVS && !film().listed ? this.#progress.take(batch) : undefined;
    return taken ? { begin: taken[0], end: taken[1], only: false } : NOTHING;
  }

  /**
   * Records the AOVs of samples that the film has without them, at least of one, by tracing their paths as far as these
   * need: in small batches, between those of a running render. Ends early where the film restarts.
   *
   * @throws The reason of `signal`, once it is aborted and the GPU has finished the batch that it was working on.
   */
  async fill(signal?: AbortSignal): Promise<void> {
    const { device, integrator, film, samples, generation, ready } = this.#host;
    const started = generation();
    for (;;) {
      await ready();
      signal?.throwIfAborted();
      const progress = this.#progress;
      const paths = Math.floor(integrator.capacity / integrator.pathsPerSample);
      const batch = progress.next(Math.max(1, samples()), paths);
      if (started !== generation() || !integrator.kernels.features.flags.AOVS || !batch) return;
      const { verified } = inErrorScopes(device, "the film's AOVs", () => this.#trace(batch, film()));
      const refused = verified.catch((error: unknown) => {
        this.#host.refused();
        if (progress === this.#progress) this.restart();
        throw error;
      });
      await Promise.all([refused, device.queue.onSubmittedWorkDone()]);
    }
  }

  #trace(batch: Batch, film: Film): void {
    const [begin, end] = this.#progress.take(batch) as readonly [number, number];
    this.#host.writeFrame();
    const list = film.listed;
    if (list) film.setPixels(undefined);
    this.#host.integrator.submit(batch, { begin, end, only: true });
    if (list) film.setPixels(list);
  }

  /** See `PathTracer.read`. The AOV must be requested. */
  async read(name: AovName): Promise<Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>> {
    const { device, film, generation } = this.#host;
    // Beside the AOV's own: coverage comes with positions.
    const names = new Set<AovBuffer>([
      AOV_PLACES[name].buffer,
      ...(name === 'position' ? ['aov_albedo' as const] : []),
    ]);
    const { unpackAov } = await loadPart('film-data', import('../film/film-data'));
    for (;;) {
      const started = generation();
      await this.fill();
      // An edit or a resize in between begins another image.
      if (started !== generation()) continue;
      const copies = await Promise.all(
        [...names].map((buffer) => {
          const found = film().buffer(buffer);
          if (!found) throw this.#missing(name);
          return readBuffer(device, found, film().pixels * AOV_BUFFERS[buffer]);
        }),
      );
      if (started === generation()) return unpackAov(name, copies);
    }
  }

  #missing(name: AovName): RenderError {
    return new RenderError('renderer/aov', `The film keeps no AOV "${name}": request it by aovs or setAovs.`);
  }
}
