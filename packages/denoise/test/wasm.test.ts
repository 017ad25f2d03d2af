import { setFlagsFromString } from 'node:v8';
import { expectNoGpuErrors, nullDevice, testDevice } from '@glanz/gpu';
import { afterEach, beforeAll, describe, expect, it, test, vi } from 'vitest';
import { denoiseOnCpu } from '../src/cpu/index';
import { DenoiseError, Denoiser, type DenoiserInput, type DenoiserOptions } from '../src/index';
import { readNetwork } from '../src/network';
import { Evaluator, WasmNetwork } from '../src/wasm/evaluator';
import { compileWasm, kernelBytes, type WasmKernels } from '../src/wasm/kernels';
import { bytesOf, planWasm } from '../src/wasm/plan';
import { bindImages, denoiseOnGpu, different, TWIN_CASES } from './gpu';
import { CHECKED_CASES, MISSING, differences, imagesOf, tolerances, weightsOf } from './oracle';
import { numbersFrom, randomImages, randomNetwork } from './random-network';

let device: GPUDevice;
beforeAll(async () => void (device = await testDevice({ driver: 'swiftshader' })));
afterEach(() => expectNoGpuErrors());

const compute = (
  weights: Uint8Array,
  images: Parameters<typeof denoiseOnGpu>[1],
  options: DenoiserOptions & { readonly input: DenoiserInput },
) => denoiseOnGpu(weights, images, { webAssembly: true, ...options }, device);

/** Images in buffers of the test device, and a reader of the result. */
const bind = (width: number, height: number) => bindImages(device, width, height);

const weights = randomNetwork(9, 'even');

describe('WebAssembly against the oracle', () => {
  for (const oracle of CHECKED_CASES)
    it(oracle.case, async () => {
      const { expected, input, ...images } = imagesOf(oracle);
      const { rgb, kernels } = await compute(weightsOf(oracle.net), images, { input });
      expect(kernels).toBe('webAssembly');
      const found = differences(rgb, expected);
      // In single precision, whatever the storage of shaders is.
      for (const [kind, limit] of Object.entries(tolerances(oracle, 'f32')))
        expect(found[kind as keyof typeof found], kind).toBeLessThanOrEqual(limit);
    });
  test.skipIf(MISSING === undefined)(`cases with real weights: ${MISSING}`, () => undefined);
});

describe('WebAssembly computes what the CPU twin does', () => {
  for (const [input, channels, graph, width, height] of TWIN_CASES)
    it(`${input}, ${channels} channels, ${graph}, ${width} × ${height}`, async () => {
      const weights = randomNetwork(channels, graph);
      const images = randomImages(width, height);
      const { rgb } = await compute(weights, images, { input });
      const expected = await denoiseOnCpu(weights, images, { input });
      // As for shaders in single precision.
      const { max, absolute } = differences(rgb, expected);
      expect(input === 'hdr' ? max : absolute).toBeLessThan(input === 'hdr' ? 2e-4 : 2e-5);
      if (width > 1) expect(new Set(expected).size).toBeGreaterThan((width * height) / 4);
    });

  it('without a GPU', async () => {
    const prefilter = { albedo: randomNetwork(3, 'plain', 2) };
    const images = randomImages(45, 37);
    const expected = await denoiseOnCpu(weights, images, { prefilter });
    const found = await denoiseOnCpu(weights, images, { prefilter, webAssembly: true });
    expect(differences(found, expected).max).toBeLessThan(2e-4);
    expect(different(found, expected)).toBeGreaterThan(0);
    const reason = new Error('no longer needed');
    await expect(denoiseOnCpu(weights, images, { webAssembly: true, signal: AbortSignal.abort(reason) })).rejects.toBe(
      reason,
    );
  });

  it('with guides that networks of their own clean first, and a scale', async () => {
    const prefilter = { albedo: randomNetwork(3, 'plain', 2), normal: randomNetwork(3, 'large', 3) };
    const images = { ...randomImages(40, 24), scale: 3 };
    const { rgb } = await compute(weights, images, { input: 'hdr', prefilter });
    expect(differences(rgb, await denoiseOnCpu(weights, images, { prefilter })).max).toBeLessThan(2e-4);
  });
});

