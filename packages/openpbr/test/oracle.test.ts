import { describe, expect, it } from 'vitest';
import {
  coatDarkening,
  coatedBase,
  dielectricEpsilon,
  dispersedIor,
  evalBsdf,
  fresnelMean,
  ggxAlpha,
  ggxMasking,
  ggxMaskingShadowing,
  prepareBsdf,
  type BsdfOptions,
  type Slopes,
} from '../src/cpu/index';
import { resolveParameters, type OpenPbrParameters, type OpenPbrVector } from '../src/parameters/index';
import { direction, integrateHemisphere } from './integrate';
import { resultsOf } from './results';
import { inSample } from './sample';
import { deltaParts, sphereFurnace } from './sphere';
import { oracle, type OraclePair, type OracleSetting } from './oracle/index';

// The parameters of the lobes that exist. Settings that touch others wait for those lobes.
const KNOWN =
  /^(base_|specular_|transmission_|subsurface_|coat_|fuzz_|thin_film_|emission_|geometry_opacity$|geometry_tangent$|geometry_thin_walled$|exterior_ior$)/;

/** Of the quadratures of albedos: with 32 they differ from those with 40 by at most 0.15 of what is allowed. */
const STEPS = process.env['GLANZ_FULL'] === undefined ? 32 : 40;

/** The oracle's albedo disagrees with the specification's text here, and its notes say to follow the text. */
const FOLLOWS_TEXT_INSTEAD = ['eon_half_weight'];

/**
 * Rough thin walls: the oracle loses or makes energy, and its notes say not to follow; and light that goes through
 * comes out of a narrower lobe here, since two refractions mostly undo each other.
 */
const THIN_WALLS = ['glass_thin_r02', 'glass_thin_r06', 'kitchen_thin'];

/** Paper: there it returns up to 9 % more than it gets. */
const PAPER = ['sss_thin', 'kitchen_thin'];

/** There, fuzz roughens the coat below it, which the specification does not ask for. */
const ROUGHENED_BY_FUZZ = ['fuzz_over_coat'];

/** The oracle refracts three wavelengths at once; here the host picks one, and evaluates the surface with its index. */
const DISPERSED = ['glass_dispersion'];
const WAVELENGTHS = [620, 540, 450] as const;

/**
 * There, a coat darkens metal by its mean reflectance, here by that at the viewer's angle (the specification's K_s):
 * near the horizon that is darker.
 */
const DARKER_AT_HORIZON = ['film_half_coated'];

/**
 * Median and 90th percentile of the differences where we differ by choice. Both sides are exact: what differs are the
 * models, so no error estimate bounds it. As measured, rounded up, which notices when either changes.
 */
// Thin walls: see above. Dispersion: what bounces among the facets leaves evenly here, there by a lobe that avoids the
// normal.
const LISTED: Readonly<Record<string, readonly [median: number, p90: number]>> = {
  glass_thin_r02: [0.015, 0.68],
  glass_thin_r06: [0.36, 0.68],
  kitchen_thin: [0.09, 0.46],
  glass_dispersion: [0.002, 0.06],
};

/**
 * Largest difference of the reflected or transmitted part of uniform light where we differ by choice: as above.
 */
// Thin walls: light that two rough faces let through or lose. Weight: there it is inside of EON, whose bounces are then
// darker.
const LISTED_ALBEDO: Readonly<Record<string, number>> = {
  eon_half_weight: 0.05,
  glass_thin_r02: 0.1,
  glass_thin_r06: 0.46,
  sss_thin: 0.12,
  kitchen_thin: 0.1,
};

/**
 * There, films are evaluated at the wavelengths above; here, over the visible spectrum, or for comparison as there.
 * Both hold for f.
 */
const hasFilm = ({ params }: OracleSetting): boolean => (params.thin_film_weight ?? 0) > 0;

const settings = oracle().settings.filter((s) => Object.keys(s.params).every((name) => KNOWN.test(name)));

/** The host turns directions into the frame of the tangent. */
function frameOf({ params }: OracleSetting): (v: OpenPbrVector) => OpenPbrVector {
  const [x, y] = params.geometry_tangent ?? [1, 0, 0];
  return (v) => [x * v[0] + y * v[1], x * v[1] - y * v[0], v[2]];
}

