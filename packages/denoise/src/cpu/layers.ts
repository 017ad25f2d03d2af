import type { Layer } from '../network';

/** Values of all channels, `[channel][row][column]`. */
export interface Planes {
  readonly channels: number;
  readonly width: number;
  readonly height: number;
  readonly data: Float32Array;
}

/** The maximum of each 2×2 pixels. */
export function pool({ channels, width, height, data }: Planes): Planes {
  const result = new Float32Array((channels * width * height) / 4);
  for (let i = 0, row = 0; row < (channels * height) / 2; row++)
    for (let x = 0; x < width / 2; x++, i++) {
      const from = 2 * row * width + 2 * x;
      result[i] = Math.max(data[from]!, data[from + 1]!, data[from + width]!, data[from + width + 1]!);
    }
  return { channels, width: width / 2, height: height / 2, data: result };
}

/** Each pixel repeated to 2×2. */
export function upsample({ channels, width, height, data }: Planes): Planes {
  const result = new Float32Array(4 * data.length);
  for (let i = 0, row = 0; row < channels * height * 2; row++)
    for (let x = 0; x < 2 * width; x++, i++) result[i] = data[(row >> 1) * width + (x >> 1)]!;
  return { channels, width: 2 * width, height: 2 * height, data: result };
}

/** The channels of both, the first's first. */
export function concatenate(a: Planes, b: Planes): Planes {
  const data = new Float32Array(a.data.length + b.data.length);
  data.set(a.data);
  data.set(b.data, a.data.length);
  return { ...a, channels: a.channels + b.channels, data };
}

/** Adds the 3×3 correlation of one channel, outside of which there are zeros, to a row of sums. */
function addRow(
  sums: Float64Array,
  plane: Float32Array,
  from: number,
  height: number,
  y: number,
  kernel: Float32Array,
) {
  const width = sums.length;
  for (let ky = 0; ky < 3; ky++) {
    const row = y + ky - 1;
    if (row < 0 || row >= height) continue;
    const at = from + row * width;
    const left = kernel[3 * ky]!;
    const middle = kernel[3 * ky + 1]!;
    const right = kernel[3 * ky + 2]!;
    let before = 0;
    let here = plane[at]!;
    for (let x = 0; x < width; x++) {
      const after = x + 1 < width ? plane[at + x + 1]! : 0;
      sums[x]! += left * before + middle * here + right * after;
      before = here;
      here = after;
    }
  }
}

/**
 * One output channel of a layer: correlation of 3×3 with zeros around the image, bias, ReLU.
 *
 * @param result Where its rows go.
 */
export function convolveChannel(layer: Layer, channel: number, input: Planes, result: Float32Array): void {
  const { width, height } = input;
  const sums = new Float64Array(width);
  for (let y = 0; y < height; y++) {
    sums.fill(layer.bias[channel]!);
    for (let c = 0; c < input.channels; c++) {
      const at = (channel * input.channels + c) * 9;
      addRow(sums, input.data, c * width * height, height, y, layer.weights.subarray(at, at + 9));
    }
    for (let x = 0; x < width; x++) result[y * width + x] = Math.max(0, sums[x]!);
  }
}
