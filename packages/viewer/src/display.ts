import { ToneMapPass, type ToneMap, type ToneMapOptions } from '@glanz/tonemap';
import { compose } from '@glanz/wgsl/compose';
import viewerBlend from './blend.wesl';
import { withErrorScopes } from './error-scopes';
import { destroyed, ViewerError } from './errors';

/** An image in a buffer of the GPU: vec4f per pixel. */
export interface GpuImage {
  readonly buffer: GPUBuffer;
  readonly size: readonly [number, number];
}

/** GPUBufferUsage; the names exist as globals in browsers only. */
const [COPY_DST, UNIFORM, STORAGE] = [0x8, 0x40, 0x80];

/** A preview that is kept, and the buffer of the full size in which it is mixed into the image. */
interface Preview extends GpuImage {
  readonly samples: number;
  readonly mixed: GPUBuffer;
}

/** A canvas of one device: draws films through the tone map, mixed with the preview that came before them. */
export class Display {
  readonly #canvas: HTMLCanvasElement;
  readonly #device: GPUDevice;
  readonly #context: GPUCanvasContext;
  readonly #pass: ToneMapPass;
  readonly #blend: GPUComputePipeline;
  readonly #uniforms: GPUBuffer;
  #small: Preview | undefined;
  /** Counts previews: one whose memory came late is not kept. */
  #turn = 0;

  private constructor(
    canvas: HTMLCanvasElement,
    device: GPUDevice,
    context: GPUCanvasContext,
    pass: ToneMapPass,
    blend: GPUComputePipeline,
    uniforms: GPUBuffer,
  ) {
    this.#canvas = canvas;
    this.#device = device;
    this.#context = context;
    this.#pass = pass;
    this.#blend = blend;
    this.#uniforms = uniforms;
  }

  /**
   * Compiles what drawing needs, and gives the canvas to the device. Where it throws, the caller destroys the device.
   *
   * @param requested Whether it is still wanted, once the shaders are there.
   * @throws {ToneMapError} `tonemap/pipeline`; {ViewerError} `viewer/no-canvas`, `viewer/gpu`, `viewer/out-of-memory`;
   * `viewer/destroyed` where it is not wanted any more.
   */
  static async create(
    canvas: HTMLCanvasElement,
    device: GPUDevice,
    view: ToneMapOptions,
    requested: () => boolean,
  ): Promise<Display> {
    const format = navigator.gpu.getPreferredCanvasFormat();
    let uniforms: GPUBuffer;
    const passing = withErrorScopes(device, 'drawing', () => {
      uniforms = device.createBuffer({ label: 'glanz viewer blend', size: 32, usage: UNIFORM | COPY_DST });
      return ToneMapPass.create(device, { format, ...view });
    });
    passing.catch(() => undefined);
    try {
      const [pass, blend] = await Promise.all([passing, compileBlend(device)]);
      if (!requested()) throw destroyed();
      const context = canvas.getContext('webgpu');
      if (!context)
        throw new ViewerError('viewer/no-canvas', 'The canvas has a context of another kind: use a new one.');
      context.configure({ device, format, alphaMode: 'premultiplied' });
      return new Display(canvas, device, context, pass, blend, uniforms!);
    } catch (error) {
      passing.then(
        (pass) => pass.destroy(),
        () => undefined,
      );
      throw error;
    }
  }

  /** Changes exposure and tone map. @throws {ToneMapError} */
  setView(view: ToneMapOptions): Promise<void> {
    return this.#pass.setOptions(view);
  }

  /** The tone map that is set. */
  get toneMap(): ToneMap {
    return this.#pass.settings.toneMap;
  }

  /** Samples of the preview that is kept, infinity of one filtered over time, 0 without one. */
  get kept(): number {
    return this.#small?.samples ?? 0;
  }

