import type { Camera } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { RenderError } from '../../src/errors';
import { cameraUniforms } from '../../src/camera/camera';

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 4, 5, 1];

describe('cameraUniforms', () => {
  it('looks along −Z with +X to the right and +Y up', () => {
    const u = cameraUniforms({ type: 'perspective', name: '', transform: identity, yfov: Math.PI / 2 }, 200, 100);
    expect(u.camera_origin).toEqual([3, 4, 5]);
    expect(u.camera_forward.map((x) => x + 0)).toEqual([-0, -0, -1].map((x) => x + 0));
    expect(u.camera_right).toEqual([1, 0, 0]);
    expect(u.camera_up).toEqual([0, 1, 0]);
    expect(u.half_extent[0]).toBeCloseTo(2, 12);
    expect(u.half_extent[1]).toBeCloseTo(1, 12);
  });

  it('ignores the scale of the transform', () => {
    const scaled = identity.map((x, i) => (i < 12 ? x * 7 : x));
    const u = cameraUniforms({ type: 'perspective', name: '', transform: scaled, yfov: 1 }, 10, 10);
    expect(Math.hypot(...u.camera_forward)).toBeCloseTo(1, 12);
  });

  const bad = (changes: object) => () =>
    cameraUniforms({ type: 'perspective', name: 'c', transform: identity, yfov: 1, ...changes } as Camera, 10, 10);

  it.each(
    [0, 5, 13]
      .flatMap((at) => [NaN, Infinity, -Infinity].map((value) => [at, value] as const))
      .concat([
        [12, 1e30],
        [14, -1e13],
      ]),
  )('refuses a transform with %2$s at %1$s', (at, value) => {
    expect(bad({ transform: identity.map((x, i) => (i === at ? value : x)) })).toThrow(
      expect.objectContaining({ code: 'renderer/camera' }) as Error,
    );
  });

  it.each<object>([
    { transform: [1, 2, 3] },
    { transform: undefined },
    { lens_radius: -1 },
    { lens_radius: NaN },
    { focus_distance: 0 },
    { focus_distance: Infinity },
    { lens_blades: NaN },
    { lens_rotation: Infinity },
    { type: 'orthographic', xmag: 1, ymag: Infinity },
    { type: 'orthographic', xmag: NaN, ymag: 1 },
    { type: 'fisheye' },
  ])('refuses %j', (changes) => {
    expect(bad(changes)).toThrow(expect.objectContaining({ code: 'renderer/camera' }) as Error);
  });

  it.each([0, -1, Math.PI, Number.NaN])('refuses a field of view of %s', (yfov) => {
    expect(() => cameraUniforms({ type: 'perspective', name: 'c', transform: identity, yfov }, 10, 10)).toThrow(
      RenderError,
    );
  });
});
