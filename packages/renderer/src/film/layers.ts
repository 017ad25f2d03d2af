import type { FilmLayer } from '../options';

/** A layer that comes from the first-hit features. */
export type FeatureLayer = Exclude<FilmLayer, 'beauty'>;

/** The film buffers that a layer is made of, in the order in which {@link unpackLayer} takes them. */
export const LAYER_SOURCES: Readonly<Record<FeatureLayer, readonly string[]>> = {
  albedo: ['feature_albedo'],
  normal: ['feature_normal'],
  depth: ['feature_normal', 'feature_albedo'],
  objectId: ['feature_ids'],
  materialId: ['feature_ids'],
};

/** One layer out of the features' sums over `count` samples. */
export function unpackLayer(layer: FeatureLayer, sources: readonly ArrayBuffer[], count: number): Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer> {
  const first = sources[0] as ArrayBuffer;
  if (layer === 'objectId' || layer === 'materialId') {
    const ids = new Uint32Array(first);
    return Uint32Array.from({ length: ids.length / 4 }, (_, i) => ids[4 * i + (layer === 'objectId' ? 0 : 1)] as number);
  }
  const sums = new Float32Array(first);
  if (layer === 'albedo') return sums.map((value) => value / count);
  if (layer === 'normal') return sums.map((value, i) => (i % 4 === 3 ? 0 : value / count));
  const coverage = new Float32Array(sources[1] as ArrayBuffer);
  return Float32Array.from({ length: sums.length / 4 }, (_, i) => ((coverage[4 * i + 3] as number) > 0 ? (sums[4 * i + 3] as number) / (coverage[4 * i + 3] as number) : 0));
}
