import { describe, expect, it, vi } from 'vitest';
import {
  albedoBsdf,
  emittedRadiance,
  evalPdfBsdf,
  pdfBsdf,
  prepareBsdf,
  sampleBsdf,
  type Bsdf,
} from '../src/cpu/index';
import { resolveParameters, type OpenPbrParameters, type OpenPbrVector } from '../src/parameters/index';
import { direction } from './integrate';
import { resultsOf } from './results';
import { anyClear, anyCoated, uniform, unit, upperDirection } from './random';
import { sphereFurnace } from './sphere';

/**
 * The proofs of the whole model. `GLANZ_FULL=1 npx vitest run --project openpbr test/proofs` runs them at full size:
 * 20,000 materials by 64 directions, 200 furnaces by 3 angles, 60 settings a lobe.
 */
const FULL = process.env['GLANZ_FULL'] !== undefined;
const size = (full: number, small: number): number => (FULL ? full : small);
const record = resultsOf('proofs');
if (FULL) vi.setConfig({ testTimeout: 3_600_000 });

/** Any material of all lobes, at the ends of its ranges more often than not. */
function anyExtreme(next: () => number): OpenPbrParameters {
  const p = anyClear(next, 0);
  const end = (value: number, low = 0, high = 1): number => (next() < 0.3 ? low : next() < 0.5 ? high : value);
  return {
    ...p,
    base_weight: end(p.base_weight),
    base_metalness: end(p.base_metalness),
    base_diffuse_roughness: end(p.base_diffuse_roughness),
    specular_weight: end(p.specular_weight, 0, 1e4),
    specular_roughness: end(p.specular_roughness),
    specular_roughness_anisotropy: end(p.specular_roughness_anisotropy),
    specular_ior: end(p.specular_ior, 0.05, 50),
    transmission_weight: end(p.transmission_weight),
    subsurface_weight: end(p.subsurface_weight),
    coat_weight: end(p.coat_weight),
    coat_roughness: end(p.coat_roughness),
    coat_roughness_anisotropy: end(p.coat_roughness_anisotropy),
    coat_ior: end(p.coat_ior, 0.05, 50),
    fuzz_weight: end(next()),
    fuzz_roughness: end(next()),
    fuzz_color: [end(next()), end(next()), end(next())],
  };
}

/**
 * Any material of all lobes without what the README names as less exact: anisotropic highlights, rough diffuse, indices
 * below 1.
 */
function anyWhite(next: () => number): OpenPbrParameters {
  const p = anyClear(next, 0.05);
  const white = [1, 1, 1] as const;
  return {
    ...p,
    base_weight: 1,
    base_color: white,
    base_diffuse_roughness: 0,
    specular_weight: 1,
    specular_color: white,
    specular_roughness_anisotropy: 0,
    transmission_color: white,
    subsurface_color: white,
    coat_color: white,
    coat_roughness_anisotropy: 0,
    fuzz_weight: next() < 0.5 ? 0 : next(),
    fuzz_color: white,
    fuzz_roughness: 0.1 + 0.9 * next(),
  };
}

