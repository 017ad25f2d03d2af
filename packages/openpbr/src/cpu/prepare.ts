import type { OpenPbrColor, OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { coatedBase, coatPass, coatThrough, prepareCoat, type Coat } from './coat';
import { interfaceEnergy, isOverOpaque, isSummed } from './dielectric';
import { diffuseEven, diffuseGain, diffuseGrazing } from './diffuse';
import { energyAlbedoMean, conductorLoss, conductorLossMean, anisotropicAlbedoMean } from './energy';
import { dielectricEpsilon, fresnelMetal, fresnelMetalMean } from './fresnel';
import { filmReflectance, filmChange, metalIndex, prepareFilm, type ComplexIndex, type Film } from './film';
import { prepareFuzz, type Fuzz } from './fuzz';
import { ggxAlpha, ggxBound, isSmooth, type Slopes } from './ggx';
import { mix, mixInterfaces, mixThin, prepareHaze, type Haze } from './haze';
import { prepareThinSubsurface, type ThinSubsurface } from './subsurface';
import { prepareTransmission, type BsdfSide, type Transmission } from './transmission';
import { clamp, rgb, rgbOf, sum } from './vector';

/** Options for {@link prepareBsdf}. */
export interface BsdfOptions extends BsdfSide {
  /** As the flag OPENPBR_MULTISCATTER; default true. */
  readonly multipleScattering?: boolean;
  /**
   * Evaluate a thin film at three wavelengths in nm, one for each channel, instead of over the visible spectrum; for
   * comparisons.
   */
  readonly filmWavelengths?: readonly [number, number, number] | undefined;
}

/** A surface seen from one direction; twin of the WGSL struct `OpenPbrBsdf`. */
export interface Bsdf {
  readonly alpha: Slopes;
  /** See {@link ggxBound}; 1 where facets let light through. */
  readonly bound: number;
  /** Probability of sampling the microfacet lobe; else it is the cosine. */
  readonly specularProbability: number;
  /** Factor on the diffuse lobe, without its colour. */
  readonly diffuseScale: number;
  readonly diffuseColor: OpenPbrColor;
  readonly diffuseRoughness: number;
  /** What rough diffuse light gets more at grazing angles; see `diffuseGain`. */
  readonly diffuseGrazing: number;
  /** Directional albedo. */
  readonly albedo: OpenPbrColor;
  readonly metal: {
    readonly f0: OpenPbrColor;
    readonly tint: OpenPbrColor;
    readonly specularWeight: number;
    readonly metalness: number;
    readonly roughness: number;
    /** Directional albedo of multiple scattering, and its mean loss. */
    readonly multiscatter: OpenPbrColor;
    readonly meanLost: number;
    /** Its complex index per channel, below a film. */
    readonly index: readonly [ComplexIndex, ComplexIndex, ComplexIndex];
  };
  readonly dielectric: {
    readonly eta: number;
    readonly epsilon: number;
    readonly summed: boolean;
    readonly roughness: number;
    readonly scale: OpenPbrColor;
    readonly multiscatter: OpenPbrColor;
  };
  readonly film: Film;
  /** Factor on what lies below the interface, by the film. */
  readonly filmPass: OpenPbrColor;
  readonly transmission: Transmission;
  /** Thin-walled diffuse lobe below the interface, with the albedos of the interface for diffuse light. */
  readonly subsurface: ThinSubsurface;
  /** Probability that a facet of a thin wall reflects. */
  readonly thinChance: number;
  /** Probability of going down when the cosine is sampled. */
  readonly below: number;
  readonly coat: Coat;
  readonly fuzz: Fuzz;
  /** The facets of the second kind, and of metal of this kind multiple scattering and its mean loss. */
  readonly haze: Haze & { readonly multiscatter: OpenPbrColor; readonly meanLost: number };
  /** Share of what facets reflect that returns. */
  readonly retroreflectivity: number;
  /** Probability of sampling the fuzz; else it is what lies below. */
  readonly fuzzProbability: number;
  /** Probability of sampling the coat; else it is the base. */
  readonly coatProbability: number;
}

/** The parameters with indices relative to what is outside, and no coat in front from inside. */
function seenFrom(p: OpenPbrParameters, { inside = false, outerIor = 1 }: BsdfSide): OpenPbrParameters {
  return {
    ...p,
    specular_ior: p.specular_ior / outerIor,
    coat_ior: p.coat_ior / outerIor,
    coat_weight: inside ? 0 : p.coat_weight,
    fuzz_weight: inside ? 0 : p.fuzz_weight,
  };
}

/**
 * Share of light that an interface reflects, and what multiple scattering adds to either side; twin of
 * `openpbr_dielectric_seen`.
 */
function prepareInterface(
  p: OpenPbrParameters,
  alpha: Slopes,
  wo: OpenPbrVector,
  mu: number,
  multipleScattering: boolean,
) {
  const epsilon = dielectricEpsilon(p.specular_ior, p.specular_weight);
  const summed = isSummed(p, epsilon);
  return {
    epsilon,
    summed,
    ...interfaceEnergy(
      epsilon,
      p.specular_roughness,
      alpha,
      wo,
      mu,
      summed && (isOverOpaque(p) || !isSmooth(alpha)),
      multipleScattering,
    ),
  };
}

/**
 * Prepares the surface for one direction; twin of `openpbr_prepare` and `openpbr_prepare_side`.
 *
 * @param given Resolved parameters.
 * @param wo Unit direction to the viewer in the local frame, +z normal on the viewer's side.
 */
export function prepareBsdf(
  given: OpenPbrParameters,
  wo: OpenPbrVector,
  { multipleScattering = true, inside = false, outerIor = 1, filmWavelengths }: BsdfOptions = {},
): Bsdf {
  const whole = seenFrom(given, { inside, outerIor });
  const p = coatedBase(whole);
  const mu = clamp(wo[2], 1e-5, 1);
  const roughness = p.specular_roughness;
  const f0 = rgb((i) => p.base_weight * p.base_color[i]);
  const weight = Math.min(p.specular_weight, 1e6);
  const alpha = ggxAlpha(roughness, p.specular_roughness_anisotropy);
  const haze = prepareHaze(whole, wo);
  const isHazy = haze.weight > 0;
  const film = prepareFilm(whole, outerIor, inside, filmWavelengths);
  const index = rgbOf((i) => metalIndex(f0[i], p.specular_color[i]));
  const metalOf = (slopes: Slopes, r: number, share: number) => {
    const lost = multipleScattering ? conductorLoss(slopes, r, wo, mu) : 0;
    const meanLost = Math.max(conductorLossMean(slopes, r), 1e-7);
    const seen = mu + 0.8 * r * r * (1 - mu);
    // Below a film one facet serves both: the mean's where the metal is rough, with Schlick's rise from there.
    const facet = mix(seen, 0.7, clamp(10 * r - 0.5, 0, 1));
    const rise = Math.max((1 - seen) ** 5 - (1 - facet) ** 5, 0);
    const typical = filmedMetal(film, index, weight, facet, fresnelMetal(f0, p.specular_color, seen, weight), rise);
    const mean = filmedMetal(film, index, weight, facet, fresnelMetalMean(f0, p.specular_color, weight));
    const limit = clamp(weight, 1e-6, 1);
    const amount = p.base_metalness * share;
    return {
      albedo: rgb((i) => amount * typical[i] * (1 - lost)),
      multiscatter: rgb(
        (i) => (amount * lost * (1 - meanLost) * mean[i] * mean[i]) / Math.max(limit - mean[i] * meanLost, 1e-7),
      ),
      meanLost,
    };
  };
  const metal = metalOf(alpha, roughness, 1 - haze.weight);
  const hazyMetal = metalOf(haze.alpha, haze.roughness, haze.weight);
  const tint: OpenPbrColor = inside ? [1, 1, 1] : p.specular_color;
  const insulator = 1 - p.base_metalness;
  const interfaceOf = (surface: OpenPbrParameters) => {
    const first = prepareInterface(surface, alpha, wo, mu, multipleScattering);
    if (!isHazy) return first;
    const second = { ...surface, specular_roughness: haze.roughness };
    return mixInterfaces(first, prepareInterface(second, haze.alpha, wo, mu, multipleScattering), haze.weight);
  };
  const face = interfaceOf(p);
  const outer = { ...p, specular_color: tint, specular_ior: inside ? 1 / whole.specular_ior : whole.specular_ior };
  // From inside nothing opaque lies beyond it.
  const uncoated = interfaceOf(inside ? { ...outer, transmission_weight: 1 } : outer);
  const filmed = filmChange(film, (1 + face.epsilon) / (1 - face.epsilon), face.albedo, alpha, wo, inside);
  const clear = inside
    ? filmChange(film, (1 + uncoated.epsilon) / (1 - uncoated.epsilon), uncoated.albedo, alpha, wo, inside)
    : filmed;
  const through = prepareTransmission(
    outer,
    face,
    uncoated,
    clear,
    alpha,
    wo,
    mu,
    insulator,
    inside ? given.coat_weight : 0,
    inside,
    multipleScattering,
  );
  const transmission = isHazy && through.thin ? mixThin(through, haze, wo, mu, multipleScattering) : through;
  const subsurface = prepareThinSubsurface(p, insulator * (1 - face.albedo));
  const scale = rgb((i) => insulator * (1 - transmission.share) * tint[i]);
  const specular = rgb(
    (i) =>
      metal.albedo[i] +
      hazyMetal.albedo[i] +
      scale[i] * Math.max(face.albedo - face.multiscatter + filmed.more[i], 0) +
      transmission.reflectionAlbedo[i],
  );
  const dielectricMultiscatter = rgb((i) => scale[i] * face.multiscatter + transmission.reflectionMultiscatter[i]);
  const diffuse =
    insulator * p.base_weight * (1 - p.transmission_weight) * (1 - p.subsurface_weight) * (1 - face.albedo);
  const spread = rgb(
    (i) =>
      metal.multiscatter[i] +
      hazyMetal.multiscatter[i] +
      dielectricMultiscatter[i] +
      (diffuse * p.base_color[i] + subsurface.back * subsurface.color[i]) * filmed.pass[i],
  );
  const beneath = rgb((i) => transmission.multiscatter[i] + subsurface.through * subsurface.color[i] * filmed.pass[i]);
  const down = sum(beneath);
  const byFacets = sum(specular) + sum(transmission.albedo);
  const all = byFacets + sum(spread) + down;
  const meanOf = (slopes: Slopes, r: number) =>
    anisotropicAlbedoMean(face.epsilon, slopes, r, energyAlbedoMean(face.epsilon, r));
  const first = meanOf(alpha, roughness);
  const reflected = isHazy ? mix(first, meanOf(haze.alpha, haze.roughness), haze.weight) : first;
  const grazing = diffuseGrazing(p.base_diffuse_roughness, roughness, reflected, face.epsilon);
  const even = diffuseEven(p.base_diffuse_roughness, reflected, face.epsilon);
  const coupling = (even * diffuseGain(grazing, mu)) / Math.max(1 - reflected, 1e-4);
  const coat = prepareCoat(whole, wo, multipleScattering);
  // A highlight comes from about as low as it is seen, spread light from everywhere.
  const highlight = coatPass(coat, mu);
  const everywhere = coatPass(coat, 2 / 3);
  const beyond = coatThrough(coat, transmission.exit, mu);
  const below = rgb(
    (i) => specular[i] * highlight[i] + spread[i] * everywhere[i] + (transmission.albedo[i] + beneath[i]) * beyond[i],
  );
  const total = sum(below) + 3 * coat.albedo;
  const fuzz = prepareFuzz(whole, wo, mu);
  const fibres = sum(fuzz.color);
  const covered = total * fuzz.below;
  return {
    alpha,
    bound: transmission.share > 0 ? 1 : ggxBound(alpha, wo),
    specularProbability: all > 0 ? byFacets / all : 0.5,
    diffuseScale: diffuse * coupling,
    subsurface: { ...subsurface, back: subsurface.back * coupling, through: subsurface.through * coupling },
    diffuseColor: p.base_color,
    diffuseRoughness: p.base_diffuse_roughness,
    diffuseGrazing: grazing,
    albedo: rgb((i) => Math.min((below[i] + coat.albedo) * fuzz.below + fuzz.color[i], 1)),
    metal: {
      f0,
      tint: p.specular_color,
      specularWeight: weight,
      metalness: p.base_metalness,
      roughness,
      multiscatter: metal.multiscatter,
      meanLost: metal.meanLost,
      index,
    },
    dielectric: {
      eta: (1 + face.epsilon) / (1 - face.epsilon),
      epsilon: face.epsilon,
      summed: face.summed,
      roughness,
      scale,
      multiscatter: dielectricMultiscatter,
    },
    film,
    filmPass: filmed.pass,
    transmission,
    thinChance: byFacets > 0 ? sum(specular) / byFacets : 1,
    below: down > 0 ? down / (down + sum(spread)) : 0,
    coat,
    fuzz,
    haze: {
      ...haze,
      bound: transmission.share > 0 ? 1 : haze.bound,
      multiscatter: hazyMetal.multiscatter,
      meanLost: hazyMetal.meanLost,
    },
    retroreflectivity: p.specular_retroreflectivity,
    fuzzProbability: fibres + covered > 0 ? fibres / (fibres + covered) : 0.5,
    coatProbability: total > 0 ? (3 * coat.albedo) / total : 0.5,
  };
}

/** Reflectance of metal with its film, at the cosine `c`; `rise` is how far the film's goes on towards 1. */
export function filmedMetal(
  film: Film,
  index: Bsdf['metal']['index'],
  specularWeight: number,
  c: number,
  clear: OpenPbrColor,
  rise = 0,
): OpenPbrColor {
  if (film.weight <= 0) return clear;
  return rgb((i) => {
    const color = mix(filmReflectance(film, index[i], (1 - c * c) * film.grazing)[i], 1, rise);
    return mix(clear[i], Math.min(specularWeight * color, 1), film.weight);
  });
}