describe('memory for WebAssembly', () => {
  const wide = randomImages(420, 64);

  it('that is little leads to tiles, with the same bits', async () => {
    // Layers of 3 to 20 channels, not all multiples of four.
    const uneven = randomNetwork(9);
    const whole = await compute(uneven, wide, { input: 'hdr' });
    expect(whole.tiles).toBe(1);
    const tiled = await compute(uneven, wide, { input: 'hdr', maxMemory: 3_000_000 });
    expect(tiled.tiles).toBeGreaterThan(1);
    expect(different(tiled.rgba, whole.rgba)).toBe(0);
  });

  describe('that is refused', () => {
    const { Memory } = WebAssembly;
    const long = randomImages(900, 64);
    /** Pages that were asked for. */
    let asked: number[];
    const refuseAbove = (pages: number) => {
      asked = [];
      WebAssembly.Memory = class extends Memory {
        constructor(descriptor: WebAssembly.MemoryDescriptor) {
          asked.push(descriptor.initial);
          if (descriptor.initial > pages) throw new RangeError('could not allocate memory');
          super(descriptor);
        }
      };
    };
    afterEach(() => void (WebAssembly.Memory = Memory));

    it('leads to smaller tiles, with the same bits', async () => {
      const whole = await compute(weights, long, { input: 'hdr' });
      refuseAbove(60);
      const tiled = await compute(weights, long, { input: 'hdr' });
      expect(asked.filter((pages) => pages > 60).length).toBeGreaterThan(0);
      expect(tiled).toMatchObject({ kernels: 'webAssembly' });
      expect(tiled.tiles).toBeGreaterThan(1);
      expect(different(tiled.rgba, whole.rgba)).toBe(0);
      const onCpu = await denoiseOnCpu(weights, long, { webAssembly: true });
      expect(differences(onCpu, whole.rgb).max).toBeLessThan(2e-4);
    });

    it('even for the smallest tile, leaves the work to shaders, or to plain loops without a GPU', async () => {
      refuseAbove(1);
      const { images, result } = bind(45, 37);
      const shaders = await Denoiser.create(device, weights, { webAssembly: false });
      await shaders.denoise(images);
      const expected = await result();
      shaders.destroy();
      const denoiser = await Denoiser.create(device, weights, { webAssembly: true });
      expect(await denoiser.denoise(images)).toMatchObject({ kernels: 'shaders' });
      expect(different(await result(), expected)).toBe(0);
      expect(asked.length).toBeGreaterThan(0);
      // Not asked for again while the size is the same.
      asked = [];
      expect(await denoiser.denoise(images)).toMatchObject({ kernels: 'shaders' });
      expect(asked).toEqual([]);
      // Another size may have room.
      WebAssembly.Memory = Memory;
      expect(await denoiser.denoise(bind(16, 16).images)).toMatchObject({ kernels: 'webAssembly' });
      denoiser.destroy();
      refuseAbove(1);
      const small = randomImages(45, 37);
      const plain = await denoiseOnCpu(weights, small);
      expect(different(await denoiseOnCpu(weights, small, { webAssembly: true }), plain)).toBe(0);
      expect(asked.length).toBeGreaterThan(0);
    });

    it('by maxMemory is an error that names it', async () => {
      const error = await compute(weights, long, { input: 'hdr', maxMemory: 1000 }).catch((cause: unknown) => cause);
      expect(error).toBeInstanceOf(DenoiseError);
      expect(error).toMatchObject({ code: 'denoise/memory', message: expect.stringContaining('maxMemory is 1000') });
    });

    it('is at most 1 GiB for values, beyond which there are tiles', async () => {
      refuseAbove(1);
      const [module, network, size] = [(await compileWasm())!, readNetwork(weights), 4096];
      expect(bytesOf(planWasm(network, size, size))).toBeGreaterThan(2 ** 30);
      expect(await Evaluator.create(module, [network], { width: size, height: size })).toBeUndefined();
      expect(asked[0]! * 65536).toBeLessThan(2 ** 30 + 2 ** 20);
      expect(asked[0]! * 65536).toBeGreaterThan(2 ** 28);
    });
  });
});

