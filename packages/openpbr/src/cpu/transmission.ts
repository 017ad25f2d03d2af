import type { OpenPbrColor, OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { conductorLoss } from './energy';
import { dielectricEpsilon } from './fresnel';
import type { FilmChange } from './film';
import { ggxDistribution, ggxMasking, type Slopes } from './ggx';
import { clamp, dot, normalize, rgb } from './vector';

/** Where the viewer is; twin of the WGSL struct `OpenPbrSide`. */
export interface BsdfSide {
  /** Whether the viewer is in the object's interior. Default false; a thin wall has none. */
  readonly inside?: boolean;
  /** Index of refraction of what is outside of the object. Default 1. */
  readonly outerIor?: number;
}

/** Light through the base, seen from one direction; twin of the WGSL struct `OpenPbrTransmission`. */
export interface Transmission {
  /**
   * Index of the far side over that of the viewer's, for directions: not so near 1 that half vectors are lost; and as
   * it is.
   */
  readonly eta: number;
  readonly fresnelEta: number;
  /** Index for the reflection by the clear part, which a coat changes. */
  readonly reflectionEta: number;
  /** The share of the dielectric that is clear. */
  readonly share: number;
  /** Factor on the transmission of facets (weight and tint), and its albedo. */
  readonly color: OpenPbrColor;
  readonly albedo: OpenPbrColor;
  /** Multiple-scattering albedo of what leaves downwards. */
  readonly multiscatter: OpenPbrColor;
  /** Coverage of the coat that the light leaves through; 0 from outside. */
  readonly exit: number;
  readonly thin: boolean;
  readonly thinAlpha: Slopes;
  /** The part of `color` that enters the subsurface, per channel, and the probability of choosing it. */
  readonly subsurface: OpenPbrColor;
  readonly subsurfaceChance: number;
  /** Factor on the reflection by the clear part, its single-scattering and its multiple-scattering albedo. */
  readonly reflection: OpenPbrColor;
  readonly reflectionAlbedo: OpenPbrColor;
  readonly reflectionMultiscatter: OpenPbrColor;
}

/** How much smoother a thin wall is for the light that it lets through: a factor on the roughness. */
export const thinNarrowing = (eta: number): number => clamp(0.65 * Math.max(eta, 1 / eta) - 0.35, 0, 1);

export const narrowedSlopes = ([x, y]: Slopes, narrowing: number): Slopes => [
  Math.max(x * narrowing ** 2, 1e-4),
  Math.max(y * narrowing ** 2, 1e-4),
];

/** What {@link prepareTransmission} needs to know of an interface. */
interface Interface {
  readonly epsilon: number;
  readonly albedo: number;
  readonly multiscatter: number;
  readonly multiscatterThrough: number;
}

/**
 * Prepares the transmission; twin of `openpbr_transmission_prepare`.
 *
 * @param outer The surface below the coat: with the roughness that the coat gives it, but the index relative to the
 * viewer's side.
 * @param face The interface of the opaque part.
 * @param uncoated The interface of `outer`.
 * @param film What the film changes on the viewer's side.
 * @param weight Share of the surface that is dielectric.
 */
export function prepareTransmission(
  outer: OpenPbrParameters,
  face: Interface,
  uncoated: Interface,
  film: FilmChange,
  alpha: Slopes,
  wo: OpenPbrVector,
  mu: number,
  weight: number,
  exit: number,
  inside: boolean,
  multipleScattering: boolean,
): Transmission {
  const epsilon = dielectricEpsilon(outer.specular_ior, outer.specular_weight);
  const bend = Math.abs(epsilon) < 5e-4 ? 5e-4 : epsilon;
  const eta = (1 + bend) / (1 - bend);
  const fresnelEta = (1 + epsilon) / (1 - epsilon);
  const amount = weight * outer.transmission_weight;
  const thin = outer.geometry_thin_walled;
  const tint: OpenPbrColor = outer.transmission_depth <= 0 || thin ? outer.transmission_color : [1, 1, 1];
  if (!thin) {
    const clear = inside ? uncoated : face;
    const below = (1 - outer.transmission_weight) * outer.subsurface_weight;
    const share = outer.transmission_weight + below;
    const enters = weight * below;
    const total = rgb((i) => amount * tint[i] + enters);
    const kept = inside ? 1 : Math.min((1 - face.albedo + 1e-6) / (1 - uncoated.albedo + 1e-6), 8);
    const color = rgb((i) => total[i] * kept);
    const multiscatter = Math.min(uncoated.multiscatterThrough, 1 - uncoated.albedo);
    const direct = 1 - uncoated.albedo - multiscatter;
    const reflection = rgb((i) => weight * share * outer.specular_color[i]);
    return {
      eta,
      fresnelEta,
      reflectionEta: (1 + clear.epsilon) / (1 - clear.epsilon),
      share,
      color,
      albedo: rgb((i) => color[i] * direct * film.direct[i]),
      multiscatter: rgb((i) => color[i] * Math.max(multiscatter * film.pass[i] + direct * film.difference[i], 0)),
      exit,
      thin,
      thinAlpha: alpha,
      reflection,
      reflectionAlbedo: rgb((i) => reflection[i] * Math.max(clear.albedo - clear.multiscatter + film.more[i], 0)),
      reflectionMultiscatter: rgb((i) => reflection[i] * clear.multiscatter),
      subsurface: rgb((i) => (total[i] > 0 ? enters / total[i] : 0)),
      subsurfaceChance: inside || enters <= 0 ? 0 : (3 * enters) / (total[0] + total[1] + total[2]),
    };
  }
  const reflected = rgb((i) => {
    const share = clamp(face.albedo + film.more[i], 0, 1);
    return (2 * share) / (1 + share);
  });
  const narrowing = thinNarrowing(eta);
  const path = 1 / Math.sqrt(Math.max(1 - (1 - mu * mu) / (eta * eta), 1e-4));
  const lostBy = (roughness: number): number => (multipleScattering ? conductorLoss(alpha, roughness, wo, mu) : 0);
  const reflection = rgb((i) => amount * reflected[i] * outer.specular_color[i]);
  const color = rgb((i) => amount * (1 - reflected[i]) * Math.max(tint[i], 1e-7) ** path);
  const reflectedLost = lostBy(outer.specular_roughness);
  const colorLost = lostBy(outer.specular_roughness * narrowing);
  return {
    eta,
    fresnelEta,
    reflectionEta: fresnelEta,
    share: outer.transmission_weight,
    subsurface: [0, 0, 0],
    subsurfaceChance: 0,
    color,
    albedo: rgb((i) => color[i] * (1 - colorLost)),
    multiscatter: rgb((i) => color[i] * colorLost),
    exit,
    thin,
    thinAlpha: narrowedSlopes(alpha, narrowing),
    reflection,
    reflectionAlbedo: rgb((i) => reflection[i] * (1 - reflectedLost)),
    reflectionMultiscatter: rgb((i) => reflection[i] * reflectedLost),
  };
}

/**
 * The direction refracted by the facet `h`, or `undefined` where everything is reflected; twin of `openpbr_refract`.
 */
export function refract(eta: number, wo: OpenPbrVector, h: OpenPbrVector): OpenPbrVector | undefined {
  const c = dot(wo, h);
  const k = 1 - (1 - c * c) / (eta * eta);
  if (Math.min(c, k) <= 0) return undefined;
  const along = c / eta - Math.sqrt(k);
  return normalize([along * h[0] - wo[0] / eta, along * h[1] - wo[1] / eta, along * h[2] - wo[2] / eta]);
}

/** The facet that refracts `wi` to `wo`, with z ≥ 0; twin of `openpbr_refract_half`. */
export function refractHalf(eta: number, wo: OpenPbrVector, wi: OpenPbrVector): OpenPbrVector {
  const h = normalize([wo[0] + eta * wi[0], wo[1] + eta * wi[1], wo[2] + eta * wi[2]]);
  return h[2] < 0 ? [-h[0], -h[1], -h[2]] : h;
}

/**
 * f · |cos θ_i| without the Fresnel factor, and density of `wi` when facets are sampled by `ggxSample`; twin of
 * `openpbr_refract_ggx`. Walter et al. 2007, separable masking, no factor of η² on radiance.
 */
export function refractGgx(
  eta: number,
  alpha: Slopes,
  wo: OpenPbrVector,
  wi: OpenPbrVector,
  h: OpenPbrVector,
): [value: number, pdf: number] {
  const c = dot(wo, h);
  const down = -dot(wi, h);
  if (Math.min(c, down) <= 0) return [0, 0];
  const visible = (ggxMasking(alpha, wo) * c * ggxDistribution(alpha, h)) / wo[2];
  const jacobian = down / Math.max((c / eta - down) ** 2, 1e-20);
  return [visible * jacobian * ggxMasking(alpha, [wi[0], wi[1], -wi[2]]), visible * jacobian];
}
