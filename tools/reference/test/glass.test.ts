import type { Material } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { compareEstimates, type Agreement } from '../src/estimator/agreement';
import { estimate, uniforms, type Estimate } from '../src/estimator/estimate';
import { readGlassReference } from '../src/estimator/glass-reference';
import { GLASS_SCENES, glassScene, type GlassSceneName } from '../src/estimator/glass-scenes';

const failures = ({ checks }: Agreement): string =>
  checks
    .filter(({ passed }) => !passed)
    .map(({ name, value, limit }) => `${name}: ${value.toFixed(2)} > ${limit.toFixed(2)}`)
    .join('; ');

describe('references of glass', () => {
  it.each(GLASS_SCENES)('%s: what is stored is what the estimator gives with another seed', (name) => {
    const { scene, ...how } = glassScene(name);
    const { image, info } = readGlassReference(name);
    expect(info.maxDepth).toBe(how.maxDepth);
    expect(info.seed).not.toBe(9);
    expect(failures(compareEstimates(estimate(scene, { ...how, samples: 32, seed: 9 }), image, how))).toBe('');
  });
});

// The same comparison must see what is wrong, at the noise that tests of the renderer have.
describe('images of other scenes', () => {
  it.each<[GlassSceneName, string, string, Partial<Material>]>([
    ['window', 'panes that absorb nothing', 'solid pane', { parameters: { transmission_color: [1, 1, 1] } }],
    ['bottle', 'a liquid that absorbs nothing', 'liquid', { parameters: { transmission_color: [1, 1, 1] } }],
    ['gem', 'another index', 'gem', { parameters: { specular_ior: 2 } }],
  ])('%s: %s does not agree', (name, _, material, change) => {
    const { scene, ...how } = glassScene(name);
    const at = scene.materials.findIndex((one) => one.name === material);
    const before = scene.materials[at]!;
    scene.materials[at] = { ...before, ...change, parameters: { ...before.parameters, ...change.parameters } };
    const image = estimate(scene, { ...how, samples: 64, seed: 9 });
    expect(failures(compareEstimates(image, readGlassReference(name).image, how))).not.toBe('');
  });
});

describe('compareEstimates', () => {
  const size = { width: 20, height: 12 };
  const values = 3 * size.width * size.height;
  const truth = Float64Array.from({ length: values }, (_, i) => 1 + 0.5 * Math.sin(i));
  /** An image with normal noise. */
  const noisy = (error: number, seed: number): Estimate => {
    const random = uniforms(seed);
    const normal = () => Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
    return { mean: truth.map((value) => value + error * normal()), standardError: truth.map(() => error) };
  };
  const compared = (change: (image: Estimate) => void): Agreement => {
    const image = noisy(0.05, 1);
    change(image);
    return compareEstimates(image, noisy(0.01, 2), size);
  };

  it('accepts two images whose noise is as they say, whatever the seeds', () => {
    for (let seed = 10; seed < 60; seed++)
      expect(failures(compareEstimates(noisy(0.05, seed), noisy(0.03, 1000 + seed), size))).toBe('');
  });

  it('sees a mean that is off, a block that is off, too little noise declared, and NaN', () => {
    expect(failures(compared(() => undefined))).toBe('');
    expect(failures(compared(({ mean }) => mean.forEach((value, i) => (mean[i] = value + 0.02))))).toMatch(/mean red/);
    // One half up, the other down.
    const tilted = compared(({ mean }) =>
      mean.forEach((value, i) => (mean[i] = value + (Math.floor(i / 3) % size.width < 10 ? 0.03 : -0.03))),
    );
    expect(failures(tilted)).toMatch(/blocks green/);
    expect(failures(compared(({ standardError }) => standardError.fill(0.001)))).not.toBe('');
    expect(failures(compared(({ mean }) => (mean[0] = NaN)))).toMatch(/mean red.*blocks red/);
  });

  it('refuses images of another size', () => {
    expect(() => compareEstimates(noisy(0.1, 1), noisy(0.1, 2), { width: 5, height: 5 })).toThrow(
      expect.objectContaining({ code: 'reference/size' }),
    );
  });
});