describe('the whole model', () => {
  const materials = size(20_000, 600);
  it(`is finite and not negative: ${materials} random materials at extremes by 64 directions (seed 300)`, () => {
    const next = uniform(300);
    const bad = (values: readonly number[]): boolean => values.some((value) => !(value >= 0 && value < Infinity));
    for (let i = 0; i < materials; i++) {
      const p = anyExtreme(next);
      for (let k = 0; k < 8; k++) {
        const wo: OpenPbrVector =
          k === 0 ? [1, 0, 1e-30] : k === 1 ? [0, 0, 1] : unit(upperDirection(next, k === 2 ? 1e-6 : 0));
        const inside = !p.geometry_thin_walled && next() < 0.4;
        const b = prepareBsdf(p, wo, { inside, outerIor: next() < 0.3 ? 0.5 + 2 * next() : 1 });
        const at = () => JSON.stringify({ p, wo, inside });
        if (bad([...albedoBsdf(b, wo), ...emittedRadiance(p, wo)])) throw new Error(`albedo or emission: ${at()}`);
        for (let j = 0; j < 8; j++) {
          const up = upperDirection(next, 0);
          const wi: OpenPbrVector = next() < 0.5 ? up : [up[0], up[1], -up[2]];
          const { f, pdf } = evalPdfBsdf(b, wo, wi);
          const s = sampleBsdf(b, wo, [next(), next(), next()]);
          if (bad([...f, pdf, s.pdf, ...s.weight]))
            throw new Error(`${[...f, pdf, s.pdf, ...s.weight].join(' ')} at wi ${wi.join(' ')}, ${at()}`);
        }
      }
    }
    record('finite', { materials, directions: 64 });
  });

  const furnaces = size(200, 24);
  it(`is within 0.985 and 1.006 in a white furnace: ${furnaces} random white materials by 3 angles (seed 301)`, () => {
    const next = uniform(301);
    const seen = { min: Infinity, max: -Infinity, density: 0 };
    for (let i = 0; i < furnaces; i++) {
      const p = anyWhite(next);
      for (const mu of [1, 0.6, 0.2]) {
        const { reflected, transmitted, pdf } = sphereFurnace(p, direction(mu), {}, size(48, 32));
        const sum = reflected[1] + transmitted[1];
        // Dielectric indices above 2.2 below a rough coat are where the tables are coarsest.
        expect(sum, JSON.stringify({ p, mu })).toBeGreaterThan(0.985);
        expect(sum, JSON.stringify({ p, mu })).toBeLessThan(1.006);
        expect(pdf, JSON.stringify({ p, mu })).toBeLessThan(1.004);
        seen.min = Math.min(seen.min, sum);
        seen.max = Math.max(seen.max, sum);
        seen.density = Math.max(seen.density, pdf);
      }
    }
    record('materials', { materials: furnaces, ...seen });
  });

  it('is reciprocal where it says so: single scattering, opaque, without coat and fuzz (seed 302)', () => {
    const next = uniform(302);
    const pairs = size(20_000, 1000);
    let worst = 0;
    for (let i = 0; i < pairs; i++) {
      const p: OpenPbrParameters = {
        ...anyExtreme(next),
        transmission_weight: 0,
        subsurface_weight: 0,
        coat_weight: 0,
        fuzz_weight: 0,
      };
      const a = unit(upperDirection(next, 0.02)),
        b = unit(upperDirection(next, 0.02));
      const there = evalPdfBsdf(prepareBsdf(p, a, { multipleScattering: false }), a, b).f[0] / b[2];
      const back = evalPdfBsdf(prepareBsdf(p, b, { multipleScattering: false }), b, a).f[0] / a[2];
      expect(Math.abs(there - back), JSON.stringify(p)).toBeLessThanOrEqual(1e-7 * Math.max(there, back));
      if (there + back > 0) worst = Math.max(worst, Math.abs(there - back) / Math.max(there, back));
    }
    record('reciprocity', { pairs, worst });
  });
});

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

/**
 * The part of the samples that are not valid: numbers evenly spread (Roberts' R₃ sequence), which know it to 4e-4; 2¹⁵
 * of them only to 2e-3.
 */
function lostOf(b: Bsdf, wo: OpenPbrVector): number {
  const count = 1 << 17;
  let lost = 0;
  for (let i = 0; i < count; i++) {
    const at = (step: number): number => (0.5 + step * i) % 1;
    if (!sampleBsdf(b, wo, [at(0.8191725134), at(0.6710436067), at(0.5497004779)]).valid) lost++;
  }
  return lost / count;
}

const RINGS = 20;
const SECTORS = 16;
/**
 * Points in a bin, of a Fibonacci lattice: refracted light ends at an edge, and a grid of as many points (24 × 24 even)
 * knows so little of the bins on it that 100,000 samples show it; a lattice has as many heights as points.
 */
const POINTS = 377;
const STEP = 233;

/**
 * Probability of a chi-square as large as that of samples against the density, over bins of equal solid angle on the
 * sphere.
 */
