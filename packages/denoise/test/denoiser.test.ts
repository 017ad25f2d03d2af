import { expectNoGpuErrors, nullDevice, testDevice } from '@glanz/gpu';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { DenoiseError, Denoiser, type DenoiseImages, type KernelFamily } from '../src/index';
import { bindImages, denoiseOnGpu, different, download, outputBuffer, upload } from './gpu';
import { randomImages, randomNetwork } from './random-network';

let device: GPUDevice;
beforeAll(async () => void (device = await testDevice({ driver: 'swiftshader' })));
afterEach(() => expectNoGpuErrors());

const weights = randomNetwork(9, 'even');
/** On this software GPU WebAssembly would compute, which `wasm.test.ts` tests. */
const SHADERS = { webAssembly: false };

/** Images in buffers of the test device, and a reader of the result. */
const bind = (width: number, height: number) => bindImages(device, width, height);

/** The code of the error that a promise rejects with. */
const codeOf = (promise: Promise<unknown>): Promise<string> =>
  promise.then(
    () => 'no error',
    (error: unknown) => (error instanceof DenoiseError ? error.code : `another error: ${String(error)}`),
  );

/** Runs with a device that says it has other limits. */
async function withLimits<T>(limits: Partial<Record<keyof GPUSupportedLimits, number>>, run: () => Promise<T>) {
  const real = device.limits;
  const own = Object.getOwnPropertyDescriptor(device, 'limits');
  Object.defineProperty(device, 'limits', {
    configurable: true,
    value: new Proxy(real, { get: (target, key) => Reflect.get(limits, key) ?? Reflect.get(target, key, target) }),
  });
  try {
    return await run();
  } finally {
    if (own) Object.defineProperty(device, 'limits', own);
    else delete (device as { limits?: unknown }).limits;
  }
}

describe('images larger than bindings and memory', () => {
  // Long ones: cuts need 96 pixels on either side, and are made across the longer.
  const wide = randomImages(420, 64);
  const tall = randomImages(64, 420);
  const compute = (options = {}, images = wide) => denoiseOnGpu(weights, images, { input: 'hdr', ...options }, device);
  async function computeWhole(images = wide): Promise<Float32Array<ArrayBuffer>> {
    const result = await compute({}, images);
    expect(result.tiles).toBe(1);
    return result.rgba;
  }

  it('are computed by rows, with the same bits', async () => {
    // The caller's images want 420 × 64 × 16 bytes; the input's tensor takes more in f32.
    const plain = await compute({ storage: 'f32' });
    const { rgba, tiles } = await withLimits({ maxStorageBufferBindingSize: 433_000 }, () =>
      compute({ storage: 'f32' }),
    );
    expect(tiles).toBe(1);
    expect(different(rgba, plain.rgba)).toBe(0);
  });

  it('are computed in tiles, with the same bits', async () => {
    // Layers of 3 to 20 channels: those beyond a multiple of four are where kernels and tiles could disagree.
    const uneven = (options = {}) => denoiseOnGpu(randomNetwork(9), wide, { input: 'hdr', ...options }, device);
    const { rgba, tiles, memoryBytes } = await uneven({ maxMemory: 1_430_000 });
    expect(tiles).toBeGreaterThan(1);
    const whole = await uneven();
    expect(whole.tiles).toBe(1);
    expect(different(rgba, whole.rgba)).toBe(0);
    // Weights are not in it.
    expect(memoryBytes).toBeLessThan(1_430_000 + 400_000);
  });

  it('are computed in smaller tiles where the GPU has less memory than allowed', async () => {
    const create = device.createBuffer;
    device.pushErrorScope('validation');
    // The error scope for memory reports a buffer that no GPU has room for.
    const push = device.pushErrorScope.bind(device);
    const pop = device.popErrorScope.bind(device);
    let refused = 0;
    let computed: Float32Array;
    let scope: number | undefined;
    Object.assign(device, {
      pushErrorScope: (filter: GPUErrorFilter) => {
        if (filter === 'out-of-memory') scope = 0;
        push(filter);
      },
      createBuffer: (descriptor: GPUBufferDescriptor) => {
        if (scope !== undefined) scope += descriptor.size;
        return create.call(device, descriptor);
      },
      popErrorScope: async () => {
        const error = await pop();
        const asked = scope ?? 0;
        scope = undefined;
        if (asked < 900_000) return error;
        refused++;
        return { message: 'no memory' } as GPUError;
      },
    });
    try {
      const { rgba, tiles } = await compute({}, tall);
      expect(refused).toBeGreaterThan(0);
      expect(tiles).toBeGreaterThan(1);
      computed = rgba;
    } finally {
      for (const name of ['pushErrorScope', 'popErrorScope', 'createBuffer'] as const)
        delete (device as unknown as Record<string, unknown>)[name];
      expect(await device.popErrorScope()).toBeNull();
    }
    expect(different(computed, await computeWhole(tall))).toBe(0);
  });

  it('are refused where not even a tile fits', async () => {
    const { images: bound } = bind(420, 210);
    const little = await Denoiser.create(device, weights, { ...SHADERS, maxMemory: 1000 });
    expect(await codeOf(little.denoise(bound))).toBe('denoise/memory');
    little.destroy();
    const narrow = await Denoiser.create(device, weights, SHADERS);
    expect(await withLimits({ maxStorageBufferBindingSize: 1000 }, () => codeOf(narrow.denoise(bound)))).toBe(
      'denoise/limit',
    );
    expect(await withLimits({ maxStorageBufferBindingSize: 1_000_000 }, () => codeOf(narrow.denoise(bound)))).toBe(
      'denoise/limit',
    );
    narrow.destroy();
  });
});

