import { compose } from '@glanz/wgsl/compose';
import { wgslModule } from '@glanz/wgsl/module';
import { ToneMapError, type ToneMap } from './names';
import { toneMapOperator } from './operators';
import pass from './pass.wesl';
import { checkToneMapOptions, type ToneMapOptions } from './tone-map';

/** Options for {@link ToneMapPass.create}. */
export interface ToneMapPassOptions extends ToneMapOptions {
  /** Format of the target. Formats ending in `-srgb` get linear values, since the hardware encodes them. */
  readonly format: GPUTextureFormat;
  /**
   * `premultiplied` (default): coverage is written to alpha and RGB is multiplied by it after the encoding, as a
   * canvas of `alphaMode: 'premultiplied'` expects it. `opaque`: alpha is ignored and written as 1.
   */
  readonly alpha?: 'premultiplied' | 'opaque';
  /** How a source of another size than the target is read. Default `bilinear`; equal sizes are always copied 1:1. */
  readonly filter?: 'nearest' | 'bilinear';
}

/** Options that can change between two draws. */
export type ToneMapPassSettings = Partial<Pick<ToneMapPassOptions, 'exposure' | 'toneMap' | 'alpha' | 'filter'>>;

/** The pass with one of the operators. */
const passModule = (toneMap: ToneMap) =>
  wgslModule(
    `tonemap/pass-${toneMap}`,
    `fn tonemap_operator(linear:vec3f)->vec3f{return tonemap_${toneMap}(linear);}`,
    [toneMapOperator(toneMap).wgsl, pass],
  );

/**
 * Draws a linear RGBA image from a storage buffer into a texture through a view transform: one fullscreen
 * triangle. The pipeline of a tone map is made on first use, without stalling.
 *
 * @example
 * const pass = await ToneMapPass.create(device, { format: navigator.gpu.getPreferredCanvasFormat(), toneMap: 'agx' });
 * const encoder = device.createCommandEncoder();
 * pass.draw(encoder, tracer.beautyBuffer, [width, height], context.getCurrentTexture().createView());
 * device.queue.submit([encoder.finish()]);
 */
export class ToneMapPass {
  readonly #device: GPUDevice;
  readonly #format: GPUTextureFormat;
  readonly #uniforms: GPUBuffer;
  readonly #pipelines = new Map<ToneMap, Promise<GPURenderPipeline>>();
  #settings: Required<ToneMapPassSettings>;
  /** The tone map of the pipeline in use. */
  #drawn: ToneMap;
  #destroyed = false;
  #pipeline: GPURenderPipeline | undefined;
  #bound:
    | { readonly source: GPUBuffer; readonly pipeline: GPURenderPipeline; readonly group: GPUBindGroup }
    | undefined;

