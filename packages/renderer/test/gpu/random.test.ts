import { compose, wgslModule } from '@glanz/wgsl';
import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { random } from '../../src/kernels/random.wgsl';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const PIXELS = 32;

/** The second pair and the number after it of `samples` samples of each pixel: x, y, next. */
async function draw(samples: number, sobol: boolean): Promise<[number, number, number][][]> {
  const host = wgslModule(
    'test/host',
    `@group(0) @binding(0) var<storage, read_write> result: array<f32>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= ${PIXELS * samples}u) { return; }
  random_begin(id.x / ${samples}u, id.x % ${samples}u, 3u, 7u);
  let first = random_2();
  let u = random_3();
  for (var i = 0u; i < 3u; i++) { result[3u * id.x + i] = u[i]; }
}`,
    [random],
  );
  const { code } = compose([host], { flags: { SOBOL: sobol } });
  const numbers = new Float32Array(await runCompute(device, code, { outputBytes: PIXELS * samples * 12, workgroups: Math.ceil((PIXELS * samples) / 64) }));
  return Array.from({ length: PIXELS }, (_, pixel) => Array.from({ length: samples }, (_, s) => [...numbers.subarray(3 * (pixel * samples + s), 3 * (pixel * samples + s) + 3)] as [number, number, number]));
}

it('64 Sobol samples put one point into every elementary interval, in every pixel', async () => {
  for (const points of await draw(64, true)) {
    for (let a = 0; a <= 6; a++) {
      const cells = new Set(points.map(([x, y]) => Math.floor(x * 2 ** a) * 64 + Math.floor(y * 2 ** (6 - a))));
      expect(cells.size).toBe(64);
    }
    expect(new Set(points.map(([, , z]) => Math.floor(64 * z))).size).toBe(64);
  }
});

it.each([true, false])('numbers are uniform in [0, 1), and pixels, pairs and single numbers do not depend on each other (Sobol: %s)', async (sobol) => {
  const pixels = await draw(64, sobol);
  const all = pixels.flat();
  expect(all.flat().every((x) => x >= 0 && x < 1)).toBe(true);
  const n = all.length;
  const correlation = (f: (p: readonly number[]) => number, g: (p: readonly number[]) => number) => all.reduce((sum, p) => sum + (f(p) - 0.5) * (g(p) - 0.5), 0) / n / (1 / 12);
  const limit = 4 / Math.sqrt(n);
  for (const [i, j] of [[0, 1], [0, 2], [1, 2]] as const) expect(Math.abs(correlation((p) => p[i]!, (p) => p[j]!))).toBeLessThan(limit);
  for (const k of [0, 1, 2]) expect(Math.abs(all.reduce((sum, p) => sum + p[k]!, 0) / n - 0.5)).toBeLessThan(limit / Math.sqrt(12));
  // The first samples of the pixels: as spread as independent numbers.
  const firsts = pixels.map((points) => points[0]![0]);
  expect(new Set(firsts).size).toBe(PIXELS);
  expect(Math.abs(firsts.reduce((a, b) => a + b) / PIXELS - 0.5)).toBeLessThan(4 / Math.sqrt(12 * PIXELS));
});
