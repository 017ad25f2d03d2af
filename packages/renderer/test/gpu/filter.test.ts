import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { OrthographicCamera } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PixelFilter } from '../../src/index';
import { addQuad, createScene } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

/** As far as the widest filter reaches from the corner, and a pixel more. */
const SIZE = 8;

/** One pixel of the image is one unit of the world. */
const camera: OrthographicCamera = {
  type: 'orthographic',
  name: 'o',
  transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 3, 1],
  xmag: 4,
  ymag: 4,
};

const gauss = (x: number, sigma: number) => Math.exp(-0.5 * (x / sigma) ** 2);
const harris = (t: number) =>
  0.35875 -
  0.48829 * Math.cos(2 * Math.PI * t) +
  0.14128 * Math.cos(4 * Math.PI * t) -
  0.01168 * Math.cos(6 * Math.PI * t);

/** Share of a filter (in one dimension, support ±radius) that lies right of x. */
function rightOf(weight: (x: number) => number, radius: number, x: number): number {
  let all = 0;
  let right = 0;
  const n = 20000;
  for (let i = 0; i < n; i++) {
    const at = ((i + 0.5) / n) * 2 * radius - radius;
    const w = weight(at);
    all += w;
    if (at > x) right += w;
  }
  return right / all;
}

const CASES: readonly (readonly [name: string, filter: PixelFilter, radius: number, weight: (x: number) => number])[] =
  [
    ['box', 'box', 0.5, () => 1],
    ['a wider box', { type: 'box', radius: 1.25 }, 1.25, () => 1],
    ['Gaussian', 'gaussian', 1.5, (x) => gauss(x, 0.5)],
    ['a wider Gaussian', { type: 'gaussian', radius: 3 }, 3, (x) => gauss(x, 1)],
    ['Blackman-Harris', 'blackman-harris', 1.5, (x) => harris((x + 1.5) / 3)],
  ];

describe('pixel filters', () => {
  it.each(CASES)(
    '%s: the corner of a bright quadrant is the analytic convolution',
    async (_, filter, radius, weight) => {
      const scene = createScene();
      // Bright where x > 0.3 and y > −0.2.
      addQuad(
        scene,
        50,
        0,
        { name: 'glow', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 1 } },
        { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 50.3, 49.8, 0, 1] },
      );
      const tracer = await PathTracer.create(device, scene, {
        width: SIZE,
        height: SIZE,
        camera,
        filter,
        background: 'transparent',
        maxDepth: 1,
        pathsInFlight: 1 << 16,
      });
      for await (const _progress of tracer.render({ samples: 4096, maxSubmitMs: 2000 }));
      const pixels = await tracer.read('beauty');
      let worst = 0;
      for (let y = 0; y < SIZE; y++) {
        for (let x = 0; x < SIZE; x++) {
          const across = rightOf(weight, radius, 0.3 - (x + 0.5 - SIZE / 2));
          const up = rightOf(weight, radius, -0.2 - (SIZE / 2 - y - 0.5));
          worst = Math.max(worst, Math.abs((pixels[4 * (SIZE * y + x)] as number) - across * up));
          // Coverage is filtered alike.
          expect(pixels[4 * (SIZE * y + x) + 3]).toBe(pixels[4 * (SIZE * y + x)]);
        }
      }
      // 4096 Sobol points: an axis-aligned corner is counted to about 1/1000; independent ones would have 4σ = 0.03.
      expect(worst).toBeLessThan(0.002);
      tracer.destroy();
    },
  );

  it('refuses a filter or radius that is none', async () => {
    const scene = createScene();
    addQuad(scene, 1, 0, { name: 'm', parameters: {} });
    for (const filter of [
      'mitchell' as 'box',
      { type: 'gaussian', radius: 0 } as const,
      { type: 'box', radius: Number.NaN } as const,
    ]) {
      await expect(PathTracer.create(device, scene, { width: 4, height: 4, filter })).rejects.toMatchObject({
        code: 'renderer/filter',
      });
    }
  });
});
