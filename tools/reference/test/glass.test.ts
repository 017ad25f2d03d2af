import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Material } from '@glanz/scene';
import { afterEach, describe, expect, it } from 'vitest';
import { compareEstimates, type Agreement } from '../src/estimator/agreement';
import { estimate, uniforms, type Estimate } from '../src/estimator/estimate';
import { readGlassReference } from '../src/estimator/glass-reference';
import { GLASS_SCENES, glassScene, type GlassScene, type GlassSceneName } from '../src/estimator/glass-scenes';
import { renderGlass } from '../src/estimator/render-glass';

afterEach(expectNoGpuErrors);

const SAMPLES = process.env['GLANZ_FULL'] === undefined ? 256 : 2048;

const failures = ({ checks }: Agreement): string =>
  checks
    .filter(({ passed }) => !passed)
    .map(({ name, value, limit }) => `${name}: ${value.toFixed(2)} > ${limit.toFixed(2)}`)
    .join('; ');

/** A glass scene with other parameters of one of its materials. */
function changed(
  name: GlassSceneName,
  material: string,
  change: Partial<Material> & Pick<Material, 'parameters'>,
): GlassScene {
  const made = glassScene(name);
  const at = made.scene.materials.findIndex((one) => one.name === material);
  const before = made.scene.materials[at]!;
  made.scene.materials[at] = { ...before, ...change, parameters: { ...before.parameters, ...change.parameters } };
  return made;
}

describe('references of glass', () => {
  it.each(GLASS_SCENES)('%s: what is stored is what the estimator gives with another seed', (name) => {
    const { scene, ...how } = glassScene(name);
    const { image, info } = readGlassReference(name);
    expect(info.maxDepth).toBe(how.maxDepth);
    expect(info.seed).not.toBe(9);
    expect(failures(compareEstimates(estimate(scene, { ...how, samples: 32, seed: 9 }), image, how))).toBe('');
  });

  it.each(GLASS_SCENES)('%s: the renderer agrees within the standard errors', async (name) => {
    const made = glassScene(name);
    const { image } = readGlassReference(name);
    const agreement = compareEstimates(await renderGlass(await testDevice(), made, { samples: SAMPLES }), image, made);
    expect(failures(agreement)).toBe('');
    // Small enough that an error of a few per cent is seen.
    for (const error of agreement.error) expect(error).toBeLessThan(0.01);
  });

  // The same comparison must see what is wrong.
  it.each<[GlassSceneName, string, string, Partial<Material> & Pick<Material, 'parameters'>]>([
    ['window', 'solid panes that absorb nothing', 'solid pane', { parameters: { transmission_color: [1, 1, 1] } }],
    ['bottle', 'a liquid that bends light as glass does', 'liquid', { parameters: { specular_ior: 1.5 } }],
    ['bottle', 'a liquid that is there instead of the glass', 'liquid', { parameters: {}, dielectric_priority: 2 }],
    ['gem', 'light of all wavelengths bent alike', 'gem', { parameters: { transmission_dispersion_abbe_number: 1e6 } }],
  ])('%s: %s does not agree', async (name, _, material, change) => {
    const made = changed(name, material, change);
    const { image } = readGlassReference(name);
    const agreement = compareEstimates(await renderGlass(await testDevice(), made, { samples: SAMPLES }), image, made);
    expect(agreement.agrees).toBe(false);
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
    return compareEstimates(image, noisy(0.03, 2), size);
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
