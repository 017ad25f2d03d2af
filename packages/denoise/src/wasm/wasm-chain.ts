import { DenoiseError } from '../error';
import {
  ALIGNMENT,
  COPY_DST,
  COPY_SRC,
  MAP_READ,
  STORAGE,
  UNIFORM,
  bindGroup,
  compileKernel,
  tryBuffers,
  type Kernel,
  type Window,
} from '../gpu';
import type { BoundImages } from '../images';
import { JobCursor } from '../jobs';
import { tileStruct } from '../kernels/layouts';
import { PreludeKernels, type Prelude } from '../prelude-kernels';
import { ENCODE_COST, blockBytes, exposureJobs, tileUniform } from '../prelude-jobs';
import type { DenoiseImages } from '../options';
import { boundChain, type NetworkOf, type Stage } from '../stages';
import type { Tile } from '../tiles';
import decode from './decode.wesl';
import { Evaluator, type EvaluatorSize, type WasmNetwork } from './evaluator';
import { compileWasm } from './kernels';
import { slices } from './slices';

/** Bytes of rows that are copied between the GPU and the module at a time: a few milliseconds of work. */
const CHUNK_BYTES = 1 << 21;

/** Buffers: a tile's uniform and zeros, means of blocks, the scale, rows for the network and out of it; then guides. */
const [TILE, BLOCKS, SCALE, ENCODED, READ, CODES, GUIDES] = [0, 1, 2, 3, 4, 5, 6] as const;
/** Bytes before the zeros. */
const ZEROS = ALIGNMENT;

/** A network and the images that it takes. */
interface Work {
  readonly network: WasmNetwork;
  readonly images: BoundImages;
  readonly prelude: Prelude;
  readonly decode: Kernel;
}

/** Rows of a tile that fit into a chunk, of `quads` vectors of four floats a pixel. */
const rowsPerChunk = ({ tiling }: WasmNetwork, quads: number): number =>
  Math.max(1, Math.floor(CHUNK_BYTES / (16 * quads * tiling.width)));

/** What a run needs to know of the denoiser. */
export interface WasmRun {
  readonly signal: AbortSignal | undefined;
  readonly onProgress: ((done: number) => void) | undefined;
  /** Throws when the denoiser was destroyed. */
  readonly expectAlive: () => void;
  /** Rejects when the device is lost. */
  readonly lost: Promise<never>;
}

/** Makes chains by kernels that are compiled; `undefined` where the engine has no memory for the smallest tile. */
export type StartedWasm = (size: EvaluatorSize) => Promise<WasmChain | undefined>;

/**
 * Compiles what does not depend on the image size.
 *
 * @returns `undefined` where a page's policy forbids WebAssembly, or the browser has no SIMD.
 * @throws {DenoiseError} `denoise/pipeline`.
 */
export async function startWasm(device: GPUDevice, networks: readonly NetworkOf[]): Promise<StartedWasm | undefined> {
  const module = await compileWasm();
  if (!module) return undefined;
  const stages = networks.map(([input, network]) => ({
    input,
    network,
    kernels: new PreludeKernels(device, network, input, 'f32'),
  }));
  await Promise.all(stages.map(({ kernels }) => kernels.prelude()));
  return (size) => WasmChain.create(device, stages, module, size);
}

/** Networks that the CPU evaluates in WebAssembly, for images in GPU buffers, which the GPU encodes and decodes. */
export class WasmChain {
  readonly #device: GPUDevice;
  readonly #stages: readonly Stage[];
  readonly #kernels: readonly (readonly [Prelude, Kernel])[];
  readonly #evaluator: Evaluator;
  readonly #buffers: readonly GPUBuffer[];
  readonly #guides: readonly GPUBuffer[];
  readonly width: number;
  readonly height: number;

  private constructor(
    device: GPUDevice,
    stages: readonly Stage[],
    kernels: readonly (readonly [Prelude, Kernel])[],
    evaluator: Evaluator,
    buffers: readonly GPUBuffer[],
    { width, height }: EvaluatorSize,
  ) {
    this.#device = device;
    this.#stages = stages;
    this.#kernels = kernels;
    this.#evaluator = evaluator;
    this.#buffers = buffers;
    this.#guides = buffers.slice(GUIDES);
    this.width = width;
    this.height = height;
  }

