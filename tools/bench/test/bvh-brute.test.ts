import { buildBlas, type Blas } from '@glanz/bvh';
import { GpuBuilder } from '@glanz/bvh/gpu';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { BUILDERS } from '../src/benchmarks/bvh-brute';
import { buildOnGpu } from '../src/bvh-brute/build-on-gpu';
import { GpuTracer } from '../src/bvh-brute/gpu';
import { Oracle } from '../src/bvh-brute/oracle';
import { facing, tryScenes } from '../src/bvh-brute/run';

let gpus: GpuTracer[];
beforeAll(async () => {
  const device = await testDevice();
  gpus = await Promise.all((['binary', 'wide'] as const).map((layout) => GpuTracer.create(device, layout)));
});
afterAll(() => expectNoGpuErrors());

describe('rays through random scenes against brute force: the small part of `npm run bench -- bvh-brute`', () => {
  for (const seed of [2001, 2002]) {
    it(`no ray is lost, on the CPU and the GPU (seed ${seed})`, async () => {
      const lines: string[] = [];
      const totals = await tryScenes({
        seed,
        scenes: 60,
        raysPerScene: 300,
        gpuEvery: 3,
        gpus,
        builders: BUILDERS,
        log: (line) => lines.push(line),
      });
      expect(lines).toEqual([]);
      expect(totals).toMatchObject({ rays: 18_000, wrong: 0, gpuWrong: 0 });
      expect(totals.hits).toBeGreaterThan(9_000);
      expect(totals.gpuRays).toBeGreaterThan(11_000);
      expect(totals.wideRays).toBeGreaterThan(2_000);
      // Most answers are pinned down by the oracle.
      expect(totals.loose).toBeLessThan(180);
      expect(totals.gpuMarginal).toBeLessThan(360);
    });
  }

  it('no ray is lost in trees that are built on the GPU (seed 2003)', async () => {
    const device = await testDevice();
    const builder = await GpuBuilder.create(device);
    const lines: string[] = [];
    const totals = await tryScenes({
      seed: 2003,
      scenes: 25,
      raysPerScene: 300,
      gpuEvery: 3,
      gpus: gpus.slice(0, 1),
      builders: [{}],
      build: buildOnGpu(device, builder),
      log: (line) => lines.push(line),
    });
    builder.destroy();
    expect(lines).toEqual([]);
    expect(totals).toMatchObject({ rays: 7_500, wrong: 0, gpuWrong: 0 });
    expect(totals.hits).toBeGreaterThan(3_500);
    expect(totals.gpuRays).toBeGreaterThan(2_000);
  });

  it.each<[string, (blas: Blas) => void]>([
    [
      'boxes a little too small',
      ({ nodes }) => nodes.forEach((x, i) => i % 16 === 4 && x < 1e38 && (nodes[i] = x - 1e-2 * Math.abs(x))),
    ],
    [
      'a triangle left out',
      ({ triangleIndices }) => triangleIndices.length > 1 && triangleIndices.fill(triangleIndices[1]!, 0, 1),
    ],
  ])('notices %s', async (_, spoil) => {
    const build: typeof buildBlas = (mesh, options) => {
      const blas = buildBlas(mesh, options);
      spoil(blas);
      return blas;
    };
    const totals = await tryScenes({
      seed: 7,
      scenes: 20,
      raysPerScene: 300,
      gpuEvery: 1,
      gpus,
      builders: BUILDERS,
      build,
      log: () => undefined,
    });
    expect(totals.wrong).toBeGreaterThan(5);
    expect(totals.gpuWrong).toBeGreaterThan(0);
  });
});

describe('the oracle', () => {
  const square = Float64Array.of(0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 0, 0, 2, 2, 0, 0, 2, 0);
  const ask = (corners: Float64Array, ...ray: number[]) => {
    const oracle = new Oracle(corners);
    oracle.ask(ray, 0);
    return [oracle.low, oracle.high];
  };

  it('bounds a hit tightly, is sure of a miss, and keeps to the interval', () => {
    const [low, high] = ask(square, 0.3, 1.2, 3, 0, 0, 0, -2, 1e30) as [number, number];
    expect(low).toBeLessThanOrEqual(1.5);
    expect(high).toBeGreaterThanOrEqual(1.5);
    expect(high - low).toBeLessThan(1e-10);
    expect(ask(square, 2.1, 1, 3, 0, 0, 0, -1, 1e30)).toEqual([Infinity, Infinity]);
    expect(ask(square, 0.3, 1.2, 3, 0, 0, 0, -2, 1.4)).toEqual([Infinity, Infinity]);
    expect(ask(square, 0.3, 1.2, 3, 1.6, 0, 0, -2, 9)).toEqual([Infinity, Infinity]);
  });

  it('lets an edge be hit or missed', () => {
    const [low, high] = ask(square.subarray(0, 9), 1, 1, 3, 0, 0, 0, -2, 1e30) as [number, number];
    expect(low).toBeCloseTo(1.5, 9);
    expect(high).toBe(Infinity);
  });

  it('lets a segment be hit where it is, not elsewhere', () => {
    const segment = Float64Array.of(0, 0, 0, 1, 0, 0, 3, 0, 0);
    const [low, high] = ask(segment, 0.5, 0, 3, 0, 0, 0, -2, 1e30) as [number, number];
    expect(low).toBeLessThanOrEqual(1.5);
    expect(high).toBe(Infinity);
    expect(ask(segment, 0.5, 0.01, 3, 0, 0, 0, -2, 1e30)).toEqual([Infinity, Infinity]);
  });
});

it('a triangle that is a point on the ray has no slack of its own, rather than none that is a number', () => {
  const point = Float64Array.from({ length: 9 }, (_, i) => [1, 2, 3][i % 3]!);
  const ray = Float32Array.of(1, 2, 5, 0, 0, 0, -1, 10);
  expect(facing(point, 0, ray, 0, 1e-6)).toMatchObject({ edges: 0, tolerance: 0 });
});
