import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import { FILM_WEIGHTS, FilmDenoiser, type DenoisableTracer, type FilmDenoiserOptions } from '../src/film/index';
import { blendTwin } from './film-twin';
import { numbersFrom, randomNetwork } from './random-network';

afterEach(() => expectNoGpuErrors());

const [WIDTH, HEIGHT] = [37, 26];
const PIXELS = WIDTH * HEIGHT;
/** Of a seed whose images are as bright as the film: single precision is enough to compare them. */
const NETWORK = randomNetwork(9, 'even', 57);

/** A smooth image with noise of a relative standard deviation. */
function noisy(deviation: number, seed = 1): Float32Array<ArrayBuffer> {
  const random = numbersFrom(seed);
  return Float32Array.from({ length: 4 * PIXELS }, (_, i) => {
    const smooth = 0.3 + 0.2 * Math.sin((i / 4 / WIDTH) * 0.2);
    return i % 4 === 3 ? 0.5 : smooth * (1 + deviation * Math.sqrt(12) * (random() - 0.5));
  });
}

async function run(
  film: Float32Array<ArrayBuffer>,
  {
    variance,
    blend = true,
    ...options
  }: { variance?: Float32Array<ArrayBuffer>; blend?: boolean } & FilmDenoiserOptions = {},
) {
  const device = await testDevice();
  const buffer = (data: Float32Array<ArrayBuffer>) => {
    const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC;
    const made = device.createBuffer({ size: data.byteLength, usage });
    device.queue.writeBuffer(made, 0, data);
    return made;
  };
  const guide = () => buffer(new Float32Array(4 * PIXELS).fill(0.5));
  const images = { width: WIDTH, height: HEIGHT, color: buffer(film), albedo: guide(), normal: guide() };
  const spread = variance && buffer(variance);
  const denoiser = await FilmDenoiser.create(
    device,
    { color: NETWORK },
    { maxSubmitMs: 1000, storage: 'f32', webAssembly: false, ...options },
  );
  try {
    const denoised = await denoiser.read(await denoiser.denoise(images, { blend: false }));
    if (!blend) return { denoised, result: denoised };
    return { denoised, result: await denoiser.read(await denoiser.denoise({ ...images, variance: spread })) };
  } finally {
    denoiser.destroy();
    for (const one of [images.color, images.albedo, images.normal, spread]) one?.destroy();
  }
}

/** Largest difference, relative to 1. */
const farthest = (a: Float32Array, b: Float32Array) => a.reduce((max, v, i) => Math.max(max, Math.abs(v - b[i]!)), 0);

