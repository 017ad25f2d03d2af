import { fileURLToPath } from 'node:url';
import { servePage, watch, type Served } from '@glanz/browser';
import type { FilmDenoiser, FilmDenoiserOptions } from '@glanz/denoise/film';
import { expect, test, type Page } from '@playwright/test';
import type { ViewerOptions } from '@glanz/viewer';
import { front, model, sky } from './open';

// What the page's thread does while an image is denoised, counted rather than timed: `bench -- denoise-thread` measures.

interface Calls {
  /** Names of the layers, or of their parts, in each submission; and what happened between submissions. */
  readonly events: (readonly string[] | 'turn' | 'abort')[];
  /** Bytes of each mapping, and of each write on the queue. */
  readonly mapped: number[];
  readonly written: number[];
}
interface TestWindow {
  calls: Calls;
  /** How often the page ran between the last part that was read and the submission that followed. */
  turnsAfterRead: number;
  filmDenoiser: (device: GPUDevice, options?: FilmDenoiserOptions) => Promise<FilmDenoiser>;
  /** Denoises a square of noise; aborts where a part of the work is done. */
  denoiseNoise: (
    size: number,
    options?: { readonly abortAt?: number; readonly webAssembly?: boolean },
  ) => Promise<string>;
}
declare const window: TestWindow & Pick<Window, 'make' | 'file'> & typeof globalThis;

let served: Served;
// One page, and one denoiser for noise: what takes the software GPU longest is to compile again.
let page: Page;
let complaints: string[] = [];
test.beforeAll(async ({ browser }) => {
  served = await servePage(fileURLToPath(new URL('page', import.meta.url)));
  page = await browser.newPage({ viewport: { width: 640, height: 480 } });
  complaints = watch(page, served.origin);
  await page.goto(served.origin);
  await page.evaluate(() => {
    const calls: Calls = (window.calls = { events: [], mapped: [], written: [] });
    let layers: string[] = [];
    let [turns, counting] = [0, false];
    const { submit, writeBuffer } = GPUQueue.prototype;
    const { pushDebugGroup } = GPUComputePassEncoder.prototype;
    const { getMappedRange } = GPUBuffer.prototype;
    GPUComputePassEncoder.prototype.pushDebugGroup = function (name) {
      layers.push(name);
      pushDebugGroup.call(this, name);
    };
    GPUQueue.prototype.submit = function (commands) {
      calls.events.push(layers);
      layers = [];
      if (counting) window.turnsAfterRead = turns;
      counting = false;
      submit.call(this, commands);
    };
    GPUQueue.prototype.writeBuffer = function (...given: Parameters<typeof writeBuffer>) {
      const [, , data, , size] = given;
      const unit = (data as Partial<Uint8Array>).BYTES_PER_ELEMENT ?? 1;
      calls.written.push(size === undefined ? data.byteLength : unit * size);
      writeBuffer.apply(this, given);
    };
    GPUBuffer.prototype.getMappedRange = function (...given) {
      const range = getMappedRange.apply(this, given);
      calls.mapped.push(range.byteLength);
      [turns, counting] = [0, true];
      return range;
    };
    const shared: { device: GPUDevice; denoiser: FilmDenoiser }[] = [];
    const create = async (webAssembly: boolean) => {
      const device = await (await navigator.gpu.requestAdapter())!.requestDevice();
      return { device, denoiser: await window.filmDenoiser(device, { webAssembly }) };
    };
    window.denoiseNoise = async (size, { abortAt = Infinity, webAssembly = false } = {}) => {
      const { device, denoiser } = (shared[webAssembly ? 1 : 0] ??= await create(webAssembly));
      const image = (fill: (i: number) => number) => {
        const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC;
        const buffer = device.createBuffer({ size: 16 * size * size, usage, mappedAtCreation: true });
        new Float32Array(buffer.getMappedRange()).forEach((_, i, all) => (all[i] = fill(i)));
        buffer.unmap();
        return buffer;
      };
      const images = {
        width: size,
        height: size,
        color: image(Math.random),
        albedo: image(() => 0.5),
        normal: image((i) => (i % 4 === 2 ? 1 : 0)),
        variance: image(() => 0.08),
      };
      // Shaders and memory for the size are made at the first image, which is not finished here.
      const first = new AbortController();
      await denoiser.denoise(images, { signal: first.signal, onProgress: () => first.abort() }).catch(() => undefined);
      for (const list of Object.values(calls) as unknown[][]) list.length = 0;
      let running = true;
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = () => {
        if (!running) return;
        turns++;
        if (calls.events.at(-1) !== 'turn') calls.events.push('turn');
        port2.postMessage(0);
      };
      port2.postMessage(0);
      const abort = new AbortController();
      const end = await denoiser
        .denoise(images, {
          signal: abort.signal,
          onProgress: (done) => {
            if (done < abortAt || abort.signal.aborted) return;
            abort.abort();
            calls.events.push('abort');
          },
        })
        .then(
          ({ kernels }) => `done by ${kernels}`,
          (error: Error) => error.name,
        );
      // What would still be submitted comes by now.
      await device.queue.onSubmittedWorkDone();
      running = false;
      return end;
    };
  });
});
test.afterEach(() => expect(complaints).toEqual([]));
test.afterAll(async () => {
  await page.close();
  await served.close();
});

