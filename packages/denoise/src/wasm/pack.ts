import { directWeight, upWeight } from '../pack-weights';
import { BLOCK } from './kernels';
import type { WasmLayer } from './plan';

/** Where weights lie, in floats. */
export interface WeightPlaces {
  /** Weights of a block of outputs. */
  readonly block: number;
  /** Those of a row of the kernel on the upsampled source, of which each parity of row and column has two. */
  readonly upRow: number;
  /** Where in a block those of the other source begin. */
  readonly direct: number;
  /** Those of one of its three rows. */
  readonly directRow: number;
}

/** Where the weights of a layer lie: first the biases of all blocks, then the blocks. */
export function weightPlaces({ up, direct }: WasmLayer): WeightPlaces {
  const upRow = up ? 2 * up.channels * BLOCK : 0;
  const directRow = 3 * direct.channels * BLOCK;
  return { block: 8 * upRow + 3 * directRow, upRow, direct: 8 * upRow, directRow };
}

/** Floats of a layer's weights. */
export const weightFloats = (planned: WasmLayer): number =>
  planned.result.channels + (planned.result.channels / BLOCK) * weightPlaces(planned).block;

/**
 * Writes a layer's weights in the order in which `convolve` reads them; channels that only pad have zeros.
 *
 * @param target Of {@link weightFloats} zeros.
 */
export function packWasm(planned: WasmLayer, target: Float32Array): void {
  const { layer, up, direct, result } = planned;
  const places = weightPlaces(planned);
  target.set(layer.bias);
  for (let o = 0; o < layer.channels; o++) {
    const at = result.channels + Math.floor(o / BLOCK) * places.block + (o % BLOCK);
    for (let tap = 0; up && tap < 16; tap++) {
      // [parity of the row][row][column][parity of the column], see `upWeight`.
      const from = at + (2 * (2 * (tap >> 3) + (tap & 1)) + ((tap >> 2) & 1)) * places.upRow;
      for (let i = 0; i < layer.upChannels; i++)
        target[from + (((tap >> 1) & 1) * up.channels + i) * BLOCK] = upWeight(layer, o, i, tap);
    }
    for (let tap = 0; tap < 9; tap++) {
      const from = at + places.direct + Math.floor(tap / 3) * places.directRow + (tap % 3) * direct.channels * BLOCK;
      for (let i = 0; i < layer.directChannels; i++) target[from + i * BLOCK] = directWeight(layer, o, i, tap);
    }
  }
}
