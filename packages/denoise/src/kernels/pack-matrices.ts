import type { MatrixSize } from './shapes';
import type { Layer } from '../network';
import { directWeight, upWeight, type PackedWeights } from '../pack-weights';

const FLOAT = new Float32Array(1);
const BITS = new Uint32Array(FLOAT.buffer);

/** The nearest number in half precision, as bits; the largest one for what lies beyond. */
export function halfBits(value: number): number {
  FLOAT[0] = Math.min(Math.abs(value), 65504);
  // What the last bit of the result is worth: 2^(exponent − 10), at least 2^−24.
  const exponent = Math.max(-14, (BITS[0]! >>> 23) - 127);
  const steps = FLOAT[0]! * 2 ** (10 - exponent);
  let rounded = Math.round(steps);
  // Halfway, to the even one.
  if (rounded - steps === 0.5 && rounded % 2 === 1) rounded--;
  // A fraction that is rounded up to the next power of two is carried into the exponent.
  return (value < 0 ? 0x8000 : 0) | ((exponent + 14) * 1024 + rounded);
}

/**
 * Puts a layer's weights in the order `[block of k inputs][tap][block of n outputs][output][input]`, in half precision,
 * after the biases in single precision: what one matrix holds lies together. Places are counted in matrices. Taps as in
 * `packWeights`. Open Image Denoise's archives hold halves, so only sums for upsampled sources are rounded.
 *
 * @param multiple Output channels are padded to a multiple of this.
 */
export function packMatrices(layer: Layer, multiple: number, { n, k }: MatrixSize): PackedWeights {
  const { channels, upChannels, directChannels, bias } = layer;
  const outputs = Math.ceil(channels / multiple) * multiple;
  const upAt = Math.ceil((2 * outputs) / (n * k));
  const directAt = upAt + Math.ceil(upChannels / k) * 16 * (outputs / n);
  const data = new Uint16Array((directAt + Math.ceil(directChannels / k) * 9 * (outputs / n)) * n * k);
  new Float32Array(data.buffer, 0, outputs).set(bias);
  const fill = (at: number, inputs: number, taps: number, weight: typeof upWeight) => {
    for (let i = 0; i < inputs; i++)
      for (let tap = 0; tap < taps; tap++) {
        const row = at * n * k + (Math.floor(i / k) * taps + tap) * outputs * k + (i % k);
        for (let o = 0; o < channels; o++) data[row + o * k] = halfBits(weight(layer, o, i, tap));
      }
  };
  fill(upAt, upChannels, 16, upWeight);
  fill(directAt, directChannels, 9, directWeight);
  return { data, outputQuads: outputs / 4, upAt, directAt };
}
