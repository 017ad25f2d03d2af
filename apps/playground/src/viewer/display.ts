import { ToneMapPass, type ToneMapOptions } from '@glanz/tonemap';
import { PlaygroundError } from '../errors';

/** A picture in a buffer of the GPU: vec4f per pixel. */
export interface GpuPicture {
  readonly buffer: GPUBuffer;
  readonly size: readonly [number, number];
}

/** A canvas of one device: draws films through the tone map, and layers as they are. */
export class Display {
  readonly #canvas: HTMLCanvasElement;
  readonly #device: GPUDevice;
  readonly #context: GPUCanvasContext;
  readonly #pass: ToneMapPass;
  readonly #plain: ToneMapPass;
  #layer: GpuPicture | undefined;

  private constructor(canvas: HTMLCanvasElement, device: GPUDevice, context: GPUCanvasContext, pass: ToneMapPass, plain: ToneMapPass) {
    this.#canvas = canvas;
    this.#device = device;
    this.#context = context;
    this.#pass = pass;
    this.#plain = plain;
  }

  static async create(canvas: HTMLCanvasElement, device: GPUDevice, view: ToneMapOptions): Promise<Display> {
    const format = navigator.gpu.getPreferredCanvasFormat();
    const [pass, plain] = await Promise.all([ToneMapPass.create(device, { format, ...view }), ToneMapPass.create(device, { format, toneMap: 'linear', alpha: 'opaque' })]);
    const context = canvas.getContext('webgpu');
    if (!context) throw new PlaygroundError('playground/no-canvas', 'The canvas gives no WebGPU context: reload the page, or use another browser.');
    context.configure({ device, format, alphaMode: 'premultiplied' });
    return new Display(canvas, device, context, pass, plain);
  }

  /** Changes exposure and tone map. */
  setView(view: ToneMapOptions): Promise<void> {
    return this.#pass.setOptions(view);
  }

  /** Takes a layer's picture, or drops it. */
  setLayer(picture: Float32Array<ArrayBuffer> | undefined, size: readonly [number, number]): void {
    this.#layer?.buffer.destroy();
    this.#layer = undefined;
    if (!picture) return;
    const buffer = this.#device.createBuffer({ label: 'playground layer', size: picture.byteLength, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST });
    this.#device.queue.writeBuffer(buffer, 0, picture);
    this.#layer = { buffer, size };
  }

  /** Whether a layer is shown rather than the film. */
  get showsLayer(): boolean {
    return this.#layer !== undefined;
  }

  /** Shows the layer, or the film where there is none. */
  draw(film: GpuPicture, width: number, height: number): void {
    // Only now, since a change of size wipes the canvas.
    if (this.#canvas.width !== width) this.#canvas.width = width;
    if (this.#canvas.height !== height) this.#canvas.height = height;
    const [pass, { buffer, size }] = this.#layer ? [this.#plain, this.#layer] : [this.#pass, film];
    const encoder = this.#device.createCommandEncoder({ label: 'playground display' });
    pass.draw(encoder, buffer, size, this.#context.getCurrentTexture().createView(), [width, height]);
    this.#device.queue.submit([encoder.finish()]);
  }

  destroy(): void {
    this.#layer?.buffer.destroy();
    this.#pass.destroy();
    this.#plain.destroy();
    this.#context.unconfigure();
  }
}
