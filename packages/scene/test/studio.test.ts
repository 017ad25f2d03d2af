import { expect, it } from 'vitest';
import type { LatLongEnvironment } from '../src/index';
import { studioEnvironment, STUDIOS } from '../src/studio';

type Vector = readonly [number, number, number];

/**
 * Irradiance on a surface of normal n over π: what a white diffuse surface shows. Summed over texels by solid angle.
 */
function whiteDiffuse({ width, height, data }: LatLongEnvironment, n: Vector): number {
  let sum = 0;
  for (let j = 0; j < height; j++) {
    const theta = ((j + 0.5) / height) * Math.PI;
    const solidAngle = ((2 * Math.PI) / width) * (Math.PI / height) * Math.sin(theta);
    for (let i = 0; i < width; i++) {
      const phi = ((i + 0.5) / width - 0.5) * 2 * Math.PI;
      const cosine =
        n[0] * Math.sin(theta) * Math.cos(phi) + n[1] * Math.cos(theta) + n[2] * Math.sin(theta) * Math.sin(phi);
      sum += (data[(j * width + i) * 3] as number) * Math.max(cosine, 0) * solidAngle;
    }
  }
  return sum / Math.PI;
}

it('is colourless, finite and lit everywhere', () => {
  const { width, height, data, type } = studioEnvironment();
  expect([type, width, height, data.length]).toEqual(['latlong', 512, 256, 512 * 256 * 3]);
  for (let i = 0; i < data.length; i += 3) {
    const v = data[i] as number;
    if (!(v > 0.1 && v < 20 && data[i + 1] === v && data[i + 2] === v))
      expect.fail(`texel ${i / 3}: ${data.subarray(i, i + 3)}`);
  }
});

it('shows white diffuse surfaces near 1 from above and the front, less from below, and models them from left to right', () => {
  const studio = studioEnvironment();
  const up = whiteDiffuse(studio, [0, 1, 0]);
  const front = whiteDiffuse(studio, [0, 0, 1]);
  const left = whiteDiffuse(studio, [-1, 0, 0]);
  const right = whiteDiffuse(studio, [1, 0, 0]);
  const down = whiteDiffuse(studio, [0, -1, 0]);
  expect(up).toBeGreaterThan(0.9);
  expect(up).toBeLessThan(2);
  expect(front).toBeGreaterThan(0.8);
  expect(front).toBeLessThan(1.4);
  expect(left / right).toBeGreaterThan(1.15);
  expect(down).toBeLessThan(0.7);
});

it('has its brightest box at the front left, above the horizon', () => {
  const { width, data } = studioEnvironment();
  let best = 0;
  for (let i = 0; i < data.length; i += 3) if ((data[i] as number) > (data[best] as number)) best = i;
  const [i, j] = [(best / 3) % width, Math.floor(best / 3 / width)];
  const phi = ((i + 0.5) / width - 0.5) * 2 * Math.PI;
  expect(Math.sin(phi)).toBeGreaterThan(0.3); // +Z
  expect(Math.cos(phi)).toBeLessThan(-0.3); // −X
  expect(j / 256).toBeLessThan(0.5);
});

it('closes without a seam where u wraps', () => {
  const { width, height, data } = studioEnvironment();
  for (let j = 0; j < height; j++) {
    const at = (i: number) => data[(j * width + i) * 3] as number;
    const step = Math.max(Math.abs(at(1) - at(0)), Math.abs(at(width - 1) - at(width - 2)), 1e-6);
    expect(Math.abs(at(0) - at(width - 1))).toBeLessThan(0.02 + 3 * step);
  }
});

it('means the same light at every size, and passes its options on', () => {
  const small = studioEnvironment({ width: 128, intensity: 2, rotation: 1, visible: false });
  expect(small).toMatchObject({ width: 128, height: 64, intensity: 2, rotation: 1, visible: false });
  expect(whiteDiffuse(small, [0, 1, 0]) / whiteDiffuse(studioEnvironment(), [0, 1, 0])).toBeCloseTo(1, 1.5);
});