describe('ways to share a layer among threads', () => {
  // Small ones: compilers on CPUs take minutes for the large.
  const families: readonly KernelFamily[] = [
    { threadsX: 4, threadsY: 2, rows: 2, outputs: 4, weights: 'storage' },
    { threadsX: 2, threadsY: 4, rows: 1, outputs: 4, maxGroups: 2 },
  ];
  it('give the same bits', async () => {
    const images = randomImages(50, 34);
    const plain = await denoiseOnGpu(weights, images, { input: 'hdr', storage: 'f32' }, device);
    for (const family of families) {
      const used: string[] = [];
      const shapeOf = ({ name }: { readonly name: string }) => {
        used.push(name);
        return family;
      };
      const { rgba } = await denoiseOnGpu(weights, images, { input: 'hdr', storage: 'f32', shapeOf }, device);
      expect(different(rgba, plain.rgba)).toBe(0);
      expect(used).toContain('dec_conv1a');
    }
  });
});

describe('submissions', () => {
  it('are many where little time is allowed, and say how far they are', async () => {
    const { images, result } = bind(160, 96);
    const patient = await Denoiser.create(device, weights, { ...SHADERS, maxSubmitMs: Infinity });
    expect((await patient.denoise(images)).submissions).toBe(1);
    const expected = await result();
    patient.destroy();
    const paced = await Denoiser.create(device, weights, { ...SHADERS, maxSubmitMs: 0.001 });
    const progress: number[] = [];
    // The first one is begun with a guess at the speed.
    for (let i = 0; i < 2; i++) await paced.denoise(images, { onProgress: (done) => progress.push(done) });
    expect(progress.length).toBeGreaterThan(20);
    expect(progress.at(-1)).toBeCloseTo(1, 9);
    expect(progress.filter((done, i) => i > 0 && done <= progress[i - 1]!).length).toBe(1);
    expect(different(await result(), expected)).toBe(0);
    paced.destroy();
  });

  it('end at an abort; the next image is right', async () => {
    const { images, result } = bind(160, 96);
    const denoiser = await Denoiser.create(device, weights, { ...SHADERS, maxSubmitMs: 0.001 });
    await denoiser.denoise(images);
    const expected = await result();
    const reason = new Error('the camera moved');
    const controller = new AbortController();
    let called = 0;
    const onProgress = () => {
      called++;
      controller.abort(reason);
    };
    await expect(denoiser.denoise(images, { signal: controller.signal, onProgress })).rejects.toBe(reason);
    // One more submission was on its way at most.
    expect(called).toBeLessThanOrEqual(3);
    await expect(denoiser.denoise(images, { signal: AbortSignal.abort(reason) })).rejects.toBe(reason);
    await denoiser.denoise(images);
    expect(different(await result(), expected)).toBe(0);
    await expect(Denoiser.create(device, weights, { signal: AbortSignal.abort(reason) })).rejects.toBe(reason);
    denoiser.destroy();
  });

  it('of two calls come one after the other', async () => {
    const a = bind(64, 48);
    const b = bind(48, 80);
    const denoiser = await Denoiser.create(device, weights, SHADERS);
    await Promise.all([denoiser.denoise(a.images), denoiser.denoise(b.images)]);
    const [first, second] = [await a.result(), await b.result()];
    await denoiser.denoise(a.images);
    expect(different(await a.result(), first)).toBe(0);
    await denoiser.denoise(b.images);
    expect(different(await b.result(), second)).toBe(0);
    denoiser.destroy();
  });
});

