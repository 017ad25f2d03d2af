import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import { compareEstimates, type Agreement } from '../src/estimator/agreement';
import { readGlassReference } from '../src/estimator/glass-reference';
import { GLASS_SCENES, glassScene, type GlassSceneName } from '../src/estimator/glass-scenes';
import { renderGlass } from '../src/estimator/render-glass';

afterEach(expectNoGpuErrors);

const FULL = process.env['GLANZ_FULL'] !== undefined;
const samples = FULL ? 1024 : 64;

/** Renders a scene and compares it with its reference, after a change of its materials. */
async function rendered(
  name: GlassSceneName,
  change: (made: ReturnType<typeof glassScene>) => void = () => undefined,
): Promise<Agreement> {
  const made = glassScene(name);
  change(made);
  // Few pixels, many programs.
  const device = await testDevice({ driver: 'swiftshader' });
  return compareEstimates(await renderGlass(device, made, { samples }), readGlassReference(name).image, made);
}

describe('the renderer, against brute force', () => {
  it.each(GLASS_SCENES)('%s: agrees within the standard errors', async (name) => {
    const { checks, error } = await rendered(name);
    expect(checks.filter(({ passed }) => !passed)).toEqual([]);
    // Small enough that an error of a few per cent is seen.
    for (const value of error) expect(value).toBeLessThan(0.02);
  });

  // That estimates see what is wrong is tested without a GPU, too (glass.test.ts).
  it.runIf(FULL)('bottle: does not agree with a liquid that absorbs nothing', async () => {
    const { agrees } = await rendered('bottle', ({ scene }) => {
      const liquid = scene.materials.find((material) => material.name === 'liquid')!;
      liquid.parameters = { ...liquid.parameters, transmission_color: [1, 1, 1] };
    });
    expect(agrees).toBe(false);
  });
});
