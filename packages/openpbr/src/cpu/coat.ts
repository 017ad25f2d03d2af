import type { OpenPbrColor, OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { interfaceEnergy } from './dielectric';
import { energyAlbedo, fresnelMean } from './energy';
import { dielectricEpsilon, fresnelDielectric } from './fresnel';
import { ggxAlpha, ggxBound, viewRoughness, type Slopes } from './ggx';
import { clamp, dot, length2, length3, rgb } from './vector';

const mix = (a: number, b: number, t: number): number => a * (1 - t) + b * t;

/** The coat seen from one direction; twin of the WGSL struct `OpenPbrCoat`. */
export interface Coat {
  readonly alpha: Slopes;
  /** See {@link ggxBound}. */
  readonly bound: number;
  readonly eta: number;
  /** Coverage times multiple-scattering compensation. */
  readonly scale: number;
  /** Directional albedo, times coverage. */
  readonly albedo: number;
  /** Factors of the base without a coat, and of light that the coat transmits towards the viewer. */
  readonly uncoated: OpenPbrColor;
  readonly through: OpenPbrColor;
  /** log₂ of the transmittance along the normal. */
  readonly absorption: OpenPbrColor;
  /** Factor of light that the base transmits upwards, for the viewing direction. */
  readonly entry: OpenPbrColor;
  /** The coat's own frame, if it has one. */
  readonly frame: CoatFrame | undefined;
}

/** Tangent, bitangent and normal of the coat in the frame of the base. */
export type CoatFrame = readonly [tangent: OpenPbrVector, bitangent: OpenPbrVector, normal: OpenPbrVector];

const unit = (v: OpenPbrVector): OpenPbrVector => {
  const length = length3(...v);
  return [v[0] / length, v[1] / length, v[2] / length];
};
const plus = (a: OpenPbrVector, b: OpenPbrVector, t: number): OpenPbrVector => [
  a[0] + t * b[0],
  a[1] + t * b[1],
  a[2] + t * b[2],
];

/** The coat's own frame seen from one direction, if it has one; twin of `openpbr_coat_frame`. */
export function coatFrame(
  { geometry_coat_normal: normal, geometry_coat_tangent: tangent }: OpenPbrParameters,
  wo: OpenPbrVector,
): CoatFrame | undefined {
  if (normal === null && tangent === null) return undefined;
  const given = normal ?? [0, 0, 1];
  const n = unit(plus(given, wo, Math.max(1e-3 - dot(given, wo), 0)));
  const along = tangent ?? [1, 0, 0];
  const flat = plus(along, n, -dot(n, along));
  const other: OpenPbrVector = Math.abs(n[0]) > 0.7 ? [0, 1, 0] : [1, 0, 0];
  const t = unit(dot(flat, flat) > 1e-6 ? flat : plus(other, n, -dot(n, other)));
  return [t, [n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]], n];
}

/** A direction of the base's frame in that of the coat. */
export const inCoat = (frame: CoatFrame | undefined, w: OpenPbrVector): OpenPbrVector =>
  frame ? [dot(frame[0], w), dot(frame[1], w), dot(frame[2], w)] : w;

/** A direction of the coat's frame in that of the base. */
export const outOfCoat = (frame: CoatFrame | undefined, w: OpenPbrVector): OpenPbrVector =>
  frame ? rgb((i) => frame[0][i] * w[0] + frame[1][i] * w[1] + frame[2][i] * w[2]) : w;

/**
 * Roughness of the base as seen through a full coat, never less than its own; twin of `openpbr_coat_roughening`.
 *
 * @param roughness specular_roughness
 * @param coatRoughness coat_roughness
 * @param coatIor coat_ior
 */
export function coatRoughening(roughness: number, coatRoughness: number, coatIor: number): number {
  const eta = Math.min(coatIor, 1e3);
  const blur = ((1.05 * (eta - 1) * Math.sqrt(1 + eta * eta)) / eta) * coatRoughness * coatRoughness;
  return Math.max(roughness, Math.sqrt(0.85 * Math.tanh(length2(eta * roughness * roughness, blur) / 0.85)));
}

/** The base below the coat: rougher, and with the step of the index that is left; twin of `openpbr_coat_base`. */
export function coatedBase(p: OpenPbrParameters): OpenPbrParameters {
  return {
    ...p,
    specular_roughness: mix(
      p.specular_roughness,
      coatRoughening(p.specular_roughness, p.coat_roughness, p.coat_ior),
      p.coat_weight,
    ),
    specular_ior: mix(
      p.specular_ior,
      Math.max(p.specular_ior, p.coat_ior) / Math.min(p.specular_ior, p.coat_ior),
      p.coat_weight,
    ),
  };
}

const path = (eta: number, mu: number): number => 1 / Math.sqrt(Math.max(1 - (1 - mu * mu) / (eta * eta), 1e-4));
const absorptionOf = (p: OpenPbrParameters): OpenPbrColor =>
  rgb((i) => 0.5 * Math.log2(Math.max(p.coat_color[i], 1e-7)));
