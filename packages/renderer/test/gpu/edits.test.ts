import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { LatLongEnvironment, Mesh, Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterEach(() => expectNoGpuErrors());

const options: PathTracerOptions = { width: 16, height: 16, camera, pathsInFlight: 1 << 13, maxDepth: 4 };
const moved = (x: number, y: number, z: number) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1];

/** A ball and a cube-like block on a floor, a lamp, a glowing square, a sky. */
function stage(): Scene {
  const scene = createScene();
  addQuad(scene, 0.9, 0, lambert(0.6, 0.5, 0.4));
  addSphere(
    scene,
    0.3,
    [0, 0, 0.3],
    { name: 'ball', parameters: { base_color: [0.8, 0.2, 0.1], specular_roughness: 0.3 } },
    12,
  );
  addQuad(
    scene,
    0.4,
    1.5,
    { name: 'glow', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 3 } },
    { flip: true, transform: moved(1, 0.8, 0) },
  );
  (scene.instances[0] as { name: string }).name = 'floor';
  (scene.instances[2] as { name: string }).name = 'panel';
  scene.materials.push({ name: 'blue', parameters: { base_color: [0.1, 0.2, 0.8], specular_weight: 0 } });
  scene.lights.push({ type: 'point', name: 'lamp', color: [1, 1, 1], intensity: 2, position: [-1, 0.5, 1.5] });
  scene.environment = sky(0);
  return scene;
}

const image = Float32Array.from({ length: 16 * 8 * 3 }, (_, i) => (Math.floor(i / 3) % 16 === 3 ? 4 : 0.2));
const sky = (rotation: number): LatLongEnvironment => ({
  type: 'latlong',
  width: 16,
  height: 8,
  data: image,
  rotation,
});

async function beauty(tracer: PathTracer, samples = 20): Promise<Float32Array> {
  for await (const _ of tracer.render({ samples, maxSubmitMs: 1000 }));
  return tracer.read('beauty');
}
async function fresh(scene: Scene): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, scene, options);
  const pixels = await beauty(tracer);
  tracer.destroy();
  return pixels;
}
const largest = (a: Float32Array, b: Float32Array) =>
  a.reduce((max, value, i) => Math.max(max, Math.abs(value - (b[i] as number))), 0);

/** Counts what is compiled while something runs. */
async function compiled(run: () => Promise<unknown>): Promise<string[]> {
  const original = device.createComputePipelineAsync.bind(device);
  const made: string[] = [];
  device.createComputePipelineAsync = (descriptor) => {
    made.push(String(descriptor.label));
    return original(descriptor);
  };
  try {
    await run();
  } finally {
    device.createComputePipelineAsync = original;
  }
  return made;
}

const square = (half: number): Mesh => ({
  name: 'part',
  positions: new Float32Array([-half, -half, 0.4, half, -half, 0.4, half, half, 0.4, -half, half, 0.4]),
  indices: new Uint32Array([0, 1, 2, 0, 2, 3]),
});

/** A name, the edit, and the scene that should come out of it. */
const EDITS: readonly (readonly [
  name: string,
  edit: (tracer: PathTracer) => Promise<void>,
  scene: (scene: Scene) => void,
])[] = [
  [
    'a light',
    (t) => t.setLight('lamp', { intensity: 9, position: [1, 0, 1] } as object),
    (s) => Object.assign(s.lights[0] as object, { intensity: 9, position: [1, 0, 1] }),
  ],
  [
    'a lamp switched off',
    (t) => t.setLight(0, { intensity: 0 }),
    (s) => Object.assign(s.lights[0] as object, { intensity: 0 }),
  ],
  [
    'the rotation of the environment',
    (t) => t.adjustEnvironment({ rotation: 1.2, intensity: 0.5 }),
    (s) => Object.assign(s.environment as object, { rotation: 1.2, intensity: 0.5 }),
  ],
  [
    'an environment hidden',
    (t) => t.adjustEnvironment({ visible: false }),
    (s) => Object.assign(s.environment as object, { visible: false }),
  ],
  [
    'a transform',
    (t) => t.setInstanceTransform('sphere', moved(0.4, -0.3, 0.1)),
    (s) => Object.assign(s.instances[1] as object, { transform: moved(0.4, -0.3, 0.1) }),
  ],
  [
    'the transform of something that glows',
    (t) => t.setInstanceTransform('panel', moved(-1, -0.8, 0)),
    (s) => Object.assign(s.instances[2] as object, { transform: moved(-1, -0.8, 0) }),
  ],
  [
    'visibility',
    (t) => t.setVisibility('sphere', false),
    (s) => Object.assign(s.instances[1] as object, { visible: false }),
  ],
  [
    'visibility of several',
    (t) => t.setVisibility(['sphere', 2], false),
    (s) => s.instances.slice(1, 3).forEach((instance) => Object.assign(instance, { visible: false })),
  ],
  [
    'the material of an instance',
    (t) => t.setInstanceMaterial(1, 'blue'),
    (s) => Object.assign(s.instances[1] as object, { material: 3 }),
  ],
  ['a mesh for a smaller one', (t) => t.replaceMesh('sphere', square(0.5)), (s) => (s.meshes[1] = square(0.5))],
  [
    'a material’s value',
    (t) => t.setMaterial('ball', { specular_roughness: 0.7 }),
    (s) =>
      ((s.materials[1] as Scene['materials'][number]).parameters = {
        base_color: [0.8, 0.2, 0.1],
        specular_roughness: 0.7,
      }),
  ],
  [
    'an emission',
    (t) => t.setMaterial('glow', { emission_luminance: 7 }),
    (s) =>
      ((s.materials[2] as Scene['materials'][number]).parameters = {
        base_weight: 0,
        specular_weight: 0,
        emission_luminance: 7,
      }),
  ],
];

