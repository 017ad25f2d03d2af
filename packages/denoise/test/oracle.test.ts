import { expectNoGpuErrors } from '@glanz/gpu';
import { afterEach, describe, expect, it, test } from 'vitest';
import { denoiseOnGpu } from './gpu';
import { CHECKED_CASES, MISSING, differences, imagesOf, tolerances, weightsOf } from './oracle';

afterEach(() => expectNoGpuErrors());

describe.each(['f32', 'f16'] as const)('the GPU with %s between layers against the oracle', (storage) => {
  // Compiling takes longest: of the real networks of one kind each storage takes one, with GLANZ_FULL all.
  const left = process.env['GLANZ_FULL'] ? undefined : { f32: 'spheres.rt_alb', f16: 'spheres.rt_nrm' }[storage];
  for (const oracle of CHECKED_CASES.filter((one) => one.case !== left))
    it(oracle.case, async () => {
      const { expected, input, ...images } = imagesOf(oracle);
      const { rgb } = await denoiseOnGpu(weightsOf(oracle.net), images, { input, storage });
      const found = differences(rgb, expected);
      for (const [kind, limit] of Object.entries(tolerances(oracle, storage)))
        expect(found[kind as keyof typeof found], kind).toBeLessThanOrEqual(limit);
    });
  test.skipIf(MISSING === undefined)(`cases with real weights: ${MISSING}`, () => undefined);
});
