import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Material, PerspectiveCamera, Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer } from '../../src/index';
import { casesOf, samplesOf } from '../full';
import { addBox, addQuad, camera, createScene } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterAll(() => expectNoGpuErrors());

const SIZE = 16;
/** Radians of a pixel: half of the slope that a lobe of roughness 0.01 has. */
const PIXEL = 5e-5;
/** Pixels that the filter reaches to, and the rounding of positions. */
const REACH = 3;
const RADIANCE = 3;
const HALF = 30;
/** Of slabs, whose bounds follow from it. */
const SAMPLES = samplesOf(128, 4);

/** Sees the origin from `far` metres, at a cosine to +z, from the side of +x; the image's top is towards −x. */
function view(cosine: number, far: number): PerspectiveCamera {
  const [s, c] = [Math.sqrt(1 - cosine * cosine), cosine];
  return {
    ...camera,
    transform: [0, 1, 0, 0, -c, 0, s, 0, s, 0, c, 0, far * s, 0, far * c, 1],
    yfov: 2 * Math.atan((SIZE * PIXEL) / 2),
  };
}

/** An emitter at height z that begins at x and goes on to −∞, seen from above or from below. */
function addEmitter(scene: Scene, x: number, z: number, flip: boolean): void {
  const material: Material = {
    name: 'lamp',
    parameters: { base_weight: 0, specular_weight: 0, emission_luminance: RADIANCE },
  };
  addQuad(scene, HALF, 0, material, { flip, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x - HALF, 0, z, 1] });
}

/** Mean of the rows above and of those below the emitter's edge, which lies in the middle, over the emitter's light. */
async function sides(scene: Scene, from: PerspectiveCamera, samples: number) {
  const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera: from, maxDepth: 64 });
  try {
    for await (const progress of tracer.render({ samples })) void progress;
    const pixels = await tracer.read('beauty');
    const rows = Array.from({ length: SIZE }, (_, y) => {
      let sum = 0;
      for (let x = 0; x < SIZE; x++) sum += pixels[4 * (y * SIZE + x) + 1]!;
      return sum / SIZE / RADIANCE;
    });
    return { above: rows.slice(0, SIZE / 2 - REACH), below: rows.slice(SIZE / 2 + REACH) };
  } finally {
    tracer.destroy();
  }
}

/** Fresnel's equations: reflectance of index n seen at a cosine from outside, and the cosine inside. */
function fresnel(n: number, cosine: number) {
  const inner = Math.sqrt(1 - (1 - cosine * cosine) / (n * n));
  const s = (cosine - n * inner) / (cosine + n * inner);
  const p = (inner - n * cosine) / (inner + n * cosine);
  return { reflected: (s * s + p * p) / 2, inner };
}
const tangent = (cosine: number) => Math.sqrt(1 - cosine * cosine) / cosine;

const mirror: Material = {
  name: 'mirror',
  parameters: { base_metalness: 1, base_color: [1, 1, 1], specular_roughness: 0 },
};
const varnish: Material = {
  name: 'varnish',
  parameters: { base_weight: 0, specular_weight: 0, coat_weight: 1, coat_ior: 1.6, coat_roughness: 0 },
};
const glass = (specular_ior: number): Material => ({
  name: 'glass',
  parameters: { transmission_weight: 1, specular_roughness: 0, specular_ior },
});

describe('smooth surfaces show edges as sharp as they are', () => {
  // The last is so low that its normal would be turned towards the viewer, were it not flat.
  it.each([0.8, 0.3, 0.01, 8e-4])('a mirror, seen at cosine %f', async (cosine) => {
    const [far, height] = cosine > 0.1 ? [2, 1] : [10, 5 * cosine];
    const scene = createScene();
    addQuad(scene, HALF, 0, mirror);
    addEmitter(scene, -height * tangent(cosine), height, true);
    const { above, below } = await sides(scene, view(cosine, far), 16);
    for (const row of above) expect(row).toBeCloseTo(1, 5);
    for (const row of below) expect(row).toBe(0);
  });

  it('a coat, which reflects as Fresnel says', async () => {
    const scene = createScene();
    addQuad(scene, HALF, 0, varnish);
    addEmitter(scene, -tangent(0.5), 1, true);
    const { above, below } = await sides(scene, view(0.5, 2), 256);
    const { reflected } = fresnel(1.6, 0.5);
    // Half of the samples or so choose the black base.
    for (const row of above) expect(Math.abs(row / reflected - 1)).toBeLessThan(0.03);
    expect(Math.abs(above.reduce((sum, row) => sum + row, 0) / above.length / reflected - 1)).toBeLessThan(0.01);
    for (const row of below) expect(row).toBe(0);
  });

  // Light that is reflected between the faces comes out further on, where the emitter is for all rows.
  it.each(casesOf([2.42, 0.5], [1.5, 0.8]))('through a slab of index %f, at cosine %f', async (ior, cosine) => {
    const scene = createScene();
    addBox(scene, [-HALF, -HALF, -0.5], [HALF, HALF, 0], glass(ior));
    const { reflected: r, inner } = fresnel(ior, cosine);
    addEmitter(scene, -0.5 * tangent(inner) - 0.5 * tangent(cosine), -1, false);
    const { above, below } = await sides(scene, view(cosine, 2), SAMPLES);
    const once = (1 - r) ** 2;
    const more = (once * r * r) / (1 - r * r);
    const mean = (rows: readonly number[]) => rows.reduce((sum, row) => sum + row, 0) / rows.length;
    // Five standard errors of a Bernoulli variable.
    const count = above.length * SIZE * SAMPLES;
    const slack = (p: number) => 5 * Math.sqrt((p * (1 - p)) / count);
    expect(Math.abs(mean(above) - once - more)).toBeLessThan(slack(once + more));
    expect(Math.abs(mean(below) - more)).toBeLessThan(slack(more));
  });

  // So low that the normal of a bumpy surface would be bent: this one is flat.
  it('in a slab of glass, seen at cosine 0.01', async () => {
    const scene = createScene();
    addBox(scene, [-HALF, -HALF, -0.5], [HALF, HALF, 0], glass(1.5));
    const { reflected: r } = fresnel(1.5, 0.01);
    addEmitter(scene, -0.05 * tangent(0.01), 0.05, true);
    const { above, below } = await sides(scene, view(0.01, 10), SAMPLES);
    const more = ((1 - r) ** 2 * r) / (1 - r * r);
    const mean = (rows: readonly number[]) => rows.reduce((sum, row) => sum + row, 0) / rows.length;
    const count = above.length * SIZE * SAMPLES;
    const slack = (p: number) => 5 * Math.sqrt((p * (1 - p)) / count);
    expect(Math.abs(mean(above) - r - more)).toBeLessThan(slack(r + more));
    expect(Math.abs(mean(below) - more)).toBeLessThan(slack(more));
  });
});
