import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { addQuad, addSphere, camera, createScene, meanOf } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

const LIGHTS = ['key', 'lamp', 'sky'] as const;

/** A red floor and a metal ball under a glowing square (key), a point light (lamp) and the sky; some may be dark. */
function studio(on: readonly string[] = LIGHTS): Scene {
  const scene = createScene();
  addQuad(scene, 2, 0, { name: 'floor', parameters: { base_color: [0.8, 0.3, 0.2], specular_roughness: 0.3 } });
  addSphere(
    scene,
    0.4,
    [0, 0, 0.5],
    { name: 'ball', parameters: { base_metalness: 1, base_color: [1, 0.8, 0.3], specular_roughness: 0.4 } },
    16,
  );
  addQuad(
    scene,
    0.5,
    2,
    { name: 'square', parameters: { emission_luminance: on.includes('key') ? 6 : 0 }, light_group: 'key' },
    { flip: true, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1.2, 1.2, 0, 1] },
  );
  scene.lights.push({
    type: 'point',
    name: 'bulb',
    light_group: 'lamp',
    color: [1, 0.9, 0.7],
    intensity: on.includes('lamp') ? 3 : 0,
    position: [-1, 0, 1.5],
  });
  if (on.includes('sky')) scene.environment = { type: 'constant', radiance: [0.2, 0.3, 0.4], light_group: 'sky' };
  return scene;
}

async function render(
  scene: Scene,
  options: Partial<PathTracerOptions> & { samples?: number } = {},
): Promise<PathTracer> {
  const tracer = await PathTracer.create(device, scene, {
    width: 16,
    height: 16,
    camera,
    pathsInFlight: 1 << 13,
    maxDepth: 4,
    ...options,
  });
  for await (const _ of tracer.render({ maxSubmitMs: 1000, samples: options.samples ?? 40 }));
  return tracer;
}

const largest = (a: Float32Array, b: Float32Array) =>
  a.reduce((max, value, i) => Math.max(max, Math.abs(value - (b[i] as number))), 0);

describe('light groups', () => {
  it('all groups add up to the beauty, which is the one without groups', async () => {
    const tracer = await render(studio());
    expect(tracer.lightGroups).toEqual(
      ['sky', 'lamp', 'key'].map((name) => ({ name, intensity: 1, color: [1, 1, 1] })),
    );
    const beauty = await tracer.read('beauty');
    const parts = await Promise.all(LIGHTS.map((name) => tracer.readLightGroup(name)));
    for (const part of parts) expect(meanOf(part, 16, 0, 0, 16, 16)[0]).toBeGreaterThan(0.001);
    const sum = beauty.map((value, i) =>
      i % 4 === 3 ? value : parts.reduce((all, part) => all + (part[i] as number), 0),
    );
    expect(largest(sum, beauty)).toBeLessThan(1e-6);
    const plain = await render(studio(), { lightGroups: 'off' });
    expect(largest(await plain.read('beauty'), beauty)).toBeLessThan(1e-5);
    tracer.destroy();
    plain.destroy();
  });

  it('a group holds the light of its lights: as in a scene where the others are dark', async () => {
    const all = await render(studio(), { samples: 256 });
    for (const name of LIGHTS) {
      const alone = await render(studio([name]), { samples: 256 });
      const expected = meanOf(await alone.read('beauty'), 16, 0, 0, 16, 16);
      const found = meanOf(await all.readLightGroup(name), 16, 0, 0, 16, 16);
      for (const c of [0, 1, 2] as const) expect(Math.abs(found[c] / expected[c] - 1)).toBeLessThan(0.02);
      alone.destroy();
    }
    all.destroy();
  });

  it('relighting costs no sample and is what the light would have given', async () => {
    const tracer = await render(studio());
    const before = await tracer.read('beauty');
    const lamp = await tracer.readLightGroup('lamp');
    const key = await tracer.readLightGroup('key');
    await tracer.setLightGroup('lamp', { intensity: 0 });
    await tracer.setLightGroup('key', { intensity: 2, color: [1, 0.5, 0.25] });
    expect(tracer.samples).toBe(40);
    const after = await tracer.read('beauty');
    const tint = [2, 1, 0.5];
    expect(
      largest(
        after,
        before.map((value, i) =>
          i % 4 === 3 ? value : value - (lamp[i] as number) + (key[i] as number) * ((tint[i % 4] as number) - 1),
        ),
      ),
    ).toBeLessThan(2e-6);
    // More samples go on from there: the same image as one that was lit so from its first sample.
    for await (const _ of tracer.render({ samples: 50, maxSubmitMs: 1000 }));
    const later = await PathTracer.create(device, studio(), {
      width: 16,
      height: 16,
      camera,
      maxDepth: 4,
      pathsInFlight: 1 << 13,
    });
    await later.setLightGroup('lamp', { intensity: 0 });
    await later.setLightGroup('key', { intensity: 2, color: [1, 0.5, 0.25] });
    for await (const _ of later.render({ samples: 50, maxSubmitMs: 1000 }));
    expect(largest(await tracer.read('beauty'), await later.read('beauty'))).toBe(0);
    expect(tracer.lightGroups.find(({ name }) => name === 'key')).toEqual({
      name: 'key',
      intensity: 2,
      color: [1, 0.5, 0.25],
    });
    tracer.destroy();
    later.destroy();
  });

  it('each light by its own name, and the same image whatever the batches', async () => {
    const options = { lightGroups: 'each' } as const;
    const scene = studio();
    delete scene.materials[2]?.light_group;
    const one = await render(scene, options);
    const two = await render(scene, { ...options, pathsInFlight: 100 });
    expect(one.lightGroups.map(({ name }) => name)).toEqual(['sky', 'lamp', 'square']);
    expect(largest(await one.readLightGroup('square'), await two.readLightGroup('square'))).toBe(0);
    expect(largest(await one.read('beauty'), await two.read('beauty'))).toBe(0);
    // A light that appears brings its group with it.
    await one.setMaterial('ball', { emission_luminance: 1 });
    expect(one.lightGroups.map(({ name }) => name)).toEqual(['sky', 'lamp', 'ball', 'square']);
    for await (const _ of one.render({ samples: 8, maxSubmitMs: 1000 }));
    // The middle of the image is the ball, which now glows.
    expect(meanOf(await one.readLightGroup('ball'), 16, 7, 7, 9, 9)[0]).toBeGreaterThan(0.9);
    one.destroy();
    two.destroy();
  });

  it('refuses groups that are not there, numbers that are not finite, and too many groups', async () => {
    const tracer = await render(studio(), { samples: 1 });
    await expect(tracer.setLightGroup('fill', { intensity: 1 })).rejects.toMatchObject({
      code: 'renderer/light-groups',
    });
    await expect(tracer.setLightGroup('key', { intensity: -1 })).rejects.toMatchObject({
      code: 'renderer/light-groups',
    });
    await expect(tracer.readLightGroup('fill')).rejects.toThrow(/sky, lamp, key/);
    tracer.destroy();
    const scene = studio();
    for (let i = 0; i < 20; i++)
      scene.lights.push({ type: 'point', name: `lamp ${i}`, color: [1, 1, 1], intensity: 1, position: [0, 0, 1] });
    await expect(PathTracer.create(device, scene, { width: 4, height: 4, lightGroups: 'each' })).rejects.toMatchObject({
      code: 'renderer/light-groups',
    });
  });
});