  private constructor(device: GPUDevice, options: ToneMapPassOptions) {
    this.#device = device;
    this.#format = options.format;
    this.#settings = {
      exposure: options.exposure ?? 0,
      toneMap: options.toneMap ?? 'neutral',
      alpha: options.alpha ?? 'premultiplied',
      filter: options.filter ?? 'bilinear',
    };
    this.#drawn = this.#settings.toneMap;
    this.#uniforms = device.createBuffer({ label: 'tonemap', size: 32, usage: UNIFORM_COPY_DST });
  }

  /**
   * Makes the pass and the pipeline of its first tone map.
   *
   * @throws {ToneMapError} `tonemap/unknown` for an unknown tone map, `tonemap/exposure`, `tonemap/pipeline` where the
   * GPU's driver does not compile the shader.
   */
  static async create(device: GPUDevice, options: ToneMapPassOptions): Promise<ToneMapPass> {
    checkToneMapOptions(options);
    const pass = new ToneMapPass(device, options);
    try {
      pass.#pipeline = await pass.#pipelineOf(pass.#settings.toneMap);
    } catch (error) {
      pass.destroy();
      throw error;
    }
    return pass;
  }

  /** The settings of the next draw. */
  get settings(): Readonly<Required<ToneMapPassSettings>> {
    return this.#settings;
  }

  /**
   * Changes exposure (EV), tone map, alpha or filter. All but a tone map that has not been used before take effect at
   * once; until that is compiled, draws use the previous curve; the promise resolves when the new one is in use.
   *
   * @throws {ToneMapError} `tonemap/unknown` for an unknown tone map, `tonemap/exposure`: the settings are then
   * unchanged. `tonemap/pipeline` where the GPU's driver does not compile the shader: the tone map stays the previous
   * one.
   */
  async setOptions(settings: ToneMapPassSettings): Promise<void> {
    checkToneMapOptions(settings);
    this.#settings = { ...this.#settings, ...settings };
    const { toneMap } = this.#settings;
    try {
      const pipeline = await this.#pipelineOf(toneMap);
      // A later call may have requested another tone map meanwhile: the last one wins.
      if (this.#destroyed || this.#settings.toneMap !== toneMap) return;
      this.#pipeline = pipeline;
      this.#drawn = toneMap;
    } catch (error) {
      if (this.#settings.toneMap === toneMap) this.#settings = { ...this.#settings, toneMap: this.#drawn };
      throw error;
    }
  }

  /**
   * Records a draw of the image over the whole target. Encode one draw of a pass per submission: its uniforms
   * are written on the queue, ahead of the encoder.
   *
   * @param source vec4f per pixel: linear RGBA multiplied by alpha, row-major, top row first; usage `STORAGE`.
   * @param size Width and height of the source, pixels.
   * @param targetSize Width and height of the target, pixels; default: those of the source.
   * @throws {ToneMapError} `tonemap/size` for an empty size or a buffer too small, `tonemap/destroyed` after
   * {@link destroy}.
   */
  draw(
    encoder: GPUCommandEncoder,
    source: GPUBuffer,
    size: readonly [number, number],
    target: GPUTextureView,
    targetSize: readonly [number, number] = size,
  ): void {
    const pipeline = this.#pipeline;
    if (!pipeline) throw new ToneMapError('tonemap/destroyed', 'This ToneMapPass was destroyed: create another one.');
    const [width, height] = size;
    if (!(width >= 1 && height >= 1 && targetSize[0] >= 1 && targetSize[1] >= 1) || source.size < width * height * 16) {
      throw new ToneMapError(
        'tonemap/size',
        `Cannot draw ${width}×${height} pixels of 16 bytes from ${source.size} bytes to ${targetSize[0]}×${targetSize[1]} pixels.`,
      );
    }
    const { exposure, alpha, filter } = this.#settings;
    const sameSize = width === targetSize[0] && height === targetSize[1];
    const values = [
      width,
      height,
      targetSize[0],
      targetSize[1],
      2 ** exposure,
      alpha === 'opaque' ? 1 : 0,
      filter === 'bilinear' && !sameSize ? 1 : 0,
      0,
    ];
    this.#device.queue.writeBuffer(this.#uniforms, 0, new Float32Array(values));
    if (this.#bound?.source !== source || this.#bound.pipeline !== pipeline) {
      const entries = [this.#uniforms, source].map((buffer, binding) => ({ binding, resource: { buffer } }));
      this.#bound = {
        source,
        pipeline,
        group: this.#device.createBindGroup({ label: 'tonemap', layout: pipeline.getBindGroupLayout(0), entries }),
      };
    }
    const pass = encoder.beginRenderPass({
      label: 'tonemap',
      colorAttachments: [{ view: target, loadOp: 'clear', storeOp: 'store', clearValue: [0, 0, 0, 0] }],
    });
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, this.#bound.group);
    pass.draw(3);
    pass.end();
  }

  /** Frees the pass's buffer. May be called any number of times. */
  destroy(): void {
    this.#destroyed = true;
    this.#pipeline = this.#bound = undefined;
    this.#pipelines.clear();
    this.#uniforms.destroy();
  }

  #pipelineOf(toneMap: ToneMap): Promise<GPURenderPipeline> {
    const known = this.#pipelines.get(toneMap);
    if (known) return known;
    const made = this.#createPipeline(toneMap);
    this.#pipelines.set(toneMap, made);
    // Do not cache a failure: the next call tries again.
    made.catch(() => this.#pipelines.delete(toneMap));
    return made;
  }

  async #createPipeline(toneMap: ToneMap): Promise<GPURenderPipeline> {
    const label = `tonemap ${toneMap}`;
    const { code } = compose([passModule(toneMap)], { flags: { TONEMAP_ENCODE: !this.#format.endsWith('-srgb') } });
    const module = this.#device.createShaderModule({ label, code });
    try {
      return await this.#device.createRenderPipelineAsync({
        label,
        layout: 'auto',
        vertex: { module },
        fragment: { module, targets: [{ format: this.#format }] },
      });
    } catch (cause) {
      throw new ToneMapError(
        'tonemap/pipeline',
        `The GPU's driver did not compile the tone map "${toneMap}": ${(cause as Error).message}. Use another tone map, or update the driver.`,
        { cause },
      );
    }
  }
}

// GPUBufferUsage.UNIFORM | COPY_DST; the constants exist as globals in browsers only.
const UNIFORM_COPY_DST = 0x40 | 0x8;
