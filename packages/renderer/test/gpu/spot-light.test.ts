import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { SpotLight } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer } from '../../src/index';
import { addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const SIZE = 16;
const ALBEDO = 0.6;
/** Points across and down a pixel. */
const GRID = 16;

const spot = (
  inner: number,
  outer: number,
  position: SpotLight['position'],
  direction: SpotLight['direction'],
): SpotLight => ({
  type: 'spot',
  name: 'spot',
  color: [1, 1, 1],
  intensity: 3,
  position,
  direction,
  inner_cone_angle: inner,
  outer_cone_angle: outer,
});

/**
 * Light that a matt floor in the plane z = 0 sends back, without a renderer: KHR_lights_punctual's cone over squared
 * distance and times the cosine, over a grid of points in each pixel. The test's camera sees from −1 to 1 there.
 */
function integrate(lights: readonly SpotLight[]): Float64Array {
  const image = new Float64Array(SIZE * SIZE);
  for (let i = 0; i < SIZE * SIZE * GRID * GRID; i++) {
    const pixel = Math.floor(i / (GRID * GRID));
    const x = (2 * ((pixel % SIZE) + ((i % GRID) + 0.5) / GRID)) / SIZE - 1;
    const y = 1 - (2 * (Math.floor(pixel / SIZE) + ((Math.floor(i / GRID) % GRID) + 0.5) / GRID)) / SIZE;
    for (const { intensity, position: p, direction: d, inner_cone_angle, outer_cone_angle } of lights) {
      const away = [x - p[0], y - p[1], -p[2]] as const;
      const distance = Math.hypot(...away);
      const cosine = (away[0] * d[0] + away[1] * d[1] + away[2] * d[2]) / (distance * Math.hypot(...d));
      const outer = Math.cos(outer_cone_angle);
      // The extension's own words, by which the sharpest edge is 0.001 wide.
      const cone =
        Math.min(1, Math.max(0, (cosine - outer) / Math.max(0.001, Math.cos(inner_cone_angle) - outer))) ** 2;
      image[pixel] =
        (image[pixel] as number) +
        ((ALBEDO / Math.PI) * intensity * cone * (p[2] / distance)) / distance ** 2 / GRID ** 2;
    }
  }
  return image;
}

const mean = (values: ArrayLike<number>) => Array.from(values).reduce((sum, value) => sum + value, 0) / values.length;

describe('spot lights on a floor, beside an integration of the same without a renderer', () => {
  const above = spot(0.25, 0.6, [0, 0, 1], [0, 0, -1]);
  it.each([
    ['half of it penumbra', [above], 'tree'],
    ['nothing but penumbra, aslant', [spot(0, 0.7, [-0.9, 0.4, 0.8], [1, -0.3, -1])], 'tree'],
    ['without penumbra', [spot(0.45, 0.45, [0.2, 0.1, 1.2], [0, 0.1, -1])], 'tree'],
    ['wide as can be', [spot(1.2, Math.PI / 2, [0.1, 0, 0.5], [0.2, 0, -1])], 'tree'],
    [
      'several, by the tree',
      [above, spot(0.05, 0.3, [0.7, 0.7, 1.5], [-0.1, -0.1, -1]), spot(0, 0.9, [-1.2, 0, 0.4], [1, 0, -0.6])],
      'tree',
    ],
    [
      'several, by power',
      [above, spot(0.05, 0.3, [0.7, 0.7, 1.5], [-0.1, -0.1, -1]), spot(0, 0.9, [-1.2, 0, 0.4], [1, 0, -0.6])],
      'power',
    ],
  ] as const)('%s', async (_, lights, lightSampling) => {
    const scene = createScene();
    addQuad(scene, 2, 0, lambert(ALBEDO));
    scene.lights.push(...lights);
    const tracer = await PathTracer.create(device, scene, {
      width: SIZE,
      height: SIZE,
      camera,
      maxDepth: 2,
      lightSampling,
    });
    for await (const progress of tracer.render({ samples: 256 })) void progress;
    const [beauty, variance] = [await tracer.read('beauty'), await tracer.read('variance')];
    tracer.destroy();
    const expected = integrate(lights);
    const rendered = expected.map((_value, i) => beauty[4 * i + 1] as number);
    const largest = Math.max(...expected);
    // Both know an edge within a pixel by some hundred points only: that is 1 % of what it parts.
    for (let i = 0; i < expected.length; i++)
      expect(Math.abs(rendered[i]! - expected[i]!)).toBeLessThan(6 * Math.sqrt(variance[4 * i + 1]!) + 0.01 * largest);
    expect(Math.abs(mean(rendered) / mean(expected) - 1)).toBeLessThan(lights.length > 1 ? 0.005 : 0.001);
  });
});
