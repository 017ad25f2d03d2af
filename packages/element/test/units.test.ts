import { describe, expect, it } from 'vitest';
import { angle, length, readFieldOfView, readLimit, readOrbit, readPoint } from '../src/units';

const basis = { theta: 0, phi: 1.3, radius: 2, share: 1.05 };

describe('units', () => {
  it('reads angles and lengths', () => {
    expect(angle('90deg')).toBeCloseTo(Math.PI / 2, 12);
    expect(angle('-1.5rad')).toBe(-1.5);
    expect(angle('.25turn')).toBeCloseTo(Math.PI / 2, 12);
    expect(angle('180')).toBeCloseTo(Math.PI, 12);
    expect(angle('auto')).toBeUndefined();
    expect(angle('1m')).toBeUndefined();
    expect(length('25cm')).toEqual({ metres: 0.25 });
    expect(length('5mm')).toEqual({ metres: 0.005 });
    expect(length('105%')).toEqual({ share: 1.05 });
    expect(length('3')).toEqual({ metres: 3 });
    expect(length('3deg')).toBeUndefined();
  });

  it('reads orbits, with what is left out from the scene', () => {
    expect(readOrbit('45deg 60deg 3m', basis)).toEqual({ theta: Math.PI / 4, phi: Math.PI / 3, radius: 3 });
    expect(readOrbit(null, basis)).toEqual({ theta: 0, phi: 1.3, radius: 2.1 });
    expect(readOrbit('auto 1rad 50%', basis)).toEqual({ theta: 0, phi: 1, radius: 1 });
    expect(readOrbit('nonsense', basis)).toEqual({ theta: 0, phi: 1.3, radius: 2.1 });
    expect(readOrbit('0deg 0deg -4m', basis).radius).toBe(2.1);
  });

  it('reads limits', () => {
    expect(readLimit('auto 30deg auto', basis)).toEqual({ theta: undefined, phi: Math.PI / 6, radius: undefined });
    expect(readLimit('-Infinity 0deg 50%', basis)).toEqual({ theta: undefined, phi: 0, radius: 1 });
  });

  it('reads points and fields of view', () => {
    expect(readPoint('1m auto -20cm', [5, 6, 7])).toEqual([1, 6, -0.2]);
    expect(readPoint(null, [5, 6, 7])).toEqual([5, 6, 7]);
    expect(readFieldOfView('45deg')).toBeCloseTo(Math.PI / 4, 12);
    expect(readFieldOfView('auto')).toBeCloseTo(Math.PI / 6, 12);
    expect(readFieldOfView('200deg')).toBeCloseTo(Math.PI / 6, 12);
  });
});