function parametersOf({ params: { exterior_ior: _, ...params } }: OracleSetting): OpenPbrParameters {
  return resolveParameters(params);
}

/** The host turns the frame towards the viewer, about the tangent, so that +z is on the viewer's side. */
const over = ([x, y, z]: OpenPbrVector): OpenPbrVector => [x, -y, -z];

/** The surfaces of a setting to compare: one surface, or for dispersion one per channel. */
function surfacesOf(setting: OracleSetting): { p: OpenPbrParameters; channels: readonly number[] }[] {
  const p = parametersOf(setting);
  if (!DISPERSED.includes(setting.id)) return [{ p, channels: [0, 1, 2] }];
  return WAVELENGTHS.map((wavelength, i) => ({
    p: { ...p, specular_ior: dispersedIor(p, wavelength) },
    channels: [i],
  }));
}

/** The microfacet lobe alone, single scattering, as a function of ω_i: for one ω_o the surface is prepared once. */
function specularLobe(p: OpenPbrParameters, wo: OpenPbrVector, side: BsdfOptions = {}) {
  const bsdf = prepareBsdf({ ...p, fuzz_weight: 0 }, wo, { multipleScattering: false, ...side });
  const specular = { ...bsdf, diffuseScale: 0 };
  return (wi: OpenPbrVector): readonly number[] => evalBsdf(specular, wo, wi);
}

/** The coat's lobe alone, single scattering, as a function of ω_i. */
function coatLobe(p: OpenPbrParameters, wo: OpenPbrVector) {
  const bare = { ...p, base_weight: 0, specular_weight: 0, fuzz_weight: 0 };
  const bsdf = prepareBsdf(bare, wo, { multipleScattering: false });
  return (wi: OpenPbrVector): readonly number[] => evalBsdf(bsdf, wo, wi);
}

/** The oracle's microfacet lobe, brought to height-correlated masking; where it does not say by which factor, ours. */
const expectedSpecular = (pair: OraclePair, k = 1): readonly number[] | undefined => {
  const lobe = pair.L === 'spec' ? pair.f : pair.L?.spec;
  return lobe?.map((value) => value * (pair.k ?? k));
};
function correlationOf(p: OpenPbrParameters, wo: OpenPbrVector, wi: OpenPbrVector): number {
  if (wi[2] < 0) return 1;
  const alpha = ggxAlpha(p.specular_roughness, p.specular_roughness_anisotropy);
  return ggxMaskingShadowing(alpha, wo, wi) / (ggxMasking(alpha, wo) * ggxMasking(alpha, wi));
}
const expectedTotal = (pair: OraclePair): readonly number[] => {
  const lobes = pair.L === 'spec' ? { spec: pair.f } : pair.L;
  return pair.f.map(
    (value, i) =>
      value +
      (lobes?.spec?.[i] ?? 0) * (lobes?.base_scale?.[i] ?? 1) * ((pair.k ?? 1) - 1) +
      (lobes?.coat?.[i] ?? 0) * ((pair.kc ?? 1) - 1),
  );
};

/**
 * What the microfacet lobe reflects more with height-correlated masking than with the oracle's separable one. White
 * surfaces get it back by multiple scattering in either convention, dark ones never: the truth is between none and all.
 */
function gainOfCorrelation(p: OpenPbrParameters, wo: OpenPbrVector, side: BsdfOptions): number[] {
  const base = coatedBase(p);
  const alpha = ggxAlpha(base.specular_roughness, base.specular_roughness_anisotropy);
  const coatAlpha = ggxAlpha(p.coat_roughness, p.coat_roughness_anisotropy);
  const lost = (slopes: Slopes, wi: OpenPbrVector) =>
    1 - (ggxMasking(slopes, wo) * ggxMasking(slopes, wi)) / ggxMaskingShadowing(slopes, wo, wi);
  const specularOf = specularLobe(p, wo, side);
  const coatOf = p.coat_weight > 0 ? coatLobe(p, wo) : () => [0, 0, 0];
  return integrateHemisphere(
    p,
    wo,
    (wi) => {
      const coat = coatOf(wi);
      return specularOf(wi).map(
        (value, i) => (value - (coat[i] as number)) * lost(alpha, wi) + (coat[i] as number) * lost(coatAlpha, wi),
      );
    },
    STEPS,
  );
}

