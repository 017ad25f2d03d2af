import { expect, test } from 'vitest';
import { createScene, frameCamera, sceneBounds, type SceneError, type FrameCameraOptions, type Scene } from '../src/index';
import { points, sample } from './sample';

for (const options of [{ aspect: 1 }, { aspect: 3 }, { aspect: 0.4, yfov: 1.2 }, { aspect: 1.5, direction: [-3, 0.1, -1] }, { aspect: 1, margin: 0.3 }] satisfies FrameCameraOptions[]) {
  test(`everything is in the picture, and the box fills it: ${JSON.stringify(options)}`, () => {
    const scene = sample();
    const { transform: m, yfov, focus_distance } = frameCamera(scene, options);
    const tangent = Math.tan(yfov / 2);
    const project = (p: number[]) => {
      const d = p.map((x, k) => x - m[12 + k]!);
      const along = (column: number) => d[0]! * m[4 * column]! + d[1]! * m[4 * column + 1]! + d[2]! * m[4 * column + 2]!;
      expect(along(2)).toBeLessThan(0);
      return [along(0) / -along(2) / (tangent * options.aspect), along(1) / -along(2) / tangent];
    };
    for (const p of points(scene)) for (const x of project(p)) expect(Math.abs(x)).toBeLessThanOrEqual(1);
    const { min, max } = sceneBounds(scene);
    const corners = Array.from({ length: 8 }, (_, i) => project([0, 1, 2].map((k) => ((i >> k) & 1 ? max : min)[k as 0])));
    const margin = 'margin' in options ? options.margin : 0.06;
    expect(Math.max(...corners.flat().map(Math.abs))).toBeCloseTo(1 - margin, 9);
    const center = [0, 1, 2].map((k) => (min[k as 0] + max[k as 0]) / 2);
    expect(Math.hypot(...center.map((x, k) => x - m[12 + k]!))).toBeCloseTo(focus_distance!, 9);
    // A rotation: right-handed, no scale.
    const dot = (a: number, b: number) => [0, 1, 2].reduce((sum, k) => sum + m[4 * a + k]! * m[4 * b + k]!, 0);
    for (const [a, b, value] of [[0, 0, 1], [1, 1, 1], [2, 2, 1], [0, 1, 0], [0, 2, 0], [1, 2, 0]] as const) expect(dot(a, b)).toBeCloseTo(value, 12);
    expect(m[0]! * (m[5]! * m[10]! - m[6]! * m[9]!) - m[1]! * (m[4]! * m[10]! - m[6]! * m[8]!) + m[2]! * (m[4]! * m[9]! - m[5]! * m[8]!)).toBeCloseTo(1, 12);
  });
}

test('what cannot be framed is refused', () => {
  const code = (scene: Scene, options: FrameCameraOptions) => {
    try {
      frameCamera(scene, options);
    } catch (error) {
      return (error as SceneError).code;
    }
    return undefined;
  };
  expect(code(createScene(), { aspect: 1 })).toBe('scene/empty');
  for (const options of [{ aspect: 0 }, { aspect: 1, yfov: 4 }, { aspect: 1, direction: [0, 1, 0] as const }, { aspect: 1, margin: 1 }]) expect(code(sample(), options)).toBe('scene/value');
});
