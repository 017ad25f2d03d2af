import type { OpenPbrColor, OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { coatEmission, coatPass, coatThrough, inCoat, outOfCoat } from './coat';
import { interfaceAlbedo } from './dielectric';
import { cosineSample, diffuseGain, eon } from './diffuse';
import { conductorLoss } from './energy';
import { fresnelDielectric, fresnelMetal } from './fresnel';
import { filmFacet } from './film';
import { fuzzAlbedo, fuzzDensity, fuzzSample } from './fuzz';
import { ggx, ggxSample, halfVector, isSmooth, SPIKE, type Slopes } from './ggx';
import { hazeThrough, mix, turned } from './haze';
import { refract, refractGgx, refractHalf } from './transmission';
import { filmedMetal, type Bsdf } from './prepare';
import { clamp, dot, rgb, sum } from './vector';

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