/** Directional albedo of an opaque surface. */
function reflectedPart(p: OpenPbrParameters, wo: OpenPbrVector, side: BsdfOptions): number[] {
  const bsdf = prepareBsdf(p, wo, side);
  return integrateHemisphere(p, wo, (wi) => evalBsdf(bsdf, wo, wi), STEPS);
}

/** The reflected light with the coat's darkening by its mean reflectance, for metal below it. */
function darkenedEvenly(p: OpenPbrParameters, wo: OpenPbrVector, reflected: readonly number[]): number[] {
  const coat = integrateHemisphere(p, wo, coatLobe(p, wo), 24);
  const epsilon = dielectricEpsilon(p.coat_ior, 1);
  const roughness = coatedBase(p).specular_roughness;
  const kept = fresnelMean(epsilon) * (1 - roughness) + fresnelMean(-epsilon) * roughness;
  const ours = coatDarkening(p, wo[2]);
  return reflected.map((value, i) => {
    const albedo = p.base_weight * (p.base_color[i] as number) * p.specular_weight;
    const even = 1 + p.coat_weight * p.coat_darkening * ((1 - kept) / (1 - kept * albedo) - 1);
    return (coat[i] as number) + ((value - (coat[i] as number)) * even) / (ours[i] as number);
  });
}

const quantile = (values: readonly number[], q: number): number =>
  [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(q * values.length))] as number;

