import { compose, wgslModule } from '@glanz/wgsl';
import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import random from '../../src/random/random.wesl';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

type Sampler = 'blue-noise' | 'sobol' | 'independent';

/** Film that the pixels are numbered in, row by row. */
interface Film {
  readonly width: number;
  readonly height: number;
}

const SMALL: Film = { width: 8, height: 4 };
const PIXELS = SMALL.width * SMALL.height;

/** The second pair and the number after it of `samples` samples of each pixel: x, y, next. */
async function draw(
  samples: number,
  sampler: Sampler,
  { width, height }: Film = SMALL,
  stream = 1,
): Promise<[number, number, number][][]> {
  const count = width * height * samples;
  const host = wgslModule(
    'test/host',
    `struct TestFrame { size: vec2u }
var<private> frame: TestFrame;
@group(0) @binding(0) var<storage, read_write> result: array<f32>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= ${count}u) { return; }
  frame.size = vec2u(${width}u, ${height}u);
  random_begin(id.x / ${samples}u, id.x % ${samples}u, ${stream}u, 7u);
  let first = random_2();
  let u = random_3();
  for (var i = 0u; i < 3u; i++) { result[3u * id.x + i] = u[i]; }
}`,
    [random],
  );
  const { code } = compose([host], {
    flags: { SOBOL: sampler !== 'independent', SCREEN_NOISE: sampler === 'blue-noise' },
  });
  const numbers = new Float32Array(
    await runCompute(device, code, { outputBytes: count * 12, workgroups: Math.ceil(count / 64) }),
  );
  return Array.from({ length: width * height }, (_, pixel) =>
    Array.from(
      { length: samples },
      (_, s) =>
        [...numbers.subarray(3 * (pixel * samples + s), 3 * (pixel * samples + s) + 3)] as [number, number, number],
    ),
  );
}

/** Whether 2^m points put one into every elementary interval of the square, and of the line. */
function expectNet(points: readonly (readonly [number, number, number])[]): void {
  const m = Math.log2(points.length);
  for (let a = 0; a <= m; a++) {
    const cells = new Set(
      points.map(([x, y]) => Math.floor(x * 2 ** a) * points.length + Math.floor(y * 2 ** (m - a))),
    );
    expect(cells.size).toBe(points.length);
  }
  expect(new Set(points.map(([, , z]) => Math.floor(points.length * z))).size).toBe(points.length);
}

it.each(['sobol', 'blue-noise'] as const)(
  '64 samples put one point into every elementary interval, in every pixel (%s)',
  async (sampler) => {
    for (const stream of [1, 9]) for (const points of await draw(64, sampler, SMALL, stream)) expectNet(points);
  },
);

it('with the samples of its neighbours too: in blocks of 2, 4 and 8 pixels squared, at 1, 2, 4, 8 and 16 samples', async () => {
  // A width that is no power of two.
  const film = { width: 24, height: 16 };
  const pixels = await draw(16, 'blue-noise', film);
  for (const edge of [2, 4, 8]) {
    for (let y0 = 0; y0 < film.height; y0 += edge) {
      for (let x0 = 0; x0 < film.width; x0 += edge) {
        const block = Array.from(
          { length: edge * edge },
          (_, i) => pixels[(y0 + Math.floor(i / edge)) * film.width + x0 + (i % edge)]!,
        );
        for (const samples of [1, 2, 4, 8, 16]) expectNet(block.flatMap((points) => points.slice(0, samples)));
      }
    }
  }
});

it.each(['blue-noise', 'sobol', 'independent'] as const)(
  'numbers are uniform in [0, 1), and pixels, pairs and single numbers do not depend on each other (%s)',
  async (sampler) => {
    const pixels = await draw(64, sampler);
    const all = pixels.flat();
    expect(all.flat().every((x) => x >= 0 && x < 1)).toBe(true);
    const n = all.length;
    const correlation = (f: (p: readonly number[]) => number, g: (p: readonly number[]) => number) =>
      all.reduce((sum, p) => sum + (f(p) - 0.5) * (g(p) - 0.5), 0) / n / (1 / 12);
    const limit = 4 / Math.sqrt(n);
    for (const [i, j] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ] as const)
      expect(
        Math.abs(
          correlation(
            (p) => p[i]!,
            (p) => p[j]!,
          ),
        ),
      ).toBeLessThan(limit);
    for (const k of [0, 1, 2])
      expect(Math.abs(all.reduce((sum, p) => sum + p[k]!, 0) / n - 0.5)).toBeLessThan(limit / Math.sqrt(12));
    // The first samples of the pixels: as spread as independent numbers.
    const firsts = pixels.map((points) => points[0]![0]);
    expect(new Set(firsts).size).toBe(PIXELS);
    expect(Math.abs(firsts.reduce((a, b) => a + b) / PIXELS - 0.5)).toBeLessThan(4 / Math.sqrt(12 * PIXELS));
  },
);

/** Power of a square image at each frequency, relative to its mean: slow, but short. */
function spectrum(image: Float64Array, edge: number): (across: number, down: number) => number {
  const total = image.reduce((sum, value) => sum + value * value, 0);
  return (across, down) => {
    let [real, imaginary] = [0, 0];
    for (let y = 0; y < edge; y++) {
      for (let x = 0; x < edge; x++) {
        const phase = (2 * Math.PI * (across * x + down * y)) / edge;
        real += image[y * edge + x]! * Math.cos(phase);
        imaginary += image[y * edge + x]! * Math.sin(phase);
      }
    }
    return (real * real + imaginary * imaginary) / total;
  };
}

/** What pixels estimate: of a pair of numbers, with the mean over the square. */
const INTEGRANDS: readonly (readonly [string, (x: number, y: number) => number, number])[] = [
  ['smooth', (x, y) => x * y * y, 1 / 6],
  ['an edge', (x, y) => (x + y < 0.8 ? 1 : 0), 0.32],
  ['a disc', (x, y) => ((x - 0.4) ** 2 + (y - 0.5) ** 2 < 0.08 ? 1 : 0), 0.08 * Math.PI],
];

/** Mean power of the frequencies up to an eighth of a period a pixel, relative to that of all; 1 for white noise. */
async function lowFrequencies(
  sampler: Sampler,
  samples: number,
  f: (x: number, y: number) => number,
  mean: number,
): Promise<number> {
  const edge = 64;
  const errors = Float64Array.from(
    await draw(samples, sampler, { width: edge, height: edge }),
    (points) => points.reduce((sum, [x, y]) => sum + f(x, y), 0) / samples - mean,
  );
  const power = spectrum(errors, edge);
  let [sum, count] = [0, 0];
  // One of each pair of opposite frequencies, without the mean.
  for (let down = 0; down <= 8; down++)
    for (let across = -8; across <= 8; across++)
      if ((down > 0 || across > 0) && across * across + down * down <= 64)
        [sum, count] = [sum + power(across, down), count + 1];
  return sum / count;
}

describe.each(INTEGRANDS)('the error of %s over the image', (_, f, mean) => {
  it.each([1, 4, 16])('has at most 0.65 of white noise at low frequencies, at %i samples', async (samples) => {
    expect(await lowFrequencies('blue-noise', samples, f, mean)).toBeLessThan(0.65);
    // About a hundred frequencies: white noise has 1 ± 0.1.
    expect(await lowFrequencies('sobol', samples, f, mean)).toBeGreaterThan(0.65);
  });
});
