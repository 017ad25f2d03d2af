import { expectNoGpuErrors } from '@glanz/gpu';
import { afterEach, describe, expect, it, test } from 'vitest';
import { denoiseOnGpu } from './gpu';
import { CHECKED_CASES, MISSING, differences, imagesOf, tolerances, weightsOf } from './oracle';

afterEach(() => expectNoGpuErrors());

describe.each(['f32', 'f16'] as const)('the GPU with %s between layers against the oracle', (storage) => {
  // Compiling takes longest: the smallest real network in single precision, where it is there, and the tiny one in
  // half; with GLANZ_FULL all. The twin computes more of them.
  const single = MISSING === undefined ? /small/ : /tiny/;
  const checked = CHECKED_CASES.filter(
    ({ net }) => process.env['GLANZ_FULL'] !== undefined || (storage === 'f32' ? single : /tiny/).test(net),
  );
  for (const oracle of checked)
    it(oracle.case, async () => {
      const { expected, input, ...images } = imagesOf(oracle);
      const { rgb } = await denoiseOnGpu(weightsOf(oracle.net), images, { input, storage });
      const found = differences(rgb, expected);
      for (const [kind, limit] of Object.entries(tolerances(oracle, storage)))
        expect(found[kind as keyof typeof found], kind).toBeLessThanOrEqual(limit);
    });
  test.skipIf(MISSING === undefined)(`cases with real weights: ${MISSING}`, () => undefined);
});
