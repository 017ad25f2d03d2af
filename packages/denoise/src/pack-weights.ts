import type { Layer } from './network';

/** A layer's weights in the order in which the shader reads them; places are counted in what it reads at once. */
export interface PackedWeights {
  readonly data: Float32Array<ArrayBuffer> | Uint16Array<ArrayBuffer>;
  /** Vectors of output channels, padded with zeros. Biases come first. */
  readonly outputQuads: number;
  /** Where the weights of the upsampled source begin. */
  readonly upAt: number;
  /** Where those of the other source begin. */
  readonly directAt: number;
}

/** Four channels make a vector; the rest is zeros. */
export const quadsOf = (channels: number): number => Math.ceil(channels / 4);

/**
 * Which rows (or columns) of a 3×3 kernel fall on row `part` (0 or 1) of a 2×2 kernel over the small image, for pixels of
 * an even or odd row.
 */
const PARTS: readonly (readonly (readonly number[])[])[] = [
  [[0], [1, 2]],
  [[0, 1], [2]],
];

/** The weight from input channel `i` of the source at full resolution to output channel `o`. */
export function directWeight(
  { weights, upChannels, directChannels }: Layer,
  o: number,
  i: number,
  tap: number,
): number {
  return weights[(o * (upChannels + directChannels) + upChannels + i) * 9 + tap]!;
}

/**
 * The same of the upsampled source: a 3×3 kernel on an image whose pixels are repeated 2×2 is a 2×2 kernel on the small
 * image for each parity, with weights added up.
 *
 * @param tap `[parity of the row][row of 2×2][column of 2×2][parity of the column]`, 0 to 15.
 */
export function upWeight({ weights, upChannels, directChannels }: Layer, o: number, i: number, tap: number): number {
  let sum = 0;
  for (const ky of PARTS[tap >> 3]![(tap >> 2) & 1]!)
    for (const kx of PARTS[tap & 1]![(tap >> 1) & 1]!)
      sum += weights[(o * (upChannels + directChannels) + i) * 9 + 3 * ky + kx]!;
  return sum;
}

/**
 * Puts a layer's weights in the order `[input channel][tap][output channel]`, after the biases: vectors of four floats.
 *
 * @param multiple Output channels are padded to a multiple of this.
 */
export function packWeights(layer: Layer, multiple: number): PackedWeights {
  const { channels, upChannels, directChannels, bias } = layer;
  const outputs = Math.ceil(channels / multiple) * multiple;
  const upAt = outputs;
  const directAt = upAt + quadsOf(upChannels) * 4 * 16 * outputs;
  const data = new Float32Array(directAt + quadsOf(directChannels) * 4 * 9 * outputs);
  data.set(bias);
  for (let o = 0; o < channels; o++) {
    for (let i = 0; i < upChannels; i++)
      for (let tap = 0; tap < 16; tap++) data[upAt + (i * 16 + tap) * outputs + o] = upWeight(layer, o, i, tap);
    for (let i = 0; i < directChannels; i++)
      for (let tap = 0; tap < 9; tap++) data[directAt + (i * 9 + tap) * outputs + o] = directWeight(layer, o, i, tap);
  }
  return { data, outputQuads: outputs / 4, upAt: upAt / 4, directAt: directAt / 4 };
}
