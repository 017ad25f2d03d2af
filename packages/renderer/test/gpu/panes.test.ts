import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { finish, type Material, type Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { prepareEnvironment } from '../../src/environment/environment';
import { PANE_BINS, PANE_COLUMNS, PANE_ROWS, PANE_BEHIND } from '../../src/guiding/pane_constants.wesl';
import { paneTableSteps } from '../../src/guiding/pane-table';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { panesOf } from '../../src/materials/panes';
import { drawGuide } from '../draw-guide';
import { addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const SIZE = 8;
const SAMPLES = 32;
const SEEDS = 8;

const glass = (parameters: Material['parameters'] = {}): Material => ({
  name: 'glass',
  parameters: { transmission_weight: 1, specular_roughness: 0.05, geometry_thin_walled: true, ...parameters },
});

/** A matte floor in the plane z = 0 below a small bright light of the environment, at 45° in the plane of x and z. */
function floor(): Scene {
  const scene = createScene();
  addQuad(scene, 1, 0, lambert(0.8));
  const [width, height] = [256, 128];
  const data = new Float32Array(3 * width * height).fill(0.05);
  // φ = 45°, θ = 90°: x = z, y = 0. Four texels of 1.4°.
  for (const y of [63, 64]) for (const x of [159, 160]) data.fill(3000, 3 * (y * width + x), 3 * (y * width + x) + 3);
  scene.environment = { type: 'latlong', width, height, data };
  return scene;
}

/** A floor that sees the light through a pane alone. */
function behind(): Scene {
  const scene = floor();
  addQuad(scene, 20, 3, glass());
  return scene;
}

/** A floor that sees the light through a pane, and once more in the pane that stands beside it. */
function beside(): Scene {
  const scene = floor();
  // In the plane x = −1.5.
  addQuad(scene, 3, 0, glass({ specular_ior: 3 }), { transform: [0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, -1.5, 0, 0, 1] });
  return scene;
}

async function films(scene: Scene, options: Partial<PathTracerOptions>): Promise<Float32Array[]> {
  const images: Float32Array[] = [];
  for (let seed = 1; seed <= SEEDS; seed++) {
    const settings = { width: SIZE, height: SIZE, camera, maxDepth: 4, sampler: 'independent', seed } as const;
    const tracer = await PathTracer.create(device, scene, { ...settings, ...options });
    for await (const _ of tracer.render({ samples: SAMPLES }));
    images.push(await tracer.read('beauty'));
    tracer.destroy();
  }
  return images;
}

/** Mean over pixels and seeds, the mean variance of a pixel over seeds, and the standard error of the mean. */
function statistics(images: readonly Float32Array[]) {
  const pixels = Array.from({ length: SIZE * SIZE }, (_, i) => images.map((image) => image[4 * i]!));
  const mean = (values: readonly number[]) => values.reduce((a, b) => a + b) / values.length;
  const variance = (values: readonly number[]) =>
    values.reduce((sum, value) => sum + (value - mean(values)) ** 2, 0) / (values.length - 1);
  const noise = mean(pixels.map(variance));
  return { mean: mean(pixels.map(mean)), variance: noise, error: Math.sqrt(noise / (SEEDS * pixels.length)) };
}

describe('a table of directions towards panes', () => {
  it('gives directions with the density that it tells, which integrates to its share', async () => {
    const scene = beside();
    const light = prepareEnvironment(scene.environment);
    const { table, width } = finish(paneTableSteps(scene, panesOf(scene), light));
    const draws = 1 << 16;
    const found = await drawGuide(device, { table, width, draws, panes: true });
    const [share, behind] = [table[1 + PANE_BINS]! + PANE_BEHIND, PANE_BEHIND / (4 * Math.PI)];
    const drawn = new Map<number, { count: number; pdf: number }>();
    let integral = 0;
    for (let i = 0; i < draws; i++) {
      const [x, y, z, pdf, even, reported] = found.subarray(8 * i, 8 * i + 8) as unknown as number[];
      expect(reported).toBeCloseTo(share, 6);
      integral += (even! * 4 * Math.PI) / draws;
      const row = Math.min(Math.floor(((x! + 1) * PANE_ROWS) / 2), PANE_ROWS - 1);
      const column = Math.floor((Math.atan2(z!, y!) / (2 * Math.PI) + 0.5) * PANE_COLUMNS);
      const bin = PANE_COLUMNS * row + Math.min(column, PANE_COLUMNS - 1);
      const one = drawn.get(bin) ?? { count: 0, pdf: pdf! };
      drawn.set(bin, { count: one.count + 1, pdf: one.pdf });
    }
    // Directions that are mirrored in the pane are a few bins; the others have the environment's density alone.
    const mirrored = [...drawn.values()].filter(({ pdf }) => pdf > 2 * behind);
    expect(mirrored.length).toBeGreaterThan(4);
    expect(mirrored.length).toBeLessThan(PANE_BINS / 20);
    // Of such a bin as many as its density says: at its edges and by the even points between them a few are off.
    for (const { count, pdf } of mirrored) {
      const expected = (pdf * 4 * Math.PI * draws) / PANE_BINS / share;
      expect(Math.abs(count - expected)).toBeLessThan(0.05 * expected + 8);
    }
    // 65,536 even points in 8,192 bins, eight each: the sum over the mirrored ones is off by their edges.
    expect(Math.abs(integral / share - 1)).toBeLessThan(0.1);
  });
});

describe('light by way of panes', () => {
  it.each([
    ['behind one', behind],
    ['mirrored in one', beside],
  ])('%s is as bright as without a guide to it, with a fraction of the noise', async (_, scene) => {
    // A trained guide replaces that of panes: one that has seen 100 paths knows nothing.
    const plain = statistics(await films(scene(), { guiding: 1e-4 }));
    const guided = statistics(await films(scene(), {}));
    expect(guided.mean).toBeGreaterThan(0);
    // Five standard errors: by chance once in 1.7 million.
    expect(Math.abs(guided.mean - plain.mean)).toBeLessThan(5 * Math.hypot(plain.error, guided.error));
    expect(guided.variance).toBeLessThan(0.5 * plain.variance);
  });

  it('is as bright as what a wall without roughness lets through', async () => {
    const smooth = floor();
    addQuad(smooth, 20, 3, glass({ specular_roughness: 0 }));
    const straight = statistics(await films(smooth, {}));
    const guided = statistics(await films(behind(), {}));
    // The lobe is a hundredth of a texel wide; the share of rough walls is read from tables.
    const error = 5 * Math.hypot(straight.error, guided.error);
    expect(Math.abs(guided.mean - straight.mean)).toBeLessThan(error + 0.01 * straight.mean);
  });
});
