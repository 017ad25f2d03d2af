import { samplesInChunk } from '../schedule/sample-range';
import type { FilmState } from './film-state';
import { varianceLayer } from './layers';

/**
 * A layer of a film on the CPU, without a device: Float32Array, RGBA, stride 4, row-major, top row first, as
 * `PathTracer.read` describes it. `beauty` is computed from the sums in double precision and rounded once; the GPU's
 * differs from it by a few units in the last place.
 */
export function readFilmState(state: FilmState, layer: 'beauty' | 'variance'): Float32Array<ArrayBuffer> {
  const { sums, parts, weights, ranges } = state;
  if (layer === 'beauty') return composeBeauty(state);
  // With catchers: the image in which they are visible surfaces, without the one that lacks the objects.
  const first = state.lightPasses > weights.first.length ? [...weights.first, ...weights.first] : weights.first;
  const partSamples = parts.reduce((sum, { chunk }) => sum + samplesInChunk(ranges, chunk), 0);
  const partSums =
    parts.length > 0
      ? sums.film_total.map((_, i) => parts.reduce((sum, part) => sum + (part.sums[i] as number), 0))
      : undefined;
  return varianceLayer(sums.film_total, sums.film_moment, first, partSamples, partSums);
}

const LUMINANCE = [0.2126, 0.7152, 0.0722] as const;

/**
 * The beauty of some pixels of a film with one light group and no catchers in place of their sums: the same bits as of
 * {@link readFilmState}.
 *
 * @param total `film_total`, which becomes the beauty.
 * @param moments `film_moment` of these pixels, of each of the films that are added up.
 * @param at The first float of these pixels.
 */
export function composeInPlace(
  total: Float32Array,
  block: Float32Array,
  [wr, wg, wb]: readonly [number, number, number],
  moments: readonly Float32Array[],
  at: number,
): void {
  const length = moments[0]?.length ?? 0;
  for (let j = 0, i = at; j < length; j += 4, i += 4) {
    let count = 0;
    for (let k = 0; k < moments.length; k++) count += (moments[k] as Float32Array)[j + 3] as number;
    // As the merged film stores it.
    count = Math.fround(count);
    if (count === 0) {
      total.fill(0, i, i + 4);
      continue;
    }
    total[i] = (wr * ((total[i] as number) + (block[i] as number))) / count;
    total[i + 1] = (wg * ((total[i + 1] as number) + (block[i + 1] as number))) / count;
    total[i + 2] = (wb * ((total[i + 2] as number) + (block[i + 2] as number))) / count;
    total[i + 3] = ((total[i + 3] as number) + (block[i + 3] as number)) / count;
  }
}

/** The twin of `film_compose` in `film.wesl`. */
function composeBeauty({ width, height, lightPasses, weights: { last }, sums }: FilmState): Float32Array<ArrayBuffer> {
  const groups = last.length;
  const stride = 4 * width * height;
  const out = new Float32Array(stride);
  const { film_total: total, film_block: block, film_moment: moment } = sums;
  if (lightPasses === groups) {
    // Without catchers, and without objects for each pixel: films have tens of millions.
    const [first] = last;
    if (first && groups === 1) {
      const [wr, wg, wb] = first;
      for (let i = 0; i < stride; i += 4) {
        const count = moment[i + 3] as number;
        if (count === 0) continue;
        out[i] = (wr * ((total[i] as number) + (block[i] as number))) / count;
        out[i + 1] = (wg * ((total[i + 1] as number) + (block[i + 1] as number))) / count;
        out[i + 2] = (wb * ((total[i + 2] as number) + (block[i + 2] as number))) / count;
        out[i + 3] = ((total[i + 3] as number) + (block[i + 3] as number)) / count;
      }
      return out;
    }
    const weights = Float64Array.from(last.flatMap((weight) => [...weight, 1]));
    for (let i = 0; i < stride; i += 4) {
      const count = moment[i + 3] as number;
      if (count === 0) continue;
      let [r, g, b, a] = [0, 0, 0, 0];
      for (let w = 0, j = i; w < weights.length; w += 4, j += stride) {
        r += (weights[w] as number) * ((total[j] as number) + (block[j] as number));
        g += (weights[w + 1] as number) * ((total[j + 1] as number) + (block[j + 1] as number));
        b += (weights[w + 2] as number) * ((total[j + 2] as number) + (block[j + 2] as number));
        a += (weights[w + 3] as number) * ((total[j + 3] as number) + (block[j + 3] as number));
      }
      out[i] = r / count;
      out[i + 1] = g / count;
      out[i + 2] = b / count;
      out[i + 3] = a / count;
    }
    return out;
  }
  for (let at = 0; at < stride; at += 4) {
    const count = moment[at + 3] as number;
    if (count === 0) continue;
    const mean = (first: number, c: number) => {
      let sum = 0;
      for (let pass = first; pass < first + groups; pass++) {
        const i = pass * stride + at + c;
        sum += (c < 3 ? (last[pass - first]?.[c] as number) : 1) * ((total[i] as number) + (block[i] as number));
      }
      return sum / count;
    };
    const rgb = (first: number) => [0, 1, 2].map((c) => mean(first, c)) as [number, number, number];
    const object = rgb(0);
    const alpha = mean(0, 3);
    const coverage = lightPasses > groups ? mean(groups, 3) : 0;
    if (coverage <= 0) {
      out.set([...object, alpha], at);
      continue;
    }
    const [caught, bare, behind] = [rgb(groups), rgb(2 * groups), rgb(3 * groups)];
    const kept = caught.map((value, c) => Math.min(value, bare[c] as number));
    const added = caught.map((value, c) => Math.max(value - (bare[c] as number), 0));
    if (behind.some((value) => value > 0)) {
      const ratio = kept.map((value, c) => ((bare[c] as number) <= 0 ? 1 : value / (bare[c] as number)));
      object.forEach((value, c) => {
        out[at + c] = value + (added[c] as number) + (behind[c] as number) * (ratio[c] as number);
      });
      out[at + 3] = alpha + coverage;
      continue;
    }
    const luminance = (values: readonly number[]) =>
      LUMINANCE.reduce((sum, weight, c) => sum + weight * (values[c] as number), 0);
    const light = luminance(bare);
    object.forEach((value, c) => (out[at + c] = value + (added[c] as number)));
    out[at + 3] = alpha + coverage * (light > 0 ? 1 - luminance(kept) / light : 0);
  }
  return out;
}
