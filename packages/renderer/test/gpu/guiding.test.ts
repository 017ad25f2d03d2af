import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { GUIDE_BINS, GUIDE_WIDTH } from '../../src/guiding/guide_constants.wesl';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { drawGuide } from '../draw-guide';
import { addQuad, camera, createScene, lambert } from '../scenes';
import { random } from '../tree-lights';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

describe('a table of directions', () => {
  const DRAWS = 1 << 14;
  const SHARE = 0.5;

  /** Two leaves, split at x = 0.25: the first has no guide, the second random probabilities, some of them 0. */
  function table() {
    const next = random(3);
    const weights = Array.from({ length: GUIDE_BINS }, () => Math.max(0, next() - 0.3));
    const total = weights.reduce((a, b) => a + b);
    const data = new Float32Array(GUIDE_WIDTH);
    data.set([2, 0, 0, 0.25]);
    let below = 0;
    weights.forEach((weight, bin) => (data[4 + GUIDE_BINS + bin] = below += (SHARE * weight) / total));
    return { data, chances: weights.map((weight) => weight / total) };
  }

  it('gives directions with the density that it tells, which integrates to its share', async () => {
    const { data, chances } = table();
    const found = await drawGuide(device, { table: data, width: GUIDE_WIDTH, draws: DRAWS, panes: false });

    const counts = new Float64Array(GUIDE_BINS);
    let integral = 0;
    for (let i = 0; i < DRAWS; i++) {
      const [x, y, z, pdf, even, share, other, length] = found.subarray(8 * i, 8 * i + 8) as unknown as number[];
      // Cosines and sines of WGSL are off by 2⁻¹¹ at most.
      expect(Math.abs(length! - 1)).toBeLessThan(2 ** -11);
      expect(share).toBeCloseTo(SHARE, 6);
      expect(other).toBe(0);
      // Rows of equal height along x, 32 bins around it from −π on: of equal solid angle.
      const [row, column] = [(x! + 1) * 4, (Math.atan2(z!, y!) / (2 * Math.PI) + 0.5) * 32];
      const bin = 32 * Math.min(Math.floor(row), 7) + Math.min(Math.floor(column), 31);
      counts[bin]!++;
      // On the edge between two bins rounding may take either.
      const inside = [row, column].every((value) => Math.abs(value - Math.round(value)) > 1e-3);
      const density = (SHARE * chances[bin]! * GUIDE_BINS) / (4 * Math.PI);
      // The difference of two sums, each rounded to 2⁻²⁵.
      if (inside)
        expect(Math.abs(pdf! - density)).toBeLessThan((2 ** -24 * GUIDE_BINS) / (4 * Math.PI) + 1e-6 * density);
      integral += (even! * 4 * Math.PI) / DRAWS;
    }
    // Draws are even in u.x: of each bin as many as its probability says, but for one at each edge, and rounding.
    chances.forEach((chance, bin) => expect(Math.abs(counts[bin]! - chance * DRAWS), `${bin}`).toBeLessThan(4));
    // 16,384 even points in 256 bins, about 64 each: of each bin's area the edge is off by a few of them.
    expect(Math.abs(integral / SHARE - 1)).toBeLessThan(0.02);
  });
});

const SIZE = 16;

/** A floor that sees a small wall, which a spot light illuminates: all light of the floor is indirect. */
function indirect(): Scene {
  const scene = createScene();
  addQuad(scene, 1, 0, lambert(0.8));
  // At (1.5, 0, 1), 0.3 m wide, facing the floor's middle.
  const s = Math.SQRT1_2;
  addQuad(scene, 0.15, 0, lambert(0.9), { transform: [s, 0, s, 0, 0, 1, 0, 0, -s, 0, s, 0, 1.5, 0, 1, 1] });
  scene.lights.push({
    type: 'spot',
    name: 'spot',
    color: [1, 1, 1],
    intensity: 100,
    position: [0.6, 0, 1.9],
    direction: [s, 0, -s],
    inner_cone_angle: 0.05,
    outer_cone_angle: 0.1,
  });
  return scene;
}