describe('FilmDenoiser', () => {
  it('blends as the twin does, with a variance and without', async () => {
    const film = noisy(0.3);
    for (const variance of [undefined, new Float32Array(4 * PIXELS).map((_, i) => 0.001 * (1 + (i % 40)))]) {
      const { denoised, result } = await run(film, variance ? { variance } : {});
      const expected = blendTwin({ width: WIDTH, height: HEIGHT, film, denoised, variance });
      expect(farthest(result, expected)).toBeLessThan(1e-5);
      expect(farthest(result, film)).toBeGreaterThan(0.01);
      expect(farthest(result, denoised)).toBeGreaterThan(0.01);
    }
  });

  it('gives a converged film back bit for bit', async () => {
    const film = noisy(0.3);
    const { result, denoised } = await run(film, { variance: new Float32Array(4 * PIXELS).fill(1e-9) });
    expect(result).toEqual(film);
    expect(farthest(denoised, film)).toBeGreaterThan(0.01);
  });

  it('takes a variance that is not finite for unknown', async () => {
    const film = noisy(0.3);
    const { result } = await run(film, { variance: new Float32Array(4 * PIXELS).fill(Infinity) });
    expect(result).toEqual((await run(film)).result);
  });

  it('holds fireflies and broken pixels back from the network, not in the film', async () => {
    const film = noisy(0.1);
    const at = 4 * (10 * WIDTH + 12);
    const denoisedWith = async (value: number) => {
      const changed = film.slice();
      changed.fill(value, at, at + 3);
      return (await run(changed, { blend: false })).denoised;
    };
    const limit = 32 * neighbours(film, 12, 10);
    const held = await denoisedWith(limit);
    expect(farthest(await denoisedWith(1e4), held)).toBeLessThan(1e-6);
    // The network sees the pixel: a limit that is 3 % lower shows.
    expect(farthest(await denoisedWith(0.97 * limit), held)).toBeGreaterThan(1e-5);
    const black = await denoisedWith(0);
    for (const broken of [Infinity, NaN]) expect(await denoisedWith(broken)).toEqual(black);
    // What is less bright passes as it is.
    const passed = await denoisedWith(0.5 * limit);
    expect(farthest(passed, held)).toBeGreaterThan(1e-4);
  });

  it.each(['albedo', 'normal'] as const)(
    'takes copies where WebAssembly computes: buffers may be freed when it has begun, with a network for %s',
    async (first) => {
      const device = await testDevice();
      const data = { color: noisy(0.3), albedo: noisy(0.1, 2), normal: noisy(0.2, 3), variance: noisy(0, 4) };
      const buffers = () => {
        const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC;
        const upload = (floats: Float32Array<ArrayBuffer>) => {
          const buffer = device.createBuffer({ size: floats.byteLength, usage });
          device.queue.writeBuffer(buffer, 0, floats);
          return buffer;
        };
        const [color, albedo, normal] = [upload(data.color), upload(data.albedo), upload(data.normal)];
        return { color, albedo, normal, variance: upload(data.variance) };
      };
      // The network that cleans one guide comes first: the other is read when that has ended.
      const weights = { color: NETWORK, [first]: randomNetwork(3, 'even') };
      const denoiser = await FilmDenoiser.create(device, weights, { webAssembly: true });
      const denoise = async (onProgress?: (images: ReturnType<typeof buffers>) => void) => {
        const images = buffers();
        const result = await denoiser.denoise(
          { width: WIDTH, height: HEIGHT, ...images },
          onProgress ? { onProgress: () => onProgress(images) } : {},
        );
        expect(result.kernels).toBe('webAssembly');
        const pixels = await denoiser.read(result);
        for (const buffer of Object.values(images)) buffer.destroy();
        return pixels;
      };
      const expected = await denoise();
      let calls = 0;
      const found = await denoise((images) => {
        calls++;
        for (const buffer of Object.values(images)) buffer.destroy();
      });
      expect(calls).toBeGreaterThan(0);
      expect(found).toEqual(expected);
      denoiser.destroy();
    },
  );

  it('asks for the AOVs that a tracer lacks', async () => {
    const device = await testDevice();
    const denoiser = await FilmDenoiser.create(device, { color: NETWORK });
    const tracer = { aovs: ['albedo'] } as unknown as DenoisableTracer;
    await expect(denoiser.denoiseTracer(tracer)).rejects.toMatchObject({
      code: 'denoise/input',
      message: expect.stringContaining('setAovs'),
    });
    denoiser.destroy();
    const images = {} as unknown as Parameters<FilmDenoiser['denoise']>[0];
    await expect(denoiser.denoise(images)).rejects.toMatchObject({ code: 'denoise/destroyed' });
  });

  it('asks for the shape of each layer, and has the same bits with another', async () => {
    const film = noisy(0.3);
    const asked = new Set<string>();
    const other = await run(film, {
      shapeOf: (layer) => {
        asked.add(layer.name);
        return layer.name === 'enc_conv0' ? { threadsX: 2, threadsY: 2, rows: 2, outputs: 4 } : undefined;
      },
    });
    expect(asked).toContain('enc_conv0');
    expect(other.result).toEqual((await run(film)).result);
  });

  it('names archives for each quality', () => {
    expect(FILM_WEIGHTS.best).toEqual({
      color: 'rt_hdr_calb_cnrm_large',
      albedo: 'rt_alb_large',
      normal: 'rt_nrm_large',
    });
  });
});

/** The brightest channel of the 24 pixels around one. */
function neighbours(film: Float32Array, x: number, y: number): number {
  let max = 0;
  for (let v = -2; v <= 2; v++)
    for (let u = -2; u <= 2; u++)
      if (u !== 0 || v !== 0) for (let c = 0; c < 3; c++) max = Math.max(max, film[4 * ((y + v) * WIDTH + x + u) + c]!);
  return max;
}
