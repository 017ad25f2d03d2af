import { ALIGNMENT, COPY_DST, STORAGE, UNIFORM, bindGroup, type Kernel, type Window } from './gpu';
import type { BoundImages } from './images';
import type { Job } from './jobs';
import { tileStruct } from './kernels/layouts';
import type { TiledPlan } from './memory';
import type { NetworkKernels } from './network-kernels';
import { pauses } from './pace';
import { ENCODE_ROWS, type Plan, type TensorWindow } from './plan';
import { ENCODE_COST, blockBytes, exposureJobs, tileUniform } from './prelude-jobs';
import type { Prelude } from './prelude-kernels';
import { readyLayer, type ReadyLayer } from './ready-layer';
import type { Tiling } from './tiles';

/** Values as uniforms of 256 bytes each, for dynamic offsets. */
function rowNumbers(count: number): ArrayBuffer {
  const data = new Uint32Array((count * ALIGNMENT) / 4);
  for (let i = 0; i < count; i++) data[(i * ALIGNMENT) / 4] = i;
  return data.buffer;
}

/** A network, ready for images of a size. Values between layers are in buffers that others may use at other times. */
export class Prepared {
  readonly #device: GPUDevice;
  readonly #prelude: Prelude;
  readonly #buffers: readonly GPUBuffer[];
  readonly #own: GPUBuffer[] = [];
  readonly #rows: GPUBuffer;
  readonly #tiles: GPUBuffer;
  readonly #encodeBases: GPUBuffer;
  readonly #blocks: GPUBuffer;
  readonly #scale: GPUBuffer;
  readonly #layers: ReadyLayer[] = [];
  readonly plan: Plan;
  readonly tiling: Tiling;

  private constructor(
    device: GPUDevice,
    prelude: Prelude,
    size: { readonly width: number; readonly height: number },
    { plan, tiling }: TiledPlan,
    buffers: readonly GPUBuffer[],
  ) {
    this.#device = device;
    this.#prelude = prelude;
    this.plan = plan;
    this.tiling = tiling;
    this.#buffers = buffers;
    const rows = Math.max(...plan.layers.map(({ workgroups }) => workgroups[1]), Math.ceil(plan.height / ENCODE_ROWS));
    const own = (label: string, bytes: number, usage: number) => {
      const buffer = device.createBuffer({ label, size: bytes, usage });
      this.#own.push(buffer);
      return buffer;
    };
    this.#rows = own('denoise rows', rows * ALIGNMENT, UNIFORM | COPY_DST);
    device.queue.writeBuffer(this.#rows, 0, rowNumbers(rows));
    this.#tiles = own('denoise tiles', tiling.tiles.length * ALIGNMENT, UNIFORM | COPY_DST);
    this.#encodeBases = own('denoise encode', plan.encode.length * ALIGNMENT, UNIFORM | COPY_DST);
    for (const [i, { result }] of plan.encode.entries())
      device.queue.writeBuffer(this.#encodeBases, i * ALIGNMENT, Uint32Array.of(result.base, 0, 0, 0));
    this.#blocks = own('denoise blocks', blockBytes(size.width, size.height), STORAGE);
    this.#scale = own('denoise scale', 16, STORAGE | COPY_DST);
  }

  /** @throws {DenoiseError} `denoise/pipeline`. */
  static async create(
    device: GPUDevice,
    kernels: NetworkKernels,
    size: { readonly width: number; readonly height: number },
    tiled: TiledPlan,
    buffers: readonly GPUBuffer[],
  ): Promise<Prepared> {
    const prepared = new Prepared(device, await kernels.prelude(), size, tiled, buffers);
    try {
      const pause = pauses();
      const compiled: Promise<Kernel>[] = [];
      for (const layer of tiled.plan.layers) {
        compiled.push(kernels.convolution(layer));
        await pause();
      }
      await Promise.all(compiled);
      for (const layer of tiled.plan.layers) {
        const kernel = await kernels.convolution(layer);
        prepared.#layers.push(readyLayer(device, kernels, kernel, layer, buffers, prepared.#rows, prepared.#own));
        await pause();
      }
    } catch (error) {
      prepared.destroy();
      throw error;
    }
    return prepared;
  }

  #window({ slot, offset, size }: TensorWindow): Window {
    return { buffer: this.#buffers[slot]!, offset, size };
  }

  /** Bytes on the GPU, without the values between layers. */
  get bytes(): number {
    return this.#own.reduce((sum, { size }) => sum + size, 0);
  }

  /** Writes what of the uniforms depends on the images. */
  #write(images: BoundImages): void {
    const data = new Uint8Array(this.tiling.tiles.length * ALIGNMENT);
    for (const [i, tile] of this.tiling.tiles.entries()) {
      const bytes = tileUniform(images, tile, [this.plan.width, this.plan.height], this.plan.input.quads);
      data.set(new Uint8Array(bytes), i * ALIGNMENT);
    }
    this.#device.queue.writeBuffer(this.#tiles, 0, data);
    if (images.scale !== undefined) this.#device.queue.writeBuffer(this.#scale, 0, Float32Array.of(images.scale));
  }

  /** The dispatches that denoise these images. Writes uniforms: one image at a time. */
  jobs(images: BoundImages): Job[] {
    const { encode } = this.#prelude;
    this.#write(images);
    const device = this.#device;
    const tile = { buffer: this.#tiles, offset: 0, size: tileStruct.size };
    const scaleBuffer = { buffer: this.#scale, offset: 0, size: 16 };
    const blocks = { buffer: this.#blocks, offset: 0, size: this.#blocks.size };
    const jobs = exposureJobs(device, this.#prelude, images, { blocks, tile, scale: scaleBuffer });
    const shared = { 6: tile, 7: images.main.window, 8: scaleBuffer };
    const encodings = this.plan.encode.map(({ fromRow, toRow, result }, i) => ({
      fromRow,
      toRow,
      group: bindGroup(device, encode, {
        ...shared,
        0: { buffer: this.#encodeBases, offset: i * ALIGNMENT, size: 16 },
        1: { buffer: this.#rows, offset: 0, size: 16 },
        ...(images.albedo ? { 3: images.albedo.window } : {}),
        ...(images.normal ? { 4: images.normal.window } : {}),
        5: this.#window(result),
      }),
    }));
    for (const i of this.tiling.tiles.keys()) {
      for (const encoding of encodings)
        jobs.push({
          ...encoding,
          name: 'encode',
          pipeline: encode.pipeline,
          x: Math.ceil(this.plan.width / 64),
          yOfRow: ENCODE_ROWS,
          z: 1,
          costOfRow: this.plan.width * ENCODE_ROWS * ENCODE_COST,
          offsets: (row) => [row * ALIGNMENT, i * ALIGNMENT],
        });
      for (const { plan, kernel, strips } of this.#layers)
        for (const { strip, resources, group } of strips)
          jobs.push({
            name: plan.layer.name,
            pipeline: kernel.pipeline,
            group: group ?? bindGroup(device, kernel, { ...resources, ...shared, 5: images.output.window }),
            x: plan.workgroups[0],
            yOfRow: 1,
            z: plan.workgroups[2],
            fromRow: strip.fromRow,
            toRow: strip.toRow,
            costOfRow: plan.costOfRow,
            offsets: (row) => (group ? [row * ALIGNMENT] : [row * ALIGNMENT, i * ALIGNMENT]),
          });
    }
    return jobs;
  }

  destroy(): void {
    for (const buffer of this.#own) buffer.destroy();
  }
}
