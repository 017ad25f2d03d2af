import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, beforeAll, describe, expect, it, vi } from 'vitest';
import { DenoiseError, type KernelFamily } from '../src/index';
import { shapesFrom, tuneShapes, type TuneOptions, type TunedShapes } from '../src/tune/index';
import { denoiseOnGpu } from './gpu';
import { randomImages, randomNetwork } from './random-network';

let device: GPUDevice;
beforeAll(async () => void (device = await testDevice({ driver: 'swiftshader' })));
afterEach(() => {
  vi.restoreAllMocks();
  return expectNoGpuErrors();
});

const weights = randomNetwork(9, 'even');
const size = { width: 50, height: 34 };

/** Runs with methods of the device replaced. */
async function replacing<T>(methods: Partial<Record<keyof GPUDevice, unknown>>, run: () => Promise<T>): Promise<T> {
  const own = Object.keys(methods).map((name) => [name, Object.getOwnPropertyDescriptor(device, name)] as const);
  for (const [name, value] of Object.entries(methods))
    Object.defineProperty(device, name, { configurable: true, writable: true, value });
  try {
    return await run();
  } finally {
    for (const [name, descriptor] of own)
      if (descriptor) Object.defineProperty(device, name, descriptor);
      else delete (device as unknown as Record<string, unknown>)[name];
  }
}

/** Counts buffers and query sets that are made and not destroyed. */
async function alive(run: () => Promise<void>): Promise<{ readonly made: number; readonly left: number }> {
  const made = new Set<object>();
  const left = new Set<object>();
  const track = <T extends GPUBuffer | GPUQuerySet>(one: T): T => {
    const destroy = one.destroy.bind(one);
    made.add(one);
    left.add(one);
    Object.assign(one, {
      destroy: () => {
        left.delete(one);
        destroy();
      },
    });
    return one;
  };
  const createBuffer = device.createBuffer.bind(device);
  const createQuerySet = device.createQuerySet.bind(device);
  await replacing(
    {
      createBuffer: (descriptor: GPUBufferDescriptor) => track(createBuffer(descriptor)),
      createQuerySet: (descriptor: GPUQuerySetDescriptor) => track(createQuerySet(descriptor)),
    },
    run,
  );
  return { made: made.size, left: left.size };
}

const denoise = (shapes?: TunedShapes) =>
  denoiseOnGpu(
    weights,
    randomImages(size.width, size.height),
    { input: 'hdr', ...(shapes ? { shapeOf: shapesFrom(shapes) } : {}) },
    device,
  );

/** How many floats differ. */
const different = (a: Float32Array, b: Float32Array) =>
  a.reduce((count, value, i) => count + (Object.is(value, b[i]) ? 0 : 1), a.length - b.length);

