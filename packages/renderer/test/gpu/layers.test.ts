import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { readFloats } from '../../src/storage/read-buffer';
import { casesOf } from '../full';
import { addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

/** A noisy image: a plane lit by a small bright square that half of the light samples miss behind a blind. */
function noisy() {
  const scene = createScene();
  addQuad(scene, 3, 0, lambert(0.7));
  addQuad(scene, 0.4, 0.6, lambert(0.2), { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5, 0.2, 0, 1] });
  addQuad(
    scene,
    0.5,
    1.5,
    { name: 'light', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 5 } },
    { flip: true, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1.1, 0.3, 0, 1] },
  );
  scene.environment = { type: 'constant', radiance: [0.1, 0.2, 0.3] };
  return scene;
}

describe('variance', () => {
  it.each(
    casesOf<readonly [NonNullable<PathTracerOptions['sampler']>, number, number]>(
      ['independent', 0.85, 1.2],
      // Sobol points vary less from chunk to chunk than the chunks' spread tells.
      ['sobol', 0.9, 4],
    ),
  )('%s: the estimate against the spread of many images', async (sampler, low, high) => {
    const runs = 24;
    const size = 12;
    const sum = new Float64Array(size * size * 3);
    const squares = new Float64Array(size * size * 3);
    let estimated = 0;
    for (let seed = 0; seed < runs; seed++) {
      const tracer = await PathTracer.create(device, noisy(), {
        width: size,
        height: size,
        camera,
        sampler,
        seed,
        maxDepth: 3,
        pathsInFlight: 1 << 14,
      });
      for await (const _ of tracer.render({ samples: 64, maxSubmitMs: 1000 }));
      const [beauty, variance] = [await tracer.read('beauty'), await tracer.read('variance')];
      for (let i = 0; i < size * size; i++) {
        expect(variance[4 * i + 3]).toBe(64);
        for (let c = 0; c < 3; c++) {
          const value = beauty[4 * i + c] as number;
          sum[3 * i + c] = (sum[3 * i + c] as number) + value;
          squares[3 * i + c] = (squares[3 * i + c] as number) + value * value;
          estimated += (variance[4 * i + c] as number) / runs;
        }
      }
      tracer.destroy();
    }
    let actual = 0;
    sum.forEach((s, i) => (actual += ((squares[i] as number) - (s * s) / runs) / (runs - 1)));
    expect(actual).toBeGreaterThan(0);
    // 432 numbers with 23 degrees of freedom each: the ratio is known to some percent.
    const ratio = estimated / actual;
    expect(ratio).toBeGreaterThan(low);
    expect(ratio).toBeLessThan(high);
  });

  it.each([
    ['from the first sample', 0],
    // The first chunk is not whole.
    ['from sample 5', 5],
  ] as const)('on the GPU: the layer that is read, %s', async (_, firstSample) => {
    const scene = noisy();
    scene.lights.push({ type: 'point', name: 'point', color: [1, 1, 1], intensity: 2, position: [0.3, 1, 0.2] });
    const tracer = await PathTracer.create(device, scene, {
      width: 12,
      height: 8,
      camera,
      maxDepth: 3,
      lightGroups: 'each',
    });
    tracer.reset({ firstSample });
    const onGpu = async () => {
      const buffer = await tracer.varianceBuffer();
      return readFloats(device, buffer, 4 * 4 * 12 * 8);
    };
    for await (const _ of tracer.render({ samples: 20, maxSubmitMs: 1000 }));
    expect((await onGpu()).subarray(0, 4)).toEqual(Float32Array.of(Infinity, Infinity, Infinity, 20));
    for await (const _ of tracer.render({ samples: 72, maxSubmitMs: 1000 }));
    const [layer, gpu, beauty] = [await tracer.read('variance'), await onGpu(), await tracer.read('beauty')];
    expect(layer.some((value, i) => i % 4 < 3 && value > 0)).toBe(true);
    gpu.forEach((value, i) => {
      if (i % 4 === 3) expect(value).toBe(72);
      // A difference of sums of squares, over the number of chunks less 1: each sum has some roundings.
      else {
        const rounding = (8 * 2 ** -24 * beauty[i]! ** 2) / 3;
        expect(Math.abs(value - layer[i]!)).toBeLessThanOrEqual(rounding + 8 * 2 ** -24 * layer[i]!);
      }
    });
    tracer.destroy();
  });

  it('is infinite before there are two chunks, and zero where nothing varies', async () => {
    const scene = createScene();
    addQuad(scene, 10, 0, { name: 'glow', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 2 } });
    const tracer = await PathTracer.create(device, scene, { width: 4, height: 4, camera });
    for await (const _ of tracer.render({ samples: 31, maxSubmitMs: 1000 }));
    expect([...(await tracer.read('variance')).subarray(0, 4)]).toEqual([Infinity, Infinity, Infinity, 31]);
    for await (const _ of tracer.render({ samples: 40, maxSubmitMs: 1000 }));
    expect([...(await tracer.read('variance')).subarray(0, 4)]).toEqual([0, 0, 0, 40]);
    tracer.destroy();
  });
});

describe('position', () => {
  it('is where the depth along the pixel’s ray ends', async () => {
    const scene = createScene();
    // A plane through the origin that rises towards +x: z = x/2.
    addQuad(scene, 0.9, 0, lambert(0.5), { transform: [1, 0, 0.5, 0, 0, 1, 0, 0, -0.5, 0, 1, 0, 0, 0, 0, 1] });
    const size = 20;
    const tracer = await PathTracer.create(device, scene, {
      width: size,
      height: size,
      camera,
      background: 'transparent',
    });
    for await (const _ of tracer.render({ samples: 64, maxSubmitMs: 1000 }));
    const [position, depth, ids] = await Promise.all([
      tracer.read('position'),
      tracer.read('depth'),
      tracer.read('objectId'),
    ]);
    let seen = 0;
    for (let y = 0; y < size; y++) {
      for (let x = 0; x < size; x++) {
        const i = y * size + x;
        const [px, py, pz, coverage] = position.subarray(4 * i, 4 * i + 4) as unknown as [
          number,
          number,
          number,
          number,
        ];
        if (coverage === 0) {
          expect([px, py, pz, ids[i]]).toEqual([0, 0, 0, 0xffffffff]);
          continue;
        }
        // On the plane, whatever part of the pixel is covered, and at the depth's distance from the camera.
        expect(Math.abs(pz - 0.5 * px)).toBeLessThan(1e-5);
        expect(Math.abs(Math.hypot(px, py, pz - 3) - (depth[i] as number))).toBeLessThan(0.003);
        if (coverage < 1) continue;
        seen++;
        // Through the pixel: the camera's plane at distance 1 spans ±1/3.
        expect(Math.abs(px / (3 - pz) - ((2 * (x + 0.5)) / size - 1) / 3)).toBeLessThan(0.005);
        expect(Math.abs(py / (3 - pz) - (1 - (2 * (y + 0.5)) / size) / 3)).toBeLessThan(0.005);
      }
    }
    expect(seen).toBeGreaterThan(100);
    tracer.destroy();
  });
});
