import { describe, expect } from 'vitest';
import { coatedBase, evalBsdf, ggxAlpha, ggxMasking, ggxMaskingShadowing, prepareBsdf, type Slopes } from '../src/cpu/index';
import { resolveParameters, type OpenPbrParameters, type OpenPbrVector } from '../src/parameters/index';
import { direction, furnace, integrateHemisphere } from './integrate';
import { oracle, sharedIt, sharedPresent, type OraclePair, type OracleSetting } from './shared';

// The parameters of the lobes that exist. Settings that touch others wait for those lobes.
const KNOWN = /^(base_|specular_|coat_|emission_|geometry_opacity$|geometry_tangent$)/;

/** The oracle disagrees with the specification's text here, and its notes say to follow the text. */
const FOLLOWS_TEXT_INSTEAD = ['eon_half_weight'];

const settings = sharedPresent ? oracle().settings.filter((s) => Object.keys(s.params).every((name) => KNOWN.test(name))) : [];

/** The host turns directions into the frame of the tangent. */
function frameOf({ params }: OracleSetting): (v: OpenPbrVector) => OpenPbrVector {
  const [x, y] = params.geometry_tangent ?? [1, 0, 0];
  return (v) => [x * v[0] + y * v[1], x * v[1] - y * v[0], v[2]];
}

function parametersOf({ params }: OracleSetting): OpenPbrParameters {
  return resolveParameters(params);
}

/** The microfacet lobe alone, single scattering. */
function specularOf(p: OpenPbrParameters, wo: OpenPbrVector, wi: OpenPbrVector): readonly number[] {
  return evalBsdf({ ...prepareBsdf(p, wo, { multipleScattering: false }), diffuseScale: 0 }, wo, wi);
}

/** The coat's lobe alone, single scattering. */
function coatOf(p: OpenPbrParameters, wo: OpenPbrVector, wi: OpenPbrVector): readonly number[] {
  return evalBsdf(prepareBsdf({ ...p, base_weight: 0, specular_weight: 0 }, wo, { multipleScattering: false }), wo, wi);
}

/** The oracle's microfacet lobe, brought to height-correlated masking. */
const expectedSpecular = (pair: OraclePair): readonly number[] | undefined => {
  const lobe = pair.L === 'spec' ? pair.f : pair.L?.spec;
  return lobe?.map((value) => value * (pair.k ?? 1));
};
const expectedTotal = (pair: OraclePair): readonly number[] => {
  const lobes = pair.L === 'spec' ? { spec: pair.f } : pair.L;
  return pair.f.map((value, i) => value + (lobes?.spec?.[i] ?? 0) * (lobes?.base_scale?.[i] ?? 1) * ((pair.k ?? 1) - 1) + (lobes?.coat?.[i] ?? 0) * ((pair.kc ?? 1) - 1));
};

/**
 * What the microfacet lobe reflects more with height-correlated masking than with the oracle's separable one. White
 * surfaces get it back by multiple scattering in either convention, dark ones never: the truth is between none and all.
 */
function gainOfCorrelation(p: OpenPbrParameters, wo: OpenPbrVector): number[] {
  const base = coatedBase(p);
  const alpha = ggxAlpha(base.specular_roughness, base.specular_roughness_anisotropy);
  const coatAlpha = ggxAlpha(p.coat_roughness, p.coat_roughness_anisotropy);
  const lost = (slopes: Slopes, wi: OpenPbrVector) => 1 - (ggxMasking(slopes, wo) * ggxMasking(slopes, wi)) / ggxMaskingShadowing(slopes, wo, wi);
  return integrateHemisphere(p, wo, (wi) => {
    const coat = p.coat_weight > 0 ? coatOf(p, wo, wi) : [0, 0, 0];
    return specularOf(p, wo, wi).map((value, i) => (value - (coat[i] as number)) * lost(alpha, wi) + (coat[i] as number) * lost(coatAlpha, wi));
  }, 40);
}

const quantile = (values: readonly number[], q: number): number => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(q * values.length))] as number;

