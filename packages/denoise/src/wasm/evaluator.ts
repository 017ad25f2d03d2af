import { DenoiseError } from '../error';
import type { Network } from '../network';
import { pauses } from '../pace';
import { tileImage, type Tiling } from '../tiles';
import { BLOCK, ROUND, SOURCE_BYTES, TILE_PIXELS, type WasmKernels } from './kernels';
import { packWasm, weightFloats, weightPlaces } from './pack';
import { bytesOf, planWasm, rowBytesOf, type WasmLayer, type WasmPlan, type WasmTensor } from './plan';

const PAGE = 65536;
/** Pages that 32 bits address. */
const MAX_PAGES = 65536;
/** Bytes at the start: rows of the table that `convolve` reads. */
const TABLE_BYTES = 256;

/** What the memory is for. */
export interface EvaluatorSize {
  /** Pixels of whole images. */
  readonly width: number;
  readonly height: number;
  /** Bytes of values between layers at most. Default 1 GiB. */
  readonly maxMemory?: number | undefined;
}

/** A network and how it computes an image: its tiles, and the plan of one. */
interface TiledNetwork {
  readonly network: Network;
  readonly tiling: Tiling;
  readonly plan: WasmPlan;
}

/** @returns The fewest tiles of an image that fit into `memory` bytes, or the bytes that the smallest tile needs. */
function tiled(network: Network, { width, height }: EvaluatorSize, memory: number): TiledNetwork | number {
  let min = Infinity;
  let plan: WasmPlan | undefined;
  const tiling = tileImage(width, height, network.overlap, (w, h) => {
    plan = planWasm(network, w, h);
    const bytes = bytesOf(plan);
    min = Math.min(min, bytes);
    return bytes <= memory;
  });
  return tiling && plan ? { network, tiling, plan } : min;
}

/** The memory for weights and values, or `undefined` where the engine refuses it. */
function tryMemory(bytes: number): WebAssembly.Memory | undefined {
  const pages = Math.ceil(bytes / PAGE);
  if (pages > MAX_PAGES) return undefined;
  try {
    return new WebAssembly.Memory({ initial: pages, maximum: pages });
  } catch {
    return undefined;
  }
}

/** A network in the memory of the kernels. */
export class WasmNetwork {
  readonly tiling: Tiling;
  readonly #plan: WasmPlan;
  readonly #kernels: WasmKernels;
  readonly #words: Int32Array;
  /** All of the memory. */
  readonly floats: Float32Array<ArrayBuffer>;
  /** Addresses: of each layer's weights, of each slot, of rows that are pooled. */
  readonly #weights: readonly number[];
  readonly #slots: readonly number[];
  readonly #pooled: number;

  constructor(
    { tiling, plan }: TiledNetwork,
    kernels: WasmKernels,
    memory: WebAssembly.Memory,
    weights: readonly number[],
    values: number,
  ) {
    this.tiling = tiling;
    this.#plan = plan;
    this.#kernels = kernels;
    this.#words = new Int32Array(memory.buffer);
    this.floats = new Float32Array(memory.buffer);
    this.#weights = weights;
    this.#pooled = values;
    let at = values + plan.poolBytes;
    this.#slots = plan.slots.map((bytes) => (at += bytes) - bytes);
  }

  /** The encoded images, which the caller writes, zeros beside the rows included. */
  get input(): WasmTensor {
    return this.#plan.input;
  }

  /** What the last layer computes, in the first three channels. */
  get output(): WasmTensor {
    return this.#plan.layers.at(-1)!.result;
  }

  /** Address of the first pixel of a row. */
  rowOf(tensor: WasmTensor, row: number): number {
    return this.#slots[tensor.slot]! + row * tensor.rowBytes + 4 * tensor.channels;
  }

  /** Writes zeros beside a row. */
  clearBorders(tensor: WasmTensor, row: number): void {
    const { channels, width } = tensor;
    const at = this.rowOf(tensor, row) / 4;
    this.floats.fill(0, at - channels, at);
    this.floats.fill(0, at + width * channels, at + (width + 1) * channels);
  }

