import { expect, test } from 'vitest';
import { createScene, SceneError, validateScene, withVariant } from '../src/index';

const scene = () => {
  const made = createScene();
  made.meshes.push({
    name: 'm',
    positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]),
    indices: new Uint32Array([0, 1, 2]),
  });
  made.materials.push(
    { name: 'red', parameters: {} },
    { name: 'blue', parameters: {} },
    { name: 'green', parameters: {} },
  );
  made.variants = ['day', 'night'];
  const transform = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  made.instances.push(
    { name: 'a', mesh: 0, material: 0, transform, variants: { 1: 2 } },
    { name: 'b', mesh: 0, material: 1, transform },
  );
  return made;
};
const materialsOf = (s: ReturnType<typeof scene>) => s.instances.map(({ material }) => material);

test('a variant exchanges materials where it names one, and the others stay; the scene itself does not change', () => {
  const loaded = scene();
  expect(validateScene(loaded)).toEqual([]);
  expect(materialsOf(withVariant(loaded, 'night'))).toEqual([2, 1]);
  expect(materialsOf(withVariant(loaded, 1))).toEqual([2, 1]);
  expect(materialsOf(withVariant(loaded, 'day'))).toEqual([0, 1]);
  expect(withVariant(loaded, undefined)).toBe(loaded);
  expect(materialsOf(loaded)).toEqual([0, 1]);
  expect(withVariant(loaded, 'night').meshes).toBe(loaded.meshes);
});

test('missing variants', () => {
  expect(() => withVariant(scene(), 'noon')).toThrow(/"noon".*"day", "night"/);
  expect(() => withVariant(createScene(), 0)).toThrow(SceneError);
  const lost = scene();
  lost.instances[1]!.variants = { 0: 3 };
  expect(() => validateScene(lost)).toThrow(/material 3/);
  lost.instances[1]!.variants = { 2: 0 };
  expect(() => validateScene(lost)).toThrow(/variant 2/);
});