const passage = (absorption: number, eta: number, mu: number): number => 2 ** (absorption * path(eta, mu));

/**
 * What is left of white light after going down from one cosine and up to the other; 1 − coverage of it is not coated.
 */
export const coatTransmittance = (p: OpenPbrParameters, muI: number, muO: number): OpenPbrColor => {
  const absorption = absorptionOf(p);
  return rgb((i) => passage(absorption[i], p.coat_ior, muI) * passage(absorption[i], p.coat_ior, muO));
};

/** Factor of the base due to repeated internal reflection in the coat; twin of `openpbr_coat_darkening`. */
export function coatDarkening(p: OpenPbrParameters, mu: number): OpenPbrColor {
  const base = coatedBase(p);
  const inner = dielectricEpsilon(base.specular_ior, p.specular_weight);
  const f0 = inner * inner;
  const epsilon = dielectricEpsilon(p.coat_ior, 1);
  const roughness = mix(mix(1, base.specular_roughness, f0), base.specular_roughness, p.base_metalness);
  const facet = mu + 0.8 * p.coat_roughness * p.coat_roughness * (1 - mu);
  const kept = Math.min(
    mix(fresnelDielectric((1 + epsilon) / (1 - epsilon), facet), fresnelMean(-epsilon), roughness),
    0.9999,
  );
  return rgb((i) => {
    const color = p.base_weight * p.base_color[i];
    const albedo = mix(
      mix(
        mix(mix(color, p.subsurface_color[i], p.subsurface_weight), 1, p.transmission_weight),
        p.specular_color[i],
        f0,
      ),
      Math.min(color * p.specular_weight, 1),
      p.base_metalness,
    );
    return mix(1, (1 - kept) / (1 - kept * albedo), p.coat_weight * p.coat_darkening);
  });
}

/** Prepares the coat for one direction; twin of `openpbr_coat_prepare`. */
export function prepareCoat(p: OpenPbrParameters, baseWo: OpenPbrVector, multipleScattering: boolean): Coat {
  const frame = coatFrame(p, baseWo);
  const wo = inCoat(frame, baseWo);
  const mu = clamp(wo[2], 1e-5, 1);
  const roughness = p.coat_roughness;
  const alpha = ggxAlpha(roughness, p.coat_roughness_anisotropy);
  const epsilon = dielectricEpsilon(p.coat_ior, 1);
  const eta = (1 + epsilon) / (1 - epsilon);
  const { albedo, multiscatter: more } = interfaceEnergy(
    epsilon,
    roughness,
    alpha,
    wo,
    mu,
    epsilon < 0,
    multipleScattering,
  );
  const absorption = absorptionOf(p);
  const darkening = coatDarkening(p, mu);
  return {
    alpha,
    bound: ggxBound(alpha, wo),
    eta,
    scale: p.coat_weight * (multipleScattering ? albedo / Math.max(albedo - more, 0.1 * albedo + 1e-7) : 1),
    albedo: p.coat_weight * albedo,
    uncoated: rgb((i) => darkening[i] * (1 - p.coat_weight)),
    through: rgb((i) => darkening[i] * p.coat_weight * (1 - albedo) * passage(absorption[i], eta, mu)),
    absorption,
    entry: rgb(
      (i) => darkening[i] * (1 - p.coat_weight + p.coat_weight * (1 - albedo) * passage(absorption[i], eta, mu)),
    ),
    frame,
  };
}

/** Factor on the base for light from the cosine `mu`; twin of `openpbr_coat_pass`. */
export const coatPass = (coat: Coat, mu: number): OpenPbrColor =>
  rgb((i) => coat.uncoated[i] + coat.through[i] * passage(coat.absorption[i], coat.eta, mu));

/** Factor on light through the base, with the cosine `mu` on the far side; twin of `openpbr_coat_through`. */
export const coatThrough = (coat: Coat, exit: number, mu: number): OpenPbrColor =>
  rgb((i) => coat.entry[i] * mix(1, passage(coat.absorption[i], coat.eta, mu), exit));

/** Factor on light that the base emits towards `wo`; twin of `openpbr_coat_emission`. */
export function coatEmission(p: OpenPbrParameters, baseWo: OpenPbrVector): OpenPbrColor {
  const wo = inCoat(coatFrame(p, baseWo), baseWo);
  const mu = clamp(wo[2], 1e-5, 1);
  const epsilon = dielectricEpsilon(p.coat_ior, 1);
  const albedo = energyAlbedo(
    epsilon,
    viewRoughness(ggxAlpha(p.coat_roughness, p.coat_roughness_anisotropy), p.coat_roughness, wo),
    mu,
  );
  const absorption = absorptionOf(p);
  return rgb((i) => mix(1, (1 - albedo) * passage(absorption[i], (1 + epsilon) / (1 - epsilon), mu), p.coat_weight));
}