describe('slices of WebAssembly', () => {
  test.skipIf(MISSING === undefined)(`with real weights: ${MISSING}`, () => undefined);
  it.skipIf(MISSING !== undefined)(
    'are made of steps of well under 50 ms, in the largest network and the widest image',
    () => {
      const network = readNetwork(weightsOf('rt_hdr_calb_cnrm_large'));
      const [width, height] = [16384, 16];
      const plan = planWasm(network, width, height);
      const memory = new WebAssembly.Memory({ initial: 1 });
      let calls = 0;
      const count = { convolve: () => void calls++, pool: () => undefined };
      const tiling = { width, height, tiles: [] };
      const steps = [
        ...new WasmNetwork(
          { network, tiling, plan },
          count,
          memory,
          plan.layers.map(() => 0),
          0,
        ).steps(),
      ];
      expect(calls).toBe(steps.length);
      // dec_conv1b: eight channels of a row, from 64. In 50 ms a processor that is a fifth as fast as any of today's,
      // 3 GFLOP/s, computes that.
      expect(Math.max(...steps)).toBe(width * 8 * 9 * 64);
    },
  );
});

describe('work in WebAssembly', () => {
  /** Time passes each time the clock is read: each step of the work is a slice of its own. */
  function fastClock() {
    let now = 0;
    return vi.spyOn(performance, 'now').mockImplementation(() => (now += 20));
  }
  afterEach(() => vi.restoreAllMocks());

  it('returns to the event loop after slow steps, ends at aborts, and is right the next time', async () => {
    const { images, result } = bind(64, 48);
    const denoiser = await Denoiser.create(device, weights, { webAssembly: true });
    await denoiser.denoise(images);
    const expected = await result();
    fastClock();
    const progress: number[] = [];
    await denoiser.denoise(images, { onProgress: (done) => progress.push(done) });
    // Of the layers at the full size alone: a row, or one parity of it where a source is upsampled, of eight channels.
    expect(progress.length).toBeGreaterThan(6 * 48);
    expect(progress.at(-1)).toBe(1);
    expect(progress.every((done, i) => i === 0 || done >= progress[i - 1]!)).toBe(true);
    expect(different(await result(), expected)).toBe(0);
    const reason = new Error('the camera moved');
    for (const after of [1, 5, 300]) {
      const controller = new AbortController();
      let called = 0;
      const onProgress = () => void (++called === after && controller.abort(reason));
      await expect(denoiser.denoise(images, { signal: controller.signal, onProgress })).rejects.toBe(reason);
      expect(called).toBe(after);
    }
    await denoiser.denoise(images);
    expect(different(await result(), expected)).toBe(0);
    denoiser.destroy();
  });

  it('counts all submissions', async () => {
    const { images } = bind(64, 48);
    const denoiser = await Denoiser.create(device, weights, { webAssembly: true });
    const submit = vi.spyOn(device.queue, 'submit');
    for (const scale of [{}, { scale: 2 }]) {
      submit.mockClear();
      const { submissions } = await denoiser.denoise({ ...images, ...scale });
      expect(submissions).toBe(submit.mock.calls.length);
    }
    denoiser.destroy();
  });

  it('reports no progress after an abort', async () => {
    const { images } = bind(64, 48);
    const denoiser = await Denoiser.create(device, weights, { webAssembly: true });
    await denoiser.denoise(images);
    fastClock();
    const reason = new Error('the camera moved');
    const controller = new AbortController();
    let called = 0;
    const onProgress = () => {
      // Between two slices, as an event of the page does it.
      if (++called === 5) queueMicrotask(() => controller.abort(reason));
    };
    await expect(denoiser.denoise(images, { signal: controller.signal, onProgress })).rejects.toBe(reason);
    expect(called).toBe(5);
    denoiser.destroy();
  });

  describe('whose rows the GPU encodes', () => {
    /** The next denoiser, with buffers that are mapped by `map`. */
    async function mapped(map: (denoiser: Denoiser, own: Promise<undefined>) => Promise<undefined>) {
      const { images } = bind(64, 48);
      const create = device.createBuffer.bind(device);
      vi.spyOn(device, 'createBuffer').mockImplementation((descriptor) => {
        const buffer = create(descriptor);
        const own = buffer.mapAsync.bind(buffer);
        return Object.assign(buffer, { mapAsync: (...range: [number]) => map(denoiser, own(...range)) });
      });
      const denoiser = await Denoiser.create(device, weights, { webAssembly: true });
      const error: unknown = await denoiser.denoise(images).catch((cause: unknown) => cause);
      denoiser.destroy();
      return error;
    }

    it('ends with a code where it is destroyed just when they are there', async () => {
      const error = await mapped(async (denoiser, own) => {
        await own;
        denoiser.destroy();
        return undefined;
      });
      expect(error).toMatchObject({ code: 'denoise/destroyed' });
    });

    it('ends with a code, and what the GPU says, where they cannot be read', async () => {
      const cause = new DOMException('mapping failed', 'OperationError');
      const error = await mapped(async (_, own) => {
        await own;
        throw cause;
      });
      expect(error).toBeInstanceOf(DenoiseError);
      expect(error).toMatchObject({ code: 'denoise/device', cause });
    });
  });

  it('of two calls comes one after the other, and sizes may change', async () => {
    const [a, b] = [bind(64, 48), bind(48, 80)];
    const denoiser = await Denoiser.create(device, weights, { webAssembly: true });
    await Promise.all([denoiser.denoise(a.images), denoiser.denoise(b.images)]);
    const [first, second] = [await a.result(), await b.result()];
    await denoiser.denoise(a.images);
    expect(different(await a.result(), first)).toBe(0);
    await denoiser.denoise(b.images);
    expect(different(await b.result(), second)).toBe(0);
    denoiser.destroy();
  });
});

