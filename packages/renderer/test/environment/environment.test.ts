import type { LatLongEnvironment } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { prepareEnvironment, roughEnvironment, turnEnvironment } from '../../src/environment/environment';

const image = (width: number, height: number, value: (x: number, y: number) => number): LatLongEnvironment => {
  const data = new Float32Array(width * height * 3);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) data.fill(value(x, y), 3 * (y * width + x), 3 * (y * width + x) + 3);
  return { type: 'latlong', width, height, data };
};

describe('prepareEnvironment', () => {
  it('needs no table for constant light: BSDF sampling is ideal', () => {
    expect(prepareEnvironment({ type: 'constant', radiance: [1, 2, 3] }).table).toBeUndefined();
    expect(prepareEnvironment(image(16, 8, () => 3)).table).toBeUndefined();
    expect(prepareEnvironment(undefined).radiance).toEqual([0, 0, 0]);
  });

  it('has densities that integrate to 1 over the square', () => {
    const table = prepareEnvironment(image(64, 32, (x, y) => (x === 20 && y === 9 ? 1000 : 1 + (x % 7)))).table;
    if (!table) throw new Error('no table');
    let sum = 0;
    for (let i = 0; i < table.width * table.height; i++) sum += table.data[4 * i + 2] as number;
    expect(sum / (table.width * table.height)).toBeCloseTo(1, 5);
  });

  it('finds a sun of one texel in an image larger than its table', () => {
    const table = prepareEnvironment(image(2500, 1250, (x, y) => (x === 1801 && y === 400 ? 1e6 : 0.1))).table;
    if (!table) throw new Error('no table');
    expect([table.width, table.height]).toEqual([1024, 512]);
    let best = 0;
    for (let i = 0; i < table.width * table.height; i++)
      if ((table.data[4 * i + 2] as number) > (table.data[4 * best + 2] as number)) best = i;
    expect(Math.abs((best % 1024) - (1801.5 * 1024) / 2500)).toBeLessThan(1.5);
    expect(Math.abs(Math.floor(best / 1024) - (400.5 * 512) / 1250)).toBeLessThan(1.5);
  });

  it.each([
    ['a sun', image(300, 150, (x, y) => (x === 33 && y === 20 ? 1e6 : 0.1))],
    ['dark rows and columns', image(64, 32, (x, y) => (x > 50 && y > 20 ? x * y : 0))],
    ['random pixels', image(37, 5, (x, y) => ((x * 7919 + y * 104729) % 101) / 50)],
    ['one column', image(1, 9, (_, y) => y)],
  ])('tells where the searches of both distributions begin: %s', (_, environment) => {
    const { width, height, data } = prepareEnvironment(environment).table!;
    const find = (ends: Float32Array, u: number) => Math.min(ends.findIndex((end) => end > u) >>> 0, ends.length - 1);
    const bounds = (starts: readonly number[], u: number, cells: number) => {
      const bins = 2 ** Math.floor(Math.log2(cells));
      const bin = Math.floor(u * bins);
      return [starts[bin]!, bin + 1 < bins ? starts[bin + 1]! : cells - 1] as const;
    };
    const cell = (x: number, y: number, c: number) => data[4 * (y * width + x) + c]!;
    const rows = Float32Array.from({ length: height }, (_unused, y) => cell(0, y, 1));
    const rowStarts = Array.from(rows, (_unused, y) => Math.floor(cell(0, y, 3) / 1024));
    for (let i = 0; i < 1000; i++) {
      const u = i / 1000;
      const y = find(rows, u);
      const [low, high] = bounds(rowStarts, u, height);
      expect(y).toBeGreaterThanOrEqual(low);
      expect(y).toBeLessThanOrEqual(high);
      const columns = Float32Array.from({ length: width }, (_unused, x) => cell(x, y, 0));
      const starts = Array.from(columns, (_unused, x) => cell(x, y, 3) % 1024);
      const v = (i * 0.618034) % 1;
      const [left, right] = bounds(starts, v, width);
      expect(find(columns, v)).toBeGreaterThanOrEqual(left);
      expect(find(columns, v)).toBeLessThanOrEqual(right);
    }
  });

  it('replaces NaN, infinite and negative pixels', () => {
    const environment = image(4, 2, () => 1);
    environment.data.set([Number.NaN, Infinity, -1]);
    const data = prepareEnvironment(environment).pixels?.data;
    expect(Array.from(data?.subarray(0, 3) ?? [])).toEqual([0, expect.closeTo(3e38, -36), 0]);
    expect(data?.every(Number.isFinite)).toBe(true);
  });
});

describe('roughEnvironment', () => {
  it('is about as bright as the whole, in size, strength and visibility as it will be', () => {
    const sky = image(200, 99, (_, y) => 5 * Math.exp(-y / 30));
    for (const environment of [
      sky,
      { ...sky, intensity: 3, visible: false },
      { type: 'constant', radiance: [1, 2, 3] } as const,
      undefined,
    ]) {
      const [rough, whole] = [roughEnvironment(environment), prepareEnvironment(environment)];
      expect(Math.abs(rough.meanLuminance - whole.meanLuminance)).toBeLessThanOrEqual(0.02 * whole.meanLuminance);
      expect([rough.radiance, rough.visible, rough.pixels, rough.table]).toEqual([
        whole.radiance,
        whole.visible,
        undefined,
        undefined,
      ]);
    }
  });
});

describe('turnEnvironment', () => {
  const sky = image(32, 16, (x, y) => (x === 9 && y === 3 ? 100 : 0.3));

  it('gives what preparing the image again gives, from each setting to each, darkness included', () => {
    const settings: LatLongEnvironment[] = [
      sky,
      { ...sky, rotation: 2 },
      { ...sky, intensity: 0 },
      { ...sky, intensity: 0.3, visible: false },
    ];
    for (const from of settings)
      for (const to of settings) expect(turnEnvironment(prepareEnvironment(from), to)).toEqual(prepareEnvironment(to));
  });

  it('knows another image by its array and by its size', () => {
    const before = prepareEnvironment(sky);
    const others = [
      { ...sky, data: sky.data.slice() },
      { ...sky, width: 16, height: 32 },
      { type: 'constant', radiance: [1, 1, 1] } as const,
      undefined,
    ];
    for (const other of others) expect(turnEnvironment(before, other)).toBeUndefined();
  });
});