describe('against an independent implementation', () => {
  // Albedos at each second angle, of one setting these and of the next the others; with GLANZ_FULL at all.
  const record = resultsOf('oracle');
  it('has at least twenty settings to compare', () => {
    expect(settings.length).toBeGreaterThanOrEqual(20);
  });

  for (const [index, setting] of settings.entries()) {
    const turn = frameOf(setting);
    const { f: tolerance, albedo: albedoTolerance, lobes } = setting.tol;
    const thin = setting.params.geometry_thin_walled ?? false;
    const sideOf = (z: number): BsdfOptions => ({
      inside: z < 0 && !thin,
      outerIor: setting.params.exterior_ior ?? 1,
      ...(hasFilm(setting) ? { filmWavelengths: WAVELENGTHS } : {}),
    });
    const clear = (setting.params.transmission_weight ?? 0) + (setting.params.subsurface_weight ?? 0) > 0;
    const pairs = setting.pairs
      .map((pair) => {
        const wo = turn(setting.wo[pair.o] as OpenPbrVector);
        const [up, side] = [wo[2] > 0, sideOf(wo[2])];
        return { pair, side, wo: up ? wo : over(wo), wi: up ? turn(pair.wi) : over(turn(pair.wi)), up };
      })
      .filter(({ up }) => up || clear);
    // Near-delta: a direction's last digits decide.
    const tame = pairs.filter(
      ({ pair }) =>
        !(Math.max(...(expectedSpecular(pair) ?? [0]), ...((pair.L !== 'spec' && pair.L?.coat) || [0])) > 100),
    );
    const each = (
      compare: (p: OpenPbrParameters, channels: readonly number[], pair: (typeof tame)[number]) => void,
    ) => {
      for (const { p, channels } of surfacesOf(setting)) for (const pair of tame) compare(p, channels, pair);
    };

    if (lobes.spec) {
      it(`${setting.id}: every pair of the microfacet lobe`, () => {
        const { rel, abs } = lobes.spec as { rel: number; abs: number };
        let compared = 0;
        each((p, channels, { pair, wo, wi, side }) => {
          const expected = expectedSpecular(pair, side.inside ? correlationOf(p, wo, wi) : 1) ?? [0, 0, 0];
          const values = specularLobe(p, wo, side)(wi);
          for (const i of channels) {
            const [value, other] = [values[i] as number, expected[i] as number];
            expect(
              Math.abs(value - other),
              `${value} for ${other} at wo ${wo.join(' ')}, wi ${wi.join(' ')}`,
            ).toBeLessThanOrEqual(Math.max(rel * Math.max(value, other), abs));
            if (other > abs) compared++;
          }
        });
        expect(compared).toBeGreaterThan(10);
      });
    }

    if (lobes.coat && !ROUGHENED_BY_FUZZ.includes(setting.id)) {
      it(`${setting.id}: every pair of the coat's lobe`, () => {
        const { rel, abs } = lobes.coat as { rel: number; abs: number };
        let compared = 0;
        each((p, _, { pair, wo, wi, up }) => {
          if (!up || wi[2] < 0) return;
          const expected = pair.L === 'spec' ? 0 : (pair.L?.coat?.[0] ?? 0) * (pair.kc ?? 1);
          const value = coatLobe(p, wo)(wi)[0] as number;
          expect(
            Math.abs(value - expected),
            `${value} for ${expected} at wo ${wo.join(' ')}, wi ${wi.join(' ')}`,
          ).toBeLessThanOrEqual(Math.max(rel * Math.max(value, expected), abs));
          if (expected > abs) compared++;
        });
        expect(compared).toBeGreaterThan(10);
      });
    }

    const listed = setting.id in LISTED;
    if (tolerance && listed) {
      it(`${setting.id}: all lobes together differ by choice, by no more than is listed`, () => {
        const differences: number[] = [];
        each((p, channels, { pair, wo, wi, side }) => {
          const expected = expectedTotal(pair);
          const values = evalBsdf(prepareBsdf(p, wo, side), wo, wi);
          for (const i of channels)
            differences.push(
              Math.abs((values[i] as number) - (expected[i] as number)) /
                Math.max(values[i] as number, expected[i] as number, 0.02),
            );
        });
        const worst = Math.max(...differences);
        const [median, p90] = [quantile(differences, 0.5), quantile(differences, 0.9)];
        record(`${setting.id} (ours by choice)`, {
          class: tolerance.cls,
          pairs: tame.length,
          worst,
          median,
          p90,
          limit: tolerance.cls === 'I' ? [tolerance.median, tolerance.p90] : [tolerance.rel, tolerance.abs],
          listed,
        });
        const [max, max90] = LISTED[setting.id] as readonly [number, number];
        expect(median).toBeLessThanOrEqual(max);
        expect(p90).toBeLessThanOrEqual(max90);
      });
    }
    if (tolerance && !listed) {
      for (const spectrum of hasFilm(setting) ? [false, true] : [false])
        it(`${setting.id}: all lobes together (class ${tolerance.cls})${spectrum ? ', over the spectrum' : ''}`, () => {
          const differences: number[] = [];
          const close: boolean[] = [];
          let worst = 0;
          each((p, channels, { pair, wo, wi, side }) => {
            const expected = expectedTotal(pair);
            const values = evalBsdf(
              prepareBsdf(p, wo, spectrum ? { ...side, filmWavelengths: undefined } : side),
              wo,
              wi,
            );
            for (const i of channels) {
              const [value, other] = [values[i] as number, expected[i] as number];
              worst = Math.max(worst, Math.abs(value - other) / Math.max(value, other, 0.02));
              if (tolerance.cls === 'S') {
                expect(
                  Math.abs(value - other),
                  `${value} for ${other} at wo ${wo.join(' ')}, wi ${wi.join(' ')}`,
                ).toBeLessThanOrEqual(Math.max((tolerance.rel ?? 0) * Math.max(value, other), tolerance.abs ?? 0));
              } else if (tolerance.cls === 'R')
                close.push(
                  Math.abs(value - other) <=
                    Math.max(2 * (tolerance.rel ?? 0) * Math.max(value, other), tolerance.abs ?? 0),
                );
              else differences.push(Math.abs(value - other) / Math.max(value, other, 0.02));
            }
          });
          const key = `${setting.id}${spectrum ? ', over the spectrum' : ''}`;
          const summary = {
            class: tolerance.cls,
            pairs: tame.length,
            worst,
            limit: tolerance.cls === 'I' ? [tolerance.median, tolerance.p90] : [tolerance.rel, tolerance.abs],
          };
          if (tolerance.cls === 'S') return record(key, summary);
          // The recommended model: nearly every pair, at twice the tolerance of its published table.
          if (tolerance.cls === 'R') {
            const part = close.filter(Boolean).length / close.length;
            record(key, { ...summary, part });
            return expect(part).toBeGreaterThanOrEqual(0.95);
          }
          record(key, { ...summary, median: quantile(differences, 0.5), p90: quantile(differences, 0.9) });
          expect(quantile(differences, 0.5), 'median').toBeLessThanOrEqual(tolerance.median ?? 0);
          expect(quantile(differences, 0.9), '90th percentile').toBeLessThanOrEqual(tolerance.p90 ?? 0);
        });
    }

    if (setting.id in LISTED_ALBEDO) {
      it(`${setting.id}: parts of uniform light differ by choice, by no more than is listed, and no light is made or lost but by colour`, () => {
        let [worst, beyond, angles] = [0, 0, 0];
        const p = parametersOf(setting);
        const white = {
          base_weight: 1,
          base_color: [1, 1, 1],
          transmission_color: [1, 1, 1],
          subsurface_color: [1, 1, 1],
        } as const;
        for (const [k, { mu, R, T, se }] of setting.albedo.entries()) {
          if (!inSample(2, index, k)) continue;
          const wo = direction(Math.abs(mu), (25 * Math.PI) / 180);
          if (mu < 0 && !clear) continue;
          const { reflected, transmitted } = sphereFurnace(p, mu > 0 ? wo : [wo[0], -wo[1], wo[2]], {}, 40);
          const differences = [0, 1, 2]
            .map(
              (i) =>
                [
                  [reflected[i], R[i], se[0]],
                  [transmitted[i], T[i], se[1]],
                ] as [number, number, number][],
            )
            .flat();
          worst = Math.max(worst, ...differences.map(([a, b]) => Math.abs(a - b)));
          if (
            differences.some(
              ([a, b, error]) => Math.abs(a - b) > Math.max(albedoTolerance.rel * b, albedoTolerance.abs) + 4 * error,
            )
          )
            beyond++;
          angles++;
          const all = sphereFurnace({ ...p, ...white }, wo, {}, 40);
          // EON is not as even as Lambert, which the coupling below gloss assumes (README).
          expect(Math.abs(all.reflected[1] + all.transmitted[1] - 1), `white, at cosine ${mu}`).toBeLessThan(0.012);
        }
        record(`albedo: ${setting.id}`, { angles, beyond, worst, limit: [albedoTolerance.rel, albedoTolerance.abs] });
        expect(worst).toBeLessThanOrEqual(LISTED_ALBEDO[setting.id] as number);
      });
    }

    if (!FOLLOWS_TEXT_INSTEAD.includes(setting.id) && ![...THIN_WALLS, ...PAPER].includes(setting.id)) {
      it(`${setting.id}: reflected and transmitted parts of uniform light`, () => {
        for (const [k, { mu, R, T, se }] of setting.albedo.entries()) {
          if ((mu <= 0 && !clear) || !inSample(2, index, k)) continue;
          const side = sideOf(mu);
          const azimuth = (25 * Math.PI) / 180;
          const wo = mu > 0 ? turn(direction(mu, azimuth)) : over(turn(direction(mu, azimuth)));
          for (const { p, channels } of surfacesOf(setting)) {
            const ours = clear
              ? sphereFurnace(p, wo, side, STEPS)
              : { reflected: reflectedPart(p, wo, side), transmitted: [0, 0, 0] };
            const deltas = deltaParts(p, wo, side);
            const transmitted = ours.transmitted.map((value, i) => value + (deltas.transmitted[i] as number));
            const spread = DARKER_AT_HORIZON.includes(setting.id)
              ? darkenedEvenly(p, wo, ours.reflected)
              : ours.reflected;
            const reflected = spread.map((value, i) => value + (deltas.reflected[i] as number));
            const gain = gainOfCorrelation(p, wo, side);
            for (const i of channels) {
              const slack = (other: number, error: number) =>
                Math.max(albedoTolerance.rel * other, albedoTolerance.abs) + 4 * error;
              const [r, t, more] = [R[i] as number, T[i] as number, gain[i] as number];
              expect(reflected[i], `reflected at cosine ${mu}, for ${r} and ${more}`).toBeGreaterThanOrEqual(
                r - slack(r, se[0]),
              );
              expect(reflected[i], `reflected at cosine ${mu}, for ${r} and ${more}`).toBeLessThanOrEqual(
                r + more + slack(r, se[0]),
              );
              expect(transmitted[i], `transmitted at cosine ${mu}, for ${t} less ${more}`).toBeGreaterThanOrEqual(
                t - more - slack(t, se[1]),
              );
              expect(transmitted[i], `transmitted at cosine ${mu}, for ${t}`).toBeLessThanOrEqual(t + slack(t, se[1]));
            }
          }
        }
      });
    }
  }
});