describe('against an independent implementation', () => {
  sharedIt('has at least twenty settings to compare', () => {
    expect(settings.length).toBeGreaterThanOrEqual(20);
  });

  for (const setting of settings) {
    const p = parametersOf(setting);
    const turn = frameOf(setting);
    const { f: tolerance, albedo: albedoTolerance, lobes } = setting.tol;
    const pairs = setting.pairs.map((pair) => ({ pair, wo: turn(setting.wo[pair.o] as OpenPbrVector), wi: turn(pair.wi) })).filter(({ wo }) => wo[2] > 0);
    // Near-delta: a direction's last digits decide.
    const tame = pairs.filter(({ pair }) => !(Math.max(...(expectedSpecular(pair) ?? [0]), ...((pair.L !== 'spec' && pair.L?.coat) || [0])) > 100));

    if (lobes.spec) {
      sharedIt(`${setting.id}: every pair of the microfacet lobe`, () => {
        const { rel, abs } = lobes.spec as { rel: number; abs: number };
        let compared = 0;
        for (const { pair, wo, wi } of tame) {
          const expected = expectedSpecular(pair) ?? [0, 0, 0];
          specularOf(p, wo, wi).forEach((value, i) => {
            const other = expected[i] as number;
            expect(Math.abs(value - other), `${value} for ${other} at wo ${wo.join(' ')}, wi ${wi.join(' ')}`).toBeLessThanOrEqual(Math.max(rel * Math.max(value, other), abs));
            if (other > abs) compared++;
          });
        }
        expect(compared).toBeGreaterThan(10);
      });
    }

    if (lobes.coat) {
      sharedIt(`${setting.id}: every pair of the coat's lobe`, () => {
        const { rel, abs } = lobes.coat as { rel: number; abs: number };
        let compared = 0;
        for (const { pair, wo, wi } of tame) {
          const expected = pair.L === 'spec' ? 0 : (pair.L?.coat?.[0] ?? 0) * (pair.kc ?? 1);
          const value = coatOf(p, wo, wi)[0] as number;
          expect(Math.abs(value - expected), `${value} for ${expected} at wo ${wo.join(' ')}, wi ${wi.join(' ')}`).toBeLessThanOrEqual(Math.max(rel * Math.max(value, expected), abs));
          if (expected > abs) compared++;
        }
        expect(compared).toBeGreaterThan(10);
      });
    }

    if (tolerance && !FOLLOWS_TEXT_INSTEAD.includes(setting.id)) {
      sharedIt(`${setting.id}: all lobes together (class ${tolerance.cls})`, () => {
        const differences: number[] = [];
        for (const { pair, wo, wi } of tame) {
          const b = prepareBsdf(p, wo);
          const expected = expectedTotal(pair);
          evalBsdf(b, wo, wi).forEach((value, i) => {
            const other = expected[i] as number;
            if (tolerance.cls === 'S') {
              expect(Math.abs(value - other), `${value} for ${other} at wo ${wo.join(' ')}, wi ${wi.join(' ')}`).toBeLessThanOrEqual(Math.max((tolerance.rel ?? 0) * Math.max(value, other), tolerance.abs ?? 0));
            } else differences.push(Math.abs(value - other) / Math.max(value, other, 0.02));
          });
        }
        if (tolerance.cls === 'S') return;
        expect(quantile(differences, 0.5), 'median').toBeLessThanOrEqual(tolerance.median ?? 0);
        expect(quantile(differences, 0.9), '90th percentile').toBeLessThanOrEqual(tolerance.p90 ?? 0);
      });
    }

    if (!FOLLOWS_TEXT_INSTEAD.includes(setting.id)) sharedIt(`${setting.id}: reflected part of uniform light`, () => {
      for (const { mu, R, se } of setting.albedo) {
        if (mu <= 0) continue;
        const wo = turn(direction(mu, (25 * Math.PI) / 180));
        const { albedo } = furnace(p, wo, {}, 40);
        const gain = gainOfCorrelation(p, wo);
        albedo.forEach((value, i) => {
          const other = R[i] as number;
          const slack = Math.max(albedoTolerance.rel * other, albedoTolerance.abs) + 4 * se[0];
          expect(value, `at cosine ${mu}, for ${other} and ${gain[i]}`).toBeGreaterThanOrEqual(other - slack);
          expect(value, `at cosine ${mu}, for ${other} and ${gain[i]}`).toBeLessThanOrEqual(other + (gain[i] as number) + slack);
        });
      }
    });
  }
});
