import type { Session } from './session';

const NO_PART = 0xffffffff;

/** Draws a line around parts over the image, from the layer of parts. */
export class Outline {
  readonly #canvas: HTMLCanvasElement;
  readonly #session: Session;
  #parts: readonly number[] = [];
  #asked = 0;
  /** Parts are read one time after the other. */
  #reading: Promise<unknown> | undefined;

  constructor(canvas: HTMLCanvasElement, session: Session) {
    this.#canvas = canvas;
    this.#session = session;
  }

  /** @param parts Indices in the scene; none take the line away. */
  show(parts: readonly number[]): void {
    this.#parts = parts;
    this.clear();
    if (parts.length > 0) void this.#draw();
  }

  /** The image has changed under the line. */
  clear(): void {
    this.#asked++;
    const { width, height } = this.#canvas;
    this.#canvas.getContext('2d')?.clearRect(0, 0, width, height);
    delete this.#canvas.dataset['part'];
  }

  /** The image does not move: the line comes back. */
  settled(): void {
    if (this.#parts.length > 0 && this.#canvas.dataset['part'] === undefined) void this.#draw();
  }

  async #draw(): Promise<void> {
    const { tracer } = this.#session;
    const parts = new Set(this.#parts);
    if (!tracer || parts.size === 0 || tracer.samples === 0) return;
    const asked = ++this.#asked;
    await this.#reading;
    if (asked !== this.#asked) return;
    const { width, height } = tracer;
    let ids: Uint32Array;
    try {
      const reading = tracer.read('objectId');
      this.#reading = reading.catch(() => undefined);
      ids = await reading;
    } catch {
      // The device was lost: so is the image that the line belongs to.
      return;
    }
    if (asked !== this.#asked || ids.length !== width * height) return;
    this.#canvas.width = width;
    this.#canvas.height = height;
    const context = this.#canvas.getContext('2d');
    if (!context) return;
    const image = context.createImageData(width, height);
    const inside = (x: number, y: number) =>
      x >= 0 &&
      y >= 0 &&
      x < width &&
      y < height &&
      ids[y * width + x] !== NO_PART &&
      parts.has(ids[y * width + x] as number);
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        if (inside(x, y) || !(inside(x - 1, y) || inside(x + 1, y) || inside(x, y - 1) || inside(x, y + 1))) continue;
        image.data.set([240, 182, 74, 255], 4 * (y * width + x));
      }
    }
    context.putImageData(image, 0, 0);
    this.#canvas.dataset['part'] = [...parts].join(' ');
  }
}
