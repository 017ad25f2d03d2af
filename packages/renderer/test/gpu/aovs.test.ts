import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Material, Scene } from '@glanz/scene';
import { afterEach, beforeAll, expect, it } from 'vitest';
import { PathTracer, type AovName, type PathTracerOptions } from '../../src/index';
import { readAov } from '../aovs';
import { addBox, addQuad, addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterEach(() => expectNoGpuErrors());

const SIZE = 24;
const options: PathTracerOptions = { width: SIZE, height: SIZE, camera, maxDepth: 4, pathsInFlight: 1 << 14 };
const ALL: readonly AovName[] = ['albedo', 'coverage', 'normal', 'depth', 'virtualDepth', 'position'];

async function render(scene: Scene, samples: number, more: Partial<PathTracerOptions> = {}): Promise<PathTracer> {
  const tracer = await PathTracer.create(device, scene, { ...options, ...more });
  for await (const _ of tracer.render({ samples, maxSubmitMs: 1000 }));
  return tracer;
}

const BALL = [0.2, 0.1, 0.3] as const;
const COLORS = [
  [0.25, 0.5, 0.75],
  [0.8, 0.2, 0.1],
  [0.9, 0.9, 0.9],
] as const;

function diffuse(): Scene {
  const scene = createScene();
  addQuad(scene, 0.8, 0, lambert(...COLORS[0]));
  addSphere(scene, 0.4, [...BALL], lambert(...COLORS[1]), 64);
  addBox(scene, [-0.7, -0.7, 0], [-0.3, -0.3, 0.5], lambert(...COLORS[2]));
  scene.environment = { type: 'constant', radiance: [1, 0.9, 0.8] };
  return scene;
}

/** What the CPU's hierarchies find at 16 × 16 points of a pixel. */
function picked(tracer: PathTracer, x: number, y: number) {
  const side = 16;
  const hits = Array.from({ length: side * side }, (_, k) =>
    tracer.pick(x + ((k % side) + 0.5) / side, y + (Math.floor(k / side) + 0.5) / side),
  );
  const around = Array.from({ length: side }, (_, k) => -0.1 + (1.2 * k) / (side - 1)).flatMap((along) => [
    tracer.pick(x + along, y - 0.1),
    tracer.pick(x + along, y + 1.1),
    tracer.pick(x - 0.1, y + along),
    tracer.pick(x + 1.1, y + along),
  ]);
  const found = hits.filter((hit) => hit !== undefined);
  const mean = (of: readonly number[], count: number) => of.reduce((sum, value) => sum + value, 0) / Math.max(1, count);
  return {
    // Slivers of another instance that these points miss touch the points around the pixel.
    ids: new Set([...hits, ...around].map((hit) => hit?.instance)),
    centre: tracer.pick(x + 0.5, y + 0.5),
    coverage: found.length / hits.length,
    albedo: [0, 1, 2].map((c) =>
      mean(
        found.map((hit) => COLORS[hit.material]?.[c] as number),
        hits.length,
      ),
    ),
    depth: mean(
      found.map((hit) => hit.distance),
      found.length,
    ),
    position: [0, 1, 2].map((c) =>
      mean(
        found.map((hit) => hit.position[c] as number),
        found.length,
      ),
    ),
  };
}

it('gives what rays on the CPU find, where nothing is smooth', async () => {
  const tracer = await render(diffuse(), 64, { aovs: ALL, background: 'transparent' });
  const found = {} as Record<AovName, Float32Array>;
  for (const name of ALL) found[name] = await readAov(device, tracer, name);
  const [objects, materials] = [await tracer.read('objectId'), await tracer.read('materialId')];
  let [inside, edges] = [0, 0];
  for (let y = 0; y < SIZE; y++) {
    for (let x = 0; x < SIZE; x++) {
      const i = y * SIZE + x;
      const expected = picked(tracer, x, y);
      const off = (name: AovName, channels: number, values: readonly number[]) =>
        Math.max(...values.map((value, c) => Math.abs((found[name][channels * i + c] as number) - value)));
      if (expected.ids.size > 1) {
        edges++;
        // 64 samples and 256 points see an edge alike up to the samples of a row of a grid of 8 × 8.
        expect(off('coverage', 1, [expected.coverage])).toBeLessThanOrEqual(0.125);
        expect(off('albedo', 3, expected.albedo)).toBeLessThanOrEqual(0.125);
        continue;
      }
      expect([objects[i], materials[i]]).toEqual([
        expected.centre?.instance ?? 0xffffffff,
        expected.centre?.material ?? 0xffffffff,
      ]);
      expect(found.coverage[i]).toBe(expected.coverage);
      // Albedos are kept with 16 bits, normals within 5e-5 radians.
      expect(off('albedo', 3, expected.albedo)).toBeLessThan(2e-5);
      expect(found.virtualDepth[i]).toBe(found.depth[i]);
      if (expected.coverage === 0) {
        for (const name of ['normal', 'position'] as const) expect(off(name, 3, [0, 0, 0])).toBe(0);
        expect(found.depth[i]).toBe(0);
        continue;
      }
      // Sides of the box and both halves of the ball meet in a pixel too: depths vary by up to 0.1 there.
      expect(off('depth', 1, [expected.depth])).toBeLessThan(0.012);
      expect(off('position', 3, expected.position)).toBeLessThan(0.012);
      inside++;
      if (expected.centre?.instance === 1 && Math.hypot(...expected.position.map((p, c) => p - BALL[c]!)) > 0.395) {
        const normal = expected.position.map((p, c) => (p - BALL[c]!) / 0.4);
        expect(off('normal', 3, normal)).toBeLessThan(0.03);
      } else if (expected.centre?.instance === 0) {
        expect(off('normal', 3, [0, 0, 1])).toBeLessThan(1e-4);
      }
    }
  }
  // Both kinds there are.
  expect(inside).toBeGreaterThan(100);
  expect(edges).toBeGreaterThan(20);
  tracer.destroy();
});

it('takes ids from the sample nearest to the centre of a pixel', async () => {
  const few = await render(diffuse(), 1, { aovs: ['objectId'], seed: 3 });
  const many = await render(diffuse(), 64, { aovs: ['objectId'], seed: 3 });
  const wrong = async (tracer: PathTracer) =>
    (await tracer.read('objectId')).reduce((sum, id, i) => {
      const centre = tracer.pick((i % SIZE) + 0.5, Math.floor(i / SIZE) + 0.5);
      return sum + (id === (centre?.instance ?? 0xffffffff) ? 0 : 1);
    }, 0);
  const [first, last] = [await wrong(few), await wrong(many)];
  // An edge of n pixels is crossed by a first sample in a quarter of them; the nearest of 64 is 0.09 pixels away.
  expect(first).toBeGreaterThan(10);
  expect(last).toBeLessThan(0.5 * first);
  few.destroy();
  many.destroy();
});

it('tells how narrowly surfaces scatter: a metal as its roughness says, Lambert 1, what reflects a little in between', async () => {
  const metal = (roughness: number): Material => ({
    name: `metal ${roughness}`,
    parameters: { base_metalness: 1, base_color: [1, 1, 1], specular_roughness: roughness },
  });
  const dielectric: Material = { name: 'dielectric', parameters: { specular_roughness: 0.3 } };
  const coated: Material = {
    name: 'coated',
    parameters: { specular_weight: 0, coat_weight: 1, coat_roughness: 0.2 },
  };
  const of = async (material: Material) => {
    const scene = createScene();
    addQuad(scene, 0.3, 0, material);
    const tracer = await render(scene, 4, { aovs: ['roughness', 'objectId'], background: 'transparent' });
    const [roughness, ids] = [await tracer.read('roughness'), await tracer.read('objectId')];
    tracer.destroy();
    ids.forEach((id, i) => id === 0xffffffff && expect(roughness[i]).toBe(0));
    const centre = (SIZE / 2) * SIZE + SIZE / 2;
    expect(ids[centre]).toBe(0);
    return roughness[centre] as number;
  };
  const emitter: Material = {
    name: 'emitter',
    parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 1, emission_color: [1, 1, 1] },
  };
  expect(await of(emitter)).toBe(0);
  // What rough facets scatter more than once leaves them widely.
  for (const [roughness, slack] of [
    [0.1, 0.001],
    [0.3, 0.01],
    [0.8, 0.1],
  ] as const) {
    const found = await of(metal(roughness));
    expect(found).toBeGreaterThan(0.999 * roughness);
    expect(found).toBeLessThan((1 + slack) * roughness);
  }
  expect(await of(lambert(0.5))).toBe(1);
  for (const material of [dielectric, coated]) {
    const roughness = await of(material);
    expect(roughness).toBeGreaterThan(0.3);
    expect(roughness).toBeLessThan(0.9);
  }
});

