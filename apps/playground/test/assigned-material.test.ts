import { expect, it } from 'vitest';
import type { Scene } from '@glanz/scene';
import { chosenInVariant, assignedMaterial } from '../src/viewer/assigned-material';

const transform = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const scene: Pick<Scene, 'instances' | 'variants'> = {
  variants: ['night', 'storm'],
  instances: [
    { name: 'sole', mesh: 0, material: 3, transform },
    { name: 'upper', mesh: 1, material: 0, transform, variants: { 0: 1, 1: 2 } },
  ],
};

it('a part has its material, or that of the variant where it has one', () => {
  expect([null, 'night', 'storm', 'gone'].map((variant) => assignedMaterial(scene, 1, variant))).toEqual([0, 1, 2, 0]);
  expect([null, 'night'].map((variant) => assignedMaterial(scene, 0, variant))).toEqual([3, 3]);
});

it('the selection changes materials with its part, and back', () => {
  expect(chosenInVariant(scene, { material: 0, instance: 1 }, null, 'storm')).toEqual({ material: 2, instance: 1 });
  expect(chosenInVariant(scene, { material: 2 }, 'storm', 'night')).toEqual({ material: 1, instance: undefined });
  expect(chosenInVariant(scene, { material: 1, instance: 1 }, 'night', null)).toEqual({ material: 0, instance: 1 });
  // The sole has no variants, and a material that no part has stays selected.
  expect(chosenInVariant(scene, { material: 3, instance: 0 }, null, 'night')).toEqual({ material: 3, instance: 0 });
  expect(chosenInVariant(scene, { material: 2 }, null, 'night')).toEqual({ material: 2, instance: undefined });
});
