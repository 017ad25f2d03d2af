import { FILM_CHUNK } from '../schedule/sample-range';
import type { FilmLayer } from '../options';

/** A layer that comes from camera rays alone. */
export type FeatureLayer = Exclude<FilmLayer, 'beauty' | 'variance'>;

/** One layer out of the features' sums over `count` samples. */
export function unpackLayer(
  layer: FeatureLayer,
  sources: readonly ArrayBuffer[],
  count: number,
): Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer> {
  const first = sources[0] as ArrayBuffer;
  if (layer === 'objectId' || layer === 'materialId') {
    const ids = new Uint32Array(first);
    return Uint32Array.from(
      { length: ids.length / 4 },
      (_, i) => ids[4 * i + (layer === 'objectId' ? 0 : 1)] as number,
    );
  }
  const sums = new Float32Array(first);
  if (layer === 'albedo') return sums.map((value) => value / count);
  if (layer === 'normal') return sums.map((value, i) => (i % 4 === 3 ? 0 : value / count));
  if (layer === 'position')
    return sums.map((value, i) => (i % 4 === 3 ? value / count : value / Math.max(sums[i | 3] as number, 1)));
  const coverage = new Float32Array(sources[1] as ArrayBuffer);
  return Float32Array.from({ length: sums.length / 4 }, (_, i) =>
    (coverage[4 * i + 3] as number) > 0 ? (sums[4 * i + 3] as number) / (coverage[4 * i + 3] as number) : 0,
  );
}

/** A weight for each light group. */
export type GroupWeights = readonly (readonly [number, number, number])[];

/**
 * Variance of the image's mean, per pixel RGB, and the pixel's number of samples: what chunk means vary by, over the
 * number of chunks. `Infinity` before there are two.
 *
 * @param total Sums over complete chunks, plane by plane.
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
      weights.forEach((weight, plane) => {
        const i = plane * moment.length + at + c;
        sum += (weight[c] as number) * ((total[i] as number) - (partSums?.[i] ?? 0));
      });
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
  plane: number,
  weight: readonly [number, number, number],
): Float32Array<ArrayBuffer> {
  const out = new Float32Array(moment.length);
  for (let at = 0; at < out.length; at += 4) {
    const count = Math.max(moment[at + 3] as number, 1);
    for (let c = 0; c < 3; c++)
      out[at + c] =
        ((weight[c] as number) *
          ((total[plane * out.length + at + c] as number) + (block[plane * out.length + at + c] as number))) /
        count;
    out[at + 3] = ((total[at + 3] as number) + (block[at + 3] as number)) / count;
  }
  return out;
}