describe('encode()', () => {
  it('records the same work into an encoder', async () => {
    const { images, result } = bind(50, 40);
    const denoiser = await Denoiser.create(device, weights, SHADERS);
    await denoiser.denoise(images);
    const expected = await result();
    const other = { ...images, output: outputBuffer(device, 50 * 40) };
    const encoder = device.createCommandEncoder();
    denoiser.encode(encoder, other);
    device.queue.submit([encoder.finish()]);
    expect(different(await download(device, other.output), expected)).toBe(0);
    denoiser.destroy();
  });

  it('wants a size that is prepared', async () => {
    const { images } = bind(50, 40);
    const denoiser = await Denoiser.create(device, weights, SHADERS);
    const encoder = device.createCommandEncoder();
    const size = expect.objectContaining({ code: 'denoise/size' });
    expect(() => denoiser.encode(encoder, images)).toThrow(size);
    await denoiser.prepare(40, 50);
    expect(() => denoiser.encode(encoder, images)).toThrow(size);
    denoiser.destroy();
  });
});

describe.each([false, true])('images in buffers, with WebAssembly: %s', (webAssembly) => {
  it('may have offsets and strides, and keep what is not theirs', async () => {
    const [width, height] = [21, 18];
    const plain = bind(width, height);
    const denoiser = await Denoiser.create(device, weights, { webAssembly });
    await denoiser.denoise(plain.images);
    const expected = await plain.result();
    // RGBA: alpha is the colour's.
    expect(expected.filter((_, i) => i % 4 === 3).every((alpha) => alpha === 0.25)).toBe(true);
    const { color } = randomImages(width, height);
    const [offset, rowStride] = [12, 80];
    const spread = new Float32Array(offset + rowStride * height).fill(9);
    for (let y = 0; y < height; y++)
      for (let i = 0; i < 3 * width; i++) spread[offset + y * rowStride + i] = color[y * width * 3 + i]!;
    const make = (data: Float32Array<ArrayBuffer>) => {
      const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC;
      const buffer = device.createBuffer({ size: data.byteLength, usage });
      device.queue.writeBuffer(buffer, 0, data);
      return buffer;
    };
    const output = make(new Float32Array(7 + 6 * width * height).fill(5));
    await denoiser.denoise({
      ...plain.images,
      color: { buffer: make(spread), offset: 4 * offset, pixelStride: 3, rowStride },
      output: { buffer: output, offset: 28, pixelStride: 6 },
    });
    const found = await download(device, output);
    for (let i = 0; i < width * height; i++) {
      const at = 7 + 6 * i;
      expect([...found.subarray(at, at + 3)]).toEqual([...expected.subarray(4 * i, 4 * i + 3)]);
      // No alpha in the colour: 1. The rest is as it was.
      expect([...found.subarray(at + 3, at + 6)]).toEqual([1, 5, 5]);
    }
    expect([...found.subarray(0, 7)]).toEqual(Array(7).fill(5));
    denoiser.destroy();
  });

  it('may lie between each other in one buffer', async () => {
    const [width, height] = [21, 18];
    const { images, result } = bind(width, height);
    const denoiser = await Denoiser.create(device, weights, { webAssembly });
    await denoiser.denoise(images);
    const expected = (await result()).filter((_, i) => i % 4 < 3);
    const { color, albedo, normal } = randomImages(width, height);
    const together = new Float32Array(9 * width * height);
    for (const [k, one] of [color, albedo, normal].entries())
      for (let i = 0; i < one.length; i++) together[9 * Math.floor(i / 3) + 3 * k + (i % 3)] = one[i]!;
    const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC;
    const buffer = device.createBuffer({ size: together.byteLength, usage });
    device.queue.writeBuffer(buffer, 0, together);
    const output = device.createBuffer({ size: 12 * width * height, usage });
    const part = (first: number) => ({ buffer, offset: 4 * first, pixelStride: 9 });
    await denoiser.denoise({
      color: part(0),
      albedo: part(3),
      normal: part(6),
      output: { buffer: output, pixelStride: 3 },
      width,
      height,
    });
    expect(different(await download(device, output), expected)).toBe(0);
    denoiser.destroy();
  });

  it('are checked', async () => {
    const { images } = bind(24, 24);
    const denoiser = await Denoiser.create(device, weights, { webAssembly });
    const codes = (change: Record<string, unknown>) =>
      codeOf(denoiser.denoise({ ...images, ...change } as unknown as DenoiseImages));
    const { color, albedo } = images;
    const unbound = device.createBuffer({ size: 24 * 24 * 16, usage: GPUBufferUsage.COPY_DST });
    expect(await codes({ color: undefined })).toBe('denoise/input');
    expect(await codes({ normal: undefined })).toBe('denoise/input');
    expect(await codes({ height: 25 })).toBe('denoise/input');
    expect(await codes({ color: unbound })).toBe('denoise/input');
    expect(await codes({ output: color })).toBe('denoise/input');
    expect(await codes({ output: { buffer: albedo } })).toBe('denoise/input');
    expect(await codes({ color: { buffer: color, offset: 2 } })).toBe('denoise/input');
    expect(await codes({ color: { buffer: color, pixelStride: 2 } })).toBe('denoise/input');
    expect(await codes({ color: { buffer: color, rowStride: 95 } })).toBe('denoise/input');
    expect(await codes({ width: 0 })).toBe('denoise/size');
    expect(await codes({ width: 12.5 })).toBe('denoise/size');
    expect(await codes({ height: 1e6 })).toBe('denoise/size');
    expect(await codes({ scale: 0 })).toBe('denoise/option');
    expect(await codes({ scale: Infinity })).toBe('denoise/option');
    expect(await codes({})).toBe('no error');
    denoiser.destroy();
  });
});