const submissions = (events: Calls['events']) => events.filter((event) => typeof event !== 'string');
const callsOf = (page: Page) => page.evaluate(() => window.calls);

test('while an image is denoised the page runs between submissions, and reads and writes no pixels', async () => {
  expect(await page.evaluate(() => window.denoiseNoise(128))).toBe('done by shaders');
  const { events, mapped, written } = await callsOf(page);
  expect(submissions(events).length).toBeGreaterThan(12);
  // In one turn: the film is copied and its fireflies are held back, and two submissions of the network go ahead of the
  // GPU; two that end together are followed by two.
  const turns = events.reduce<number[]>(
    (counts, event) => (event === 'turn' ? [...counts, 0] : [...counts.slice(0, -1), counts.at(-1)! + 1]),
    [0],
  );
  expect(Math.max(...turns)).toBeLessThanOrEqual(4);
  expect(mapped).toEqual([]);
  // Sizes and windows of the layers.
  expect(written.reduce((sum, bytes) => sum + bytes, 0)).toBeLessThan(4096);
});

test('an abort is followed by no other layer', async () => {
  expect(await page.evaluate(() => window.denoiseNoise(128, { abortAt: 0.3 }))).toBe('AbortError');
  const { events } = await callsOf(page);
  const at = events.indexOf('abort');
  const before = submissions(events.slice(0, at));
  expect(before.length).toBeGreaterThan(3);
  expect(submissions(events.slice(at))).toEqual([]);
  // What the GPU had not begun by then is the rest of a layer, or parts of two.
  expect(new Set(before.at(-1)).size).toBeLessThanOrEqual(2);
});

test('in WebAssembly an image is read and written by parts, and the page runs between slices of the layers', async () => {
  expect(await page.evaluate(() => window.denoiseNoise(256, { webAssembly: true }))).toBe('done by webAssembly');
  const { mapped, written } = await callsOf(page);
  // Nine channels in vectors of four floats, in single precision; at most 2 MiB at a time.
  expect(mapped.reduce((sum, bytes) => sum + bytes, 0)).toBe(256 * 256 * 48);
  expect(Math.max(...mapped)).toBeLessThanOrEqual(2 ** 21);
  expect(Math.max(...written)).toBeLessThanOrEqual(2 ** 21);
  // Then the layers, 6.6 GFLOP: a core with 60 GFLOP/s fills eighteen slices of 6 ms with them.
  expect(await page.evaluate(() => window.turnsAfterRead)).toBeGreaterThan(5);
});

test('an abort of WebAssembly is followed by no submission', async () => {
  expect(await page.evaluate(() => window.denoiseNoise(256, { webAssembly: true, abortAt: 0.3 }))).toBe('AbortError');
  const { events } = await callsOf(page);
  expect(submissions(events.slice(events.indexOf('abort')))).toEqual([]);
});

for (const [policy, kernels] of [
  ["script-src 'self' 'wasm-unsafe-eval'", 'webAssembly'],
  ["script-src 'self'", 'shaders'],
] as const)
  test(`under the policy ${policy} the software GPU's images are computed by ${kernels}`, async ({ browser }) => {
    const strict = await servePage(fileURLToPath(new URL('page', import.meta.url)), {
      'content-security-policy': policy,
    });
    const own = await browser.newPage();
    try {
      await own.goto(strict.origin);
      const found = await own.evaluate(async () => {
        const device = await (await navigator.gpu.requestAdapter())!.requestDevice();
        const [size, usage] = [16 * 16 * 16, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC];
        const image = () => device.createBuffer({ size, usage });
        const denoiser = await window.filmDenoiser(device);
        const images = { width: 16, height: 16, color: image(), albedo: image(), normal: image() };
        const result = await denoiser.denoise(images, { blend: false });
        device.destroy();
        return result.kernels;
      });
      expect(found).toBe(kernels);
    } finally {
      await own.close();
      await strict.close();
    }
  });

test('the variance of a film is not read by the page', async () => {
  const bytes = await page.evaluate(
    async ([base64, options]) => {
      const viewer = window.make({ ...(options as ViewerOptions), samples: 40, keepSamples: false, pixelRatio: 0.25 });
      await viewer.load(window.file(base64 as string, 'model.glb'));
      for (let i = 0; viewer.state !== 'done' && i < 3000; i++) await new Promise((resolve) => setTimeout(resolve, 20));
      const tracer = viewer.tracer!;
      await tracer.setAovs(['albedo', 'normal']);
      const denoiser = await window.filmDenoiser(viewer.device!, { webAssembly: false });
      const { mapped } = window.calls;
      mapped.length = 0;
      await denoiser.denoiseTracer(tracer);
      const read = mapped.reduce((sum, one) => sum + one, 0);
      viewer.destroy();
      return { samples: tracer.samples, read, film: 16 * tracer.width * tracer.height };
    },
    [model.toString('base64'), { maxDepth: 3, camera: front, environment: sky, controls: false }] as const,
  );
  expect(bytes.samples).toBeGreaterThanOrEqual(32);
  expect(bytes.film).toBeGreaterThan(50_000);
  expect(bytes.read).toBeLessThan(1024);
});
