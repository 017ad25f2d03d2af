import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type FilmLayer, type PathTracerOptions } from '../../src/index';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

const SAMPLES = 40;
const options: PathTracerOptions = { width: 40, height: 24, camera, pathsInFlight: 1 << 13, maxDepth: 4 };
const LAYERS: readonly FilmLayer[] = ['beauty', 'variance', 'albedo', 'normal', 'depth', 'objectId'];

function scene() {
  const stage = createScene();
  addQuad(stage, 0.9, 0, lambert(0.6, 0.5, 0.4));
  addSphere(stage, 0.3, [0, 0, 0.3], { name: 'ball', parameters: { base_color: [0.8, 0.2, 0.1] } }, 8);
  stage.environment = { type: 'constant', radiance: [1, 0.9, 0.8] };
  return stage;
}

async function layers(tracer: PathTracer): Promise<Record<string, number[]>> {
  for await (const _ of tracer.render({ samples: SAMPLES }));
  const all: Record<string, number[]> = {};
  for (const layer of LAYERS) all[layer] = Array.from(await tracer.read(layer));
  return all;
}

async function made(size: Partial<PathTracerOptions>): Promise<Record<string, number[]>> {
  const tracer = await PathTracer.create(device, scene(), { ...options, ...size });
  const all = await layers(tracer);
  tracer.destroy();
  return all;
}

describe('setRenderScale', () => {
  it('gives every layer bit for bit as a tracer of that size does, and the whole image again', async () => {
    const tracer = await PathTracer.create(device, scene(), options);
    tracer.setRenderScale(0.5);
    expect([tracer.width, tracer.height, tracer.renderScale]).toEqual([20, 12, 0.5]);
    expect(await layers(tracer)).toEqual(await made({ width: 20, height: 12 }));
    tracer.setRenderScale(0.27);
    expect([tracer.width, tracer.height]).toEqual([11, 6]);
    expect(await layers(tracer)).toEqual(await made({ width: 11, height: 6 }));
    tracer.setRenderScale(1);
    expect(await layers(tracer)).toEqual(await made({}));
    tracer.destroy();
  });

  it('takes images whose pixels are no multiple of four', async () => {
    const tracer = await PathTracer.create(device, scene(), { ...options, width: 41, height: 23 });
    tracer.setRenderScale(0.5);
    expect(await layers(tracer)).toEqual(await made({ width: 21, height: 12 }));
    tracer.destroy();
  });

  it('creates no buffer and no texture, also with samples for a noise target', async () => {
    const tracer = await PathTracer.create(device, scene(), options);
    for await (const _ of tracer.render({ samples: 64, noise: 1e-6 }));
    const bytes = tracer.statistics.gpuBytes;
    const created: string[] = [];
    const watched = ['createBuffer', 'createTexture'] as const;
    for (const name of watched) {
      const original = device[name].bind(device) as (descriptor: { label?: string }) => never;
      device[name] = (descriptor: { label?: string }) => {
        created.push(descriptor.label ?? '');
        return original(descriptor);
      };
    }
    try {
      for (const scale of [1 / 3, 1, 1 / 8, 0.01]) {
        tracer.setRenderScale(scale);
        for await (const _ of tracer.render({ samples: 64, noise: 1e-6 }));
        expect(tracer.samples).toBe(64);
      }
    } finally {
      for (const name of watched) delete (device as unknown as Record<string, unknown>)[name];
    }
    // Reading the noise back takes a buffer each time, for a moment.
    expect([...new Set(created)].filter((label) => label !== 'glanz read')).toEqual([]);
    expect(tracer.statistics.gpuBytes).toBe(bytes);
    tracer.destroy();
  });

  it('stays through edits that bring other kernels, ends with another size, and saves what it has', async () => {
    const tracer = await PathTracer.create(device, scene(), options);
    tracer.setRenderScale(0.5);
    await tracer.setMaterial('ball', { coat_weight: 0.7, base_metalness: 0.5 });
    for await (const _ of tracer.render({ samples: 20 }));
    const state = await tracer.saveFilm();
    expect([state.width, state.height, state.sums.film_total.length]).toEqual([20, 12, 4 * 20 * 12]);
    const beauty = await tracer.read('beauty');
    tracer.reset();
    await tracer.restoreFilm(state);
    expect(await tracer.read('beauty')).toEqual(beauty);
    tracer.setRenderScale(1);
    await expect(tracer.restoreFilm(state)).rejects.toMatchObject({ code: 'renderer/film-state' });
    tracer.setRenderScale(0.5);
    await tracer.resize(40, 24);
    expect([tracer.width, tracer.height, tracer.renderScale]).toEqual([40, 24, 1]);
    tracer.setRenderScale(0.5);
    await tracer.resize(30, 20);
    expect([tracer.width, tracer.height, tracer.renderScale]).toEqual([30, 20, 1]);
    tracer.destroy();
  });

  it('lets a resize that destroy() overtakes end quietly', async () => {
    const tracer = await PathTracer.create(device, scene(), options);
    tracer.setRenderScale(0.5);
    const resized = tracer.resize(30, 20);
    tracer.destroy();
    await expect(resized).resolves.toBeUndefined();
  });

  it.each([0, -1, 1.01, Number.NaN, Infinity, '0.5' as unknown as number])('refuses %s', async (scale) => {
    const tracer = await PathTracer.create(device, scene(), options);
    expect(() => tracer.setRenderScale(scale)).toThrow(expect.objectContaining({ code: 'renderer/size' }));
    expect(tracer.renderScale).toBe(1);
    tracer.destroy();
  });
});
