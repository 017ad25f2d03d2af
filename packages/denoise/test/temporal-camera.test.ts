import { describe, expect, it } from 'vitest';
import { eyeOf, projectionOf } from '../src/temporal/camera';

/** Turned about two axes, scaled by 3, at (1, 2, 3). */
function camera() {
  const [c, s] = [Math.cos(0.7), Math.sin(0.7)];
  const [d, t] = [Math.cos(-0.4), Math.sin(-0.4)];
  const right = [c, 0, -s];
  const up = [s * t, d, c * t];
  const back = [s * d, -t, c * d];
  const columns = [right, up, back].flatMap((axis) => [...axis.map((x) => 3 * x), 0]);
  return { right, up, back, transform: [...columns, 1, 2, 3, 1] };
}

describe('projectionOf', () => {
  it('brings points along the rays of a perspective camera to their places in the image', () => {
    const { right, up, back, transform } = camera();
    const [yfov, aspect] = [0.8, 1.7];
    const m = projectionOf({ type: 'perspective', transform, yfov }, aspect)!;
    for (const [u, v, distance] of [
      [0, 0, 1],
      [1, -1, 0.2],
      [-0.3, 0.6, 40],
    ] as const) {
      const [x, y] = [u * aspect * Math.tan(yfov / 2), v * Math.tan(yfov / 2)];
      const point = [0, 1, 2].map((i) => i + 1 + distance * (x * right[i]! + y * up[i]! - back[i]!));
      const clip = [0, 1, 2, 3].map((row) =>
        [...point, 1].reduce((sum, p, column) => sum + m[4 * column + row]! * p, 0),
      );
      expect(clip[3]).toBeCloseTo(distance, 10);
      expect(clip[0]! / clip[3]!).toBeCloseTo(u, 10);
      expect(clip[1]! / clip[3]!).toBeCloseTo(v, 10);
    }
  });

  it('knows none of cameras of other kinds', () => {
    const { transform } = camera();
    expect(projectionOf({ type: 'orthographic', transform }, 1)).toBeUndefined();
    expect(projectionOf({ type: 'panorama', transform }, 1)).toBeUndefined();
  });
});

describe('eyeOf', () => {
  it('is the place of a camera, and far behind an orthographic one', () => {
    const { back, transform } = camera();
    expect(eyeOf({ type: 'perspective', transform })).toEqual([1, 2, 3]);
    const eye = eyeOf({ type: 'orthographic', transform });
    const off = [0, 1, 2].map((i) => eye[i]! - (i + 1));
    const length = Math.hypot(...off);
    expect(length).toBeGreaterThan(1e5);
    off.forEach((x, i) => expect(x / length).toBeCloseTo(back[i]!, 10));
  });
});