it('costs no sample of the image, and comes later for samples that were taken without', async () => {
  const without = await render(diffuse(), 20);
  const beauty = await without.read('beauty');
  const first = await render(diffuse(), 20, { aovs: ALL });
  expect(await first.read('beauty')).toEqual(beauty);
  await without.setAovs(ALL);
  expect(without.aov('albedo').samples).toBe(20);
  expect(await without.read('beauty')).toEqual(beauty);
  for (const name of ALL)
    expect(await readAov(device, without, name), name).toEqual(await readAov(device, first, name));
  for (const tracer of [without, first]) for await (const _ of tracer.render({ samples: 70 }));
  expect(without.aov('albedo').samples).toBe(64);
  for (const name of ALL)
    expect(await readAov(device, without, name), name).toEqual(await readAov(device, first, name));
  expect(await without.read('beauty')).toEqual(await first.read('beauty'));
  without.destroy();
  first.destroy();
});

it('reads layers of films that were made without: they are requested, and recorded for the samples that there are', async () => {
  const tracer = await render(diffuse(), 20);
  const beauty = await tracer.read('beauty');
  expect(() => tracer.aov('normal')).toThrow(expect.objectContaining({ code: 'renderer/aov' }));
  const [normal, depth, ids] = await Promise.all([
    tracer.read('normal'),
    tracer.read('depth'),
    tracer.read('objectId'),
  ]);
  expect([...tracer.aovs].sort()).toEqual(['depth', 'normal', 'objectId']);
  expect(await tracer.read('beauty')).toEqual(beauty);
  const recorded = await render(diffuse(), 20, { aovs: ALL });
  expect(normal).toEqual(await recorded.read('normal'));
  expect(depth).toEqual(await recorded.read('depth'));
  expect(ids).toEqual(await recorded.read('objectId'));
  // An edit begins the film again, and its AOVs with it.
  await tracer.setInstanceTransform(1, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.4, 0, 0, 1]);
  expect(tracer.aov('normal').samples).toBe(0);
  const moved = await tracer.read('objectId');
  expect(moved).not.toEqual(ids);
  expect(tracer.aov('normal').samples).toBe(1);
  // Samples that come then are recorded from the second on.
  for await (const _ of tracer.render({ samples: 20 }));
  expect(tracer.aov('normal').samples).toBe(20);
  tracer.destroy();
  recorded.destroy();
});

