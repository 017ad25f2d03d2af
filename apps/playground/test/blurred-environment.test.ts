import { expect, test } from 'vitest';
import { blurEnvironment } from '../src/viewer/blurred-environment';

/** Solid angle of a texel's row, all of it. */
const rowArea = (row: number, rows: number) =>
  2 * Math.PI * (Math.cos((row / rows) * Math.PI) - Math.cos(((row + 1) / rows) * Math.PI));

const light = (height: number, at: (x: number, y: number) => number) => {
  const width = 2 * height;
  const data = new Float32Array(width * height * 3);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) data.fill(at(x, y), 3 * (y * width + x), 3 * (y * width + x) + 3);
  return { type: 'latlong', width, height, data } as const;
};

const total = ({
  width,
  height,
  data,
}: {
  readonly width: number;
  readonly height: number;
  readonly data: Float32Array;
}) => {
  let sum = 0;
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) sum += (data[3 * (y * width + x)]! * rowArea(y, height)) / width;
  return sum;
};

test('a constant stays constant, at the poles too', () => {
  for (const value of blurEnvironment(
    light(64, () => 0.7),
    15,
  ).data)
    expect(value).toBeCloseTo(0.7, 5);
});

test('light is spread, not made or lost', () => {
  const spot = light(64, (x, y) => (x >= 60 && x < 68 && y >= 28 && y < 36 ? 100 : 0));
  const blurred = blurEnvironment(spot, 10);
  expect(Math.abs(total(blurred) / total(spot) - 1)).toBeLessThan(0.02);
  // In the middle of a square of 22.5° a Gaussian of 10° leaves erf(11.25 / 10√2)² = 0.547; texels of 10° add 0.4° to
  // it.
  expect(Math.abs(Math.max(...blurred.data) - 54.7)).toBeLessThan(4);
});

test('a spot has the width of the Gaussian that was asked for', () => {
  const degrees = 10;
  const spot = light(180, (x, y) => (x === 180 && y === 90 ? 1e4 : 0));
  const { width, height, data } = blurEnvironment(spot, degrees);
  const row = Math.floor(height / 2);
  const [peak, aside] = [width / 2, width / 2 + Math.round((degrees / 360) * width)].map(
    (x) => data[3 * (row * width + x)]!,
  );
  // One standard deviation aside, with texels of half of it: between 0.4 and 0.8 of the peak around exp(−½) = 0.61.
  expect(aside! / peak!).toBeGreaterThan(0.4);
  expect(aside! / peak!).toBeLessThan(0.8);
});