async function film(scene: Scene, samples: number, options: Partial<PathTracerOptions>): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, scene, {
    width: SIZE,
    height: SIZE,
    camera,
    maxDepth: 4,
    sampler: 'independent',
    ...options,
  });
  for await (const _ of tracer.render({ samples }));
  const image = await tracer.read('beauty');
  tracer.destroy();
  return image;
}

describe('PathTracer with a guide', () => {
  // Mean over seeds of the image's mean with its standard error, and the mean variance of its pixels.
  const measure = async (scene: Scene, guiding: number) => {
    const images: Float32Array[] = [];
    for (let seed = 1; seed <= 6; seed++) images.push(await film(scene, 32, { guiding, seed }));
    const pixels = Array.from({ length: SIZE * SIZE }, (_, i) => images.map((image) => image[4 * i]!));
    const mean = (values: readonly number[]) => values.reduce((a, b) => a + b) / values.length;
    const variance = mean(
      pixels.map((values) => values.reduce((sum, x) => sum + (x - mean(values)) ** 2, 0) / (values.length - 1)),
    );
    // Pixels are independent: the error of the mean follows from theirs.
    return { mean: mean(pixels.map(mean)), variance, error: Math.sqrt(variance / (images.length * pixels.length)) };
  };

  it('leaves the mean as it is, and takes most of the noise of indirect light away', async () => {
    const [plain, guided] = [await measure(indirect(), 0), await measure(indirect(), 0.1)];
    expect(plain.mean).toBeGreaterThan(0);
    // Five standard errors: by chance once in 1.7 million.
    expect(Math.abs(guided.mean - plain.mean)).toBeLessThan(5 * Math.hypot(plain.error, guided.error));
    // 1,280 degrees of freedom each: a ratio of variances is known within 20 %, and that of this scene is a third.
    expect(guided.variance).toBeLessThan(0.6 * plain.variance);
  });

  it('leaves highlights to the closure: mean and noise of a glossy, coated and fuzzy floor stay as they are', async () => {
    const scene = createScene();
    const parameters = { base_color: [0.05, 0.05, 0.05], specular_ior: 2, specular_roughness: 0.3 } as const;
    const layers = { coat_weight: 0.3, coat_roughness: 0.4, fuzz_weight: 0.1 };
    addQuad(scene, 1, 0, { name: 'glossy', parameters: { ...parameters, ...layers } });
    // A ceiling with a bright spot, which the floor mirrors.
    addQuad(scene, 1, 0, lambert(0.9), { transform: [1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 3, 1] });
    scene.lights.push({
      type: 'spot',
      name: 'spot',
      color: [1, 1, 1],
      intensity: 100,
      position: [0, 0, 2],
      direction: [0, 0, 1],
      inner_cone_angle: 0.3,
      outer_cone_angle: 0.4,
    });
    const [plain, guided] = [await measure(scene, 0), await measure(scene, 0.1)];
    expect(plain.mean).toBeGreaterThan(0);
    expect(Math.abs(guided.mean - plain.mean)).toBeLessThan(5 * Math.hypot(plain.error, guided.error));
    expect(guided.variance).toBeLessThan(1.25 * plain.variance);
  });

  it('gives the same film, bit for bit, however it is cut into batches', async () => {
    const whole = await film(indirect(), 4, { guiding: 0.01 });
    const cut = await film(indirect(), 4, { guiding: 0.01, pathsInFlight: 128 });
    expect(cut).toEqual(whole);
  });

  it('changes nothing where there is nothing to guide', async () => {
    const scene = indirect();
    scene.materials = scene.materials.map((one) => ({ ...one, parameters: { ...one.parameters, base_metalness: 1 } }));
    expect(await film(scene, 4, { guiding: 0.01 })).toEqual(await film(scene, 4, {}));
  });
});