describe('the choice between WebAssembly and shaders', () => {
  const kernelsOf = async (options: DenoiserOptions, on = device) => {
    const { images } = bindImages(on, 16, 16);
    const denoiser = await Denoiser.create(on, weights, options);
    try {
      return (await denoiser.denoise(images)).kernels;
    } finally {
      denoiser.destroy();
    }
  };
  it('is made by the adapter, unless an option makes it', async () => {
    const { device: none, errors } = await nullDevice();
    const hardware = () =>
      new Proxy(none, {
        get(target, key) {
          if (key === 'adapterInfo') return { architecture: 'turing', device: '', description: '' };
          const value = Reflect.get(target, key) as unknown;
          return typeof value === 'function' ? (value as (...args: unknown[]) => unknown).bind(target) : value;
        },
      });
    expect(await kernelsOf({})).toBe('webAssembly');
    expect(await kernelsOf({ webAssembly: false })).toBe('shaders');
    expect(await kernelsOf({}, hardware())).toBe('shaders');
    expect(await kernelsOf({ webAssembly: true }, hardware())).toBe('webAssembly');
    expect(errors).toEqual([]);
    none.destroy();
  });

  it('falls back to shaders where a policy forbids WebAssembly', async () => {
    const compile = vi.spyOn(WebAssembly, 'compile').mockRejectedValue(new WebAssembly.CompileError('unsafe-eval'));
    expect(await kernelsOf({})).toBe('shaders');
    expect(compile).toHaveBeenCalled();
    compile.mockRestore();
    const { WebAssembly: own } = globalThis;
    Object.assign(globalThis, { WebAssembly: undefined });
    try {
      expect(await kernelsOf({ webAssembly: true })).toBe('shaders');
    } finally {
      Object.assign(globalThis, { WebAssembly: own });
    }
  });

  it('prepares what denoise() uses, and shaders for encode() where that is asked for', async () => {
    const { images } = bind(48, 32);
    const denoiser = await Denoiser.create(device, weights, { webAssembly: true });
    const compile = vi.spyOn(device, 'createComputePipelineAsync');
    const made = vi.spyOn(device, 'createBuffer');
    try {
      await denoiser.prepare(48, 32);
      const { memoryBytes } = denoiser;
      expect(compile.mock.calls.map(([{ label }]) => label)).toEqual(['denoise decode']);
      const buffers = made.mock.calls.length;
      await denoiser.denoise(images);
      expect(compile).toHaveBeenCalledTimes(1);
      expect(made).toHaveBeenCalledTimes(buffers);
      expect(denoiser.memoryBytes).toBe(memoryBytes);
      await denoiser.prepare(48, 32, { encode: true });
      expect(compile.mock.calls.length).toBeGreaterThan(1);
      expect(denoiser.memoryBytes).toBeGreaterThan(memoryBytes);
    } finally {
      compile.mockRestore();
      made.mockRestore();
      denoiser.destroy();
    }
  });

  it('leaves encode() to shaders', async () => {
    const { images, result } = bind(32, 32);
    const shaders = await Denoiser.create(device, weights, { webAssembly: false });
    await shaders.denoise(images);
    const expected = await result();
    shaders.destroy();
    const denoiser = await Denoiser.create(device, weights, { webAssembly: true });
    await denoiser.denoise(images);
    expect(different(await result(), expected)).toBeGreaterThan(0);
    const encoder = device.createCommandEncoder();
    expect(() => denoiser.encode(encoder, images)).toThrow(
      expect.objectContaining({
        code: 'denoise/size',
        message: expect.stringContaining('prepare(width, height, { encode: true })'),
      }),
    );
    await denoiser.prepare(32, 32, { encode: true });
    denoiser.encode(encoder, images);
    device.queue.submit([encoder.finish()]);
    expect(different(await result(), expected)).toBe(0);
    denoiser.destroy();
  });
});

