import { ToneMapPass, type ToneMapOptions } from '@glanz/tonemap';
import { ThreeError } from './error';

/** A canvas that films are drawn to, tone-mapped. */
export class CanvasOutput {
  readonly #canvas: HTMLCanvasElement | OffscreenCanvas;
  readonly #context: GPUCanvasContext;
  readonly #device: GPUDevice;
  readonly #pass: ToneMapPass;

  private constructor(
    canvas: HTMLCanvasElement | OffscreenCanvas,
    context: GPUCanvasContext,
    device: GPUDevice,
    pass: ToneMapPass,
  ) {
    this.#canvas = canvas;
    this.#context = context;
    this.#device = device;
    this.#pass = pass;
  }

  /** @throws {ThreeError} `three/canvas`; {ToneMapError} */
  static async create(
    canvas: HTMLCanvasElement | OffscreenCanvas,
    device: GPUDevice,
    { exposure, toneMap }: ToneMapOptions,
  ): Promise<CanvasOutput> {
    const context = (canvas as HTMLCanvasElement).getContext('webgpu');
    if (!context)
      throw new ThreeError('three/canvas', 'The canvas has a context of another kind, such as WebGL: use a new one.');
    const format = navigator.gpu.getPreferredCanvasFormat();
    const pass = await ToneMapPass.create(device, {
      format,
      ...(exposure === undefined ? {} : { exposure }),
      ...(toneMap === undefined ? {} : { toneMap }),
    });
    context.configure({ device, format, alphaMode: 'premultiplied' });
    return new CanvasOutput(canvas, context, device, pass);
  }

  resize(width: number, height: number): void {
    if (this.#canvas.width !== width) this.#canvas.width = width;
    if (this.#canvas.height !== height) this.#canvas.height = height;
  }

  setView(view: ToneMapOptions): Promise<void> {
    return this.#pass.setOptions(view);
  }

  draw(film: GPUBuffer, size: readonly [number, number]): void {
    const encoder = this.#device.createCommandEncoder({ label: 'glanz three' });
    const { width, height } = this.#canvas;
    this.#pass.draw(encoder, film, size, this.#context.getCurrentTexture().createView(), [width, height]);
    this.#device.queue.submit([encoder.finish()]);
  }

  destroy(): void {
    this.#context.unconfigure();
    this.#pass.destroy();
  }
}