describe('measured shapes', () => {
  it('are plain data for each layer but the last; images have the same bits with them', async () => {
    const tuned = await tuneShapes(device, weights, { ...size, maxMs: Infinity });
    expect(Object.keys(tuned)).toHaveLength(15);
    // The image is computed at a multiple of 16.
    expect(Object.keys(tuned)[0]).toBe('enc_conv0 0+9>4 64x48');
    expect(Object.keys(tuned)).toContain('dec_conv1a 4+9>4 64x48');
    const stored = JSON.parse(JSON.stringify(tuned)) as TunedShapes;
    const plain = await denoise();
    expect(different((await denoise(stored)).rgba, plain.rgba)).toBe(0);
    // Not the usual shape anywhere: the same bits still, and each layer gets what it is given.
    const family: KernelFamily = { threadsX: 2, threadsY: 4, rows: 2, outputs: 4 };
    const others = Object.fromEntries(Object.keys(tuned).map((key) => [key, family]));
    const labels: string[] = [];
    const compile = device.createComputePipelineAsync.bind(device);
    const createComputePipelineAsync = (descriptor: GPUComputePipelineDescriptor) => {
      labels.push(descriptor.label!);
      return compile(descriptor);
    };
    const { rgba } = await replacing({ createComputePipelineAsync }, () => denoise(others));
    expect(different(rgba, plain.rgba)).toBe(0);
    const layers = labels.filter((label) => label.includes('threads of'));
    expect(layers.length).toBeGreaterThan(2);
    expect(
      layers.filter((label) => !/^denoise 2x4x\d threads of 4x2x4\b/.test(label) && !label.includes('last')),
    ).toEqual([]);
  });

  it('are the usual ones of layers at other sizes', () => {
    const shapeOf = shapesFrom({ 'a 0+3>4 16x16': { threadsX: 2, threadsY: 2, rows: 2, outputs: 4 } });
    const layer = { name: 'a', upChannels: 0, directChannels: 3, channels: 4 };
    expect(shapeOf(layer, 16, 16)?.threadsX).toBe(2);
    expect(shapeOf(layer, 16, 32)).toBeUndefined();
    expect(shapeOf({ ...layer, channels: 5 }, 16, 16)).toBeUndefined();
    expect(shapesFrom({})({ ...layer, name: '__proto__' }, 16, 16)).toBeUndefined();
  });

  it('are those that the clock finds the fastest', async () => {
    // Without timestamps, and with a clock by which the GPU is slow but for one shape.
    const fast = /4x4x\d threads of 4x1x4/;
    let label = '';
    let now = 0;
    vi.spyOn(performance, 'now').mockImplementation(() => now);
    const createCommandEncoder = device.createCommandEncoder.bind(device);
    const { queue } = device;
    const slowQueue = new Proxy(queue, {
      get(target, key) {
        const value = Reflect.get(target, key, target) as unknown;
        if (typeof value !== 'function') return value;
        if (key !== 'onSubmittedWorkDone') return (value as (...all: unknown[]) => unknown).bind(target);
        return async () => {
          await target.onSubmittedWorkDone();
          now += fast.test(label) ? 2 : 3;
        };
      },
    });
    const tuned = await replacing(
      {
        features: new Set<string>(),
        queue: slowQueue,
        createCommandEncoder: () => {
          const encoder = createCommandEncoder();
          const begin = encoder.beginComputePass.bind(encoder);
          encoder.beginComputePass = (descriptor) => {
            const pass = begin(descriptor);
            const set = pass.setPipeline.bind(pass);
            pass.setPipeline = (pipeline) => {
              label = pipeline.label;
              return set(pipeline);
            };
            return pass;
          };
          return encoder;
        },
      },
      () => tuneShapes(device, weights, { ...size, maxMs: Infinity, maxSubmitMs: 1 }),
    );
    // Rows of one pixel cannot be pooled: there the usual shape stays.
    for (const [key, { threadsX, threadsY, rows }] of Object.entries(tuned))
      expect([key, threadsX, threadsY, rows]).toEqual([key, 4, ...(/^enc_conv[1-4]/.test(key) ? [2, 2] : [4, 1])]);
  });

  it('are the usual ones where there is no time, and always for the same layers', async () => {
    const create = device.createCommandEncoder.bind(device);
    const measuring = async (maxMs: number): Promise<[shapes: TunedShapes, submissions: number]> => {
      let submissions = 0;
      const shapes = await replacing({ createCommandEncoder: () => (submissions++, create()) }, () =>
        tuneShapes(device, weights, { ...size, maxMs }),
      );
      return [shapes, submissions];
    };
    const [none, few] = await measuring(0.001);
    const [all, many] = await measuring(Infinity);
    expect([few, many > 15]).toEqual([0, true]);
    expect(Object.keys(none)).toEqual(Object.keys(all));
    expect(Object.values(none)).toEqual(Array(15).fill({ threadsX: 4, threadsY: 2, rows: 2, outputs: 4 }));
  });
});

describe('memory', () => {
  it('is freed at the end', async () => {
    const { made, left } = await alive(async () => void (await tuneShapes(device, weights, { ...size })));
    expect(made).toBeGreaterThan(10);
    expect(left).toBe(0);
  });

  it('is freed where the signal aborts, at any moment', async () => {
    const reason = new Error('the page is left');
    const { queue } = device;
    const counts: number[] = [];
    for (const moment of [0, 1, 4, 17]) {
      const controller = new AbortController();
      let submissions = 0;
      const watched = new Proxy(queue, {
        get(target, key) {
          const value = Reflect.get(target, key, target) as unknown;
          if (typeof value !== 'function') return value;
          if (key === 'submit' && ++submissions >= moment) controller.abort(reason);
          return (value as (...all: unknown[]) => unknown).bind(target);
        },
      });
      const { made, left } = await alive(() =>
        replacing({ queue: watched }, async () => {
          const tuning = tuneShapes(device, weights, { ...size, maxMs: Infinity, signal: controller.signal });
          if (moment === 0) setTimeout(() => controller.abort(reason), 5);
          await expect(tuning).rejects.toBe(reason);
          // What the driver was compiling comes after the end.
          await new Promise((resolve) => setTimeout(resolve, 300));
        }),
      );
      expect(left, `aborted at submission ${moment}`).toBe(0);
      counts.push(made);
    }
    expect(Math.min(...counts)).toBeGreaterThan(1);
    await expect(tuneShapes(device, weights, { ...size, signal: AbortSignal.abort(reason) })).rejects.toBe(reason);
  });
});

it('options are checked', async () => {
  const code = (options: Partial<TuneOptions>) =>
    tuneShapes(device, weights, { ...size, ...options }).catch((error: unknown) =>
      error instanceof DenoiseError ? error.code : error,
    );
  expect(await code({ maxMs: 0 })).toBe('denoise/option');
  expect(await code({ maxMs: NaN })).toBe('denoise/option');
  expect(await code({ storage: 'f8' as 'f16' })).toBe('denoise/option');
  expect(await code({ width: 0 })).toBe('denoise/size');
  expect(await code({ maxMemory: 1000 })).toBe('denoise/memory');
});