/** An environment that counts the texel components that are read from its array. */
function counted(rotation = 0) {
  const count = { reads: 0 };
  const data = new Proxy(image.slice(), {
    get(target, key) {
      if (typeof key === 'string' && /^\d+$/.test(key)) count.reads++;
      const value: unknown = Reflect.get(target, key, target);
      return typeof value === 'function' ? value.bind(target) : value;
    },
  });
  return { count, environment: { ...sky(rotation), data } };
}

describe('edits of a live tracer', () => {
  it.each(EDITS)(
    '%s: the image of a tracer made for the edited scene, and nothing compiled',
    async (_, edit, change) => {
      const tracer = await PathTracer.create(device, stage(), options);
      const before = await beauty(tracer);
      const made = await compiled(() => edit(tracer));
      expect(made).toEqual([]);
      expect(tracer.samples).toBe(0);
      const after = await beauty(tracer);
      const scene = stage();
      change(scene);
      const expected = await fresh(scene);
      expect(largest(after, before)).toBeGreaterThan(1e-3);
      // The order of nodes in the hierarchy may differ, not what they hold; sums are in the same order.
      expect(largest(after, expected)).toBeLessThan(1e-5);
      tracer.destroy();
    },
  );

  it('the same environment at another rotation or intensity, even 0, is set without reading a texel', async () => {
    const { count, environment } = counted();
    const tracer = await PathTracer.create(device, { ...stage(), environment }, options);
    const turned = { ...environment, rotation: 1.2 };
    const next: LatLongEnvironment[] = [turned, { ...turned, intensity: 0 }, { ...turned, intensity: 0.5 }];
    for (const setting of next) {
      expect(count.reads).toBeGreaterThanOrEqual(image.length);
      count.reads = 0;
      await tracer.setEnvironment(setting);
      expect(count.reads).toBe(0);
      // A control: texels that are not on the GPU are read.
      await tracer.setEnvironment(sky(0));
      await tracer.setEnvironment(setting);
    }
    await tracer.setEnvironment(turned);
    for (const setting of next) await tracer.setEnvironment(setting);
    const expected = { ...stage(), environment: { ...sky(1.2), intensity: 0.5 } };
    expect(largest(await beauty(tracer), await fresh(expected))).toBeLessThan(1e-5);
    // Numbers beside the texels are validated as ever, and so is a size that the texels do not have.
    const refused = (change: object) =>
      tracer.setEnvironment({ ...environment, ...change }).then(
        () => 'none',
        (error: { code?: string }) => error.code,
      );
    expect(await refused({ rotation: Number.NaN })).toBe('scene/not-finite');
    expect(await refused({ width: 32 })).toBe('scene/length');
    // The array, not the object around it, is what is known.
    const other = Object.assign(environment, { data: counted().environment.data.fill(Number.NaN) });
    expect(await refused({ data: other.data })).toBe('scene/not-finite');
    tracer.destroy();
  });

  it('a part that is hidden at first, and a larger mesh, bring new buffers', async () => {
    const scene = stage();
    scene.instances[1] = { ...(scene.instances[1] as Scene['instances'][number]), visible: false };
    const tracer = await PathTracer.create(device, scene, options);
    await beauty(tracer, 1);
    await tracer.setVisibility('sphere', true);
    expect(largest(await beauty(tracer), await fresh(stage()))).toBeLessThan(1e-5);
    const larger = createScene();
    addSphere(larger, 0.5, [0.2, 0, 0.5], lambert(1), 40);
    // Two edits at once: both hold.
    await Promise.all([
      tracer.replaceMesh('sphere', larger.meshes[0] as Mesh),
      tracer.setLight('lamp', { intensity: 5 }),
      tracer.setInstanceTransform('panel', moved(-1, 0, 0)),
    ]);
    const expected = stage();
    expected.meshes[1] = larger.meshes[0] as Mesh;
    Object.assign(expected.lights[0] as object, { intensity: 5 });
    Object.assign(expected.instances[2] as object, { transform: moved(-1, 0, 0) });
    expect(largest(await beauty(tracer), await fresh(expected))).toBeLessThan(1e-5);
    expect(tracer.pick(10, 8)?.instance).toBe(1);
    tracer.destroy();
  });

  it('variants come and go', async () => {
    const scene = stage();
    scene.variants = ['night', 'day'];
    scene.instances[1] = { ...(scene.instances[1] as Scene['instances'][number]), variants: { 1: 3 } };
    const tracer = await PathTracer.create(device, scene, options);
    const own = await beauty(tracer);
    await tracer.setVariant('day');
    const blue = stage();
    Object.assign(blue.instances[1] as object, { material: 3 });
    expect(largest(await beauty(tracer), await fresh(blue))).toBeLessThan(1e-5);
    await tracer.setVariant('night');
    expect(largest(await beauty(tracer), own)).toBe(0);
    await tracer.setVariant(1);
    await tracer.setVariant(undefined);
    expect(largest(await beauty(tracer), own)).toBe(0);
    tracer.destroy();
  });

  it('a variant takes effect with the next sample, and nothing is compiled, not even for a lobe that only a variant has', async () => {
    const scene = stage();
    scene.variants = ['blue', 'dusty'];
    scene.materials.push({ name: 'dusty', parameters: { base_color: [0.1, 0.2, 0.8], fuzz_weight: 1 } });
    scene.instances[1] = { ...(scene.instances[1] as Scene['instances'][number]), variants: { 0: 3, 1: 4 } };
    const tracer = await PathTracer.create(device, scene, options);
    const own = await beauty(tracer);
    const made = await compiled(async () => {
      const change = tracer.setVariant('blue');
      // The film is empty at once, and its first sample is already blue.
      expect(tracer.samples).toBe(0);
      const first = await beauty(tracer, 1);
      expect(largest(first, own)).toBeGreaterThan(0.05);
      await change;
      const same = stage();
      Object.assign(same.instances[1] as object, { material: 3 });
      const other = await PathTracer.create(device, same, options);
      expect(largest(first, await beauty(other, 1))).toBeLessThan(1e-5);
      other.destroy();
    });
    expect(made).toEqual([]);
    // Materials of variants are in the scene from the beginning, and so are their lobes.
    expect(await compiled(() => tracer.setVariant('dusty'))).toEqual([]);
    tracer.destroy();
  });

  it('a lobe that appears compiles in the background while the old kernels serve; one that goes compiles nothing', async () => {
    const tracer = await PathTracer.create(device, stage(), { ...options, seed: 3 });
    const made = await compiled(async () => {
      const change = tracer.setMaterial('ball', { coat_weight: 1, coat_roughness: 0.1 });
      expect(tracer.samples).toBe(0);
      // The old pipelines render at once.
      for await (const _ of tracer.render({ samples: 2, maxSubmitMs: 1000 }));
      await change;
    });
    expect(made).toContain('glanz shade');
    expect(made.every((label) => label === 'glanz shade')).toBe(true);
    const coated = stage();
    (coated.materials[1] as Scene['materials'][number]).parameters = {
      base_color: [0.8, 0.2, 0.1],
      specular_roughness: 0.3,
      coat_weight: 1,
      coat_roughness: 0.1,
    };
    const other = await PathTracer.create(device, coated, { ...options, seed: 3 });
    expect(largest(await beauty(tracer), await beauty(other))).toBeLessThan(1e-5);
    other.destroy();
    expect(await compiled(() => tracer.setMaterial('ball', { coat_weight: 0 }))).toEqual([]);
    expect(await compiled(() => tracer.setMaterial('ball', { coat_weight: 0.5 }))).toEqual([]);
    tracer.destroy();
  });

  it('depth and background are edits too', async () => {
    const tracer = await PathTracer.create(device, stage(), options);
    await beauty(tracer);
    tracer.setDepth(2);
    const direct = await PathTracer.create(device, stage(), { ...options, maxDepth: 2, background: 'transparent' });
    tracer.setBackground('transparent');
    expect(largest(await beauty(tracer), await beauty(direct))).toBe(0);
    tracer.destroy();
    direct.destroy();
  });

  it('what cannot be done is refused, and leaves everything as it was', async () => {
    const tracer = await PathTracer.create(device, stage(), options);
    const before = await beauty(tracer);
    const code = (run: () => unknown) =>
      Promise.resolve()
        .then(run)
        .then(
          () => 'none',
          (error: { code?: string }) => error.code,
        );
    expect(await code(() => tracer.setInstanceTransform('nobody', moved(0, 0, 0)))).toBe('renderer/instance');
    expect(await code(() => tracer.setInstanceTransform('panel', [1, 2, 3]))).toBe('renderer/transform');
    expect(await code(() => tracer.setInstanceTransform('panel', moved(Number.NaN, 0, 0)))).toBe('renderer/transform');
    expect(await code(() => tracer.setInstanceMaterial('panel', 'nothing'))).toBe('renderer/material');
    expect(await code(() => tracer.setLight('sun', { intensity: 1 }))).toBe('renderer/light');
    expect(await code(() => tracer.setLight('lamp', { intensity: -1 }))).toBe('scene/value');
    expect(await code(() => tracer.setVariant('day'))).toBe('renderer/variant');
    expect(await code(() => tracer.replaceMesh('nothing', square(1)))).toBe('renderer/mesh');
    expect(await code(() => tracer.replaceMesh('sphere', { ...square(1), indices: new Uint32Array([0, 1, 9]) }))).toBe(
      'scene/reference',
    );
    expect(await code(() => tracer.adjustEnvironment({ rotation: Number.NaN }))).toBe('renderer/environment');
    expect(await code(() => tracer.setDepth(0))).toBe('renderer/option');
    for (const name of ['floor', 'panel']) await tracer.setVisibility(name, false);
    expect(await code(() => tracer.setVisibility('sphere', false))).toBe('renderer/no-triangles');
    for (const name of ['floor', 'panel']) await tracer.setVisibility(name, true);
    expect(largest(await beauty(tracer), before)).toBe(0);
    tracer.destroy();
  });

  it('a new image is prepared in slices: the event loop turns meanwhile, and other edits hold', async () => {
    const tracer = await PathTracer.create(device, stage(), options);
    const [width, height] = [4096, 2048];
    const large = { ...sky(0), width, height, data: new Float32Array(width * height * 3).fill(0.5) };
    let turns = 0;
    const turn = () => {
      turns++;
      turning = setImmediate(turn);
    };
    let turning = setImmediate(turn);
    const lit = tracer.setEnvironment(large);
    await tracer.setMaterial('ball', { base_color: [0.1, 0.1, 0.9] });
    expect((tracer.scene.environment as LatLongEnvironment).width).toBe(16);
    await lit;
    clearImmediate(turning);
    expect(turns).toBeGreaterThan(3);
    const after = await beauty(tracer);
    tracer.destroy();
    const same = stage();
    same.environment = large;
    same.materials[1]!.parameters = { ...same.materials[1]!.parameters, base_color: [0.1, 0.1, 0.9] };
    expect(largest(after, await fresh(same))).toBe(0);
  });

  it('edits of the environment hold in the order in which they were made, although images take longer', async () => {
    const tracer = await PathTracer.create(device, stage(), options);
    const imageOf = (value: number): LatLongEnvironment => ({
      ...sky(0),
      width: 1024,
      height: 512,
      data: new Float32Array(1024 * 512 * 3).fill(value),
    });
    const [first, second] = [imageOf(0.2), imageOf(0.7)];
    await Promise.all([
      tracer.setEnvironment(first),
      tracer.setEnvironment(second),
      tracer.adjustEnvironment({ rotation: 1, intensity: 2 }),
    ]);
    expect(tracer.scene.environment).toEqual({ ...second, rotation: 1, intensity: 2, visible: true });
    await Promise.all([
      tracer.setEnvironment(first),
      tracer.setEnvironment({ type: 'constant', radiance: [1, 1, 1] }),
      expect(tracer.adjustEnvironment({ intensity: 2 })).rejects.toMatchObject({ code: 'renderer/environment' }),
    ]);
    expect(tracer.scene.environment).toEqual({ type: 'constant', radiance: [1, 1, 1] });
    // One that is refused delays no other.
    await Promise.all([
      expect(tracer.setEnvironment({ ...first, data: new Float32Array(3) })).rejects.toMatchObject({
        code: expect.stringMatching(/^scene\//),
      }),
      tracer.setEnvironment(undefined),
    ]);
    expect(tracer.scene.environment).toBeUndefined();
    tracer.destroy();
  });
});