  /**
   * @returns `undefined` where the engine has no memory for the smallest tile.
   * @throws {DenoiseError} `denoise/memory`, `denoise/pipeline`.
   */
  static async create(
    device: GPUDevice,
    stages: readonly Stage[],
    module: WebAssembly.Module,
    size: EvaluatorSize,
  ): Promise<WasmChain | undefined> {
    const { width, height } = size;
    const networks = stages.map(({ network }) => network);
    const bindings = { 3: 'read', 5: 'write', 6: 'uniform', 7: 'read', 8: 'read' } as const;
    const [evaluator, kernels] = await Promise.all([
      Evaluator.create(module, networks, size),
      Promise.all(
        stages.map(({ kernels: own }) =>
          Promise.all([own.prelude(), compileKernel(device, 'denoise decode', decode, own.flags, bindings)]),
        ),
      ),
    ]);
    if (!evaluator) return undefined;
    const chunk = Math.max(
      ...evaluator.networks.map((network) => {
        const quads = network.input.channels / 4;
        return 16 * quads * network.tiling.width * rowsPerChunk(network, quads);
      }),
    );
    const buffers = await tryBuffers(device, [
      { label: 'denoise tile', size: 2 * ALIGNMENT, usage: UNIFORM | COPY_DST },
      { label: 'denoise blocks', size: blockBytes(width, height), usage: STORAGE },
      { label: 'denoise scale', size: 16, usage: STORAGE | COPY_DST },
      { label: 'denoise encoded', size: chunk, usage: STORAGE | COPY_SRC },
      { label: 'denoise read', size: chunk, usage: MAP_READ | COPY_DST },
      { label: 'denoise codes', size: Math.max(chunk, CHUNK_BYTES), usage: STORAGE | COPY_DST },
      ...stages.slice(1).map((_, i) => ({ label: `denoise guide ${i}`, size: width * height * 12, usage: STORAGE })),
    ]);
    if (!buffers)
      throw new DenoiseError(
        'denoise/memory',
        `The GPU has no memory for what surrounds a network of ${width} × ${height} pixels: denoise a smaller image.`,
      );
    return new WasmChain(device, stages, kernels, evaluator, buffers, size);
  }

  /** Bytes on the GPU and in the module's memory. */
  get bytes(): number {
    return this.#buffers.reduce((sum, { size }) => sum + size, this.#evaluator.bytes);
  }

  /** Tiles that the image is cut into; with several networks, the most. */
  get tiles(): number {
    return Math.max(...this.#evaluator.networks.map(({ tiling }) => tiling.tiles.length));
  }

  /**
   * Denoises these images.
   *
   * @returns Submissions to the GPU.
   * @throws {DenoiseError} `denoise/size`, `denoise/input`, `denoise/limit`, `denoise/option`, `denoise/device`,
   * `denoise/destroyed`; the signal's reason where it aborts.
   */
  async run(images: DenoiseImages, run: WasmRun): Promise<number> {
    const bound = boundChain(this.#device, this.#stages, this.#guides, images);
    const { networks } = this.#evaluator;
    const encoding = ({ tiling }: WasmNetwork) => tiling.width * tiling.height * ENCODE_COST;
    const total = networks.reduce((sum, one) => sum + (one.work + encoding(one)) * one.tiling.tiles.length, 0);
    let spent = 0;
    let submissions = 0;
    let loss: { readonly cause: unknown } | undefined;
    run.lost.catch((cause: unknown) => (loss = { cause }));
    const check = () => {
      run.signal?.throwIfAborted();
      run.expectAlive();
      if (loss) throw loss.cause;
    };
    const report = () => {
      check();
      run.onProgress?.(Math.min(1, spent / total));
      // The caller may have ended it just now.
      check();
    };
    const pause = slices(report);
    for (const [i, network] of networks.entries()) {
      const [prelude, decoder] = this.#kernels[i]!;
      const work = { network, images: bound[i]!, prelude, decode: decoder };
      submissions += this.#expose(work);
      for (const tile of network.tiling.tiles) {
        await this.#encode(work, tile, run, (part) => {
          submissions++;
          spent += part * encoding(network);
          report();
        });
        for (const done of network.steps()) {
          spent += done;
          const due = pause();
          if (due) await due;
        }
        submissions += await this.#decode(work, tile, pause);
      }
    }
    await Promise.race([this.#device.queue.onSubmittedWorkDone(), run.lost]);
    spent = total;
    report();
    return submissions;
  }

  #window(index: number, offset = 0, size = this.#buffers[index]!.size - offset): Window {
    return { buffer: this.#buffers[index]!, offset, size };
  }

  /** Writes the uniform of `rows` rows of a tile from row `from` on. */
  #place({ images, network }: Work, tile: Tile, from: number, rows: number): Window {
    const quads = network.input.channels / 4;
    const part = { ...tile, y: tile.y + from };
    this.#device.queue.writeBuffer(
      this.#buffers[TILE]!,
      0,
      tileUniform(images, part, [network.tiling.width, rows], quads),
    );
    return this.#window(TILE, 0, tileStruct.size);
  }

