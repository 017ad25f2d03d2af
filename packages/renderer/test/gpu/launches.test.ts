import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterAll, afterEach, beforeAll, expect, it, vi } from 'vitest';
import type { Scene } from '@glanz/scene';
import { PathTracer } from '../../src/index';
import { addBox, addQuad, addSphere, camera, createScene, lambert } from '../scenes';

// Test machines have no GPU: a software GPU counts the paths that are left, one by another name launches threads for all.
let software: GPUDevice;
let device: GPUDevice;
beforeAll(async () => {
  software = await testDevice();
  // Not the same one.
  device = await testDevice({ features: [] });
  Object.defineProperty(device, 'adapterInfo', {
    value: { vendor: 'a', architecture: 'real', device: 'one', description: '' },
    configurable: true,
  });
});
afterAll(async () => {
  Reflect.deleteProperty(device, 'adapterInfo');
  await expectNoGpuErrors();
});
afterEach(() => {
  vi.restoreAllMocks();
});

/** Milky glass in front of a wall, below a light: a rough sphere or a smooth box. */
function milk(roughness: number) {
  const scene = createScene();
  addQuad(scene, 5, -1, lambert(0.7));
  addQuad(scene, 1, 3, { name: 'light', parameters: { emission_luminance: 5 } }, { flip: true });
  const material = {
    name: 'milk',
    parameters: {
      transmission_weight: 1,
      specular_roughness: roughness,
      transmission_depth: 0.3,
      transmission_scatter: [0.8, 0.7, 0.6] as const,
    },
  };
  if (roughness > 0) addSphere(scene, 0.5, [0, 0, 0], material, 16);
  else addBox(scene, [-0.4, -0.4, -0.4], [0.4, 0.4, 0.4], material);
  scene.environment = { type: 'constant', radiance: [0.2, 0.3, 0.4] };
  return scene;
}

/** The same on a floor that catches shadows, behind a pane of which half is cut out. */
function caught() {
  const scene = milk(0.2);
  const [wall] = scene.instances;
  scene.instances[0] = { ...wall!, catcher: true };
  addQuad(scene, 0.3, 1, { name: 'pane', parameters: { geometry_opacity: 0.5 } });
  return scene;
}

async function render(on: GPUDevice, scene: Scene, lightPaths = 0) {
  const tracer = await PathTracer.create(on, scene, {
    width: 16,
    height: 12,
    camera,
    maxDepth: 6,
    maxVolumeDepth: 48,
    pathsInFlight: 400,
    lightPaths,
  });
  for await (const _ of tracer.render({ samples: 4 }));
  const pixels = await tracer.read('beauty');
  const rays = await tracer.readRayCount();
  expect(tracer.statistics.badSamples).toBe(0);
  tracer.destroy();
  return { pixels, rays };
}

type Image = Awaited<ReturnType<typeof render>>;

function expectSame(image: Image, other: Image) {
  expect(image.rays).toBe(other.rays);
  expect(image.pixels.every((value, i) => Object.is(value, other.pixels[i]))).toBe(true);
  // And it is an image.
  expect(new Set(other.pixels).size).toBeGreaterThan(300);
}

const passes = () => Object.getPrototypeOf(device.createCommandEncoder().beginComputePass()) as GPUComputePassEncoder;

it('the image is the same bit for bit whether the GPU counts the paths that are left or threads without one end', async () => {
  const indirect = vi.spyOn(passes(), 'dispatchWorkgroupsIndirect');
  const counted = await render(software, milk(0.2));
  expect(indirect).toHaveBeenCalled();
  indirect.mockClear();
  const launched = await render(device, milk(0.2));
  expect(indirect).not.toHaveBeenCalled();
  expectSame(launched, counted);
});

it.each([
  { of: 'rough glass', scene: () => milk(0.2), more: [] },
  { of: 'smooth glass around a medium', scene: () => milk(0), more: [] },
  { of: 'catchers and cut-outs', scene: caught, more: [] },
  { of: 'light paths', scene: () => milk(0), lightPaths: 0.5, more: ['light_trace'] },
])(
  'the image is the same bit for bit where one workgroup takes all paths: $of',
  async ({ scene, lightPaths, more }) => {
    const many = await render(device, scene(), lightPaths);
    const prototype = passes();
    const { setPipeline, dispatchWorkgroups } = prototype;
    const labels = new WeakMap<GPUComputePassEncoder, string>();
    const narrowed = new Set<string>();
    vi.spyOn(prototype, 'setPipeline').mockImplementation(function (this: GPUComputePassEncoder, pipeline) {
      labels.set(this, pipeline.label);
      return setPipeline.call(this, pipeline);
    });
    vi.spyOn(prototype, 'dispatchWorkgroups').mockImplementation(function (this: GPUComputePassEncoder, x, y, z) {
      const [, name] = / (intersect|shade|connect|light_trace)$/.exec(labels.get(this) ?? '') ?? [];
      if (name && x > 1) narrowed.add(name);
      return dispatchWorkgroups.call(this, name ? 1 : x, y, z);
    });
    expectSame(await render(device, scene(), lightPaths), many);
    expect([...narrowed].sort()).toEqual(['connect', 'intersect', ...more, 'shade']);
  },
);