  /**
   * Keeps a copy of a preview, to be mixed into the images that follow. Where there is no memory for it, they appear
   * without the transition.
   *
   * @param samples Infinity: it is filtered over time.
   * @param fullSize Of the images that follow.
   */
  async keep({ buffer, size }: GpuImage, samples: number, fullSize: readonly [number, number]): Promise<void> {
    this.forget();
    const turn = this.#turn;
    const bytes = size[0] * size[1] * 16;
    const made: GPUBuffer[] = [];
    const device = this.#device;
    try {
      await withErrorScopes(device, 'the preview', () => {
        const copy = device.createBuffer({ label: 'glanz viewer preview', size: bytes, usage: STORAGE | COPY_DST });
        made.push(
          copy,
          device.createBuffer({ label: 'glanz viewer mixed', size: fullSize[0] * fullSize[1] * 16, usage: STORAGE }),
        );
        const encoder = device.createCommandEncoder({ label: 'glanz viewer keep' });
        encoder.copyBufferToBuffer(buffer, 0, copy, 0, bytes);
        device.queue.submit([encoder.finish()]);
      });
    } catch {
      for (const one of made) one.destroy();
      return;
    }
    const [copy, mixed] = made as [GPUBuffer, GPUBuffer];
    if (turn === this.#turn) this.#small = { buffer: copy, mixed, size, samples };
    else for (const one of made) one.destroy();
  }

  /** Drops what was kept. */
  forget(): void {
    this.#turn++;
    this.#small?.buffer.destroy();
    this.#small?.mixed.destroy();
    this.#small = undefined;
  }

  /**
   * Gives the canvas its size. It is a texture, whose sides are limited; the page stretches it. Another size wipes it.
   *
   * @param size Pixels of the canvas.
   * @returns Those that it has.
   */
  resize(size: readonly [number, number]): [number, number] {
    const scale = Math.min(1, this.#device.limits.maxTextureDimension2D / Math.max(...size));
    const [width, height] = size.map((pixels) => Math.max(1, Math.floor(pixels * scale))) as [number, number];
    if (this.#canvas.width !== width) this.#canvas.width = width;
    if (this.#canvas.height !== height) this.#canvas.height = height;
    return [width, height];
  }

  /**
   * Shows an image.
   *
   * @param canvasSize Pixels of the canvas.
   * @param weight Of the kept preview in it, 0..1.
   */
  draw(film: GpuImage, canvasSize: readonly [number, number], weight: number): void {
    // Only now, since a change of size wipes the canvas.
    const size = this.resize(canvasSize);
    const encoder = this.#device.createCommandEncoder({ label: 'glanz viewer' });
    const source = this.#small && weight > 0 ? this.#mix(encoder, film, this.#small, weight) : film.buffer;
    this.#pass.draw(encoder, source, film.size, this.#context.getCurrentTexture().createView(), size);
    this.#device.queue.submit([encoder.finish()]);
  }

  destroy(): void {
    this.forget();
    this.#pass.destroy();
    this.#uniforms.destroy();
    this.#context.unconfigure();
  }

  #mix(encoder: GPUCommandEncoder, film: GpuImage, small: Preview, weight: number): GPUBuffer {
    const [width, height] = film.size;
    const { mixed } = small;
    if (mixed.size !== width * height * 16) return film.buffer;
    this.#device.queue.writeBuffer(
      this.#uniforms,
      0,
      new Float32Array([width, height, ...small.size, weight, small.samples === Infinity ? 1 : 0, 0, 0]),
    );
    const buffers = [this.#uniforms, film.buffer, small.buffer, mixed];
    const group = this.#device.createBindGroup({
      label: 'glanz viewer blend',
      layout: this.#blend.getBindGroupLayout(0),
      entries: buffers.map((buffer, binding) => ({ binding, resource: { buffer } })),
    });
    const pass = encoder.beginComputePass({ label: 'glanz viewer blend' });
    pass.setPipeline(this.#blend);
    pass.setBindGroup(0, group);
    pass.dispatchWorkgroups(Math.ceil(width / 8), Math.ceil(height / 8));
    pass.end();
    return mixed;
  }
}

async function compileBlend(device: GPUDevice): Promise<GPUComputePipeline> {
  const label = 'glanz viewer blend';
  const module = device.createShaderModule({ label, code: compose([viewerBlend]).code });
  try {
    return await device.createComputePipelineAsync({
      label,
      layout: 'auto',
      compute: { module, entryPoint: 'viewer_blend' },
    });
  } catch (cause) {
    throw new ViewerError('viewer/gpu', `The GPU refused the shader for drawing: ${(cause as Error).message}`, {
      cause,
    });
  }
}
