import { expect, test } from '@playwright/test';
import { fitCamera, OrbitCamera } from '../src/viewer/orbit-camera';

const bounds = { min: [-1, -1, -1], max: [1, 1, 1] } as const;
const camera = { type: 'perspective', name: 'front', transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1], yfov: 0.6 } as const;
const eyeOf = (orbit: OrbitCamera) => [12, 13, 14].map((i) => orbit.camera().transform[i]!);
const near = (given: ArrayLike<number>, wanted: readonly number[]) => wanted.forEach((value, i) => expect(given[i]).toBeCloseTo(value, 9));

test('starts where the given camera is', () => {
  near(new OrbitCamera(camera, bounds).camera().transform, camera.transform);
});

test('a quarter turn to the right looks from +x, up looks from +y', () => {
  const orbit = new OrbitCamera(camera, bounds);
  orbit.orbit(Math.PI / 2, 0);
  near(orbit.camera().transform, [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 5, 0, 0, 1]);
  orbit.orbit(0, 10);
  expect(eyeOf(orbit)[1]).toBeGreaterThan(4.9);
});

test('the axes stay at right angles, whatever is done', () => {
  const orbit = new OrbitCamera(camera, bounds);
  for (let i = 0; i < 50; i++) {
    orbit.orbit(Math.sin(i), Math.cos(3 * i));
    orbit.pan(Math.sin(5 * i), Math.cos(7 * i));
    orbit.zoom(1 + 0.5 * Math.sin(11 * i));
    const m = orbit.camera().transform;
    const dot = (a: number, b: number) => m[a]! * m[b]! + m[a + 1]! * m[b + 1]! + m[a + 2]! * m[b + 2]!;
    near([dot(0, 0), dot(4, 4), dot(8, 8), dot(0, 4), dot(0, 8), dot(4, 8)], [1, 1, 1, 0, 0, 0]);
  }
});

test('a pan by one height shifts by what the picture is high', () => {
  const orbit = new OrbitCamera(camera, bounds);
  orbit.pan(0, 1);
  near(eyeOf(orbit), [0, 2 * 5 * Math.tan(0.3), 5]);
});

test('a zoom by 2 halves the distance to the point in focus', () => {
  const orbit = new OrbitCamera(camera, bounds);
  orbit.zoom(2);
  near(eyeOf(orbit), [0, 0, 2.5]);
});

test('a parallel projection magnifies instead', () => {
  const orbit = new OrbitCamera({ type: 'orthographic', name: 'side', transform: camera.transform, xmag: 4, ymag: 2 }, bounds);
  orbit.zoom(4);
  expect(orbit.camera()).toMatchObject({ xmag: 1, ymag: 0.5 });
});

test('a film narrower than the author’s keeps the width of the view', () => {
  const fitted = fitCamera({ ...camera, aspect: 2 }, 1);
  expect(fitted.type === 'perspective' && Math.tan(fitted.yfov / 2)).toBeCloseTo(2 * Math.tan(0.3), 9);
  expect(fitCamera({ ...camera, aspect: 1 }, 2)).toMatchObject({ yfov: 0.6 });
});
