import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { afterEach, describe, expect, it, vi } from 'vitest';
import { GROUND_TRUTH_CASES } from '../src/cases';
import type { ReferenceImage, Tolerance } from '../src/reference-set';
import { compareImages, failures, relMse } from '../src/compare';

const size = { width: 128, height: 128 };
const tolerance: Tolerance = { mean: 0.003, block: 0.005, k: 2, floor: 2e-5, outlier: 0.002 };
const SPP = 16384;
/** Standard deviation of one sample, relative to the pixel. */
const SIGMA = 0.5;

function randoms(seed: number): () => number {
  let state = seed;
  const uniform = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  // Box–Muller.
  return () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
}

/** A smooth image that no mirror image equals, and estimates of it. */
const truth = Float64Array.from({ length: size.width * size.height * 3 }, (_, i) => {
  const [x, y] = [(Math.floor(i / 3) % size.width) / size.width, Math.floor(i / 3 / size.width) / size.height];
  return 0.2 + 0.5 * x + 0.3 * y * y + 0.1 * (i % 3);
});
const estimate = (samples: number, seed: number): Float32Array => {
  const normal = randoms(seed);
  return Float32Array.from(truth, (value) => value * (1 + (SIGMA / Math.sqrt(samples)) * normal()));
};

const mean = estimate(SPP, 1);
const epsilon = 0.01 * (truth.reduce((sum, value) => sum + value * value, 0) / truth.length);
const reference: ReferenceImage = {
  mean,
  standardError: Float32Array.from(truth, (value) => (value * SIGMA) / Math.sqrt(SPP)),
  stats: { spp: SPP, relmse_eps: epsilon, relmse_1spp: SIGMA ** 2, relmse_of_reference: SIGMA ** 2 / SPP },
};
const verdict = (candidate: Float32Array, samples = 64, noise = 1) =>
  compareImages(candidate, samples, reference, size, tolerance, noise);

describe('compareImages', () => {
  it('lets unbiased estimates pass, at several sample counts and seeds', () => {
    for (const samples of [8, 64, 1024])
      for (const seed of [2, 3, 4]) expect(failures(verdict(estimate(samples, seed), samples))).toBe('');
  });

  it('takes less noise of the mean for granted where samples leave less', () => {
    const limit = (noise: number) =>
      verdict(estimate(8, 2), 8, noise).checks.find(({ name }) => name === 'T1 mean red')!.limit;
    expect(limit(0.6) / limit(1)).toBeCloseTo(0.6, 2);
  });

  it('measures the error per sample and the efficiency', () => {
    const { relMsePerSample, efficiency } = verdict(estimate(64, 5));
    expect(relMsePerSample).toBeGreaterThan(0.9 * SIGMA ** 2);
    expect(relMsePerSample).toBeLessThan(1.1 * SIGMA ** 2);
    expect(efficiency).toBeGreaterThan(0.9);
    expect(efficiency).toBeLessThan(1.1);
  });

  it.each([
    ['1 % too bright', (p: Float32Array) => p.map((v) => v * 1.01), /T1/],
    [
      'mirrored',
      (p: Float32Array) =>
        p.map((_, i) => p[(Math.floor(i / 3 / 128) * 128 + 127 - (Math.floor(i / 3) % 128)) * 3 + (i % 3)]!),
      /T2/,
    ],
    ['red and blue swapped', (p: Float32Array) => p.map((_, i) => p[i - (i % 3) + 2 - (i % 3)]!), /T1/],
    ['twice as noisy as it should be', (p: Float32Array) => p.map((v, i) => truth[i]! + 2 * (v - truth[i]!)), /T3/],
    ['with fireflies', (p: Float32Array) => p.map((v, i) => (i % 300 === 0 ? v * 8 : v)), /T4/],
    ['with one NaN', (p: Float32Array) => p.map((v, i) => (i === 1000 ? NaN : v)), /finite/],
    [
      'with one dark block',
      (p: Float32Array) => p.map((v, i) => (Math.floor(i / 3) % 128 < 32 && i / 3 / 128 < 16 ? v * 0.9 : v)),
      /T2/,
    ],
  ])('catches an image that is %s', (_, spoil, expected) => {
    expect(failures(verdict(spoil(estimate(64, 6))))).toMatch(expected);
    // So do as few samples as tests take.
    expect(failures(verdict(spoil(estimate(8, 6)), 8, 0.6))).toMatch(expected);
  });

  it('refuses images of another size', () => {
    expect(() => verdict(new Float32Array(12))).toThrow(/pixels/);
  });

  const full = join(import.meta.dirname, '../../../../shared/groundtruth');
  const script = join(full, 'compare.mjs');
  afterEach(() => vi.unstubAllEnvs());

  it.runIf(existsSync(script))(
    'agrees with the script that came with the reference set in full precision (skipped where that is absent)',
    async () => {
      vi.stubEnv('GLANZ_GROUNDTRUTH', join(full, 'scenes'));
      const other = (await import(/* @vite-ignore */ pathToFileURL(script).href)) as {
        compare(
          folder: string,
          candidate: Float32Array,
          spp: number,
        ): { ok: boolean; relMSE: number; efficiency: number; checks: { value: number; limit: number; ok: boolean }[] };
        loadRef(folder: string): { img: Float32Array };
      };
      const { GroundTruth } = await import('../src/reference-set');
      for (const name of ['cornell_diffuse', 'furnace_metal', 'env_sun']) {
        const truth = new GroundTruth(name);
        const image = truth.image();
        const normal = randoms(7);
        for (const bias of [1, 1.02]) {
          const candidate = image.mean.map(
            (value, i) => bias * (value + image.standardError[i]! * Math.sqrt(image.stats.spp / 64) * normal()),
          );
          const theirs = other.compare(truth.folder, candidate, 64);
          const ours = compareImages(candidate, 64, image, truth.description.film, truth.tolerance);
          expect(ours.checks.map(({ passed }) => passed)).toEqual(theirs.checks.map(({ ok }) => ok));
          for (const [i, { value, limit }] of ours.checks.entries()) {
            expect(value).toBeCloseTo(theirs.checks[i]!.value, 9);
            expect(limit).toBeCloseTo(theirs.checks[i]!.limit, 9);
          }
          expect(ours.efficiency).toBeCloseTo(theirs.efficiency, 6);
        }
      }
    },
  );
});