it('goes on where AOVs are given up and requested again', async () => {
  const tracer = await render(diffuse(), 4, { aovs: ['objectId'] });
  const ids = await tracer.read('objectId');
  const bytes = tracer.statistics.gpuBytes;
  await tracer.setAovs([]);
  expect(tracer.statistics.gpuBytes).toBeLessThan(bytes);
  expect(() => tracer.aov('objectId')).toThrow(expect.objectContaining({ code: 'renderer/aov' }));
  await tracer.setAovs(['objectId']);
  expect(await tracer.read('objectId')).toEqual(ids);
  expect(tracer.samples).toBe(4);
  tracer.destroy();
});

it('ends the wait for AOVs by a signal: before the edit, while kernels compile, and between batches', async () => {
  const reason = new Error('enough');
  // A batch a sample.
  const tracer = await render(diffuse(), 20, { pathsInFlight: SIZE * SIZE });
  const before = tracer.setAovs(['normal'], { signal: AbortSignal.abort(reason) });
  await expect(before).rejects.toBe(reason);
  expect(tracer.aovs).toEqual([]);

  const compiling = new AbortController();
  const requested = tracer.setAovs(['normal'], { signal: compiling.signal });
  compiling.abort(reason);
  await expect(requested).rejects.toBe(reason);
  expect(tracer.aovs).toEqual(['normal']);

  const filling = new AbortController();
  const recorded = tracer.setAovs(['normal'], { signal: filling.signal });
  const abort = async () => {
    const samples = () => {
      try {
        return tracer.aov('normal').samples;
      } catch {
        return 0;
      }
    };
    while (samples() === 0) await new Promise((resolve) => setTimeout(resolve));
    filling.abort(reason);
  };
  await Promise.all([expect(recorded).rejects.toBe(reason), abort()]);
  expect(tracer.aov('normal').samples).toBeLessThan(20);

  const whole = await render(diffuse(), 20, { aovs: ['normal'] });
  expect(await tracer.read('normal')).toEqual(await whole.read('normal'));
  tracer.destroy();
  whole.destroy();
});

