import { ALIGNMENT } from './gpu';
import { hasMatrices, stagedUpChannels, tileHeight, tileOutputs, tileWidth, type KernelShape } from './kernels/shapes';
import { INPUT, type Layer, type Network } from './network';
import { quadsOf } from './pack-weights';

/** Values of all channels of a layer, or the encoded images (`INPUT`), in a buffer that tensors share over time. */
export interface TensorPlan {
  readonly quads: number;
  readonly width: number;
  readonly height: number;
  /** Bytes of four channels of a pixel. */
  readonly texelBytes: number;
  /** Index of its buffer. */
  readonly slot: number;
}

/** Part of a tensor's buffer: bytes, and how many texels lie before it. */
export interface TensorWindow {
  readonly slot: number;
  readonly offset: number;
  readonly size: number;
  readonly base: number;
}

/** Rows of workgroups whose sources and results fit into bindings. */
export interface Strip {
  readonly fromRow: number;
  readonly toRow: number;
  readonly direct: TensorWindow;
  readonly up: TensorWindow | undefined;
  /** `undefined` for the last layer, which writes to the caller's image. */
  readonly result: TensorWindow | undefined;
}

/** How a layer is computed. */
export interface LayerPlan {
  readonly layer: Layer;
  readonly shape: KernelShape;
  /** Pixels of the layer, before pooling. */
  readonly width: number;
  readonly height: number;
  readonly direct: TensorPlan;
  readonly up: TensorPlan | undefined;
  readonly result: TensorPlan | undefined;
  /** Workgroups along x, along y, and over output channels. */
  readonly workgroups: readonly [x: number, y: number, z: number];
  readonly strips: readonly Strip[];
  /** Multiply-adds of a row of workgroups. */
  readonly costOfRow: number;
}

/** How an image, or a tile of it, is computed. */
export interface Plan {
  readonly width: number;
  readonly height: number;
  /** Bytes of each buffer. */
  readonly slots: readonly number[];
  readonly input: TensorPlan;
  /** Strips of the encoding, in rows of {@link ENCODE_ROWS} pixels; only `result` counts. */
  readonly encode: readonly { readonly fromRow: number; readonly toRow: number; readonly result: TensorWindow }[];
  readonly layers: readonly LayerPlan[];
}

/** Pixels along y that one row of the encoding covers. */
export const ENCODE_ROWS = 16;

/** What a plan depends on beside the network and the size. */
export interface PlanOptions {
  readonly texelBytes: number;
  /** Bytes that a binding may have. */
  readonly maxBinding: number;
  readonly shapeOf: (layer: Layer, width: number, height: number) => KernelShape;
}

/** Gives tensors buffers; a buffer is free again when the last layer that reads its tensor is done. */
export class Slots {
  readonly bytes: number[] = [];
  readonly #free = new Set<number>();

  take(size: number): number {
    const free = [...this.#free];
    // The smallest that is large enough, else the largest, which grows.
    const enough = free.filter((slot) => this.bytes[slot]! >= size).sort((a, b) => this.bytes[a]! - this.bytes[b]!);
    const slot = enough[0] ?? free.sort((a, b) => this.bytes[b]! - this.bytes[a]!)[0] ?? this.bytes.length;
    this.bytes[slot] = Math.max(this.bytes[slot] ?? 0, size);
    this.#free.delete(slot);
    return slot;
  }

  release(slot: number): void {
    this.#free.add(slot);
  }
}

/** The bytes of rows `[from, to)` of a tensor, as a binding. */
function windowOf(tensor: TensorPlan, from: number, to: number): TensorWindow {
  const rowBytes = tensor.quads * tensor.width * tensor.texelBytes;
  const offset = Math.floor((Math.max(0, from) * rowBytes) / ALIGNMENT) * ALIGNMENT;
  const size = Math.min(tensor.height, to) * rowBytes - offset;
  return { slot: tensor.slot, offset, size, base: offset / tensor.texelBytes };
}

/** Cuts `[0, rows)` into the fewest pieces that `fits` accepts; `undefined` where a single row does not fit. */
function cutRows<T>(rows: number, make: (from: number, to: number) => T | undefined): T[] | undefined {
  const pieces: T[] = [];
  for (let from = 0; from < rows;) {
    let low = from;
    let high = rows;
    let piece = make(from, high);
    if (piece === undefined) {
      // The largest end that fits, by bisection.
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        const tried = make(from, middle);
        if (tried === undefined) high = middle;
        else [low, piece] = [middle, tried];
      }
      if (piece === undefined) return undefined;
      high = low;
    }
    pieces.push(piece);
    from = high;
  }
  return pieces;
}

