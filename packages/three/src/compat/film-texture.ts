import { compose } from '@glanz/wgsl/compose';
import { ClampToEdgeWrapping, DataTexture, HalfFloatType, LinearFilter, LinearSRGBColorSpace, RGBAFormat } from 'three';
import { ThreeError } from '../error';
import filmTexels from './film_texels.wesl';

/** GPUBufferUsage and GPUMapMode; the names exist as globals in browsers only. */
const [MAP_READ, COPY_SRC, COPY_DST, UNIFORM, STORAGE] = [0x1, 0x4, 0x8, 0x40, 0x80];
const READ = 1;

/** A film as a texture of three: linear RGBA halves, bottom row first, colour not multiplied by alpha. */
export function createFilmTexture(): DataTexture {
  const texture = new DataTexture(new Uint16Array(4), 1, 1, RGBAFormat, HalfFloatType);
  texture.name = 'glanz film';
  texture.colorSpace = LinearSRGBColorSpace;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
  return texture;
}

/** Puts texels into a texture of three, which may have had another size. */
export function writeFilmTexture(texture: DataTexture, texels: Uint16Array, width: number, height: number): void {
  const { image } = texture;
  // Textures of three's renderers keep the size that they were made with.
  if (image.width !== width || image.height !== height) texture.dispose();
  Object.assign(image, { data: texels, width, height });
  texture.needsUpdate = true;
}

/** Reads films back from one device, as texels for {@link writeFilmTexture}. */
export class FilmReader {
  readonly #device: GPUDevice;
  #pipeline: Promise<GPUComputePipeline> | undefined;
  #size: readonly [number, number] = [0, 0];
  #buffers: { readonly size: GPUBuffer; readonly texels: GPUBuffer; readonly staging: GPUBuffer } | undefined;

  constructor(device: GPUDevice) {
    this.#device = device;
  }

  /**
   * Reads a film; one call at a time.
   *
   * @param film vec4f per pixel, linear, multiplied by alpha, top row first.
   * @throws {ThreeError} `three/gpu`
   */
  async read(film: () => { readonly buffer: GPUBuffer; readonly width: number; readonly height: number }): Promise<{
    readonly texels: Uint16Array;
    readonly width: number;
    readonly height: number;
  }> {
    try {
      const pipeline = await (this.#pipeline ??= this.#compile());
      // As it is once the pipeline is there.
      const { buffer, width, height } = film();
      const staging = this.#encode(pipeline, buffer, width, height);
      await staging.mapAsync(READ);
      const texels = new Uint16Array(staging.getMappedRange(0, 8 * width * height).slice(0));
      staging.unmap();
      return { texels, width, height };
    } catch (cause) {
      if (cause instanceof ThreeError) throw cause;
      throw new ThreeError('three/gpu', `The film could not be read from the GPU: ${(cause as Error).message}`, {
        cause,
      });
    }
  }

  destroy(): void {
    for (const buffer of Object.values(this.#buffers ?? {})) buffer.destroy();
    this.#buffers = undefined;
    this.#size = [0, 0];
  }

  #compile(): Promise<GPUComputePipeline> {
    const label = 'glanz three film';
    return this.#device.createComputePipelineAsync({
      label,
      layout: 'auto',
      compute: {
        module: this.#device.createShaderModule({ label, code: compose([filmTexels]).code }),
        entryPoint: 'three_film_texels',
      },
    });
  }

  #encode(pipeline: GPUComputePipeline, film: GPUBuffer, width: number, height: number): GPUBuffer {
    const device = this.#device;
    const bytes = 8 * width * height;
    if (!this.#buffers || this.#size[0] !== width || this.#size[1] !== height) {
      this.destroy();
      const make = (label: string, size: number, usage: number) =>
        device.createBuffer({ label: `glanz three ${label}`, size, usage });
      this.#buffers = {
        size: make('size', 16, UNIFORM | COPY_DST),
        texels: make('texels', bytes, STORAGE | COPY_SRC),
        staging: make('staging', bytes, MAP_READ | COPY_DST),
      };
      this.#size = [width, height];
      device.queue.writeBuffer(this.#buffers.size, 0, Uint32Array.of(width, height, 0, 0));
    }
    const { size, texels, staging } = this.#buffers;
    const encoder = device.createCommandEncoder({ label: 'glanz three film' });
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(
      0,
      device.createBindGroup({
        layout: pipeline.getBindGroupLayout(0),
        entries: [size, film, texels].map((buffer, binding) => ({ binding, resource: { buffer } })),
      }),
    );
    pass.dispatchWorkgroups(Math.ceil(width / 8), Math.ceil(height / 8));
    pass.end();
    encoder.copyBufferToBuffer(texels, 0, staging, 0, bytes);
    device.queue.submit([encoder.finish()]);
    return staging;
  }
}
