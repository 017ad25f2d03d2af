import { describe, expect, it } from 'vitest';
import { nextCheck, TileGrid } from '../../src/schedule/adaptive';
import { noiseMap, noisyTiles, samplesLeft } from '../../src/schedule/noise-target';

describe('nextCheck', () => {
  it('looks four times an octave at most, at whole chunks of 16 samples', () => {
    const checks: number[] = [];
    for (let samples = 0; checks.length < 8;) checks.push((samples = nextCheck(samples)));
    expect(checks).toEqual([64, 96, 128, 192, 256, 384, 512, 768]);
    for (let samples = 0; samples < 5000; samples++) {
      const check = nextCheck(samples);
      expect(check).toBeGreaterThan(samples);
      expect(check % 16).toBe(0);
    }
  });
});

describe('noiseMap', () => {
  it('is relative to a tile’s brightness, with a floor for black ones', () => {
    // Two tiles of 64 pixels: radiance 2 with a standard error of 0.1, and black with the same.
    const { tiles, whole } = noiseMap(Float32Array.from([64 * 0.01, 64 * 4, 64, 0, 64 * 0.01, 0, 64, 0]));
    const floor = (0.01 * 4 * 64) / 128;
    expect(tiles[0]).toBeCloseTo(0.1 / Math.sqrt(4 + floor), 6);
    expect(tiles[1]).toBeCloseTo(0.1 / Math.sqrt(floor), 6);
    expect(whole).toBeCloseTo(Math.sqrt(((tiles[0] as number) ** 2 + (tiles[1] as number) ** 2) / 2), 6);
  });
  it('is 0 for a black image', () => {
    expect(noiseMap(Float32Array.of(0, 0, 64, 0, 0, 0, 64, 0)).whole).toBe(0);
  });
});

describe('noisyTiles', () => {
  it('takes tiles above the target, and neighbours of those twice above it', () => {
    // 4 × 3 tiles.
    const errors = Float64Array.from([0, 0, 0, 0, 0.05, 0, 0.03, 0, 0, 0, 0, 0]);
    expect(noisyTiles(errors, 4, 0.02)).toEqual([0, 1, 4, 5, 6, 8, 9]);
    expect(noisyTiles(errors, 4, 0.1)).toEqual([]);
  });
});

describe('samplesLeft', () => {
  it('a tile twice as noisy as wanted needs four times the samples, rounded up to the next look', () => {
    const left = (error: number, max = 1e6) =>
      samplesLeft(
        [0],
        Float64Array.of(error),
        0.01,
        max,
        () => 64,
        () => 10,
        nextCheck,
      );
    expect(left(0.02)).toBe((256 - 64) * 10);
    expect(left(0.03)).toBe((768 - 64) * 10);
    expect(left(0.03, 500)).toBe((500 - 64) * 10);
    // Calm itself, taken for its neighbour's sake.
    expect(left(0.001)).toBe((96 - 64) * 10);
  });
});

describe('TileGrid', () => {
  it.each([
    [1, 1],
    [8, 8],
    [9, 7],
    [33, 20],
  ])('%i × %i: every pixel is in one tile', (width, height) => {
    const grid = new TileGrid(width, height);
    const tiles = Array.from({ length: grid.count }, (_, i) => i);
    const pixels = grid.pixels(tiles);
    expect([...pixels].sort((a, b) => a - b)).toEqual(Array.from({ length: width * height }, (_, i) => i));
    for (const tile of tiles) {
      const own = grid.pixels([tile]);
      expect(own.length).toBe(grid.pixelsIn(tile));
      for (const pixel of own)
        expect(Math.floor((pixel % width) / 8) + grid.columns * Math.floor(Math.floor(pixel / width) / 8)).toBe(tile);
    }
  });
});