describe('create()', () => {
  it('refuses what cannot be', async () => {
    const create = (options: object, bytes: Uint8Array<ArrayBuffer> = weights) =>
      codeOf(Denoiser.create(device, bytes, options).then((denoiser) => denoiser.destroy()));
    expect(await create({ input: 'depth' })).toBe('denoise/option');
    expect(await create({ storage: 'f64' })).toBe('denoise/option');
    expect(await create({ maxMemory: 0 })).toBe('denoise/option');
    expect(await create({ maxSubmitMs: NaN })).toBe('denoise/option');
    expect(await create({ input: 'albedo' })).toBe('denoise/weights');
    expect(await create({ prefilter: { albedo: weights } })).toBe('denoise/weights');
    expect(await create({ prefilter: { normal: randomNetwork(3) } }, randomNetwork(6))).toBe('denoise/option');
    expect(await create({}, new Uint8Array(100))).toBe('denoise/weights');
    expect(await create({}, weights.slice(0, 5000))).toBe('denoise/weights');
    expect(await create({})).toBe('no error');
  });

  it('reports what the driver says of a shader', async () => {
    const original = device.createShaderModule;
    Object.assign(device, {
      createShaderModule: ({ code }: GPUShaderModuleDescriptor) =>
        original.call(device, { code: code.replace('fn main(', 'fn main(broken: ') }),
    });
    try {
      expect(await codeOf(Denoiser.create(device, weights))).toBe('denoise/pipeline');
    } finally {
      delete (device as { createShaderModule?: unknown }).createShaderModule;
    }
  });
});