/** How a layer is computed with a shape; `undefined` where a row of workgroups does not fit into bindings. */
export function planLayer(
  layer: Layer,
  shape: KernelShape,
  direct: TensorPlan,
  up: TensorPlan | undefined,
  result: TensorPlan | undefined,
  maxBinding: number,
): LayerPlan | undefined {
  const { width, height } = direct;
  const rowPixels = tileHeight(shape);
  const workgroups = [
    Math.ceil(width / tileWidth(shape)),
    Math.ceil(height / rowPixels),
    Math.ceil(layer.channels / tileOutputs(shape)),
  ] as const;
  const strips = cutRows(workgroups[1], (fromRow, toRow) => {
    const [from, to] = [fromRow * rowPixels, toRow * rowPixels];
    const strip: Strip = {
      fromRow,
      toRow,
      direct: windowOf(direct, from - 1, to + 1),
      up: up && windowOf(up, from / 2 - 1, to / 2 + 1),
      result: result && (layer.pool ? windowOf(result, from / 2, to / 2) : windowOf(result, from, to)),
    };
    const windows = [strip.direct, strip.up, strip.result];
    return windows.every((window) => !window || window.size <= maxBinding) ? strip : undefined;
  });
  const costOfRow = rowPixels * width * layer.channels * (9 * layer.directChannels + 4 * layer.upChannels);
  return strips && { layer, shape, width, height, direct, up, result, workgroups, strips, costOfRow };
}

/**
 * Plans the evaluation of a network.
 *
 * @param width Pixels, a multiple of 16, as is `height`.
 * @returns `undefined` where a row of workgroups does not fit into bindings.
 */
export function planNetwork(network: Network, width: number, height: number, options: PlanOptions): Plan | undefined {
  const { texelBytes, maxBinding, shapeOf } = options;
  const slots = new Slots();
  const lastUse = (source: number) =>
    network.layers.findLastIndex((layer) => layer.direct === source || layer.up === source);
  const tensors = new Map<number, TensorPlan>();
  const add = (source: number, quads: number, w: number, h: number): TensorPlan => {
    const slot = slots.take(Math.ceil((quads * w * h * texelBytes) / ALIGNMENT) * ALIGNMENT);
    const tensor = { quads, width: w, height: h, texelBytes, slot };
    tensors.set(source, tensor);
    return tensor;
  };
  const input = add(INPUT, quadsOf(network.channels), width, height);
  const encode = cutRows(Math.ceil(height / ENCODE_ROWS), (fromRow, toRow) => {
    const result = windowOf(input, fromRow * ENCODE_ROWS, toRow * ENCODE_ROWS);
    return result.size <= maxBinding ? { fromRow, toRow, result } : undefined;
  });
  if (!encode) return undefined;
  const layers: LayerPlan[] = [];
  for (const [i, layer] of network.layers.entries()) {
    const direct = tensors.get(layer.direct)!;
    const up = layer.up === undefined ? undefined : tensors.get(layer.up)!;
    const shape = shapeOf(layer, direct.width, direct.height);
    if (!hasMatrices(shape) && stagedUpChannels(shape, up !== undefined) === 0) return undefined;
    const half = layer.pool ? 2 : 1;
    const last = i === network.layers.length - 1;
    const result = last ? undefined : add(i, quadsOf(layer.channels), direct.width / half, direct.height / half);
    const planned = planLayer(layer, shape, direct, up, result, maxBinding);
    if (!planned) return undefined;
    layers.push(planned);
    for (const [source, tensor] of tensors)
      if (lastUse(source) === i) {
        slots.release(tensor.slot);
        tensors.delete(source);
      }
  }
  return { width, height, slots: slots.bytes, input, encode, layers };
}
