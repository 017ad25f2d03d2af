import { resolveParameters } from '@glanz/openpbr';
import { expect, it } from 'vitest';
import { defaultMaterial } from '../src/index';

it("is the spec's defaults, a new object each time", () => {
  expect(resolveParameters(defaultMaterial().parameters)).toMatchObject({
    base_weight: 1,
    base_color: [0.8, 0.8, 0.8],
    base_metalness: 0,
    specular_roughness: 0.3,
    emission_luminance: 0,
  });
  expect(defaultMaterial()).not.toBe(defaultMaterial());
});
