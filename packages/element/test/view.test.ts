import { createScene, defaultMaterial, type Scene } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { cameraOf, describeView, limitsOf, orbitOf } from '../src/view';

/** A box from (−1, 0, −2) to (3, 4, 2). */
function box(): Scene {
  const scene = createScene();
  scene.meshes.push({
    name: 'box',
    positions: Float32Array.of(-1, 0, -2, 3, 0, -2, 3, 4, 2, -1, 4, 2),
    indices: Uint32Array.of(0, 1, 2, 0, 2, 3),
  });
  scene.materials.push(defaultMaterial());
  scene.instances.push({
    name: 'box',
    mesh: 0,
    material: 0,
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  });
  return scene;
}

const nothing = { orbit: null, target: null, fieldOfView: null, min: null, max: null };
const eyeOf = (camera: { readonly transform: ArrayLike<number> }) => Array.from(camera.transform).slice(12, 15);

describe('views by attributes', () => {
  it('frames the ball around the scene by default, from the front and 15° above', () => {
    const orbit = orbitOf(box(), 1.5, nothing);
    const radius = 0.5 * Math.hypot(4, 4, 4);
    expect(orbit.target).toEqual([1, 2, 0]);
    expect(orbit.radius).toBeCloseTo((1.05 * radius) / Math.sin(Math.PI / 12), 10);
    const eye = eyeOf(cameraOf(box(), 1.5, nothing));
    expect(eye[0]).toBeCloseTo(1, 10);
    expect(eye[1]).toBeCloseTo(2 + orbit.radius * Math.sin(Math.PI / 12), 10);
    expect(eye[2]).toBeCloseTo(orbit.radius * Math.cos(Math.PI / 12), 10);
  });

  it('makes rotations: orthonormal, right-handed, upright', () => {
    for (const orbit of ['0deg 75deg 3m', '130deg 20deg 3m', '-70deg 140deg 3m', '10deg 0deg 3m']) {
      const m = cameraOf(box(), 1, { ...nothing, orbit }).transform as number[];
      const [x, y, z] = [m.slice(0, 3), m.slice(4, 7), m.slice(8, 11)] as [number[], number[], number[]];
      const dot = (a: number[], b: number[]) => a.reduce((sum, value, k) => sum + value * b[k]!, 0);
      for (const axis of [x, y, z]) expect(dot(axis, axis)).toBeCloseTo(1, 10);
      expect(dot(x, y)).toBeCloseTo(0, 10);
      const cross = [x[1]! * y[2]! - x[2]! * y[1]!, x[2]! * y[0]! - x[0]! * y[2]!, x[0]! * y[1]! - x[1]! * y[0]!];
      cross.forEach((value, k) => expect(value).toBeCloseTo(z[k]!, 10));
      expect(x[1]).toBe(0);
      expect(y[1]).toBeGreaterThan(0);
    }
  });

  it('sets limits', () => {
    expect(limitsOf(box(), 1, nothing)).toEqual({});
    expect(limitsOf(box(), 1, { ...nothing, min: '-45deg auto 2m', max: '45deg 90deg auto' })).toEqual({
      theta: [-Math.PI / 4, Math.PI / 4],
      phi: [-Infinity, Math.PI / 2],
      radius: [2, Infinity],
    });
  });

  it.each([
    [0, 1.5, 'from the front'],
    [Math.PI / 4, 1, 'from the front right, above'],
    [-Math.PI / 2, 1.5, 'from the left'],
    [Math.PI, 2.2, 'from the back, below'],
    [7 * Math.PI, 0.1, 'from the back, straight above'],
  ])('says where it is seen from: θ %d, φ %d', (theta, phi, text) => expect(describeView({ theta, phi })).toBe(text));
});
