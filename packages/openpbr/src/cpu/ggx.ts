import type { OpenPbrVector } from '../parameters/index';
import { clamp, length2, length3, normalize } from './vector';

/** GGX slopes along the tangent and the bitangent. */
export type Slopes = readonly [x: number, y: number];

/** Density of a delta lobe that was sampled; all other densities are negligible compared with it. */
export const SPIKE = 1e30;

/** Whether a lobe is a delta, whose only facet is the normal; twin of `openpbr_smooth`. */
export const isSmooth = (alpha: Slopes): boolean => alpha[0] <= 1e-4;

/** Roughness and anisotropy to slopes, not below 1e-4; twin of `openpbr_alpha`. */
export function ggxAlpha(roughness: number, anisotropy: number): Slopes {
  const flat = 1 - anisotropy;
  const along = roughness * roughness * Math.sqrt(2 / (1 + flat * flat));
  return [Math.max(along, 1e-4), Math.max(flat * along, 1e-4)];
}

const stretch = (alpha: Slopes, w: OpenPbrVector): number => length3(alpha[0] * w[0], alpha[1] * w[1], w[2]);

/** Density of facet normals, per solid angle and projected area; its integral over cos θ is 1. */
export function ggxDistribution(alpha: Slopes, h: OpenPbrVector): number {
  const t = (h[0] / alpha[0]) ** 2 + (h[1] / alpha[1]) ** 2 + h[2] * h[2];
  return 1 / (Math.PI * alpha[0] * alpha[1] * t * t);
}

/** The visible part of the facets from one direction (Smith's G1). */
export const ggxMasking = (alpha: Slopes, w: OpenPbrVector): number => (2 * w[2]) / (w[2] + stretch(alpha, w));

/** Height-correlated masking and shadowing, 1/(1 + Λ_o + Λ_i). */
export function ggxMaskingShadowing(alpha: Slopes, wo: OpenPbrVector, wi: OpenPbrVector): number {
  return (2 * wo[2] * wi[2]) / (wo[2] * stretch(alpha, wi) + wi[2] * stretch(alpha, wo));
}

/**
 * D·G2/(4 cos θ_o) and the density of reflected directions under {@link ggxSample} with the same bound; twin of
 * `openpbr_ggx`.
 */
export function ggx(
  alpha: Slopes,
  wo: OpenPbrVector,
  wi: OpenPbrVector,
  h: OpenPbrVector,
  bound = 1,
): [value: number, pdf: number] {
  const d = ggxDistribution(alpha, h) / 2;
  const so = stretch(alpha, wo);
  const si = stretch(alpha, wi);
  return [(d * wi[2]) / (wo[2] * si + wi[2] * so), d / (bound * wo[2] + so)];
}

/** The specular_roughness whose highlight is stretched to `alpha`. */
export const ggxRoughness = (alpha: Slopes): number => Math.sqrt(length2(alpha[0], alpha[1]) / Math.SQRT2);

/** Round roughness that reflects as large a share of the light towards `w`; twin of `openpbr_view_roughness`. */
export const viewRoughness = (alpha: Slopes, roughness: number, w: OpenPbrVector): number =>
  Math.sqrt(Math.min(length3(alpha[0] * w[0], alpha[1] * w[1], roughness * roughness * w[2]), 1));

/**
 * The cosine at which a round highlight has the same masking: `mu` of `w` if the highlight is round; twin of
 * `openpbr_conductor_cosine`.
 */
export const conductorCosine = (alpha: Slopes, w: OpenPbrVector, mu: number): number =>
  mu / length2(mu, (length2(alpha[0] * w[0], alpha[1] * w[1]) * Math.SQRT2) / length2(alpha[0], alpha[1]));

/** The half vector, finite where two grazing directions cancel; twin of `openpbr_half`. */
export const halfVector = (wo: OpenPbrVector, wi: OpenPbrVector): OpenPbrVector =>
  normalize([wo[0] + wi[0], wo[1] + wi[1], Math.max(wo[2] + wi[2], 1e-7)]);

/**
 * How much of the spherical cap of visible normals reflects upwards, at most (Eto and Tokuyoshi 2023): a factor on the
 * cap's depth below the equator; twin of `openpbr_ggx_bound`.
 */
export function ggxBound(alpha: Slopes, wo: OpenPbrVector): number {
  const a = Math.min(alpha[0], alpha[1], 1);
  const s = 1 + length2(wo[0], wo[1]);
  return ((1 - a * a) * s * s) / (s * s + a * a * wo[2] * wo[2]);
}

/**
 * A half vector visible from `wo` (Dupuy and Benyoub 2023); twin of `openpbr_ggx_sample`.
 *
 * @param u In [0, 1)².
 * @param bound From {@link ggxBound}, to leave out normals that cannot reflect upwards; 1 for all.
 */
export function ggxSample(
  alpha: Slopes,
  wo: OpenPbrVector,
  u: readonly [number, number, ...number[]],
  bound = 1,
): OpenPbrVector {
  if (isSmooth(alpha)) return [0, 0, 1];
  const v = normalize([alpha[0] * wo[0], alpha[1] * wo[1], wo[2]]);
  const phi = 2 * Math.PI * u[0];
  const z = (1 - u[1]) * (1 + bound * v[2]) - bound * v[2];
  const r = Math.sqrt(clamp(1 - z * z, 0, 1));
  return normalize([
    alpha[0] * (r * Math.cos(phi) + v[0]),
    alpha[1] * (r * Math.sin(phi) + v[1]),
    Math.max(z + v[2], 1e-7),
  ]);
}
