import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { LightProfile, ProfileLight, Scene } from '@glanz/scene';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { addQuad, camera, createScene, lambert, meanOf } from '../scenes';

type Vector = readonly [number, number, number];

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

/** A profile of a function, at angles of its own choice: nothing of the renderer's grid. */
function profileOf(
  shine: (theta: number, phi: number) => number,
  verticals: number,
  horizontals: number,
  upTo = Math.PI,
): LightProfile {
  const vertical = Float32Array.from({ length: verticals }, (_, i) => (upTo * i) / (verticals - 1));
  const horizontal = Float32Array.from({ length: horizontals }, (_, i) => (2 * Math.PI * i) / horizontals);
  return {
    vertical,
    horizontal,
    intensities: Float32Array.from({ length: verticals * horizontals }, (_, i) =>
      shine(vertical[i % verticals]!, horizontal[Math.floor(i / verticals)]!),
    ),
  };
}

/** Sees only what lies at the origin of a floor, at an angle from the side, from 2 m away. */
const narrow = (() => {
  const [c, s] = [Math.cos(0.9), Math.sin(0.9)];
  return { ...camera, transform: [0, 1, 0, 0, -c, 0, s, 0, s, 0, c, 0, 2 * s, 0, 2 * c, 1], yfov: 1e-3 };
})();

async function seen(
  light: ProfileLight,
  options: Partial<PathTracerOptions> = {},
  more: Scene['lights'] = [],
): Promise<readonly number[]> {
  const scene = createScene();
  addQuad(scene, 20, 0, lambert(0.5));
  scene.lights.push(light, ...more);
  const tracer = await PathTracer.create(device, scene, {
    width: 4,
    height: 4,
    camera: narrow,
    maxDepth: 2,
    ...options,
  });
  for await (const _ of tracer.render({ samples: options.lightSampling ? 512 : 4 }));
  const pixels = await tracer.read('beauty');
  tracer.destroy();
  return meanOf(pixels, 4, 0, 0, 4, 4);
}

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const unit = (v: Vector): Vector => v.map((c) => c / Math.hypot(...v)) as unknown as Vector;

// Through a whole turn, and steep enough to tell angles from their neighbours.
const shine = (theta: number, phi: number) =>
  (1.2 + Math.cos(theta)) ** 2 * (2 + Math.sin(phi) + 0.5 * Math.cos(2 * phi));
const round = profileOf(shine, 361, 144);

it.each<[string, Vector, Vector, Vector]>([
  ['nearly straight above, its axis down', [0.1, -0.05, 2], [0, 0, -1], [1, 0, 0]],
  ['from the side', [1.5, 0.4, 1], [0, 0, -1], [1, 0, 0]],
  ['turned around its axis', [1.5, 0.4, 1], [0, 0, -1], [-0.3, 0.8, 0]],
  ['pointing away', [0.7, -1, 1.3], [0, 0, 1], [0, 1, 0]],
  ['slanted', [-1, 0.5, 1.5], unit([0.5, 0.2, -0.6]), [0, 1, 0.4]],
])('%s, a lamp lights a place by its profile over the squared distance', async (_, position, direction, tangent) => {
  const [r, g, b] = await seen({
    type: 'profile',
    name: 'lamp',
    color: [1, 0.5, 0.25],
    intensity: 3,
    position,
    direction,
    tangent,
    profile: round,
  });
  const outward = unit(position.map((c) => -c) as unknown as Vector);
  const x = unit(tangent.map((c, k) => c - dot(tangent, direction) * direction[k]!) as unknown as Vector);
  const y = cross(x, direction);
  const theta = Math.acos(Math.max(-1, Math.min(1, dot(outward, direction))));
  const phi = Math.atan2(dot(outward, y), dot(outward, x));
  const expected =
    ((0.5 / Math.PI) * 3 * shine(theta, phi < 0 ? phi + 2 * Math.PI : phi) * unit(position)[2]) /
    dot(position, position);
  [r, g, b].forEach((value, k) => expect(Math.abs(value! / ([1, 0.5, 0.25][k]! * expected) - 1)).toBeLessThan(0.005));
});

it('the same all around with one horizontal angle; dark beyond the last vertical one', async () => {
  const profile = profileOf((theta) => Math.max(0, Math.cos(theta)), 91, 1, Math.PI / 2);
  const at = (position: Vector, direction: Vector) =>
    seen({ type: 'profile', name: 'lamp', color: [1, 1, 1], intensity: 1, position, direction, profile });
  const [slanted] = await at([1, 1, 1], [0, 0, -1]);
  // Lambert's lamp over Lambert's floor: cos² over the squared distance.
  expect(Math.abs(slanted! / ((0.5 / Math.PI) * (1 / 3) * (1 / 3)) - 1)).toBeLessThan(0.002);
  expect(await at([1, 1, 1], [0, 0, 1])).toEqual([0, 0, 0]);
});

it('is found among others by the tree and by power', async () => {
  const spread: Scene['lights'] = Array.from({ length: 12 }, (_, i) => ({
    type: 'point',
    name: `${i}`,
    color: [1, 1, 1],
    intensity: 0.05,
    position: [Math.cos(i), Math.sin(i), 1 + 0.1 * i],
  }));
  const beam = profileOf((theta) => (theta < 0.3 ? 5 : 0), 181, 1);
  // The beam hits the place, a second lamp of the same kind misses it.
  const lamp = (x: number): ProfileLight => ({
    type: 'profile',
    name: `lamp ${x}`,
    color: [1, 1, 1],
    intensity: 1,
    position: [x, 0, 2],
    direction: [0, 0, -1],
    profile: beam,
  });
  const expected =
    (0.5 / Math.PI) *
    (5 / 4 +
      spread.reduce(
        (sum, light) =>
          sum + (light.type === 'point' ? (0.05 * light.position[2]) / Math.hypot(...light.position) ** 3 : 0),
        0,
      ));
  for (const lightSampling of ['tree', 'power'] as const) {
    const [value] = await seen(lamp(0), { lightSampling }, [lamp(5), ...spread]);
    expect(Math.abs(value! / expected - 1), lightSampling).toBeLessThan(0.02);
  }
});
