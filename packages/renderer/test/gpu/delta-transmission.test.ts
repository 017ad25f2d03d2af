import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Material, Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { samplesOf } from '../full';
import { addQuad, addSphere, camera, createScene, lambert, meanOf, middle } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterAll(() => expectNoGpuErrors());

const SIZE = 8;

async function image(scene: Scene, samples: number, options: Partial<PathTracerOptions> = {}): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera, ...options });
  try {
    for await (const progress of tracer.render({ samples })) void progress;
    return await tracer.read('beauty');
  } finally {
    tracer.destroy();
  }
}

const mean = (pixels: Float32Array) => {
  const size = Math.sqrt(pixels.length / 4);
  return meanOf(pixels, size, 0, 0, size, size);
};

const pane = (parameters: Material['parameters'] = {}): Material => ({
  name: 'pane',
  parameters: {
    transmission_weight: 1,
    specular_roughness: 0,
    specular_ior: 1.5,
    geometry_thin_walled: true,
    ...parameters,
  },
});

/** What two parallel faces reflect, all reflections between them counted. */
function reflected(cosine: number, n = 1.5): number {
  const g = Math.sqrt(n * n - 1 + cosine * cosine);
  const r =
    0.5 * ((g - cosine) / (g + cosine)) ** 2 * (1 + ((cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1)) ** 2);
  return (2 * r) / (1 + r);
}

/** Sees the origin from below panes at z = 1. */
const low = (() => {
  const [c, s] = [Math.cos(1.2), Math.sin(1.2)];
  return { ...camera, transform: [0, 1, 0, 0, -c, 0, s, 0, s, 0, c, 0, 0.9 * s, 0, 0.9 * c, 1], yfov: 1e-3 };
})();

const emitter: Material = { name: 'lamp', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 3 } };

describe('smooth thin walls', () => {
  it('let the light of lamps without size through, less what they reflect', async () => {
    for (const [direction, panes] of [
      [[0, 0, -1], 1],
      [[0.8, 0, -0.6], 1],
      [[0.6, 0, -0.8], 3],
    ] as const) {
      const scene = createScene();
      addQuad(scene, 50, 0, lambert(0.5));
      for (let i = 0; i < panes; i++) addQuad(scene, 50, 1 + i, pane());
      scene.lights.push({ type: 'directional', name: 'sun', color: [1, 1, 1], intensity: 2, direction });
      const cosine = -direction[2];
      // maxDepth 2: a pane is no edge.
      const seen = mean(await image(scene, 4, { camera: low, maxDepth: 2 }));
      for (const value of seen)
        expect(Math.abs(value / ((0.5 / Math.PI) * 2 * cosine * (1 - reflected(cosine)) ** panes) - 1)).toBeLessThan(
          0.002,
        );
    }
  });

  it('tint it, more the more slanted it goes through them', async () => {
    const scene = createScene();
    addQuad(scene, 50, 0, lambert(0.5));
    addQuad(scene, 50, 1, pane({ transmission_color: [0.9, 0.5, 0.2] }));
    scene.lights.push({ type: 'directional', name: 'sun', color: [1, 1, 1], intensity: 2, direction: [0.8, 0, -0.6] });
    const seen = mean(await image(scene, 4, { camera: low, maxDepth: 2 }));
    const slant = 1 / Math.sqrt(1 - 0.64 / 2.25);
    [0.9, 0.5, 0.2].forEach((c, k) =>
      expect(seen[k]! / ((0.5 / Math.PI) * 2 * 0.6 * (1 - reflected(0.6)) * c ** slant)).toBeCloseTo(1, 3),
    );
  });

  it.each([
    ['far, where light samples count', 4, 0.5],
    ['close, where BSDF samples count', 1.2, 6],
  ] as const)('a glowing square behind one lights a floor once, %s', async (_, height, size) => {
    const scene = createScene();
    addQuad(scene, 50, 0, lambert(0.5));
    addQuad(scene, 50, 1, pane());
    addQuad(scene, size / 2, height, emitter, { flip: true });
    const seen = mean(await image(scene, 512, { camera: low, maxDepth: 2 }));
    let expected = 0;
    const steps = 400;
    for (let i = 0; i < steps; i++) {
      for (let j = 0; j < steps; j++) {
        const [x, y] = [((i + 0.5) / steps - 0.5) * size, ((j + 0.5) / steps - 0.5) * size];
        const cosine = height / Math.hypot(x, y, height);
        expected += (cosine ** 4 / height ** 2) * (1 - reflected(cosine)) * (size / steps) ** 2;
      }
    }
    expected *= (0.5 / Math.PI) * 3;
    for (const value of seen) expect(Math.abs(value / expected - 1)).toBeLessThan(0.01);
  });

  it('are seen through as they are: by the camera, and reflecting what is before them', async () => {
    const scene = createScene();
    addQuad(scene, 50, -1, emitter);
    addQuad(scene, 50, 0, pane());
    const through = mean(await image(scene, 256, { maxDepth: 1 }));
    const narrow = mean(await image(scene, 256, { maxDepth: 1, camera: { ...camera, yfov: 1e-3 } }));
    expect(narrow[0] / (3 * (1 - reflected(1)))).toBeCloseTo(1, 2);
    expect(through[0]).toBeLessThan(3);
    // In even light a pane takes nothing and adds nothing.
    const even = createScene();
    even.environment = { type: 'constant', radiance: [1, 1, 1] };
    addSphere(even, 0.8, [0, 0, 0], pane(), 64);
    for (const value of mean(await image(even, 256, { maxDepth: 16, camera: middle(0.6) })))
      expect(Math.abs(value - 1)).toBeLessThan(0.005);
  });

  it('a matte ball under a dome of glass in a bright environment: as if every pane were rough by a hair, with less noise', async () => {
    // An environment with a small bright patch, which only light samples find well.
    const [width, height] = [32, 16];
    const data = new Float32Array(width * height * 3).fill(0.2);
    data.fill(60, 3 * (2 * width + 8), 3 * (2 * width + 10));
    const scene = (specular_roughness: number) => {
      const made: Scene = { ...createScene(), environment: { type: 'latlong', width, height, data } };
      addSphere(made, 0.5, [0, 0, 0], lambert(0.7), 32);
      addSphere(made, 0.9, [0, 0, 0], pane({ specular_roughness }), 96);
      return made;
    };
    // The middle of the ball.
    const ball = { maxDepth: 12, width: 6, height: 6, camera: middle(6 / 16) };
    const runs = async (roughness: number, samples: number) => {
      const values: number[] = [];
      for (let seed = 0; seed < 6; seed++)
        values.push(mean(await image(scene(roughness), samples, { seed, ...ball }))[0]);
      const average = values.reduce((a, b) => a + b) / values.length;
      return {
        average,
        variance: values.reduce((sum, v) => sum + (v - average) ** 2, 0) / (values.length - 1) / values.length,
      };
    };
    const samples = samplesOf(16, 2);
    const [clear, blurred] = [await runs(0, samples), await runs(0.02, 8 * samples)];
    expect(Math.abs(clear.average - blurred.average)).toBeLessThan(
      4.5 * Math.sqrt(clear.variance + blurred.variance) + 0.002 * clear.average,
    );
    expect(8 * blurred.variance).toBeGreaterThan(4 * clear.variance);
  }, 120_000);
});