describe.each([false, true])('the end, with WebAssembly: %s', (webAssembly) => {
  it('frees everything', async () => {
    const { device, errors } = await nullDevice();
    const create = device.createBuffer;
    const alive = new Set<GPUBuffer>();
    const memories: WebAssembly.Memory[] = [];
    const { Memory } = WebAssembly;
    WebAssembly.Memory = class extends Memory {
      constructor(descriptor: WebAssembly.MemoryDescriptor) {
        super(descriptor);
        memories.push(this);
      }
    };
    Object.assign(device, {
      createBuffer: (descriptor: GPUBufferDescriptor) => {
        const buffer = create.call(device, descriptor);
        alive.add(buffer);
        const destroy = buffer.destroy.bind(buffer);
        return Object.assign(buffer, { destroy: () => (alive.delete(buffer), destroy()) });
      },
    });
    try {
      const prefilter = { albedo: randomNetwork(3, 'even'), normal: randomNetwork(3, 'even') };
      const denoiser = await Denoiser.create(device, weights, { webAssembly, prefilter });
      await denoiser.prepare(100, 80);
      // Of WebAssembly's memory no more than the last is kept.
      const bytes = () => [...alive].reduce((sum, { size }) => sum + size, memories.at(-1)?.buffer.byteLength ?? 0);
      const large = bytes();
      expect(denoiser.memoryBytes).toBe(large);
      await denoiser.prepare(40, 32);
      expect(denoiser.memoryBytes).toBe(bytes());
      expect(denoiser.memoryBytes).toBeLessThan(large);
      expect(memories).toHaveLength(webAssembly ? 2 : 0);
      denoiser.destroy();
      expect(alive.size).toBe(0);
      expect(denoiser.memoryBytes).toBe(0);
    } finally {
      WebAssembly.Memory = Memory;
    }
    expect(errors).toEqual([]);
    device.destroy();
  });

  it('ends what is under way', async () => {
    const { images } = bind(96, 96);
    const denoiser = await Denoiser.create(device, weights, { webAssembly, maxSubmitMs: 0.001 });
    await denoiser.denoise(images);
    const running = denoiser.denoise(images, { onProgress: () => denoiser.destroy() });
    expect(await codeOf(running)).toBe('denoise/destroyed');
    expect(await codeOf(denoiser.denoise(images))).toBe('denoise/destroyed');
    expect(await codeOf(denoiser.prepare(10, 10))).toBe('denoise/destroyed');
    expect(() => denoiser.encode(device.createCommandEncoder(), images)).toThrow(
      expect.objectContaining({ code: 'denoise/destroyed' }),
    );
    denoiser.destroy();
  });

  it('of the device is an error', async () => {
    // A device of this test's own: no other asks for these features with such limits.
    const lost = await testDevice({ features: [], defaultLimits: webAssembly });
    const { color, albedo, normal } = randomImages(96, 96);
    const images = {
      color: upload(lost, color),
      albedo: upload(lost, albedo),
      normal: upload(lost, normal),
      output: outputBuffer(lost, 96 * 96),
      width: 96,
      height: 96,
    };
    const denoiser = await Denoiser.create(lost, weights, { webAssembly, maxSubmitMs: 0.001 });
    await denoiser.denoise(images);
    const running = denoiser.denoise(images, { onProgress: () => lost.destroy() });
    expect(await codeOf(running)).toBe('denoise/device');
    denoiser.destroy();
  });
});
