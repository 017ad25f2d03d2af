import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import { FULL_SAMPLES, GROUND_TRUTH_CASES, type GroundTruthCase } from '../src/cases';
import { failures } from '../src/compare';

afterEach(expectNoGpuErrors);

const FULL = process.env['GLANZ_FULL'] !== undefined;
/**
 * What another case would fail with: a closed furnace is 1 everywhere, which the tests of the renderer compare without
 * a reference (path-tracer.test.ts); all bounces between matt walls are in the box with spheres, direct light in
 * `cornell_diffuse bounce2`, and the light of an environment without a sun in the one with a sun.
 */
const COVERED = ['furnace_closed full', 'cornell_diffuse full', 'cornell_diffuse direct', 'env_soft full'];
const cases: readonly GroundTruthCase[] = !FULL
  ? GROUND_TRUTH_CASES.filter(({ scene, variant }) => !COVERED.includes(`${scene} ${variant}`))
  : GROUND_TRUTH_CASES.map((one) => ({ ...one, samples: FULL_SAMPLES * one.samples, noise: 1 }));

describe('ground truth', () => {
  it.each(cases)(
    '$scene ($variant) agrees with its reference at $samples samples',
    async ({ scene, variant, samples, noise }) => {
      const { GroundTruth, renderGroundTruth } = await import('../src/index');
      const options = { samples, variant, noise };
      const { comparison } = await renderGroundTruth(await testDevice(), new GroundTruth(scene), options);
      expect(failures(comparison)).toBe('');
      // SwiftShader on a slow machine takes most of a minute for the slowest of them.
    },
    300_000,
  );

  it.each(FULL ? ['cornell_spheres', 'env_sun'] : ['env_sun'])(
    '%s agrees with its reference when directions are guided',
    async (scene) => {
      const { compareImages, GroundTruth, renderImage } = await import('../src/index');
      const { groundTruthOptions } = await import('../src/render');
      const truth = new GroundTruth(scene);
      const options = { ...groundTruthOptions(truth, {}), guiding: 0.1, samples: 8 };
      const image = await renderImage(await testDevice(), await truth.scene(), options);
      expect(failures(compareImages(image, 8, truth.image(), truth.description.film, truth.tolerance))).toBe('');
    },
    300_000,
  );

  it('detects a renderer that loses bounces (the full variant against a render of direct light)', async () => {
    const { GroundTruth, compareImages, renderImage } = await import('../src/index');
    const truth = new GroundTruth('cornell_diffuse');
    const { width, height } = truth.description.film;
    const image = await renderImage(await testDevice(), await truth.scene(), {
      width,
      height,
      samples: 8,
      maxDepth: 2,
      multipleScattering: false,
    });
    expect(failures(compareImages(image, 8, truth.image(), { width, height }, truth.tolerance))).toMatch(/T1/);
  });
});