describe('the reference set', () => {
  const full = join(import.meta.dirname, '../../../../shared/groundtruth/scenes');
  afterEach(() => vi.unstubAllEnvs());

  it('has all references, finite, of the size of the film', async () => {
    const { GroundTruth } = await import('../src/reference-set');
    for (const { scene, variant } of GROUND_TRUTH_CASES) {
      const truth = new GroundTruth(scene);
      const { mean, standardError } = truth.image(variant);
      const { width, height } = truth.description.film;
      expect([mean.length, standardError.length], scene).toEqual([3 * width * height, 3 * width * height]);
      expect(
        mean.every((value) => value >= 0 && value < 65_504) &&
          standardError.every((value) => value >= 0 && value < 65_504),
        scene,
      ).toBe(true);
    }
  });

  it.runIf(existsSync(full))(
    'is that in full precision, rounded to half floats (skipped where that is absent)',
    async () => {
      const { GroundTruth } = await import('../src/reference-set');
      for (const { scene, variant } of GROUND_TRUTH_CASES) {
        const half = new GroundTruth(scene).image(variant);
        vi.stubEnv('GLANZ_GROUNDTRUTH', full);
        const float = new GroundTruth(scene).image(variant);
        vi.unstubAllEnvs();
        // Half the distance between neighbours, below 2^-14 that of subnormal numbers.
        for (const of of ['mean', 'standardError'] as const) {
          const far = half[of].findIndex(
            (value, i) => Math.abs(value - float[of][i]!) > Math.max(2 ** -11 * float[of][i]!, 2 ** -25),
          );
          expect(far, `${scene} ${variant} ${of}`).toBe(-1);
        }
        expect(half.stats).toEqual(float.stats);
      }
    },
  );
});

describe('relMse', () => {
  it('is the squared relative error on an even image', () => {
    expect(relMse([1.1, 1.1, 1.1], [1, 1, 1], 0)).toBeCloseTo(0.01, 12);
    expect(relMse([1.1, 1, 1], [1, 1, 1], 0)).toBeCloseTo(0.01 / 3, 12);
  });
});
