import { FILM_CHUNK } from '../schedule/sample-range';
import type { AovName } from '../options';
import { AOV_PLACES } from './aovs';

/** A layer out of copies of the AOV's buffer and, for positions, of that with the coverage. */
export function unpackAov(
  name: AovName,
  copies: readonly ArrayBuffer[],
): Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer> {
  const { format, stride, offset, channels } = AOV_PLACES[name];
  const source = new (format === 'uint32' ? Uint32Array : Float32Array)(copies[0] as ArrayBuffer);
  if (channels === 1) {
    const single = new (format === 'uint32' ? Uint32Array : Float32Array)(source.length / stride);
    return single.map((_, i) => source[stride * i + offset] as number);
  }
  if (channels === stride) return source;
  // With the albedo lies the coverage, which positions have beside them too.
  const last = name === 'normal' ? undefined : new Float32Array(copies.at(-1) as ArrayBuffer);
  return Float32Array.from(source, (value, i) => (i % 4 === 3 ? (last?.[i] ?? 0) : value));
}

/** A weight for each light group. */
export type GroupWeights = readonly (readonly [number, number, number])[];

/**
 * Variance of the image's mean, per pixel RGB, and the pixel's number of samples: what chunk means vary by, over the
 * number of chunks. `Infinity` before there are two.
 *
 * @param total Sums over complete chunks, pass by pass.
 * @param moment Sums of squared chunk means, and the number of samples.
 * @param partSamples Samples of the total that belong to chunks that are not whole.
 * @param partSums Their sums.
 */
export function varianceLayer(
  total: Float32Array,
  moment: Float32Array,
  weights: GroupWeights,
  partSamples = 0,
  partSums?: Float32Array,
): Float32Array<ArrayBuffer> {
  const out = new Float32Array(moment.length);
  for (let at = 0; at < moment.length; at += 4) {
    const samples = moment[at + 3] as number;
    const chunks = Math.floor(Math.max(0, samples - partSamples) / FILM_CHUNK);
    for (let c = 0; c < 3; c++) {
      let sum = 0;
      for (let pass = 0, i = at + c; pass < weights.length; pass++, i += moment.length)
        sum += (weights[pass]?.[c] as number) * ((total[i] as number) - (partSums?.[i] ?? 0));
      const mean = sum / (chunks * FILM_CHUNK);
      out[at + c] =
        chunks < 2
          ? Infinity
          : Math.max(0, (moment[at + c] as number) - chunks * mean * mean) / (chunks * (chunks - 1));
    }
    out[at + 3] = samples;
  }
  return out;
}

/** The part of one light group in the image, RGBA: its light as the group is set, and the coverage of the image. */
export function groupLayer(
  total: Float32Array,
  block: Float32Array,
  moment: Float32Array,
  pass: number,
  weight: readonly [number, number, number],
): Float32Array<ArrayBuffer> {
  const out = new Float32Array(moment.length);
  for (let at = 0; at < out.length; at += 4) {
    const count = Math.max(moment[at + 3] as number, 1);
    for (let c = 0; c < 3; c++)
      out[at + c] =
        ((weight[c] as number) *
          ((total[pass * out.length + at + c] as number) + (block[pass * out.length + at + c] as number))) /
        count;
    out[at + 3] = ((total[at + 3] as number) + (block[at + 3] as number)) / count;
  }
  return out;
}