function fitOf(b: Bsdf, wo: OpenPbrVector, samples: number, next: () => number): number {
  const expected = new Float64Array(RINGS * SECTORS);
  const cell = (4 * Math.PI) / (RINGS * SECTORS * POINTS);
  for (let bin = 0; bin < expected.length; bin++) {
    for (let i = 0; i < POINTS; i++) {
      const z = (Math.floor(bin / SECTORS) + (i + 0.5) / POINTS) / RINGS;
      const turn = ((bin % SECTORS) + ((i * STEP) % POINTS) / POINTS) / SECTORS;
      expected[bin] =
        (expected[bin] as number) + samples * cell * pdfBsdf(b, wo, direction(-1 + 2 * z, 2 * Math.PI * turn));
    }
  }
  const hits = new Float64Array(RINGS * SECTORS);
  for (let i = 0; i < samples; i++) {
    const { wi, valid } = sampleBsdf(b, wo, [next(), next(), next()]);
    if (!valid) continue;
    const turn = Math.atan2(wi[1], wi[0]) / (2 * Math.PI);
    const bin =
      Math.min(Math.floor(((wi[2] + 1) / 2) * RINGS), RINGS - 1) * SECTORS +
      (Math.floor((turn - Math.floor(turn)) * SECTORS) % SECTORS);
    hits[bin] = (hits[bin] as number) + 1;
  }
  let chiSquare = 0,
    freedom = -1,
    pooled = 0,
    pooledHits = 0;
  expected.forEach((count, bin) => {
    const got = hits[bin] as number;
    if (count < 1e-9 * samples) expect(got, 'samples where the density is 0').toBe(0);
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
  expect(freedom).toBeGreaterThan(5);
  return tail(chiSquare, freedom);
}

describe('chi-squared of the samples against the density', () => {
  const LOBES: Readonly<Record<string, (next: () => number) => Partial<OpenPbrParameters>>> = {
    diffuse: (next) => ({ specular_weight: 0, base_diffuse_roughness: next() }),
    metal: (next) => ({ base_metalness: 1, specular_roughness_anisotropy: 0.8 * next() }),
    dielectric: (next) => ({ specular_ior: 1.1 + next(), base_weight: next() }),
    glass: (next) => ({ transmission_weight: 1, specular_ior: 1.3 + next() }),
    'thin glass': (next) => ({ transmission_weight: 1, geometry_thin_walled: true, specular_ior: 1.5 + next() }),
    subsurface: (next) => ({ subsurface_weight: 0.5 + 0.5 * next(), specular_ior: 1.3 + next() }),
    paper: (next) => ({
      subsurface_weight: 1,
      geometry_thin_walled: true,
      subsurface_scatter_anisotropy: 2 * next() - 1,
    }),
    coat: (next) => ({ coat_weight: 1, coat_roughness: 0.4 + 0.6 * next(), base_metalness: next() }),
    film: (next) => ({
      thin_film_weight: next(),
      thin_film_thickness: next(),
      thin_film_ior: 1.2 + next(),
      transmission_weight: next() < 0.5 ? 0 : 1,
      specular_ior: 1.3 + next(),
    }),
    fuzz: (next) => ({ fuzz_weight: 1, fuzz_roughness: 0.3 + 0.7 * next() }),
    everything: (next) => ({
      ...anyCoated(next, 0.45),
      transmission_weight: 0.5 * next(),
      subsurface_weight: 0.5 * next(),
      fuzz_weight: next(),
      fuzz_roughness: 0.3 + 0.7 * next(),
      coat_roughness: 0.4 + 0.6 * next(),
      specular_ior: 1.4 + next(),
    }),
  };
  Object.entries(LOBES).forEach(([name, lobe], index) => {
    // By default one setting a lobe: `everything` has most lobes at once, and it has three, as has glass.
    const settings = size(60, name === 'everything' || name === 'glass' ? 3 : 1);
    it(`${name}: ${settings} settings, significance 0.01 with Šidák's correction (seed ${310 + index})`, () => {
      const next = uniform(310 + index);
      const limit = 1 - 0.99 ** (1 / settings);
      let min = 1,
        worst = 0,
        counted = 0;
      // ∫ pdf, and the part of the samples that are lost (facets that send light to where there is none), make 1.
      const whole = (p: OpenPbrParameters, wo: OpenPbrVector, inside: boolean): void => {
        const missing = Math.abs(
          sphereFurnace(p, wo, { inside }, 40).pdf + lostOf(prepareBsdf(p, wo, { inside }), wo) - 1,
        );
        expect(missing, JSON.stringify({ p, wo, inside })).toBeLessThan(2e-3);
        worst = Math.max(worst, missing);
        counted++;
      };
      const samples = size(100_000, 30_000);
      for (let i = 0; i < settings; i++) {
        const p = resolveParameters({ specular_roughness: 0.45 + 0.55 * next(), ...lobe(next) });
        const wo = direction(0.1 + 0.9 * next(), 6 * next());
        const inside = !p.geometry_thin_walled && p.transmission_weight + p.subsurface_weight > 0 && next() < 0.4;
        if (name === 'diffuse' || i % size(1, 3) === 0) whole(p, wo, inside);
        const fit = fitOf(prepareBsdf(p, wo, { inside }), wo, samples, next);
        expect(fit, JSON.stringify({ p, wo, inside })).toBeGreaterThan(limit);
        min = Math.min(min, fit);
      }
      record(`density: ${name}`, { settings: counted, worst });
      record(`chi-squared: ${name}`, { settings, samples, limit, min });
    });
  });
});