it('resumes with a saved film', async () => {
  const first = await render(diffuse(), 40, { aovs: ['albedo'] });
  const state = await first.saveFilm();
  const second = await render(diffuse(), 1, { aovs: ['albedo'] });
  await second.restoreFilm(state);
  expect(second.aov('albedo').samples).toBe(0);
  for await (const _ of second.render({ samples: 50 }));
  expect(second.aov('albedo').samples).toBe(0);
  for await (const _ of first.render({ samples: 50 }));
  expect(await second.read('albedo')).toEqual(await first.read('albedo'));
  expect(second.aov('albedo').samples).toBe(50);
  expect(await second.read('beauty')).toEqual(await first.read('beauty'));
  first.destroy();
  second.destroy();
});

it('records the same in bands and in several samples at once', async () => {
  const large = await render(diffuse(), 10, { aovs: ALL, pathsInFlight: 1 << 16 });
  const small = await render(diffuse(), 10, { aovs: ALL, pathsInFlight: 100 });
  for (const name of ALL) expect(await readAov(device, small, name), name).toEqual(await readAov(device, large, name));
  expect(await small.read('materialId')).toEqual(await large.read('materialId'));
  large.destroy();
  small.destroy();
});

/** Everything that brings resources to kernels: textures, opacity, a light tree, a map, a catcher, media, groups. */
function rich(): Scene {
  const scene = diffuse();
  scene.images.push({ name: 'p', width: 2, height: 2, data: new Uint8Array(16).fill(128) });
  scene.textures.push({ image: 0, color_space: 'srgb' });
  Object.assign(scene.materials[0] as object, { textures: { geometry_opacity: { texture: 0, channels: 'r' } } });
  scene.materials[1]!.parameters = {
    transmission_weight: 1,
    transmission_depth: 1,
    transmission_scatter: [0.5, 0.5, 0.5],
  };
  for (let i = 0; i < 20; i++)
    scene.lights.push({
      type: 'point',
      name: `p${i}`,
      color: [1, 1, 1],
      intensity: 1,
      position: [0.1 * i, 0, 2],
      light_group: `g${i % 2}`,
    });
  scene.environment = { type: 'latlong', width: 4, height: 2, data: new Float32Array(24).fill(1) };
  scene.instances[2]!.catcher = true;
  return scene;
}

it('records all of them within the limits that every browser has, eight storage buffers in a kernel among them', async () => {
  const small = await testDevice({ defaultLimits: true, driver: 'swiftshader' });
  const tracer = await PathTracer.create(small, rich(), {
    ...options,
    aovs: [...ALL, 'objectId', 'materialId', 'motion'],
  });
  for await (const _ of tracer.render({ samples: 2 }));
  expect(tracer.aov('motion').samples).toBe(2);
  tracer.destroy();
});

it('leaves the programs of tracers without AOVs alone', async () => {
  // A device of its own: others have compiled these programs before.
  const own = await testDevice({ features: [], driver: 'swiftshader' });
  const programs: string[] = [];
  const original = own.createShaderModule.bind(own);
  own.createShaderModule = (descriptor) => {
    programs.push(descriptor.code);
    return original(descriptor);
  };
  const tracer = await PathTracer.create(own, diffuse(), options);
  for await (const _ of tracer.render({ samples: 1 }));
  expect(programs.length).toBeGreaterThan(5);
  for (const code of programs) expect(code).not.toMatch(/aov|history/i);
  await tracer.setAovs(['motion']);
  expect(programs.some((code) => /aov_/.test(code) && /history_moves/.test(code))).toBe(true);
  tracer.destroy();
});

it('denoised() gives a denoiser its guides, and leaves the film as it is', async () => {
  const tracer = await render(diffuse(), 4);
  const film = await tracer.read('beauty');
  const { signal } = new AbortController();
  const pixels = await tracer.denoised(
    {
      async denoiseTracer(given: PathTracer, asked) {
        expect([given === tracer, asked?.signal === signal]).toEqual([true, true]);
        expect([...given.aovs].sort()).toEqual(['albedo', 'normal']);
        return readAov(device, given, 'albedo');
      },
      read: (albedo) => Promise.resolve(new Float32Array(albedo)),
    },
    { signal },
  );
  // Without the coverage, which the layer has beside it.
  expect(pixels).toEqual((await tracer.read('albedo')).filter((_, i) => i % 4 !== 3));
  expect(await tracer.read('beauty')).toEqual(film);
  tracer.destroy();
  await expect(
    tracer.denoised({ denoiseTracer: () => Promise.reject(), read: () => Promise.reject() }),
  ).rejects.toThrow('destroyed');
});