  /** Multiply-adds of a tile. */
  get work(): number {
    return this.#plan.layers.reduce((sum, { direct, up, result }) => {
      const perPixel = (4 * (up?.channels ?? 0) + 9 * direct.channels) * result.channels;
      return sum + perPixel * direct.width * direct.height;
    }, 0);
  }

  /**
   * Computes all layers of a tile in small steps: {@link BLOCK} channels of a row, or of every second pixel of one.
   *
   * @returns Yields the multiply-adds of each step, after it.
   */
  *steps(): Generator<number, void> {
    for (const [i, planned] of this.#plan.layers.entries()) yield* this.#layer(planned, this.#weights[i]!);
  }

  *#layer(planned: WasmLayer, weights: number): Generator<number, void> {
    const { layer, direct, up, result } = planned;
    const { block } = weightPlaces(planned);
    const columns = up ? 2 : 1;
    const tiles = Math.ceil(direct.width / (columns * TILE_PIXELS));
    const pooledRow = rowBytesOf(direct.width, result.channels);
    for (let y = 0; y < direct.height; y++) {
      const row = layer.pool ? this.#pooled + (y & 1) * pooledRow : this.rowOf(result, y);
      for (let parity = 0; parity < columns; parity++) {
        const sources = this.#sources(planned, y, parity);
        const rounds = sources.reduce((sum, source) => sum + source[2], 0);
        for (let first = 0; first < result.channels; first += BLOCK) {
          const blockAt = weights + 4 * (result.channels + (first / BLOCK) * block);
          for (const [s, [address, step, count, weightsAt]] of sources.entries())
            this.#words.set([address, step, count, blockAt + 4 * weightsAt], (s * SOURCE_BYTES) / 4);
          this.#kernels.convolve(
            row + 4 * (parity * result.channels + first),
            4 * columns * result.channels,
            tiles,
            weights + 4 * first,
            0,
            sources.length,
          );
          yield tiles * TILE_PIXELS * rounds * ROUND * BLOCK;
        }
      }
      if (!layer.pool) this.clearBorders(result, y);
      else if (y & 1) {
        const to = this.rowOf(result, y >> 1);
        this.#kernels.pool(to, this.#pooled, this.#pooled + pooledRow, result.width, result.channels / 4);
        this.clearBorders(result, y >> 1);
      }
    }
  }

  /** Rows of the table for `convolve`, with places of weights in a block: what the pixels of a row sum up. */
  #sources(planned: WasmLayer, y: number, parity: number): [number, number, number, number][] {
    const { direct, up } = planned;
    const places = weightPlaces(planned);
    const sources: [number, number, number, number][] = [];
    const pixel = 4 * direct.channels;
    if (up)
      for (let ky = 0; ky < 2; ky++) {
        const row = (y >> 1) + ky - 1 + (y & 1);
        if (row < 0 || row >= up.height) continue;
        const address = this.rowOf(up, row) + 4 * (parity - 1) * up.channels;
        const weights = (2 * (2 * (y & 1) + parity) + ky) * places.upRow;
        sources.push([address, 4 * up.channels, (2 * up.channels) / ROUND, weights]);
      }
    for (let ky = 0; ky < 3; ky++) {
      const row = y + ky - 1;
      if (row < 0 || row >= direct.height) continue;
      const address = this.rowOf(direct, row) + (parity - 1) * pixel;
      const weights = places.direct + ky * places.directRow;
      sources.push([address, (up ? 2 : 1) * pixel, (3 * direct.channels) / ROUND, weights]);
    }
    return sources;
  }
}

/** Networks in one memory: weights of all, and values of one at a time. */
export class Evaluator {
  readonly networks: readonly WasmNetwork[];
  readonly bytes: number;

  private constructor(networks: readonly WasmNetwork[], bytes: number) {
    this.networks = networks;
    this.bytes = bytes;
  }

  /**
   * @returns `undefined` where the engine has no memory for the smallest tile.
   * @throws {DenoiseError} `denoise/memory` where `maxMemory` is less than that needs.
   */
  static async create(
    module: WebAssembly.Module,
    networks: readonly Network[],
    size: EvaluatorSize,
  ): Promise<Evaluator | undefined> {
    const { width, height, maxMemory = 2 ** 30 } = size;
    let allowed = maxMemory;
    for (;;) {
      const parts: TiledNetwork[] = [];
      for (const network of networks) {
        const part = tiled(network, size, allowed);
        if (typeof part !== 'number') parts.push(part);
        else if (allowed < maxMemory) return undefined;
        else
          throw new DenoiseError(
            'denoise/memory',
            `The smallest tile of ${width} × ${height} pixels needs ${part} bytes in WebAssembly, and maxMemory is ${maxMemory}. Allow more, or use a smaller network.`,
          );
      }
      let at = TABLE_BYTES;
      const weights = parts.map(({ plan }) =>
        plan.layers.map((planned) => {
          const from = at;
          at += 4 * weightFloats(planned);
          return from;
        }),
      );
      const values = Math.ceil(at / PAGE) * PAGE;
      const needed = Math.max(...parts.map(({ plan }) => bytesOf(plan)));
      const memory = tryMemory(values + needed + TABLE_BYTES);
      if (!memory) {
        // Less than what was refused, in smaller tiles.
        allowed = 0.75 * needed;
        continue;
      }
      const { exports } = await WebAssembly.instantiate(module, { m: { memory } });
      const pause = pauses();
      for (const [i, { plan }] of parts.entries())
        for (const [k, planned] of plan.layers.entries()) {
          packWasm(planned, new Float32Array(memory.buffer, weights[i]![k], weightFloats(planned)));
          await pause();
        }
      const kernels = exports as unknown as WasmKernels;
      return new Evaluator(
        parts.map((part, i) => new WasmNetwork(part, kernels, memory, weights[i]!, values)),
        memory.buffer.byteLength,
      );
    }
  }
}
