import { compose, wgslModule } from '@glanz/wgsl';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import guide from '../../src/guiding/guide.wesl';
import { GUIDE_BINS, GUIDE_WIDTH } from '../../src/guiding/guide_constants.wesl';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { readFloats } from '../../src/storage/read-buffer';
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
    const texture = device.createTexture({ size: [GUIDE_WIDTH, 1], format: 'r32float', usage: 0x6 });
    device.queue.writeTexture({ texture }, data, { bytesPerRow: 4 * GUIDE_WIDTH }, [GUIDE_WIDTH, 1]);
    const result = device.createBuffer({ size: 32 * DRAWS, usage: 0x84 });
    // Of each draw a direction with its density, and the density of another one, spread evenly over the sphere.
    const main = wgslModule(
      'test/guide',
      `@group(0) @binding(0) var guide: texture_2d<f32>;
@group(0) @binding(1) var<storage, read_write> result: array<vec4f>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  let place = guide_find(vec3f(0.25, 9.0, -9.0));
  let u = vec2f(f32(id.x) + 0.5, f32(reverseBits(id.x) >> 8u) * ${DRAWS / 2 ** 24}) / ${DRAWS}.0;
  let direction = guide_sample(place, vec2f(u.x * guide_share(place), u.y));
  result[2u * id.x] = vec4f(direction, guide_pdf(place, direction));
  let around = 6.283185307179586 * u.y;
  let z = 2.0 * u.x - 1.0;
  let even = vec3f(sqrt(1.0 - z * z) * vec2f(cos(around), sin(around)), z);
  result[2u * id.x + 1u] = vec4f(guide_pdf(place, even), guide_share(place),
    guide_share(guide_find(vec3f(0.2, 0.0, 0.0))), length(direction));
}`,
      [guide],
    );
    const pipeline = await device.createComputePipelineAsync({
      layout: 'auto',
      compute: { module: device.createShaderModule({ code: compose([main]).code }), entryPoint: 'main' },
    });
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(
      0,
      device.createBindGroup({
        layout: pipeline.getBindGroupLayout(0),
        entries: [
          { binding: 0, resource: texture.createView() },
          { binding: 1, resource: { buffer: result } },
        ],
      }),
    );
    pass.dispatchWorkgroups(DRAWS / 64);
    pass.end();
    device.queue.submit([encoder.finish()]);
    const found = await readFloats(device, result);
    result.destroy();
    texture.destroy();

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
  it('leaves the mean as it is, and takes most of the noise of indirect light away', async () => {
    // Mean and variance over seeds of the image's mean, and the mean variance of its pixels.
    const measure = async (guiding: number) => {
      const images: Float32Array[] = [];
      for (let seed = 1; seed <= 6; seed++) images.push(await film(indirect(), 32, { guiding, seed }));
      const pixels = Array.from({ length: SIZE * SIZE }, (_, i) => images.map((image) => image[4 * i]!));
      const mean = (values: readonly number[]) => values.reduce((a, b) => a + b) / values.length;
      const variance = (values: readonly number[]) =>
        values.reduce((sum, value) => sum + (value - mean(values)) ** 2, 0) / (values.length - 1);
      return {
        mean: mean(pixels.map(mean)),
        variance: mean(pixels.map(variance)),
        // Pixels are independent: the error of the mean follows from theirs.
        error: Math.sqrt(mean(pixels.map(variance)) / (images.length * pixels.length)),
      };
    };
    const [plain, guided] = [await measure(0), await measure(0.1)];
    expect(plain.mean).toBeGreaterThan(0);
    // Five standard errors: by chance once in 1.7 million.
    expect(Math.abs(guided.mean - plain.mean)).toBeLessThan(5 * Math.hypot(plain.error, guided.error));
    // 1,280 degrees of freedom each: a ratio of variances is known within 20 %, and that of this scene is a third.
    expect(guided.variance).toBeLessThan(0.6 * plain.variance);
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