const DEGREE = Math.PI / 180;
const plain = { zenith: [0, 0, 0], horizon: [0, 0, 0], nadir: [0, 0, 0] } as const;

it('a box of one colour lies in its direction, spans its angles and is black elsewhere', () => {
  const { width, height, data } = studioEnvironment({
    width: 1024,
    setup: {
      backdrop: plain,
      boxes: [{ azimuth: 90 * DEGREE, elevation: 0, width: 40 * DEGREE, height: 20 * DEGREE, radiance: [1, 0.5, 0] }],
    },
  });
  // Solid angle of a rectangle seen from the point over its middle: 4 asin(sin(a/2) sin(b/2)) for tangents' half angles
  // a/2, b/2.
  const expected = 4 * Math.asin(Math.sin(20 * DEGREE) * Math.sin(10 * DEGREE));
  let solid = 0;
  const sum = [0, 0, 0];
  for (let j = 0; j < height; j++) {
    const texel = ((2 * Math.PI) / width) * (Math.PI / height) * Math.sin(((j + 0.5) / height) * Math.PI);
    for (let i = 0; i < width; i++) {
      const at = (j * width + i) * 3;
      if (Math.abs((data[at + 1] as number) - 0.5 * (data[at] as number)) > 1e-6 || data[at + 2] !== 0)
        expect.fail(`texel ${i}, ${j}: ${data.subarray(at, at + 3)}`);
      if ((data[at] as number) > 0.375) solid += texel;
      const [theta, phi] = [((j + 0.5) / height) * Math.PI, ((i + 0.5) / width - 0.5) * 2 * Math.PI];
      const direction = [Math.sin(theta) * Math.cos(phi), Math.cos(theta), Math.sin(theta) * Math.sin(phi)];
      direction.forEach((d, k) => (sum[k]! += (data[at] as number) * texel * d));
    }
  }
  // An edge that is soft over 0.03 takes 0.25 % at the corners. The sides are meridians, so that all rows round alike: by
  // up to half of a texel, of 114 from side to side.
  expect(Math.abs(solid / expected - 1)).toBeLessThan(0.0025 + 1 / 114);
  // +X is azimuth 90°: the box lies evenly around it, in texels too.
  expect(sum[0]).toBeGreaterThan(0);
  for (const k of [1, 2]) expect(Math.abs(sum[k]! / sum[0]!)).toBeLessThan(1e-6);
});

it('a disc has the solid angle of a cone', () => {
  const { width, height, data } = studioEnvironment({
    width: 1024,
    setup: {
      backdrop: plain,
      boxes: [{ azimuth: 0, elevation: 0.5, width: 40 * DEGREE, height: 40 * DEGREE, shape: 'disc', radiance: 1 }],
    },
  });
  let solid = 0;
  for (let j = 0; j < height; j++)
    for (let i = 0; i < width; i++)
      if ((data[(j * width + i) * 3] as number) > 0.375)
        solid += ((2 * Math.PI) / width) * (Math.PI / height) * Math.sin(((j + 0.5) / height) * Math.PI);
  // Some 390 of the 11,500 texels lie on its rim, and each is counted or not: a standard deviation of √(390/12) texels,
  // 0.05 %. Four of these.
  expect(Math.abs(solid / (2 * Math.PI * (1 - Math.cos(20 * DEGREE))) - 1)).toBeLessThan(0.002);
});

it.each(Object.entries(STUDIOS))(
  '%s is finite, not black, and lights a white surface from above or the front',
  (_, setup) => {
    const studio = studioEnvironment({ setup });
    for (const value of studio.data) if (!(value >= 0 && value < 1000)) expect.fail(`a texel is ${value}`);
    const best = Math.max(
      whiteDiffuse(studio, [0, 1, 0]),
      whiteDiffuse(studio, [0, 0, 1]),
      whiteDiffuse(studio, [-1, 0, 0]),
    );
    expect(best).toBeGreaterThan(0.3);
    expect(best).toBeLessThan(3);
  },
);
