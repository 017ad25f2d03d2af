import type { DataTexture } from 'three';
import type { ThreePathTracer } from '../three-path-tracer';
import { createFilmTexture, FilmReader, writeFilmTexture } from './film-texture';

/** What is rendered so far, where three-gpu-pathtracer has a render target. */
export interface FilmTarget {
  /** Linear RGBA halves, bottom row first, colour not multiplied by alpha; `image.data` holds them. */
  readonly texture: DataTexture;
  /** Pixels. */
  readonly width: number;
  readonly height: number;
}

/** Keeps a texture of three up to date with a film. One read is under way at a time. */
export class FilmCopy implements FilmTarget {
  readonly texture = createFilmTexture();
  #reader: FilmReader | undefined;
  #device: GPUDevice | undefined;
  #reading = false;
  #again = false;
  #turn = 0;
  #samples = 0;

  /** Samples that the texture shows, 0 after {@link clear}. */
  get samples(): number {
    return this.#samples;
  }

  get width(): number {
    return this.texture.image.width;
  }

  get height(): number {
    return this.texture.image.height;
  }

  /** What was read, and what is being read, is of no use any more. */
  clear(): void {
    this.#turn++;
    this.#samples = 0;
    this.#again = false;
  }

  /**
   * Reads the film as it is; if a read is under way, once more after it.
   *
   * @returns When the texture has it, or {@link clear} was called.
   * @throws {ThreeError} `three/gpu`
   */
  async read(tracer: ThreePathTracer): Promise<void> {
    if (this.#reading) {
      this.#again = true;
      return;
    }
    this.#reading = true;
    try {
      do {
        this.#again = false;
        if (this.#device !== tracer.device) {
          this.#reader?.destroy();
          this.#device = tracer.device;
          this.#reader = new FilmReader(tracer.device);
        }
        const turn = this.#turn;
        let samples = 0;
        const { texels, width, height } = await (this.#reader as FilmReader).read(() => {
          samples = tracer.samples;
          return { buffer: tracer.tracer.beautyBuffer, width: tracer.width, height: tracer.height };
        });
        if (turn !== this.#turn) continue;
        writeFilmTexture(this.texture, texels, width, height);
        this.#samples = samples;
      } while (this.#again && !tracer.destroyed);
    } finally {
      this.#reading = false;
    }
  }

  destroy(): void {
    this.clear();
    this.#reader?.destroy();
    this.#reader = undefined;
    this.#device = undefined;
    this.texture.dispose();
  }
}