describe('the module', () => {
  // Node 20 has relaxed SIMD behind a flag, later versions and browsers without.
  beforeAll(() => setFlagsFromString('--experimental-wasm-relaxed-simd'));

  it.each([false, true])('convolves, with fused products: %s', async (fused) => {
    const memory = new WebAssembly.Memory({ initial: 1 });
    const floats = new Float32Array(memory.buffer);
    const random = numbersFrom(5);
    for (let i = 0; i < floats.length; i++) floats[i] = random() - 0.5;
    const { instance } = await WebAssembly.instantiate(kernelBytes(fused), { m: { memory } });
    const { convolve } = instance.exports as unknown as WasmKernels;
    // Two sources, of 8 and 4 floats at strides of 3 and 5; results at a stride of 9 floats; two tiles of four pixels.
    const sources = [
      { at: 1000, stride: 3, rounds: 2, weights: 2000 },
      { at: 1500, stride: 5, rounds: 1, weights: 3000 },
    ];
    const [result, step, bias] = [5000, 9, 4000];
    const expected = Array.from({ length: 64 }, (_, i) => {
      const [pixel, channel] = [i >> 3, i & 7];
      let sum = floats[bias + channel]!;
      for (const { at, stride, rounds, weights } of sources)
        for (let k = 0; k < 4 * rounds; k++)
          sum += floats[at + pixel * stride + k]! * floats[weights + 8 * k + channel]!;
      return Math.max(0, sum);
    });
    const words = new Int32Array(memory.buffer);
    for (const [i, { at, stride, rounds, weights }] of sources.entries())
      words.set([4 * at, 4 * stride, rounds, 4 * weights], 4 * i);
    convolve(4 * result, 4 * step, 2, 4 * bias, 0, 2);
    expect(expected.filter((value) => value > 0).length).toBeGreaterThan(16);
    for (const [i, value] of expected.entries())
      // Twelve products of at most a quarter, each rounded.
      expect(Math.abs(floats[result + (i >> 3) * step + (i & 7)]! - value)).toBeLessThan(24 * 2 ** -24);
  });

  it('needs nothing but SIMD without fused products', () => {
    setFlagsFromString('--no-experimental-wasm-relaxed-simd');
    expect(WebAssembly.validate(kernelBytes(false))).toBe(true);
  });
});
