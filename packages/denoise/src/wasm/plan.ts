import { INPUT, type Layer, type Network } from '../network';
import { Slots } from '../plan';
import { BLOCK, ROUND } from './kernels';

/**
 * Values of a layer, or the encoded images, in the module's memory: `[row][pixel][channel]`, in single precision.
 * Before and after a row lies a pixel of zeros; rows are as long as tiles of pixels want them.
 */
export interface WasmTensor {
  /** Channels in memory, a multiple of 4. */
  readonly channels: number;
  readonly width: number;
  readonly height: number;
  readonly rowBytes: number;
  /** Index of its part of the memory. */
  readonly slot: number;
}

/** A layer and its tensors. */
export interface WasmLayer {
  readonly layer: Layer;
  readonly direct: WasmTensor;
  readonly up: WasmTensor | undefined;
  readonly result: WasmTensor;
}

/** How a network computes an image, or a tile of it. */
export interface WasmPlan {
  readonly input: WasmTensor;
  readonly layers: readonly WasmLayer[];
  /** Bytes of each part of the memory. */
  readonly slots: readonly number[];
  /** Bytes of two rows before they are pooled. */
  readonly poolBytes: number;
}

const roundUp = (value: number, to: number): number => Math.ceil(value / to) * to;

/** Bytes of a row without its borders. */
export const rowBytesOf = (width: number, channels: number): number => 4 * channels * roundUp(width, 8);

/** Bytes of all values. */
export const bytesOf = ({ slots, poolBytes }: WasmPlan): number => slots.reduce((sum, bytes) => sum + bytes, poolBytes);

/**
 * Plans the evaluation of a network.
 *
 * @param width Pixels, a multiple of 16, as is `height`.
 */
export function planWasm(network: Network, width: number, height: number): WasmPlan {
  const slots = new Slots();
  const tensors = new Map<number, WasmTensor>();
  const lastUse = (source: number) =>
    network.layers.findLastIndex((layer) => layer.direct === source || layer.up === source);
  const add = (source: number, channels: number, w: number, h: number): WasmTensor => {
    const rowBytes = rowBytesOf(w, channels) + 8 * channels;
    const tensor = { channels, width: w, height: h, rowBytes, slot: slots.take(rowBytes * h) };
    tensors.set(source, tensor);
    return tensor;
  };
  const input = add(INPUT, roundUp(network.channels, ROUND), width, height);
  let poolBytes = 0;
  const layers = network.layers.map((layer, i) => {
    const direct = tensors.get(layer.direct)!;
    const up = layer.up === undefined ? undefined : tensors.get(layer.up)!;
    const half = layer.pool ? 2 : 1;
    const result = add(i, roundUp(layer.channels, BLOCK), direct.width / half, direct.height / half);
    if (layer.pool) poolBytes = Math.max(poolBytes, 2 * rowBytesOf(direct.width, result.channels));
    for (const [source, tensor] of tensors)
      if (lastUse(source) === i) {
        slots.release(tensor.slot);
        tensors.delete(source);
      }
    return { layer, direct, up, result };
  });
  return { input, layers, slots: slots.bytes, poolBytes };
}
