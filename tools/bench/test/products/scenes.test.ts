import { describe, expect, it } from 'vitest';
import type { PerspectiveCamera } from '@glanz/scene';
import { fitCamera, PRODUCTS, sunEnvironment } from '../../src/products/scenes';

describe('products', () => {
  it('are a dozen without the sample assets, each of another name', () => {
    expect(new Set(PRODUCTS.map(({ name }) => name)).size).toBe(PRODUCTS.length);
    expect(PRODUCTS.filter(({ files }) => files.length === 0).length).toBeGreaterThanOrEqual(12);
  });

  it('are tasks of the size that was asked for', async () => {
    const task = await PRODUCTS.find(({ name }) => name === 'ring')!.task(32, 18);
    expect(task).toMatchObject({ width: 32, height: 18, camera: { aspect: 32 / 18 } });
    expect(new TextDecoder().decode(task.glb.subarray(0, 4))).toBe('glTF');
  });
});

it('keeps what a camera shows in narrower and wider images', () => {
  const camera: PerspectiveCamera = {
    type: 'perspective',
    name: 'c',
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    yfov: 0.6,
    aspect: 1.6,
  };
  const extents = (aspect: number) => {
    const up = Math.tan(fitCamera(camera, aspect).yfov / 2);
    return [aspect * up, up] as const;
  };
  const [across, up] = extents(1.6);
  expect(up).toBeCloseTo(Math.tan(0.3), 12);
  for (const aspect of [0.5, 1, 16 / 9, 3]) {
    const [a, b] = extents(aspect);
    expect(a).toBeGreaterThanOrEqual(across - 1e-12);
    expect(b).toBeGreaterThanOrEqual(up - 1e-12);
    expect(Math.min(a / across, b / up)).toBeCloseTo(1, 12);
  }
});

it('makes a sun of the stated irradiance in its direction', () => {
  const environment = sunEnvironment();
  if (environment.type !== 'latlong') throw new Error('not a map');
  const { width, height, data } = environment;
  const sum = [0, 0, 0];
  let irradiance = 0;
  for (let y = 0; y < height; y++) {
    const theta = ((y + 0.5) / height) * Math.PI;
    for (let x = 0; x < width; x++) {
      // The sky is dimmer than 1.
      const radiance = data[3 * (y * width + x)]!;
      if (radiance < 1) continue;
      const phi = ((x + 0.5) / width - 0.5) * 2 * Math.PI;
      const light = (radiance - 0.6) * Math.sin(theta) * (Math.PI / height) * ((2 * Math.PI) / width);
      irradiance += light;
      [Math.sin(theta) * Math.cos(phi), Math.cos(theta), Math.sin(theta) * Math.sin(phi)].forEach(
        (value, i) => (sum[i]! += light * value),
      );
    }
  }
  // A disc of some dozen texels.
  expect(Math.abs(irradiance / 9 - 1)).toBeLessThan(0.1);
  const length = Math.hypot(...sum);
  const towards = [0.48, 0.8, 0.36];
  const cosine = sum.reduce((all, value, i) => all + (value * towards[i]!) / length / Math.hypot(...towards), 0);
  expect(Math.acos(Math.min(1, cosine))).toBeLessThan(0.005);
});