  #submit(record: (pass: GPUComputePassEncoder) => void, after?: (encoder: GPUCommandEncoder) => void): void {
    const encoder = this.#device.createCommandEncoder({ label: 'denoise' });
    const pass = encoder.beginComputePass({ label: 'denoise' });
    record(pass);
    pass.end();
    after?.(encoder);
    this.#device.queue.submit([encoder.finish()]);
  }

  /**
   * Finds the scale of an image, or writes the one that is given.
   *
   * @returns Submissions to the GPU.
   */
  #expose(work: Work): number {
    const { images, prelude, network } = work;
    if (images.scale !== undefined) {
      this.#device.queue.writeBuffer(this.#buffers[SCALE]!, 0, Float32Array.of(images.scale));
      return 0;
    }
    const tile = this.#place(work, network.tiling.tiles[0]!, 0, 1);
    const windows = { blocks: this.#window(BLOCKS), tile, scale: this.#window(SCALE) };
    const cursor = new JobCursor(exposureJobs(this.#device, prelude, images, windows));
    this.#submit((pass) => cursor.encode(pass, Infinity));
    return 1;
  }

  /** Encodes a tile on the GPU and copies it into the module's memory, rows by rows. */
  async #encode(work: Work, tile: Tile, { expectAlive, lost }: WasmRun, onRows: (part: number) => void): Promise<void> {
    const { images, network, prelude } = work;
    const { input, tiling } = network;
    const { encode } = prelude;
    const quads = input.channels / 4;
    const step = rowsPerChunk(network, quads);
    const staging = this.#buffers[READ]!;
    for (let from = 0; from < tiling.height; from += step) {
      const rows = Math.min(step, tiling.height - from);
      const bytes = 16 * quads * tiling.width * rows;
      const zeros = this.#window(TILE, ZEROS, 16);
      const group = bindGroup(this.#device, encode, {
        0: zeros,
        1: zeros,
        ...(images.albedo ? { 3: images.albedo.window } : {}),
        ...(images.normal ? { 4: images.normal.window } : {}),
        5: this.#window(ENCODED),
        6: this.#place(work, tile, from, rows),
        7: images.main.window,
        8: this.#window(SCALE),
      });
      this.#submit(
        (pass) => {
          pass.setPipeline(encode.pipeline);
          pass.setBindGroup(0, group, [0, 0]);
          pass.dispatchWorkgroups(Math.ceil(tiling.width / 64), rows);
        },
        (encoder) => encoder.copyBufferToBuffer(this.#buffers[ENCODED]!, 0, staging, 0, bytes),
      );
      const mapped = staging.mapAsync(MAP_READ, 0, bytes);
      // A lost device, or a denoiser that is destroyed, ends the mapping with an error that says less.
      await Promise.race([mapped, lost]).catch(async (cause: unknown) => {
        expectAlive();
        await Promise.race([lost, new Promise((resolve) => setTimeout(resolve, 100))]);
        expectAlive();
        throw new DenoiseError('denoise/device', `The GPU's results cannot be read: ${String(cause)}.`, { cause });
      });
      // It may have been destroyed since the mapping was there.
      expectAlive();
      this.#interleave(network, new Float32Array(staging.getMappedRange(0, bytes)), from, rows);
      staging.unmap();
      onRows(rows / tiling.height);
    }
  }

  /** Copies rows that the GPU has encoded, `[row][channels / 4][column]` of four floats. */
  #interleave(network: WasmNetwork, encoded: Float32Array, first: number, rows: number): void {
    const { floats, input } = network;
    const { channels, width } = input;
    for (let row = 0, i = 0; row < rows; row++) {
      const to = network.rowOf(input, first + row) / 4;
      for (let quad = 0; quad < channels; quad += 4)
        for (let x = 0, at = to + quad; x < width; x++, at += channels, i += 4) {
          floats[at] = encoded[i]!;
          floats[at + 1] = encoded[i + 1]!;
          floats[at + 2] = encoded[i + 2]!;
          floats[at + 3] = encoded[i + 3]!;
        }
      network.clearBorders(input, first + row);
    }
  }

  /** Copies what counts of a tile's result to the GPU, which decodes it. */
  async #decode(work: Work, tile: Tile, pause: () => Promise<void> | undefined): Promise<number> {
    const { images, network, decode: kernel } = work;
    const { output, floats, tiling } = network;
    const { width } = tiling;
    const step = rowsPerChunk(network, 1);
    const end = tile.innerY[1] - tile.y;
    let submissions = 0;
    for (let from = tile.innerY[0] - tile.y; from < end; from += step) {
      const rows = Math.min(step, end - from);
      const codes = new Float32Array(4 * width * rows);
      for (let row = 0, i = 0; row < rows; row++) {
        let at = network.rowOf(output, from + row) / 4;
        for (let x = 0; x < width; x++, at += output.channels, i += 4) {
          codes[i] = floats[at]!;
          codes[i + 1] = floats[at + 1]!;
          codes[i + 2] = floats[at + 2]!;
        }
      }
      this.#device.queue.writeBuffer(this.#buffers[CODES]!, 0, codes);
      const group = bindGroup(this.#device, kernel, {
        3: this.#window(CODES),
        5: images.output.window,
        6: this.#place(work, tile, from, rows),
        7: images.main.window,
        8: this.#window(SCALE),
      });
      this.#submit((pass) => {
        pass.setPipeline(kernel.pipeline);
        pass.setBindGroup(0, group);
        pass.dispatchWorkgroups(Math.ceil(width / 64), rows);
      });
      submissions++;
      const due = pause();
      if (due) await due;
    }
    return submissions;
  }

  /** Frees the buffers. The module's memory is collected with this object. */
  destroy(): void {
    for (const buffer of this.#buffers) buffer.destroy();
  }
}
