import type { OpenPbrColor, OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { mirrorLost } from './energy';
import { dielectricEpsilon } from './fresnel';
import type { FilmShare } from './film';
import { ggxDistribution, ggxMasking, type Slopes } from './ggx';
import { clamp, dot, normalize } from './vector';

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
  readonly mirrorEta: number;
  /** The share of the dielectric that is clear. */
  readonly share: number;
  /** Factor on what facets let through: share of the surface, tint; and the albedo of that. */
  readonly color: OpenPbrColor;
  readonly albedo: OpenPbrColor;
  /** Albedo of what leaves downwards after bounces among the facets. */
  readonly bounced: OpenPbrColor;
  /** Coverage of the coat that the light leaves through; 0 from outside. */
  readonly exit: number;
  readonly thin: boolean;
  readonly thinAlpha: Slopes;
  /** The part of `color` that enters the subsurface, per channel, and the probability of choosing it. */
  readonly subsurface: OpenPbrColor;
  readonly subsurfaceChance: number;
  /** Factor on the reflection by the clear part; the albedo of that, and of further bounces. */
  readonly mirror: OpenPbrColor;
  readonly mirrorAlbedo: OpenPbrColor;
  readonly mirrorBounced: OpenPbrColor;
}

const rgb = (channel: (i: 0 | 1 | 2) => number): OpenPbrColor => [channel(0), channel(1), channel(2)];

/** What {@link prepareTransmission} needs to know of an interface. */
interface Interface {
  readonly epsilon: number;
  readonly share: number;
  readonly bounced: number;
  readonly bouncedThrough: number;
}

/**
 * Prepares what is let through; twin of `openpbr_transmission_prepare`.
 *
 * @param outer The surface without what a coat does to its index, but with the roughness below it, relative to the
 * viewer's side.
 * @param face The interface of the opaque part.
 * @param bare The interface of `outer`.
 * @param film What a film changes of the side that is seen.
 * @param weight Share of the surface that is dielectric.
 */
export function prepareTransmission(
  outer: OpenPbrParameters,
  face: Interface,
  bare: Interface,
  film: FilmShare,
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
    const clear = inside ? bare : face;
    const below = (1 - outer.transmission_weight) * outer.subsurface_weight;
    const share = outer.transmission_weight + below;
    const enters = weight * below;
    const total = rgb((i) => amount * tint[i] + enters);
    const kept = inside ? 1 : Math.min((1 - face.share + 1e-6) / (1 - bare.share + 1e-6), 8);
    const color = rgb((i) => total[i] * kept);
    const bounced = Math.min(bare.bouncedThrough, 1 - bare.share);
    const direct = 1 - bare.share - bounced;
    const mirror = rgb((i) => weight * share * outer.specular_color[i]);
    return {
      eta,
      fresnelEta,
      mirrorEta: (1 + clear.epsilon) / (1 - clear.epsilon),
      share,
      color,
      albedo: rgb((i) => color[i] * direct * film.direct[i]),
      bounced: rgb((i) => color[i] * Math.max(bounced * film.pass[i] + direct * film.apart[i], 0)),
      exit,
      thin,
      thinAlpha: alpha,
      mirror,
      mirrorAlbedo: rgb((i) => mirror[i] * Math.max(clear.share - clear.bounced + film.more[i], 0)),
      mirrorBounced: rgb((i) => mirror[i] * clear.bounced),
      subsurface: rgb((i) => (total[i] > 0 ? enters / total[i] : 0)),
      subsurfaceChance: inside || enters <= 0 ? 0 : (3 * enters) / (total[0] + total[1] + total[2]),
    };
  }
  const reflected = rgb((i) => {
    const share = clamp(face.share + film.more[i], 0, 1);
    return (2 * share) / (1 + share);
  });
  const narrowing = clamp(0.65 * Math.max(eta, 1 / eta) - 0.35, 0, 1);
  const path = 1 / Math.sqrt(Math.max(1 - (1 - mu * mu) / (eta * eta), 1e-4));
  const lostBy = (roughness: number): number => (multipleScattering ? mirrorLost(alpha, roughness, wo, mu) : 0);
  const mirror = rgb((i) => amount * reflected[i] * outer.specular_color[i]);
  const color = rgb((i) => amount * (1 - reflected[i]) * Math.max(tint[i], 1e-7) ** path);
  const reflectedLost = lostBy(outer.specular_roughness);
  const colorLost = lostBy(outer.specular_roughness * narrowing);
  return {
    eta,
    fresnelEta,
    mirrorEta: fresnelEta,
    share: outer.transmission_weight,
    subsurface: [0, 0, 0],
    subsurfaceChance: 0,
    color,
    albedo: rgb((i) => color[i] * (1 - colorLost)),
    bounced: rgb((i) => color[i] * colorLost),
    exit,
    thin,
    thinAlpha: [Math.max(alpha[0] * narrowing ** 2, 1e-4), Math.max(alpha[1] * narrowing ** 2, 1e-4)],
    mirror,
    mirrorAlbedo: rgb((i) => mirror[i] * (1 - reflectedLost)),
    mirrorBounced: rgb((i) => mirror[i] * reflectedLost),
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
