import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Camera, LatLongEnvironment, OrthographicCamera, PerspectiveCamera } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { addQuad, addSphere, camera as pinhole, createScene, lambert, middle } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

async function render(
  scene: ReturnType<typeof createScene>,
  camera: Camera,
  options: Partial<PathTracerOptions> & { samples?: number } = {},
): Promise<{ pixels: Float32Array; tracer: PathTracer }> {
  const tracer = await PathTracer.create(device, scene, {
    width: 32,
    height: 32,
    pathsInFlight: 1 << 14,
    camera,
    ...options,
  });
  for await (const _ of tracer.render({ maxSubmitMs: 1000, samples: options.samples ?? 16 }));
  return { pixels: await tracer.read('beauty'), tracer };
}

const glow = (luminance: number) => ({
  name: 'glow',
  parameters: { base_weight: 0, specular_weight: 0, emission_luminance: luminance },
});

describe('cameras', () => {
  it('parallel projection: a square of half size h covers h/ymag of the image, however far it is', async () => {
    for (const distance of [0, -7]) {
      const scene = createScene();
      addQuad(scene, 0.5, distance, glow(1));
      const camera: OrthographicCamera = {
        type: 'orthographic',
        name: 'o',
        transform: pinhole.transform,
        xmag: 1,
        ymag: 1,
      };
      const { pixels, tracer } = await render(scene, camera, { background: 'transparent' });
      // Pixels 8..23 of 32 are inside, all others outside.
      for (let y = 0; y < 32; y++)
        for (let x = 0; x < 32; x++)
          expect(pixels[4 * (32 * y + x) + 3]).toBe(x >= 8 && x < 24 && y >= 8 && y < 24 ? 1 : 0);
      expect(tracer.pick(16, 16)).toMatchObject({ distance: 3 - distance, depth: 3 - distance });
      expect(tracer.pick(7, 16)).toBeUndefined();
      tracer.destroy();
    }
  });

  it('a panorama along +X is the environment itself, texel for pixel', async () => {
    const data = Float32Array.from({ length: 32 * 16 * 3 }, (_, i) => ((i * 7919) % 101) / 50);
    const environment: LatLongEnvironment = { type: 'latlong', width: 32, height: 16, data };
    const scene = createScene();
    addSphere(scene, 1e-3, [0, 500, 0], lambert(0), 8);
    scene.environment = environment;
    // Looks along +X: right is +Z, up +Y, back −X.
    const { pixels, tracer } = await render(
      scene,
      { type: 'panorama', name: 'p', transform: [0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1] },
      { width: 32, height: 16, samples: 1024, maxDepth: 1 },
    );
    // A pixel is the mean over its square of the bilinear image: weights 1 : 6 : 1 over the neighbours, each way.
    const texel = (x: number, y: number, c: number) =>
      data[3 * (Math.min(Math.max(y, 0), 15) * 32 + ((x + 32) % 32)) + c] as number;
    for (let y = 0; y < 16; y++) {
      for (let x = 0; x < 32; x++) {
        for (let c = 0; c < 3; c++) {
          let expected = 0;
          for (const [dy, wy] of [
            [-1, 1],
            [0, 6],
            [1, 1],
          ] as const)
            for (const [dx, wx] of [
              [-1, 1],
              [0, 6],
              [1, 1],
            ] as const)
              expected += (texel(x + dx, y + dy, c) * wx * wy) / 64;
          expect(Math.abs((pixels[4 * (32 * y + x) + c] as number) - expected)).toBeLessThan(0.01);
        }
      }
    }
    tracer.destroy();
  });

  it('a panorama picks what lies behind', async () => {
    const scene = createScene();
    addQuad(scene, 1, 5, lambert(0.5), { flip: true });
    const { tracer } = await render(
      scene,
      { type: 'panorama', name: 'p', transform: pinhole.transform },
      { width: 64, height: 32, samples: 1 },
    );
    // The camera looks along −z from z = 3; the quad at z = 5 lies behind, at the image's left and right edge.
    expect(tracer.pick(0.01, 16)?.distance).toBeCloseTo(2, 3);
    expect(tracer.pick(63.99, 16)?.depth).toBeCloseTo(-2, 3);
    expect(tracer.pick(32, 16)).toBeUndefined();
    tracer.destroy();
  });

  // A small light out of focus is imaged as the aperture: a point p at depth d shows, for a lens point l, at
  // p/d + l (1/f − 1/d) on the plane at distance 1.
  const LIGHT = 0.1;
  const lens: PerspectiveCamera = { ...pinhole, yfov: 2 * Math.atan(0.5), lens_radius: 0.4, focus_distance: 1 };
  const aperture = async (camera: PerspectiveCamera) => {
    const scene = createScene();
    addQuad(scene, LIGHT, 0, glow(1));
    // The aperture and what is around it: two thirds of the view.
    const size = 32;
    const part = 2 / 3;
    const { pixels, tracer } = await render(scene, middle(part, camera), {
      width: size,
      height: size,
      samples: 512,
      background: 'transparent',
    });
    tracer.destroy();
    // Lens coordinates of each pixel's centre, right and up.
    const shrink = 1 / 1 - 1 / 3;
    const seen: { x: number; y: number; value: number }[] = [];
    for (let i = 0; i < size * size; i++) {
      const x = (part * (((i % size) + 0.5) / size - 0.5)) / shrink / 0.4;
      const y = (part * (0.5 - (Math.floor(i / size) + 0.5) / size)) / shrink / 0.4;
      seen.push({ x, y, value: pixels[4 * i] as number });
    }
    return seen;
  };

  /** What a pixel shows: the part of the aperture, of so much area on a lens of radius 1, through which it sees the light. */
  const expected = (area: number) => ((2 * LIGHT) / 3 / (1 - 1 / 3) / 0.4) ** 2 / area;
  const meanOf = (seen: readonly { readonly value: number }[]) =>
    seen.reduce((sum, { value }) => sum + value, 0) / seen.length;

  it('a round lens out of focus shows an even disk of the lens’s size', async () => {
    const seen = await aperture(lens);
    // Half of the light is 0.125 of the lens wide, half of a pixel 0.04.
    const inside = seen.filter(({ x, y }) => Math.hypot(x, y) < 0.8);
    const outside = seen.filter(({ x, y }) => Math.hypot(x, y) > 1.2);
    const mean = meanOf(inside);
    // Four standard deviations, over eight seeds: 0.86 %, and at most 0.93 % of the parts.
    expect(Math.abs(mean / expected(Math.PI) - 1)).toBeLessThan(4 * 0.0086);
    expect(outside.every(({ value }) => value === 0)).toBe(true);
    // Even: halves left and right, inner and outer disks of equal area hold the same light.
    for (const keep of [
      ({ x }: { x: number }) => x > 0,
      ({ y }: { y: number }) => y > 0,
      ({ x, y }: { x: number; y: number }) => Math.hypot(x, y) < 0.8 * Math.SQRT1_2,
    ])
      expect(Math.abs(meanOf(inside.filter(keep)) / mean - 1)).toBeLessThan(4 * 0.0093);
  });

  it('blades make the disk a polygon that rotates', async () => {
    // Standard deviations over eight seeds: of the mean, and of the upper half's by it.
    for (const [blades, rotation, deviation, upperDeviation] of [
      [3, 0, 0.0166, 0.02],
      [6, 0.3, 0.0078, 0.0088],
    ] as const) {
      const seen = await aperture({ ...lens, lens_blades: blades, lens_rotation: rotation });
      // Distance to the nearest edge line of the polygon with corners at rotation + 2πk/n; positive inside.
      const depth = (x: number, y: number) => {
        let min = Infinity;
        for (let k = 0; k < blades; k++) {
          const middle = rotation + ((k + 0.5) * 2 * Math.PI) / blades;
          min = Math.min(min, Math.cos(Math.PI / blades) - (x * Math.cos(middle) + y * Math.sin(middle)));
        }
        return min;
      };
      const inside = seen.filter(({ x, y }) => depth(x, y) > 0.23);
      const mean = meanOf(inside);
      expect(inside.length).toBeGreaterThan(50);
      const area = (blades / 2) * Math.sin((2 * Math.PI) / blades);
      expect(Math.abs(mean / expected(area) - 1)).toBeLessThan(4 * deviation);
      expect(seen.filter(({ x, y, value }) => depth(x, y) < -0.23 && value > 0)).toEqual([]);
      const upper = inside.filter(({ y }) => y > 0.05);
      expect(Math.abs(meanOf(upper) / mean - 1)).toBeLessThan(4 * upperDeviation);
      expect(inside.filter(({ value }) => value < 0.3 * mean)).toEqual([]);
    }
  });

  it('what is picked and focused on is sharp', async () => {
    const scene = createScene();
    addQuad(scene, 0.5, -3, glow(1));
    const blurred: PerspectiveCamera = { ...pinhole, lens_radius: 0.3, focus_distance: 1 };
    const { tracer, pixels } = await render(scene, blurred, { samples: 64, background: 'transparent' });
    const partial = (image: Float32Array) =>
      image.filter((value, i) => i % 4 === 3 && value > 0.02 && value < 0.98).length;
    const hit = tracer.pick(18, 14);
    expect(hit?.depth).toBeCloseTo(6, 5);
    expect(hit?.distance).toBeGreaterThan(6);
    await tracer.setCamera({ ...blurred, focus_distance: hit?.depth as number });
    for await (const _ of tracer.render({ maxSubmitMs: 1000, samples: 64 }));
    const sharp = await tracer.read('beauty');
    // Half an extent of 0.5/6·3 of 16 pixels: edges at 12 and 20 exactly, so not one pixel is partly covered.
    expect(partial(pixels)).toBeGreaterThan(150);
    expect(partial(sharp)).toBe(0);
    tracer.destroy();
  });

  it('another kind of camera on a live tracer compiles one kernel; the same kind none', async () => {
    const scene = createScene();
    addQuad(scene, 0.5, 0, glow(1));
    const { tracer } = await render(scene, pinhole, { samples: 1, background: 'transparent' });
    const original = device.createComputePipelineAsync.bind(device);
    const made: string[] = [];
    device.createComputePipelineAsync = (descriptor) => {
      made.push(String(descriptor.label));
      return original(descriptor);
    };
    try {
      await tracer.setCamera({ ...pinhole, yfov: 0.5 });
      expect(made).toEqual([]);
      const change = tracer.setCamera({ ...pinhole, lens_radius: 0.011, lens_blades: 5 });
      // The old view serves meanwhile.
      for await (const _ of tracer.render({ maxSubmitMs: 1000, samples: 1 }));
      await change;
      expect(tracer.samples).toBe(0);
      expect(made.length).toBeLessThanOrEqual(1);
      expect(made.every((label) => label === 'glanz generate')).toBe(true);
    } finally {
      device.createComputePipelineAsync = original;
    }
    tracer.destroy();
  });
});
