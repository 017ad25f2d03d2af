import { describe, expect, it } from 'vitest';
import { OrbitRig } from '../src/orbit';

const bounds = { min: [-1, -1, -1], max: [1, 1, 1] } as const;
const front = {
  type: 'perspective',
  name: 'front',
  transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1],
  yfov: 0.6,
} as const;
const eye = (rig: OrbitRig) => Array.from(rig.camera().transform).slice(12, 15);

describe('OrbitRig', () => {
  it('keeps its axes at right angles, whatever is done', () => {
    const rig = new OrbitRig(front, bounds, { damping: 0 });
    for (let i = 0; i < 50; i++) {
      rig.orbit(Math.sin(i), Math.cos(3 * i));
      rig.pan(Math.sin(5 * i), Math.cos(7 * i));
      rig.zoom(1 + 0.5 * Math.sin(11 * i));
      rig.jump();
      const m = rig.camera().transform;
      const dot = (a: number, b: number) => m[a]! * m[b]! + m[a + 1]! * m[b + 1]! + m[a + 2]! * m[b + 2]!;
      [dot(0, 0), dot(4, 4), dot(8, 8), dot(0, 4), dot(0, 8), dot(4, 8)].forEach((value, k) =>
        expect(value).toBeCloseTo(k < 3 ? 1 : 0, 9),
      );
    }
  });

  it('returns the orbit that it was given, with the magnification of a parallel projection', () => {
    for (const camera of [
      front,
      { type: 'orthographic', name: 'side', transform: front.transform, xmag: 4, ymag: 2 } as const,
    ]) {
      const rig = new OrbitRig(camera, bounds, { damping: 0 });
      rig.orbit(0.4, 0.2);
      rig.zoom(3);
      rig.pan(0.1, 0.2);
      const other = new OrbitRig(camera, bounds, { damping: 0 });
      other.setOrbit(rig.goal);
      rig.jump();
      other.jump();
      expect(rig.goal.zoom).toBe(camera === front ? undefined : 3);
      const [a, b] = [rig.camera(), other.camera()];
      Array.from(a.transform).forEach((value, i) => expect(b.transform[i]).toBeCloseTo(value, 10));
      if (b.type === 'orthographic') expect(b.ymag).toBeCloseTo(2 / 3, 12);
    }
  });

  it('begins where the camera stands, and orbits the point beside the centre of the scene', () => {
    const rig = new OrbitRig(front, bounds);
    Array.from(rig.camera().transform).forEach((value, i) =>
      expect(value).toBeCloseTo(front.transform[i] as number, 12),
    );
    expect(rig.goal).toEqual({ theta: 0, phi: Math.PI / 2, radius: 5, target: [0, 0, 0] });
  });

  it('is the camera that it was given, to the last bit, until it moves and again when it is back', () => {
    // Rolled by a third of a turn, not looking at the middle, with a lens that is focused beside it.
    const [c, k] = [Math.cos(1.1), Math.sin(1.1)];
    const rolled = {
      ...front,
      transform: [c, k, 0, 0, -k, c, 0, 0, 0, 0, 1, 0, 0.1, 0.2, 5.3, 1],
      lens_radius: 0.1,
      focus_distance: 1.7,
    };
    const rig = new OrbitRig(rolled, bounds, { damping: 0 });
    expect(rig.camera()).toEqual(rolled);
    rig.orbit(0.3, 0);
    rig.step(0.016);
    const turned = rig.camera();
    expect(turned).not.toEqual(rolled);
    // Upright, and focused at its target.
    expect(turned.transform[1]).toBe(0);
    expect(turned).toMatchObject({ focus_distance: rig.goal.radius });
    rig.yfov = 0.5;
    rig.setCamera(rolled);
    rig.step(0.016);
    expect(rig.camera()).toEqual(rolled);
    rig.yfov = 0.5;
    expect(rig.camera()).toEqual({ ...rolled, yfov: 0.5 });
    // Where limits do not let it stand, it is not.
    const limited = new OrbitRig(rolled, bounds, { damping: 0, limits: { radius: [1, 2] } });
    expect(Math.hypot(...eye(limited))).toBeLessThan(2.3);
  });

  it('stands where spherical coordinates say', () => {
    const rig = new OrbitRig(front, bounds, { damping: 0 });
    const [theta, phi, radius] = [0.7, 1.1, 3];
    rig.setOrbit({ theta, phi, radius, target: [1, 2, 3] });
    rig.step(0.016);
    const expected = [
      1 + radius * Math.sin(phi) * Math.sin(theta),
      2 + radius * Math.cos(phi),
      3 + radius * Math.sin(phi) * Math.cos(theta),
    ];
    eye(rig).forEach((value, k) => expect(value).toBeCloseTo(expected[k] as number, 10));
    // It looks at the target: its third axis points away from it.
    const m = rig.camera().transform;
    [8, 9, 10].forEach((i, k) => expect(m[i]).toBeCloseTo(((expected[k] as number) - [1, 2, 3][k]!) / radius, 10));
  });

  it('goes the short way round', () => {
    const rig = new OrbitRig(front, bounds);
    rig.setOrbit({ theta: 3 });
    rig.jump();
    rig.setOrbit({ theta: -3 });
    expect(rig.goal.theta).toBeCloseTo(2 * Math.PI - 3, 10);
  });

  it('gets as far in a second whatever the rate of frames, and then rests', () => {
    const after = (frames: number) => {
      const rig = new OrbitRig(front, bounds, { damping: 0.5 });
      rig.orbit(1, 0.2);
      rig.zoom(2);
      for (let i = 0; i < frames; i++) rig.step(0.4 / frames);
      return rig.orbitNow;
    };
    // Exponential decay: 1 − e^(−0.4 / 0.5) of the way.
    const share = 1 - Math.exp(-0.8);
    for (const frames of [4, 24, 96]) {
      expect(after(frames).theta).toBeCloseTo(share, 9);
      expect(after(frames).radius).toBeCloseTo(5 * 0.5 ** share, 9);
    }
    const rig = new OrbitRig(front, bounds, { damping: 0.05 });
    rig.orbit(1, 0);
    let steps = 0;
    while (rig.step(1 / 60)) steps++;
    expect(steps).toBeGreaterThan(5);
    expect(steps).toBeLessThan(60);
    expect(rig.orbitNow).toEqual(rig.goal);
    expect(rig.moving).toBe(false);
  });

  it('pans in the plane of the image: a height of the image moves the target by what is seen of it', () => {
    const rig = new OrbitRig(front, bounds, { damping: 0 });
    rig.pan(0, 1);
    rig.step(0.016);
    expect(rig.goal.target[1]).toBeCloseTo(2 * 5 * Math.tan(0.3), 10);
  });

  it('stays off the poles, and refuses what is not finite', () => {
    const rig = new OrbitRig(front, bounds, { damping: 0 });
    rig.orbit(0, 10);
    rig.step(0.016);
    const before = rig.goal;
    for (const wrong of [
      { theta: Number.NaN },
      { radius: Infinity },
      { theta: 1, radius: 0 },
      { target: [0, Number.NaN, 0] as const },
      { phi: '1' as never },
    ]) {
      expect(() => rig.setOrbit(wrong)).toThrow(expect.objectContaining({ code: 'viewer/camera' }));
    }
    for (const wrong of [Number.NaN, Infinity, -1e30]) {
      for (const change of [
        () => rig.orbit(wrong, 0),
        () => rig.orbit(0, wrong),
        () => rig.pan(wrong, 0),
        () => rig.zoom(wrong),
        () => rig.focus([0, wrong, 0]),
        () => void (rig.yfov = wrong),
        () => rig.setCamera({ ...front, yfov: wrong }),
      ]) {
        expect(change).toThrow(expect.objectContaining({ code: 'viewer/camera' }));
      }
      expect(() => void (rig.damping = wrong)).toThrow(expect.objectContaining({ code: 'viewer/option' }));
    }
    expect(rig.goal).toEqual(before);
    rig.step(Number.NaN);
    expect(rig.goal.phi).toBeCloseTo((0.5 * Math.PI) / 180, 10);
    expect(eye(rig).every(Number.isFinite)).toBe(true);
    rig.zoom(1e6);
    expect(rig.goal.radius).toBeGreaterThan(0);
  });

  it('keeps to its limits, by user input and by calls', () => {
    const rig = new OrbitRig(front, bounds, {
      damping: 0,
      limits: { theta: [-0.5, 0.5], phi: [1, 2], radius: [4, 6] },
    });
    rig.orbit(3, 1);
    expect(rig.goal.theta).toBe(0.5);
    expect(rig.goal.phi).toBeCloseTo(1, 12);
    rig.zoom(100);
    expect(rig.goal.radius).toBe(4);
    rig.setOrbit({ theta: -1, phi: 3, radius: 50 });
    expect(rig.goal).toMatchObject({ theta: -0.5, radius: 6 });
    expect(rig.goal.phi).toBeCloseTo(2, 12);
    rig.limits = { radius: [1, 2] };
    expect(rig.goal.radius).toBe(2);
  });

  it('zooms parallel projections by their size', () => {
    const rig = new OrbitRig(
      { type: 'orthographic', name: 'o', transform: front.transform, xmag: 2, ymag: 1 },
      bounds,
      { damping: 0 },
    );
    rig.zoom(2);
    rig.step(0.016);
    expect(rig.camera()).toMatchObject({ xmag: 1, ymag: 0.5 });
  });

  it('serves a scene without a size', () => {
    const rig = new OrbitRig(front, { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] });
    rig.zoom(3);
    rig.jump();
    expect(eye(rig).every(Number.isFinite)).toBe(true);
  });
});
