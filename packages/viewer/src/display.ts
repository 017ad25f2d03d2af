import { ToneMapPass, type ToneMapOptions } from '@glanz/tonemap';
import { compose } from '@glanz/wgsl/compose';
import { viewerBlend } from './blend.wgsl';
import { ViewerError } from './errors';

/** A picture in a buffer of the GPU: vec4f per pixel. */
export interface GpuPicture {
  readonly buffer: GPUBuffer;
  readonly size: readonly [number, number];
}

/** GPUBufferUsage; the names exist as globals in browsers only. */
const [COPY_DST, UNIFORM, STORAGE] = [0x8, 0x40, 0x80];

/** A canvas of one device: draws films through the tone map, mixed with the preview that came before them. */
export class Display {
  readonly #canvas: HTMLCanvasElement;
  readonly #device: GPUDevice;
  readonly #context: GPUCanvasContext;
  readonly #pass: ToneMapPass;
  readonly #blend: GPUComputePipeline;
  readonly #uniforms: GPUBuffer;
  #small: (GpuPicture & { readonly samples: number }) | undefined;
  #mixed: GPUBuffer | undefined;

  private constructor(canvas: HTMLCanvasElement, device: GPUDevice, context: GPUCanvasContext, pass: ToneMapPass, blend: GPUComputePipeline) {
    this.#canvas = canvas;
    this.#device = device;
    this.#context = context;
    this.#pass = pass;
    this.#blend = blend;
    this.#uniforms = device.createBuffer({ label: 'glanz viewer blend', size: 32, usage: UNIFORM | COPY_DST });
  }

  static async create(canvas: HTMLCanvasElement, device: GPUDevice, view: ToneMapOptions): Promise<Display> {
    const format = navigator.gpu.getPreferredCanvasFormat();
    const module = device.createShaderModule({ label: 'glanz viewer blend', code: compose([viewerBlend]).code });
    const [pass, blend] = await Promise.all([
      ToneMapPass.create(device, { format, ...view }),
      device.createComputePipelineAsync({ label: 'glanz viewer blend', layout: 'auto', compute: { module, entryPoint: 'viewer_blend' } }),
    ]);
    const context = canvas.getContext('webgpu');
    if (!context) throw new ViewerError('viewer/no-canvas', 'The canvas gives no WebGPU context: it may have one of another kind already; use a fresh canvas.');
    context.configure({ device, format, alphaMode: 'premultiplied' });
    return new Display(canvas, device, context, pass, blend);
  }

  /** Changes exposure and tone map. */
  setView(view: ToneMapOptions): Promise<void> {
    return this.#pass.setOptions(view);
  }

  /** Samples of the preview that is kept, 0 without one. */
  get kept(): number {
    return this.#small?.samples ?? 0;
  }

  /** Keeps a copy of a picture, to be mixed into those that follow. */
  keep({ buffer, size }: GpuPicture, samples: number): void {
    this.forget();
    const bytes = size[0] * size[1] * 16;
    const copy = this.#device.createBuffer({ label: 'glanz viewer preview', size: bytes, usage: STORAGE | COPY_DST });
    const encoder = this.#device.createCommandEncoder({ label: 'glanz viewer keep' });
    encoder.copyBufferToBuffer(buffer, 0, copy, 0, bytes);
    this.#device.queue.submit([encoder.finish()]);
    this.#small = { buffer: copy, size, samples };
  }

  /** Lets go of what was kept. */
  forget(): void {
    this.#small?.buffer.destroy();
    this.#mixed?.destroy();
    this.#small = this.#mixed = undefined;
  }

  /**
   * Shows a picture.
   *
   * @param canvasSize Pixels of the canvas.
   * @param share Of the kept preview in it, 0..1.
   */
  draw(film: GpuPicture, canvasSize: readonly [number, number], share: number): void {
    const [width, height] = canvasSize;
    // Only now, since a change of size wipes the canvas.
    if (this.#canvas.width !== width) this.#canvas.width = width;
    if (this.#canvas.height !== height) this.#canvas.height = height;
    const encoder = this.#device.createCommandEncoder({ label: 'glanz viewer' });
    const source = this.#small && share > 0 ? this.#mix(encoder, film, this.#small, share) : film.buffer;
    this.#pass.draw(encoder, source, film.size, this.#context.getCurrentTexture().createView(), canvasSize);
    this.#device.queue.submit([encoder.finish()]);
  }

  destroy(): void {
    this.forget();
    this.#pass.destroy();
    this.#uniforms.destroy();
    this.#context.unconfigure();
  }

  #mix(encoder: GPUCommandEncoder, film: GpuPicture, small: GpuPicture, share: number): GPUBuffer {
    const [width, height] = film.size;
    if (this.#mixed?.size !== width * height * 16) {
      this.#mixed?.destroy();
      this.#mixed = this.#device.createBuffer({ label: 'glanz viewer mixed', size: width * height * 16, usage: STORAGE });
    }
    this.#device.queue.writeBuffer(this.#uniforms, 0, new Float32Array([width, height, ...small.size, share, 0, 0, 0]));
    const buffers = [this.#uniforms, film.buffer, small.buffer, this.#mixed];
    const group = this.#device.createBindGroup({ label: 'glanz viewer blend', layout: this.#blend.getBindGroupLayout(0), entries: buffers.map((buffer, binding) => ({ binding, resource: { buffer } })) });
    const pass = encoder.beginComputePass({ label: 'glanz viewer blend' });
    pass.setPipeline(this.#blend);
    pass.setBindGroup(0, group);
    pass.dispatchWorkgroups(Math.ceil(width / 8), Math.ceil(height / 8));
    pass.end();
    return this.#mixed;
  }
}
