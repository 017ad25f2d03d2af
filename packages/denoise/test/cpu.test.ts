import { describe, expect, it, test } from 'vitest';
import { denoiseOnCpu, type Planes } from '../src/cpu/index';
import { CHECKED_CASES, MISSING, differences, imagesOf, tolerances, weightsOf, type OracleCase } from './oracle';

/** Names the first layer that differs; more use than a wrong image. */
function expectLayer(oracle: OracleCase, name: string, { data, channels, width, height }: Planes): void {
  const layer = oracle.layers[name]!;
  expect([channels, height, width], name).toEqual(layer.shape);
  const mean = data.reduce((sum, value) => sum + value, 0) / data.length;
  expect(Math.abs(mean - layer.mean), `${name}: mean`).toBeLessThan(2e-5 * Math.abs(layer.mean) + 1e-6);
  for (const [c, y, x, value] of layer.probes)
    expect(Math.abs(data[(c! * height + y!) * width + x!]! - value!), `${name} at ${c}, ${y}, ${x}`).toBeLessThan(1e-4);
}

async function expectCase(oracle: OracleCase): Promise<void> {
  const { expected, expectedNet, input, ...images } = imagesOf(oracle);
  let last: Planes | undefined;
  const onLayer = (name: string, planes: Planes) => {
    expectLayer(oracle, name, planes);
    last = planes;
  };
  const result = await denoiseOnCpu(weightsOf(oracle.net), images, { input, onLayer });
  const tolerance = tolerances(oracle, 'f32');
  const found = differences(result, expected);
  for (const [kind, limit] of Object.entries(tolerance))
    expect(found[kind as keyof typeof found], kind).toBeLessThanOrEqual(limit);
  expect(differences(last!.data, expectedNet()).absolute).toBeLessThanOrEqual(oracle.net === 'tiny' ? 1e-4 : 2e-5);
}

describe('the CPU twin against the oracle', () => {
  for (const oracle of CHECKED_CASES) it(oracle.case, () => expectCase(oracle));
  test.skipIf(MISSING === undefined)(`cases with real weights: ${MISSING}`, () => undefined);
});
