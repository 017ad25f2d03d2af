import type { Session } from './session';

const NO_PART = 0xffffffff;

/** Draws a line around a part over the image, from the layer of parts. */
export class Outline {
  readonly #canvas: HTMLCanvasElement;
  readonly #session: Session;
  #instance: number | undefined;
  #asked = 0;

  constructor(canvas: HTMLCanvasElement, session: Session) {
    this.#canvas = canvas;
    this.#session = session;
  }

  /** @param instance Index in the scene; undefined takes the line away. */
  show(instance: number | undefined): void {
    this.#instance = instance;
    this.clear();
    if (instance !== undefined) void this.#draw();
  }

  /** The image has changed under the line. */
  clear(): void {
    this.#asked++;
    const { width, height } = this.#canvas;
    this.#canvas.getContext('2d')?.clearRect(0, 0, width, height);
    delete this.#canvas.dataset['part'];
  }

  /** The image stands still: the line comes back. */
  settled(): void {
    if (this.#instance !== undefined && this.#canvas.dataset['part'] === undefined) void this.#draw();
  }

  async #draw(): Promise<void> {
    const { tracer } = this.#session;
    const instance = this.#instance;
    if (!tracer || instance === undefined || tracer.samples === 0) return;
    const asked = ++this.#asked;
    const { width, height } = tracer;
    let ids: Uint32Array;
    try {
      ids = await tracer.read('objectId');
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
      x >= 0 && y >= 0 && x < width && y < height && ids[y * width + x] === instance && ids[y * width + x] !== NO_PART;
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        if (inside(x, y) || !(inside(x - 1, y) || inside(x + 1, y) || inside(x, y - 1) || inside(x, y + 1))) continue;
        image.data.set([240, 182, 74, 255], 4 * (y * width + x));
      }
    }
    context.putImageData(image, 0, 0);
    this.#canvas.dataset['part'] = String(instance);
  }
}
