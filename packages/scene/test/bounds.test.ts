import { expect, test } from 'vitest';
import { createScene, sceneBounds } from '../src/index';
import { points, sample } from './sample';

test('the box of the used, visible vertices in the world', () => {
  const scene = sample();
  const all = points(scene);
  const { min, max } = sceneBounds(scene);
  for (const k of [0, 1, 2] as const) {
    expect(min[k]).toBeCloseTo(Math.min(...all.map((p) => p[k]!)), 12);
    expect(max[k]).toBeCloseTo(Math.max(...all.map((p) => p[k]!)), 12);
  }
  scene.instances[1]!.visible = false;
  expect(sceneBounds(scene)).toEqual({ min: [0, 0, 0], max: [2, 1, 3] });
});

test('a turned box is measured by its vertices, not by its turned box', () => {
  const scene = sample();
  const s = Math.SQRT1_2;
  scene.meshes[0]!.positions = new Float32Array([1, 0, 0, 0, 1, 0, -1, 0, 0]);
  scene.instances = [{ name: 'turned', mesh: 0, material: 0, transform: [s, s, 0, 0, -s, s, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }];
  const { min, max } = sceneBounds(scene);
  // (1,0) → (s,s), (0,1) → (−s,s), (−1,0) → (−s,−s); the box of the unturned box would reach 2s.
  for (const [value, expected] of [[min[0], -s], [min[1], -s], [max[0], s], [max[1], s]] as const) expect(value).toBeCloseTo(expected, 12);
});

test('an empty scene has an inverted box', () => {
  expect(sceneBounds(createScene())).toEqual({ min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] });
});
