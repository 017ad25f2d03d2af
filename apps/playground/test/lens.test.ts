import { expect, test } from 'vitest';
import { initialState } from '../src/state/state';
import { directionOf, fieldOfView, focalLength, STANDARD_VIEWS, withLens } from '../src/viewer/lens';

const camera = {
  type: 'perspective',
  name: 'c',
  transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 2, 1],
  yfov: 0.5,
  focus_distance: 2,
} as const;
const { lens } = initialState('studio');

test('focal lengths are those printed on full-frame lenses', () => {
  // Vertical angles of view from the data sheets of lenses: 24 mm 53°, 50 mm 27°, 85 mm 16°, 200 mm 7°.
  for (const [millimetres, degrees] of [
    [24, 53],
    [50, 27],
    [85, 16],
    [200, 7],
  ] as const)
    expect(Math.abs(fieldOfView(millimetres) - degrees)).toBeLessThan(0.6);
  expect(focalLength(fieldOfView(35))).toBeCloseTo(35, 9);
});

test('without an option for it the camera stays as it is', () => {
  expect(withLens(camera, lens, 1.5)).toEqual(camera);
});

test('the pupil of a 50 mm lens at f/2 is 25 mm wide', () => {
  const seen = withLens(camera, { ...lens, fov: fieldOfView(50), stop: 2, blades: 7, focus: 1.25 }, 1);
  expect(seen).toMatchObject({ lens_blades: 7, focus_distance: 1.25 });
  expect((seen as { lens_radius: number }).lens_radius).toBeCloseTo(0.0125, 9);
});

test('orthographic shows as much as perspective did at the distance in focus', () => {
  const seen = withLens(camera, { ...lens, projection: 'orthographic' }, 1.5);
  expect(seen).toMatchObject({ type: 'orthographic' });
  const { xmag, ymag } = seen as { xmag: number; ymag: number };
  expect(ymag).toBeCloseTo(2 * Math.tan(0.25), 9);
  expect(xmag).toBeCloseTo(1.5 * ymag, 9);
});

test('standard views look from where they say', () => {
  const expected = {
    front: [0, 0, 1],
    right: [1, 0, 0],
    back: [0, 0, -1],
    left: [-1, 0, 0],
    top: [0, 1, 0],
    bottom: [0, -1, 0],
  } as const;
  for (const [name, direction] of Object.entries(expected)) {
    const seen = directionOf(STANDARD_VIEWS[name as keyof typeof expected]);
    expect(Math.hypot(...seen), name).toBeCloseTo(1, 12);
    // Straight up and down views would have no "up": they are tilted to a pitch of 1.55, towards the front.
    const tilt = direction[1] === 0 ? 0 : Math.PI / 2 - 1.55;
    const angle = Math.acos(Math.min(1, seen[0] * direction[0] + seen[1] * direction[1] + seen[2] * direction[2]));
    expect(angle, name).toBeCloseTo(tilt, 7);
    if (tilt > 0) expect(seen[2], name).toBeCloseTo(Math.sin(tilt), 7);
  }
});
