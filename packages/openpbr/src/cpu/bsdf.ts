import type { OpenPbrColor, OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { coatedBase, coatEmission, coatPass, coatThrough, inCoat, outOfCoat, prepareCoat, type Coat } from './coat';
import { interfaceEnergy, isOverOpaque, isSummed, interfaceAlbedo, summedAlbedoMean } from './dielectric';
import { cosineSample, diffuseEven, diffuseGain, diffuseGrazing, eon } from './diffuse';
import { energyAlbedoMean, conductorLoss, conductorLossMean, stretchedAlbedoMean } from './energy';
import { dielectricEpsilon, fresnelDielectric, fresnelMetal, fresnelMetalMean } from './fresnel';
import { filmFacet, filmReflectance, filmChange, metalIndex, prepareFilm, type ComplexIndex, type Film } from './film';
import { fuzzAlbedo, fuzzDensity, fuzzSample, prepareFuzz, type Fuzz } from './fuzz';
import { ggx, ggxAlpha, ggxBound, ggxSample, halfVector, isSmooth, SPIKE, type Slopes } from './ggx';
import { hazeThrough, mix, mixInterfaces, mixThin, prepareHaze, turned, type Haze } from './haze';
import { prepareThinSubsurface, type ThinSubsurface } from './subsurface';
import {
  prepareTransmission,
  refract,
  refractGgx,
  refractHalf,
  type BsdfSide,
  type Transmission,
} from './transmission';
import { clamp, dot } from './vector';

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

/** A sampled direction; twin of the WGSL struct `OpenPbrSample`. */
export interface BsdfSample {
  readonly wi: OpenPbrVector;
  /**
   * Density per solid angle; 0 if there is no sample. Of delta lobes, which {@link evalPdfBsdf} leaves out, their
   * probability times {@link SPIKE}.
   */
  readonly pdf: number;
  /** f · |cos θ_i| / pdf. */
  readonly weight: OpenPbrColor;
  readonly valid: boolean;
  /** `wi` is on the other side. */
  readonly transmitted: boolean;
  /**
   * Whether the direction enters the subsurface medium, not the transparent interior; the weight includes this choice.
   */
  readonly subsurface: boolean;
}

const rgb = (channel: (i: 0 | 1 | 2) => number): OpenPbrColor => [channel(0), channel(1), channel(2)];
const rgbOf = <T>(channel: (i: 0 | 1 | 2) => T): readonly [T, T, T] => [channel(0), channel(1), channel(2)];
const sum = (color: OpenPbrColor): number => color[0] + color[1] + color[2];

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
    const typical = filmedMetal(film, index, weight, seen, fresnelMetal(f0, p.specular_color, seen, weight));
    const mean = filmedMetal(film, index, weight, 0.7, fresnelMetalMean(f0, p.specular_color, weight));
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
  const filmed = filmChange(film, (1 + face.epsilon) / (1 - face.epsilon), face.albedo, alpha, wo);
  const clear = inside
    ? filmChange(film, (1 + uncoated.epsilon) / (1 - uncoated.epsilon), uncoated.albedo, alpha, wo)
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
  const facets = sum(specular) + sum(transmission.albedo);
  const all = facets + sum(spread) + down;
  const meanOf = (slopes: Slopes, r: number) =>
    stretchedAlbedoMean(
      face.epsilon,
      slopes,
      r,
      face.summed && isOverOpaque(p) ? summedAlbedoMean(face.epsilon, r) : energyAlbedoMean(face.epsilon, r),
    );
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
    specularProbability: all > 0 ? facets / all : 0.5,
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
    thinChance: facets > 0 ? sum(specular) / facets : 1,
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

/** Reflectance of metal with its film. */
function filmedMetal(
  film: Film,
  index: Bsdf['metal']['index'],
  specularWeight: number,
  c: number,
  clear: OpenPbrColor,
): OpenPbrColor {
  if (film.weight <= 0) return clear;
  return rgb((i) =>
    mix(
      clear[i],
      Math.min(specularWeight * filmReflectance(film, index[i], (1 - c * c) * film.grazing)[i], 1),
      film.weight,
    ),
  );
}

/** The reflectance of a facet seen at cosine c, by all microfacet lobes of the base, and its transmittance. */
function facet(b: Bsdf, c: number): { reflected: OpenPbrColor; through: OpenPbrColor } {
  const metal = filmedMetal(
    b.film,
    b.metal.index,
    b.metal.specularWeight,
    c,
    fresnelMetal(b.metal.f0, b.metal.tint, c, b.metal.specularWeight),
  );
  const fresnel = fresnelDielectric(b.dielectric.eta, c);
  const { thin, reflectionEta, fresnelEta, reflection, color } = b.transmission;
  const clear = fresnelDielectric(reflectionEta, c);
  const { weight } = b.film;
  const film = weight > 0 ? filmFacet(b.film, c) : ([0, 0, 0] as const);
  const below = 1 - fresnelDielectric(fresnelEta, c);
  return {
    reflected: rgb(
      (i) =>
        b.metal.metalness * metal[i] +
        b.dielectric.scale[i] * mix(fresnel, film[i], weight) +
        reflection[i] * (thin ? 1 : mix(clear, film[i], weight)),
    ),
    through: rgb((i) => color[i] * (thin ? 1 : below * (1 - (weight * (film[i] - clear)) / Math.max(1 - clear, 1e-6)))),
  };
}

/** Probability that a facet reflects, once it is sampled; else it lets light through. */
function reflectionChance(b: Bsdf, { reflected, through }: ReturnType<typeof facet>): number {
  if (b.transmission.thin) return b.thinChance;
  return sum(through) > 0 ? sum(reflected) / (sum(reflected) + sum(through)) : 1;
}

/** Cosine, and what the interface lets through on the way of the light to the diffuse lobe. */
const diffusePass = (b: Bsdf, wi: OpenPbrVector): number =>
  wi[2] * diffuseGain(b.diffuseGrazing, wi[2]) * (1 - albedoFrom(b, wi));

/** Directional albedo of the interface for light from `wi`. */
function albedoFrom({ dielectric, alpha, haze }: Bsdf, wi: OpenPbrVector): number {
  const first = interfaceAlbedo(dielectric, alpha, wi);
  if (haze.weight <= 0) return first;
  return mix(first, interfaceAlbedo({ ...dielectric, roughness: haze.roughness }, haze.alpha, wi), haze.weight);
}

/** The facet that lets light through from `wi` to `wo`. */
const throughHalf = ({ transmission: { thin, eta } }: Bsdf, wo: OpenPbrVector, wi: OpenPbrVector): OpenPbrVector =>
  thin ? halfVector(wo, [wi[0], wi[1], -wi[2]]) : refractHalf(eta, wo, wi);

/**
 * Densities of the delta lobes of the base, of the coat and of retroreflection: {@link SPIKE} for those that were
 * sampled, else 0.
 */
type Spikes = readonly [base: number, coat: number, back: number];
const NO_SPIKES: Spikes = [0, 0, 0];

/** Value without Fresnel's factor, and density, of one kind of facets or of both by their shares. */
function bothKinds(
  { alpha, haze }: Pick<Bsdf, 'alpha' | 'haze'>,
  lobe: (slopes: Slopes, isHazy: boolean) => readonly [number, number],
  [first, second]: readonly [Slopes, Slopes] = [alpha, haze.alpha],
): readonly [value: number, density: number] {
  const one = lobe(first, false);
  if (haze.weight <= 0) return one;
  const other = lobe(second, true);
  return [mix(one[0], other[0], haze.weight), mix(one[1], other[1], haze.weight)];
}

/** What a facet reflects; the density is without the probability of sampling facets. */
function reflectedBy(
  b: Bsdf,
  wo: OpenPbrVector,
  wi: OpenPbrVector,
  h: OpenPbrVector,
  spike: number,
): { f: OpenPbrColor; pdf: number } {
  const [value, density] = bothKinds(b, (slopes, isHazy) =>
    isSmooth(slopes) ? [spike, spike] : ggx(slopes, wo, wi, h, isHazy ? b.haze.bound : b.bound),
  );
  const sides = facet(b, clamp(dot(wo, h), 0, 1));
  return {
    f: rgb((i) => value * sides.reflected[i]),
    pdf: b.specularProbability * reflectionChance(b, sides) * density,
  };
}

/** `scatter` for directions on the other side. */
function scatterThrough(
  b: Bsdf,
  wo: OpenPbrVector,
  wi: OpenPbrVector,
  h: OpenPbrVector,
  spikes: Spikes,
): { f: OpenPbrColor; pdf: number } {
  if (wo[2] <= 0) return { f: [0, 0, 0], pdf: 0 };
  const { transmission } = b;
  const c = clamp(dot(wo, h), 0, 1);
  const alpha = transmission.thin ? transmission.thinAlpha : b.alpha;
  const [value, density] = bothKinds(
    b,
    (slopes) =>
      isSmooth(slopes)
        ? [spikes[0], spikes[0]]
        : transmission.thin
          ? ggx(slopes, wo, [wi[0], wi[1], -wi[2]], h)
          : refractGgx(transmission.eta, slopes, wo, wi, h),
    [alpha, hazeThrough(transmission, b.haze)],
  );
  const sides = facet(b, c);
  const coat = coatThrough(b.coat, transmission.exit, -wi[2]);
  const cosine = -wi[2] / Math.PI;
  const pdf =
    b.specularProbability * (1 - reflectionChance(b, sides)) * density + (1 - b.specularProbability) * b.below * cosine;
  const mirrored: OpenPbrVector = [wi[0], wi[1], -wi[2]];
  const thinDiffuse = eon(b.subsurface.color, b.diffuseRoughness, wo, mirrored);
  const passes = b.subsurface.through * diffusePass(b, mirrored);
  return {
    f: rgb(
      (i) =>
        (sides.through[i] * value + transmission.multiscatter[i] * cosine + thinDiffuse[i] * passes * b.filmPass[i]) *
        coat[i] *
        b.fuzz.below,
    ),
    pdf: (1 - b.fuzzProbability) * (1 - b.coatProbability) * pdf,
  };
}

function scatter(
  b: Bsdf,
  wo: OpenPbrVector,
  wi: OpenPbrVector,
  h: OpenPbrVector,
  spikes: Spikes,
  backH?: OpenPbrVector,
): { f: OpenPbrColor; pdf: number } {
  if (wi[2] < 0) return scatterThrough(b, wo, wi, h, spikes);
  if (Math.min(wo[2], wi[2]) <= 0) return { f: [0, 0, 0], pdf: 0 };
  const c = clamp(dot(wo, h), 0, 1);
  let light = reflectedBy(b, wo, wi, h, spikes[0]);
  const share = b.retroreflectivity;
  if (share > 0) {
    const back = turned(wi);
    const returned = reflectedBy(b, wo, back, backH ?? halfVector(wo, back), spikes[2]);
    const { f, pdf } = light;
    light = { f: rgb((i) => mix(f[i], returned.f[i], share)), pdf: mix(pdf, returned.pdf, share) };
  }
  const through = b.diffuseScale > 0 || b.subsurface.back > 0 ? diffusePass(b, wi) : 0;
  const metalLobe = (conductorLoss(b.alpha, b.metal.roughness, wi, wi[2]) / b.metal.meanLost / Math.PI) * wi[2];
  const hazyLobe =
    b.haze.weight > 0
      ? (conductorLoss(b.haze.alpha, b.haze.roughness, wi, wi[2]) / b.haze.meanLost / Math.PI) * wi[2]
      : 0;
  const diffuse = eon(b.diffuseColor, b.diffuseRoughness, wo, wi);
  const thinDiffuse = eon(b.subsurface.color, b.diffuseRoughness, wo, wi);
  const { frame } = b.coat;
  const coatWi = inCoat(frame, wi);
  const pass = coatPass(b.coat, Math.max(coatWi[2], 1e-5));
  const [top, topDensity] = isSmooth(b.coat.alpha)
    ? [spikes[1], spikes[1]]
    : coatWi[2] > 0
      ? ggx(b.coat.alpha, inCoat(frame, wo), coatWi, inCoat(frame, h), b.coat.bound)
      : [0, 0];
  const mirrored = b.coat.scale * fresnelDielectric(b.coat.eta, c) * top;
  const fibres = fuzzDensity(b.fuzz, wi);
  const basePdf = light.pdf + ((1 - b.specularProbability) * (1 - b.below) * wi[2]) / Math.PI;
  return {
    f: rgb(
      (i) =>
        (light.f[i] +
          (b.dielectric.multiscatter[i] * wi[2]) / Math.PI +
          metalLobe * b.metal.multiscatter[i] +
          hazyLobe * b.haze.multiscatter[i] +
          through * b.filmPass[i] * (b.diffuseScale * diffuse[i] + b.subsurface.back * thinDiffuse[i])) *
          pass[i] *
          b.fuzz.below +
        mirrored * b.fuzz.below +
        b.fuzz.color[i] * fibres,
    ),
    pdf:
      (basePdf * (1 - b.coatProbability) + topDensity * b.coatProbability) * (1 - b.fuzzProbability) +
      fibres * b.fuzzProbability,
  };
}

/**
 * f · |cos θ_i| and density together, without delta lobes (roughness 0.01 and below); twin of `openpbr_eval_pdf`. `wo` is
 * the one that {@link prepareBsdf} had.
 */
export const evalPdfBsdf = (b: Bsdf, wo: OpenPbrVector, wi: OpenPbrVector): { f: OpenPbrColor; pdf: number } => {
  return wi[2] >= 0
    ? scatter(b, wo, wi, halfVector(wo, wi), NO_SPIKES)
    : scatterThrough(b, wo, wi, throughHalf(b, wo, wi), NO_SPIKES);
};

/** f · |cos θ_i|; twin of `openpbr_eval`. `wo` is the one that {@link prepareBsdf} had. */
export const evalBsdf = (b: Bsdf, wo: OpenPbrVector, wi: OpenPbrVector): OpenPbrColor => evalPdfBsdf(b, wo, wi).f;

/** Density of {@link sampleBsdf} per solid angle; twin of `openpbr_pdf`. */
export const pdfBsdf = (b: Bsdf, wo: OpenPbrVector, wi: OpenPbrVector): number => evalPdfBsdf(b, wo, wi).pdf;

/** A direction for `u` in [0, 1)³; twin of `openpbr_sample`. */
export function sampleBsdf(b: Bsdf, wo: OpenPbrVector, numbers: readonly [number, number, number]): BsdfSample {
  const fuzzy = numbers[2] < b.fuzzProbability;
  const u = [numbers[0], numbers[1], (numbers[2] - b.fuzzProbability) / Math.max(1 - b.fuzzProbability, 1e-7)] as const;
  let h: OpenPbrVector;
  let wi: OpenPbrVector;
  let transmitted = false;
  let medium = 1;
  let spikes = NO_SPIKES;
  let backH: OpenPbrVector | undefined;
  const top = u[2] < b.coatProbability;
  const chosen = u[2] - b.coatProbability;
  const limit = (1 - b.coatProbability) * b.specularProbability;
  if (fuzzy) {
    wi = fuzzSample(b.fuzz, u);
    h = halfVector(wo, wi);
  } else if (top || chosen < limit) {
    const { haze } = b;
    const number = chosen / limit;
    const isHazy = !top && number < haze.weight;
    const side =
      top || haze.weight <= 0
        ? number
        : isHazy
          ? number / haze.weight
          : (number - haze.weight) / Math.max(1 - haze.weight, 1e-7);
    const { thin, thinAlpha, eta } = b.transmission;
    const { frame } = b.coat;
    const kind = isHazy
      ? { alpha: haze.alpha, thinAlpha: hazeThrough(b.transmission, haze), bound: haze.bound }
      : { alpha: b.alpha, thinAlpha, bound: b.bound };
    const alpha = top ? b.coat.alpha : thin && side >= b.thinChance ? kind.thinAlpha : kind.alpha;
    h = top
      ? outOfCoat(frame, ggxSample(alpha, inCoat(frame, wo), u, b.coat.bound))
      : ggxSample(alpha, wo, u, kind.bound);
    // Where both have one normal, deltas of the coat and the base are one direction.
    const isOne = !frame || Math.fround(frame[2][2]) >= 1;
    if (isSmooth(alpha)) spikes = [isOne || !top ? SPIKE : 0, isOne || top ? SPIKE : 0, 0];
    const c = dot(wo, h);
    wi = [2 * c * h[0] - wo[0], 2 * c * h[1] - wo[1], 2 * c * h[2] - wo[2]];
    const chance = reflectionChance(b, facet(b, clamp(c, 0, 1)));
    transmitted = !top && side >= chance;
    medium = (side - chance) / (1 - chance);
    if (transmitted) wi = thin ? [wi[0], wi[1], -wi[2]] : (refract(eta, wo, h) ?? [0, 0, 0]);
    // A facet may reflect downwards or refract upwards, and downwards of the coat is not that of the base: lost.
    if (transmitted !== wi[2] < 0 || (top && inCoat(frame, wi)[2] <= 0))
      return { wi, pdf: 0, weight: [0, 0, 0], valid: false, transmitted, subsurface: false };
    // Of those that reflect, some return.
    if (!top && !transmitted && side < chance * b.retroreflectivity) {
      wi = turned(wi);
      backH = h;
      h = halfVector(wo, wi);
      spikes = [0, 0, isSmooth(alpha) ? SPIKE : 0];
    }
  } else {
    wi = cosineSample(u);
    const down = b.below * (1 - b.coatProbability - limit);
    transmitted = chosen - limit < down;
    medium = (chosen - limit) / down;
    if (transmitted) wi = [wi[0], wi[1], -wi[2]];
    h = transmitted ? throughHalf(b, wo, wi) : halfVector(wo, wi);
  }
  const { f, pdf } = scatter(b, wo, wi, h, spikes, backH);
  if (!(pdf > 0)) return { wi, pdf: 0, weight: [0, 0, 0], valid: false, transmitted, subsurface: false };
  const { subsurface: part, subsurfaceChance: enters } = b.transmission;
  const subsurface = transmitted && medium < enters;
  // The weight is for the medium that was chosen.
  const chosenPart = (i: 0 | 1 | 2): number =>
    !transmitted || enters === 0 ? 1 : subsurface ? part[i] / enters : (1 - part[i]) / (1 - enters);
  return { wi, pdf, weight: rgb((i) => (f[i] / pdf) * chosenPart(i)), valid: true, transmitted, subsurface };
}

/** Reflected and transmitted part of uniform light; twin of `openpbr_albedo`. */
export const albedoBsdf = (b: Bsdf, wo: OpenPbrVector): OpenPbrColor => (wo[2] > 0 ? b.albedo : [0, 0, 0]);

/** Radiance that leaves towards `wo`; twin of `openpbr_emission`. */
export function emittedRadiance(p: OpenPbrParameters, wo: OpenPbrVector): OpenPbrColor {
  if (wo[2] <= 0) return [0, 0, 0];
  const pass = coatEmission(p, wo);
  return rgb(
    (i) =>
      p.emission_color[i] * p.emission_luminance * pass[i] * (1 - p.fuzz_weight * fuzzAlbedo(p.fuzz_roughness, wo[2])),
  );
}
