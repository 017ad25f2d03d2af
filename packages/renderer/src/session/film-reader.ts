import { loadPart } from '@glanz/wgsl';
import { withErrorScopes } from '../device/error-scopes';
import type { Film } from '../film/film';
import type { GroupWeights } from '../film/layers';
import { forBands } from '../integrator/bands';
import type { Integrator } from '../integrator/integrator';
import type { KernelCache } from '../integrator/kernel-cache';
import type { Kernel } from '../integrator/pipelines';
import { TileGrid } from '../schedule/adaptive';
import { headEnd, headSamples } from '../schedule/sample-range';
import type { GpuMemory } from '../storage/buffers';
import { readFloats } from '../storage/read-buffer';

/** What a {@link FilmReader} asks of the session that it belongs to. */
export interface FilmReaderHost {
  readonly device: GPUDevice;
  readonly memory: GpuMemory;
  readonly cache: KernelCache;
  readonly integrator: Integrator;
  readonly film: () => Film;
  /** Number of the film's first sample. */
  readonly first: () => number;
  /** Number of the next sample of the pixels under way. */
  readonly next: () => number;
  /** Weights of the light groups when the film was begun. */
  readonly firstWeights: () => GroupWeights;
  /** Whether `film_head` holds the sums of a first chunk that is not whole. */
  readonly headCopied: () => boolean;
  /** Settles when the film has been cleared. */
  readonly cleared: () => Promise<void>;
  /** Throws if the tracer was destroyed or its device lost. */
  readonly check: () => void;
  readonly writeFrame: () => void;
  /** The GPU has refused something. */
  readonly refused: () => void;
}

type Floats = Float32Array<ArrayBuffer>;

/** Copies the sums of a film, and what follows from them. The film is only read. */
export class FilmReader {
  readonly #host: FilmReaderHost;

  constructor(host: FilmReaderHost) {
    this.#host = host;
  }

  /** Buffers of the film, to the CPU. The copies are submitted before this returns. */
  copy(...names: readonly string[]): Promise<Floats>[] {
    return names.map((name) => this.#floats(this.#buffer(name)));
  }

  /** The sums of a first chunk that is not whole, once the film has gone beyond it. @param next The next sample. */
  async head(next = this.#host.next()): Promise<Floats | undefined> {
    const first = this.#host.first();
    if (headSamples(first) === 0 || next < headEnd(first)) return undefined;
    return this.#floats(this.#host.headCopied() ? this.#host.film().head : this.#buffer('film_total'));
  }

  /** The layer `variance` of `PathTracer.read`. */
  async variance(): Promise<Floats> {
    const { integrator, first, firstWeights } = this.#host;
    // With catchers: the image in which they are what they are, without the one that lacks the objects.
    const weights = integrator.pathsPerSample > 1 ? [...firstWeights(), ...firstWeights()] : firstWeights();
    const missing = headSamples(first());
    const [total, moment, head] = await Promise.all([...this.copy('film_total', 'film_moment'), this.head()]);
    const { varianceLayer } = await loadPart('film-data', import('../film/film-data'));
    return varianceLayer(total as Floats, moment as Floats, weights, missing, head);
  }

  /** See `PathTracer.varianceBuffer`. */
  async varianceBuffer(): Promise<GPUBuffer> {
    const { cleared, integrator, memory, first } = this.#host;
    await cleared();
    // The kernel knows nothing of the samples that a first chunk lacks.
    const layer = headSamples(first()) > 0 ? await this.variance() : undefined;
    return this.#measure('variance', (kernel, { pixels }) => {
      if (layer?.length === 4 * pixels) memory.write(this.#buffer('film_variance'), layer);
      else forBands(pixels, (batch) => integrator.submitPixels('variance', kernel, batch));
    });
  }

  /** Sums over tiles, see `noiseMap`. */
  async measureNoise(): Promise<Float32Array> {
    const { device, integrator, writeFrame } = this.#host;
    let size = 0;
    const sums = await this.#measure('noise', (kernel, { width, height }) => {
      const { columns, rows } = new TileGrid(width, height);
      size = 16 * columns * rows;
      writeFrame();
      integrator.submitTiles(kernel, columns, rows);
    });
    return readFloats(device, sums, size);
  }

  /** Runs a kernel whose result is made when it is first bound; frees that where the GPU refuses it. */
  async #measure(name: 'variance' | 'noise', submit: (kernel: Kernel, film: Film) => void): Promise<GPUBuffer> {
    const { cache, check, device, film: current, integrator, refused } = this.#host;
    const kernel = await cache.kernel(name, integrator.kernels.features);
    check();
    const film = current();
    const result = `film_${name}`;
    try {
      await withErrorScopes(device, `the film's ${name}`, () => submit(kernel, film));
    } catch (error) {
      film.release(result);
      refused();
      throw error;
    }
    return film.buffer(result) as GPUBuffer;
  }

  #buffer(name: string): GPUBuffer {
    return this.#host.film().buffer(name) as GPUBuffer;
  }

  #floats(buffer: GPUBuffer): Promise<Floats> {
    return readFloats(this.#host.device, buffer, this.#host.film().bytes(buffer));
  }
}
