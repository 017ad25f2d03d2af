import { testDevice } from '@glanz/gpu';
import { createShaderModule } from '@glanz/wgsl';
import { expect, it } from 'vitest';
import { requiredFeatures, type OpenPbrFlags } from '../src/wgsl/index';
import { gpuShader } from './gpu';
import { LOBES } from './lobes';
import { uniform } from './random';

const FULL = process.env['GLANZ_FULL'] !== undefined;

/** Sets of flags that materials ask for: of each lobe alone, each pair of lobes, and any. */
function flagSets(): OpenPbrFlags[] {
  const choices = Object.entries({ ...LOBES, subsurface_weight: [1, 0.5] }).flatMap(([name, values]) =>
    values.map((value) => [name, value] as const),
  );
  const next = uniform(11);
  const materials = [
    [],
    ...choices.map((one) => [one]),
    ...choices.flatMap((one, i) => choices.slice(i + 1).map((two) => [one, two])),
    ...Array.from({ length: 200 }, () => choices.filter(() => next() < 0.3)),
  ];
  const sets = materials.flatMap((chosen) =>
    [true, false].map((multipleScattering) =>
      requiredFeatures([{ ...Object.fromEntries(chosen), thin_film_thickness: 0.5 }], { multipleScattering }),
    ),
  );
  return [...new Map(sets.map((flags) => [JSON.stringify(flags), flags])).values()];
}

// Text that compilers refuse only where some flag is on or off shows in no test that renders a few materials.
it('programs of all kinds of materials compile', async () => {
  const device = await testDevice();
  const sets = flagSets();
  expect(sets.length).toBeGreaterThan(100);
  // A third of them, all with --full.
  for (const [i, flags] of sets.entries())
    if (FULL || i % 3 === 0) await createShaderModule(device, gpuShader(flags), JSON.stringify(flags));
});
