import { describe, expect, it } from 'vitest';
import { evalPdfBsdf, pdfBsdf, prepareBsdf, sampleBsdf, type Bsdf } from '../src/cpu/index';
import { resolveParameters, type OpenPbrParameters, type OpenPbrVector } from '../src/parameters/index';
import { direction, furnace } from './integrate';
import { anyCoated, anySurface, uniform, upperDirection, withLobes } from './random';

const SURFACES: readonly (readonly [string, Partial<OpenPbrParameters>])[] = [
  ['the default', {}],
  ['plain diffuse', { specular_weight: 0 }],
  ['rough dielectric over rough diffuse', { specular_roughness: 0.8, base_diffuse_roughness: 1 }],
  ['metal', { base_metalness: 1, base_color: [0.9, 0.6, 0.3], specular_roughness: 0.35 }],
  ['very rough metal', { base_metalness: 1, specular_roughness: 1 }],
  ['anisotropic metal', { base_metalness: 1, specular_roughness: 0.5, specular_roughness_anisotropy: 0.7 }],
  ['coat over diffuse', { specular_weight: 0, coat_weight: 1, coat_roughness: 0.4, coat_color: [0.9, 0.5, 0.2] }],
  [
    'anisotropic half coat over metal',
    {
      base_metalness: 1,
      specular_roughness: 0.5,
      coat_weight: 0.5,
      coat_roughness: 0.6,
      coat_roughness_anisotropy: 0.6,
    },
  ],
  ['coat over the default', { coat_weight: 1, coat_roughness: 0.35 }],
  ['hazy metal', { base_metalness: 1, specular_roughness: 0.3, specular_haze: 0.5, specular_haze_spread: 0.5 }],
  ['retroreflection over diffuse', { specular_roughness: 0.4, specular_retroreflectivity: 0.6 }],
  [
    'haze and retroreflection of anisotropic half metal below a coat',
    {
      base_metalness: 0.5,
      specular_roughness: 0.4,
      specular_roughness_anisotropy: 0.5,
      specular_haze: 0.3,
      specular_retroreflectivity: 0.5,
      coat_weight: 0.6,
      coat_roughness: 0.4,
    },
  ],
  ['half metal of a high index', { base_metalness: 0.5, specular_ior: 2.2, specular_roughness: 0.5 }],
];
/** Left out by default: lobes that others of {@link SURFACES} contain, and that proofs.test.ts samples alone. */
const ALONE = ['the default', 'plain diffuse', 'metal', 'very rough metal', 'coat over diffuse'];
const FULL = process.env['GLANZ_FULL'] !== undefined;
const VIEWS: readonly OpenPbrVector[] = [direction(0.9), direction(0.25)];
const SAMPLES = 100_000;

/** Upper tail of the chi-square distribution (Wilson and Hilferty's approximation). */
function tail(chiSquare: number, freedom: number): number {
  const z = (Math.cbrt(chiSquare / freedom) - (1 - 2 / (9 * freedom))) / Math.sqrt(2 / (9 * freedom));
  // Complementary error function, Abramowitz and Stegun 7.1.26.
  const x = Math.abs(z) / Math.SQRT2;
  const t = 1 / (1 + 0.3275911 * x);
  const erfc =
    t *
    (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429)))) *
    Math.exp(-x * x);
  return z > 0 ? erfc / 2 : 1 - erfc / 2;
}

const RINGS = 16;
const SECTORS = 32;
const SUB = 6;

/**
 * Expected hits per bin of equal solid angle: the density by the midpoint rule, finer towards the axis and the horizon
 * is not needed.
 */
function expectedHits(b: Bsdf, wo: OpenPbrVector): Float64Array {
  const bins = new Float64Array(RINGS * SECTORS);
  const cell = (2 * Math.PI) / (RINGS * SECTORS * SUB * SUB);
  for (let i = 0; i < RINGS * SUB; i++) {
    const z = (i + 0.5) / (RINGS * SUB);
    for (let j = 0; j < SECTORS * SUB; j++) {
      const wi = direction(z, (2 * Math.PI * (j + 0.5)) / (SECTORS * SUB));
      const bin = Math.floor(i / SUB) * SECTORS + Math.floor(j / SUB);
      bins[bin] = (bins[bin] as number) + SAMPLES * cell * pdfBsdf(b, wo, wi);
    }
  }
  return bins;
}

