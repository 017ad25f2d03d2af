import type { OpenPbrColor, OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { coatedBase, coatEmission, coatPass, prepareCoat, type Coat } from './coat';
import { cosineSample, eon } from './diffuse';
import { energyLost, energyLostMean, energyShare, energyShareMean, energyTotal, fresnelMean } from './energy';
import { dielectricEpsilon, fresnelDielectric, fresnelMetal, fresnelMetalMean } from './fresnel';
import { ggx, ggxAlpha, ggxSample, halfVector, mirrorCosine, mirrorRoughness, viewRoughness, type Slopes } from './ggx';
import { clamp, dot } from './vector';

/** What {@link prepareBsdf} may be told. */
export interface BsdfOptions {
  /** As the flag OPENPBR_MULTISCATTER; default true. */
  readonly multipleScattering?: boolean;
}

/** A surface seen from one direction; twin of the WGSL struct `OpenPbrBsdf`. */
export interface Bsdf {
  readonly alpha: Slopes;
  /** Probability of sampling the microfacet lobe; else it is the cosine. */
  readonly specularProbability: number;
  /** Factor on the diffuse lobe, without its colour. */
  readonly diffuseScale: number;
  readonly diffuseColor: OpenPbrColor;
  readonly diffuseRoughness: number;
  /** Directional albedo. */
  readonly albedo: OpenPbrColor;
  readonly metal: {
    readonly f0: OpenPbrColor;
    readonly tint: OpenPbrColor;
    readonly specularWeight: number;
    readonly metalness: number;
    /** See {@link mirrorRoughness}. */
    readonly roughness: number;
    /** Directional albedo of multiple scattering, and its mean loss. */
    readonly bounced: OpenPbrColor;
    readonly meanLost: number;
  };
  readonly dielectric: { readonly eta: number; readonly epsilon: number; readonly roughness: number; readonly scale: OpenPbrColor };
  readonly coat: Coat;
  /** Probability of sampling the coat; else it is the base. */
  readonly coatProbability: number;
}

/** A sampled direction; twin of the WGSL struct `OpenPbrSample`. */
export interface BsdfSample {
  readonly wi: OpenPbrVector;
  /** Density per solid angle; 0 if there is no sample. */
  readonly pdf: number;
  /** f · |cos θ_i| / pdf. */
  readonly weight: OpenPbrColor;
  readonly valid: boolean;
}

const rgb = (channel: (i: 0 | 1 | 2) => number): OpenPbrColor => [channel(0), channel(1), channel(2)];
const sum = (color: OpenPbrColor): number => color[0] + color[1] + color[2];

/**
 * Prepares the surface for one direction; twin of `openpbr_prepare`.
 *
 * @param whole Resolved parameters.
 * @param wo Unit direction to the viewer in the local frame, +z normal.
 */
export function prepareBsdf(whole: OpenPbrParameters, wo: OpenPbrVector, { multipleScattering = true }: BsdfOptions = {}): Bsdf {
  const p = coatedBase(whole);
  const mu = clamp(wo[2], 1e-5, 1);
  const roughness = p.specular_roughness;
  const f0 = rgb((i) => p.base_weight * p.base_color[i]);
  const weight = Math.min(p.specular_weight, 1e6);
  const alpha = ggxAlpha(roughness, p.specular_roughness_anisotropy);
  const mirror = mirrorRoughness(roughness, p.specular_roughness_anisotropy);
  const mirrorMu = mirrorCosine(alpha, wo, mu);
  const lost = multipleScattering ? energyLost(mirror, mirrorMu) : 0;
  const meanLost = Math.max(energyLostMean(mirror), 1e-7);
  const typical = fresnelMetal(f0, p.specular_color, mu + 0.8 * roughness * roughness * (1 - mu), weight);
  const mean = fresnelMetalMean(f0, p.specular_color, weight);
  const limit = clamp(weight, 1e-6, 1);
  const bounced = rgb((i) => (p.base_metalness * lost * (1 - meanLost) * mean[i] * mean[i]) / Math.max(limit - mean[i] * meanLost, 1e-7));
  const epsilon = dielectricEpsilon(p.specular_ior, p.specular_weight);
  const share = energyShare(epsilon, viewRoughness(alpha, roughness, wo), mu);
  const more = multipleScattering ? Math.max(1 - energyTotal(epsilon, mirror, mirrorMu), 0) * (epsilon >= 0 ? fresnelMean(epsilon) : share) : 0;
  const boost = multipleScattering ? share / Math.max(share - more, 0.1 * share + 1e-7) : 1;
  const insulator = 1 - p.base_metalness;
  const specular = rgb((i) => p.base_metalness * typical[i] * (1 - lost) + insulator * share * p.specular_color[i]);
  const spread = rgb((i) => bounced[i] + insulator * p.base_weight * (1 - share) * p.base_color[i]);
  const bright = sum(specular);
  const all = bright + sum(spread);
  const reflected = energyShareMean(epsilon, roughness);
  const coat = prepareCoat(whole, wo, mu, multipleScattering);
  // A highlight comes from about as low as it is seen, spread light from everywhere.
  const highlight = coatPass(coat, mu);
  const everywhere = coatPass(coat, 2 / 3);
  const below = rgb((i) => specular[i] * highlight[i] + spread[i] * everywhere[i]);
  const total = sum(below) + 3 * coat.albedo;
  return {
    alpha,
    specularProbability: all > 0 ? bright / all : 0.5,
    diffuseScale: ((insulator * p.base_weight * (1 - share)) / Math.max(1 - reflected, 1e-4)) * (1 - 0.08 * p.base_diffuse_roughness * reflected),
    diffuseColor: p.base_color,
    diffuseRoughness: p.base_diffuse_roughness,
    albedo: rgb((i) => Math.min(below[i] + coat.albedo, 1)),
    metal: { f0, tint: p.specular_color, specularWeight: weight, metalness: p.base_metalness, roughness: mirror, bounced, meanLost },
    dielectric: { eta: (1 + epsilon) / (1 - epsilon), epsilon, roughness, scale: rgb((i) => insulator * p.specular_color[i] * boost) },
    coat,
    coatProbability: total > 0 ? (3 * coat.albedo) / total : 0.5,
  };
}

function scatter(b: Bsdf, wo: OpenPbrVector, wi: OpenPbrVector, h: OpenPbrVector): { f: OpenPbrColor; pdf: number } {
  if (Math.min(wo[2], wi[2]) <= 0) return { f: [0, 0, 0], pdf: 0 };
  const c = clamp(dot(wo, h), 0, 1);
  const [value, density] = ggx(b.alpha, wo, wi, h);
  const metal = fresnelMetal(b.metal.f0, b.metal.tint, c, b.metal.specularWeight);
  const dielectric = fresnelDielectric(b.dielectric.eta, c);
  const scale = b.diffuseScale * wi[2] * (1 - energyShare(b.dielectric.epsilon, viewRoughness(b.alpha, b.dielectric.roughness, wi), wi[2]));
  const bounced = (energyLost(b.metal.roughness, mirrorCosine(b.alpha, wi, wi[2])) / b.metal.meanLost / Math.PI) * wi[2];
  const diffuse = eon(b.diffuseColor, b.diffuseRoughness, wo, wi);
  const pass = coatPass(b.coat, wi[2]);
  const [top, topDensity] = ggx(b.coat.alpha, wo, wi, h);
  const mirrored = b.coat.scale * fresnelDielectric(b.coat.eta, c) * top;
  const basePdf = b.specularProbability * density + ((1 - b.specularProbability) * wi[2]) / Math.PI;
  return {
    f: rgb((i) => (value * (b.metal.metalness * metal[i] + b.dielectric.scale[i] * dielectric) + bounced * b.metal.bounced[i] + scale * diffuse[i]) * pass[i] + mirrored),
    pdf: basePdf * (1 - b.coatProbability) + topDensity * b.coatProbability,
  };
}

/** f · |cos θ_i| and density together; twin of `openpbr_eval_pdf`. `wo` is the one that {@link prepareBsdf} had. */
export const evalPdfBsdf = (b: Bsdf, wo: OpenPbrVector, wi: OpenPbrVector): { f: OpenPbrColor; pdf: number } => scatter(b, wo, wi, halfVector(wo, wi));

/** f · |cos θ_i|; twin of `openpbr_eval`. `wo` is the one that {@link prepareBsdf} had. */
export const evalBsdf = (b: Bsdf, wo: OpenPbrVector, wi: OpenPbrVector): OpenPbrColor => evalPdfBsdf(b, wo, wi).f;

/** Density of {@link sampleBsdf} per solid angle; twin of `openpbr_pdf`. */
export const pdfBsdf = (b: Bsdf, wo: OpenPbrVector, wi: OpenPbrVector): number => evalPdfBsdf(b, wo, wi).pdf;

/** A direction for `u` in [0, 1)³; twin of `openpbr_sample`. */
export function sampleBsdf(b: Bsdf, wo: OpenPbrVector, u: readonly [number, number, number]): BsdfSample {
  let h: OpenPbrVector;
  let wi: OpenPbrVector;
  const top = u[2] < b.coatProbability;
  if (top || u[2] - b.coatProbability < (1 - b.coatProbability) * b.specularProbability) {
    h = ggxSample(top ? b.coat.alpha : b.alpha, wo, u);
    const c = 2 * dot(wo, h);
    wi = [c * h[0] - wo[0], c * h[1] - wo[1], c * h[2] - wo[2]];
  } else {
    wi = cosineSample(u);
    h = halfVector(wo, wi);
  }
  const { f, pdf } = scatter(b, wo, wi, h);
  return pdf > 0 ? { wi, pdf, weight: rgb((i) => f[i] / pdf), valid: true } : { wi, pdf: 0, weight: [0, 0, 0], valid: false };
}

/** Reflected part of uniform light; twin of `openpbr_albedo`. */
export const albedoBsdf = (b: Bsdf, wo: OpenPbrVector): OpenPbrColor => (wo[2] > 0 ? b.albedo : [0, 0, 0]);

/** Radiance that leaves towards `wo`; twin of `openpbr_emission`. */
export function emittedRadiance(p: OpenPbrParameters, wo: OpenPbrVector): OpenPbrColor {
  if (wo[2] <= 0) return [0, 0, 0];
  const pass = coatEmission(p, wo);
  return rgb((i) => p.emission_color[i] * p.emission_luminance * pass[i]);
}