describe('sampling', () => {
  SURFACES.forEach(([name, given], index) => {
    if (!FULL && ALONE.includes(name)) return;
    it(`${name}: follows its density, and its weights average to the albedo (${SAMPLES} samples, seeds ${100 + index} and ${200 + index})`, () => {
      const p = resolveParameters(given);
      VIEWS.forEach((wo, view) => {
        const b = prepareBsdf(p, wo);
        const next = uniform(100 * (view + 1) + index);
        const hits = new Float64Array(RINGS * SECTORS);
        let valid = 0;
        const sum = [0, 0, 0];
        const squares = [0, 0, 0];
        for (let i = 0; i < SAMPLES; i++) {
          const s = sampleBsdf(b, wo, [next(), next(), next()]);
          if (!s.valid) continue;
          valid++;
          s.weight.forEach((w, k) => {
            sum[k] = (sum[k] as number) + w;
            squares[k] = (squares[k] as number) + w * w;
          });
          const phi = Math.atan2(s.wi[1], s.wi[0]);
          const ring = Math.min(Math.floor(s.wi[2] * RINGS), RINGS - 1);
          const sector = Math.floor(((phi < 0 ? phi + 2 * Math.PI : phi) / (2 * Math.PI)) * SECTORS) % SECTORS;
          hits[ring * SECTORS + sector] = (hits[ring * SECTORS + sector] as number) + 1;
        }
        const { albedo, pdf } = furnace(p, wo);
        // The density integrates to the part of the samples that is valid: 5 standard errors.
        expect(Math.abs(valid / SAMPLES - pdf), `valid ${valid / SAMPLES}, integral ${pdf}`).toBeLessThan(
          5 * Math.sqrt(Math.max(pdf * (1 - pdf), 1e-4) / SAMPLES),
        );
        albedo.forEach((value, k) => {
          const mean = (sum[k] as number) / SAMPLES;
          const error = Math.sqrt(Math.max((squares[k] as number) / SAMPLES - mean * mean, 0) / SAMPLES);
          expect(Math.abs(mean - value), `mean weight ${mean}, albedo ${value}`).toBeLessThan(5 * error + 2e-4);
        });
        const expected = expectedHits(b, wo);
        let chiSquare = 0;
        let freedom = -1;
        let pooled = 0;
        let pooledHits = 0;
        expected.forEach((count, bin) => {
          const got = hits[bin] as number;
          if (count < 20) {
            pooled += count;
            pooledHits += got;
            return;
          }
          chiSquare += (got - count) ** 2 / count;
          freedom++;
        });
        if (pooled >= 20) {
          chiSquare += (pooledHits - pooled) ** 2 / pooled;
          freedom++;
        }
        expect(freedom).toBeGreaterThan(50);
        expect(tail(chiSquare, freedom), `chi square ${chiSquare} with ${freedom} degrees of freedom`).toBeGreaterThan(
          1e-4 / (SURFACES.length * VIEWS.length),
        );
      });
    });
  });

  it('reports the density and the weight of the direction that it gives, 5000 random surfaces (seed 21)', () => {
    const next = uniform(21);
    const lobes = uniform(23);
    let compared = 0;
    for (let i = 0; i < 5000; i++) {
      const p = withLobes((i % 2 === 0 ? anySurface : anyCoated)(next, 0.2), lobes);
      const wo = upperDirection(next, 0.02);
      const b = prepareBsdf(p, wo);
      const s = sampleBsdf(b, wo, [next(), next(), next()]);
      if (!s.valid || s.wi[2] < 1e-4) continue;
      compared++;
      const { f, pdf } = evalPdfBsdf(b, wo, s.wi);
      expect(Math.abs(s.pdf / pdf - 1)).toBeLessThan(1e-5);
      s.weight.forEach((w, k) =>
        expect(Math.abs(w * s.pdf - (f[k] as number))).toBeLessThanOrEqual(1e-5 * Math.max(f[k] as number, 1e-6)),
      );
    }
    expect(compared).toBeGreaterThan(4000);
  });

  it('never answers with a weight that is out of proportion: at most 4, 20000 random surfaces (seed 22)', () => {
    const next = uniform(22);
    const lobes = uniform(24);
    let largest = 0;
    for (let i = 0; i < 20_000; i++) {
      const p = withLobes((i % 2 === 0 ? anySurface : anyCoated)(next, 0), lobes);
      const wo = upperDirection(next, 0.001);
      const { weight } = sampleBsdf(prepareBsdf(p, wo), wo, [next(), next(), next()]);
      largest = Math.max(largest, ...weight);
    }
    expect(largest).toBeLessThan(4);
  });
});
