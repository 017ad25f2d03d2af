import { fileURLToPath } from 'node:url';
import { injectFaults, quads, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import type { Viewer, ViewerOptions } from '@glanz/viewer';
import type { denoising, ImageDenoiser } from '@glanz/viewer/denoise';
import { done, front, heard, model, settled, sky } from './open';

declare global {
  interface Window {
    denoising: typeof denoising;
    filmDenoiser: (device: GPUDevice) => Promise<ImageDenoiser>;
    /** What denoisers of {@link openFake} were asked for, in order. */
    asked: (string | number)[];
    /** Settles the denoisers' creation, where it was to wait. */
    come: () => void;
  }
}

let served: Served;
test.beforeAll(async ({ deviceHost }) => {
  served = await servePage(fileURLToPath(new URL('page', import.meta.url)));
  deviceHost.origin = served.origin;
});
test.afterAll(() => served.close());
test.use({ viewport: { width: 640, height: 480 } });

let complaints: string[] = [];
test.beforeEach(({ page }) => void (complaints = watch(page, served.origin)));
test.afterEach(() => expect(complaints).toEqual([]));

const base64 = model.toString('base64');
// A square before two others takes some of the sky from them.
const shadowed = quads([
  { name: 'left', colour: [0.9, 0.02, 0.02], at: [-1.2, 0, 0] },
  { name: 'right', colour: [0.02, 0.8, 0.02], at: [1.2, 0, 0] },
  { name: 'front', colour: [0.5, 0.5, 0.5], at: [0, 0, 0.7] },
]);
const common = { maxDepth: 3, camera: front, environment: sky, controls: false } as const;

test('at few samples the image is nearer to the converged one, on the canvas and in files; the film is what it is', async ({
  page,
}) => {
  await page.goto(served.origin);
  const result = await page.evaluate(
    async ([bytes, options]) => {
      const codesOf = (source: CanvasImageSource, width: number, height: number) => {
        const context = new OffscreenCanvas(width, height).getContext('2d')!;
        context.drawImage(source, 0, 0);
        return [...context.getImageData(0, 0, width, height).data];
      };
      const render = async (more: ViewerOptions) => {
        const viewer = window.make({ ...(options as ViewerOptions), pixelRatio: 0.25, ...more });
        let shown: number[] = [];
        const [frames, samples]: [boolean[], boolean[]] = [[], []];
        viewer.on('frame', ({ denoised }) => {
          frames.push(denoised);
          shown = codesOf(viewer.canvas, viewer.canvas.width, viewer.canvas.height);
        });
        viewer.on('sample', ({ denoised }) => void samples.push(denoised));
        await viewer.load(window.file(bytes as string, 'model.glb'));
        for (let i = 0; viewer.state !== 'done' && i < 3000; i++)
          await new Promise((resolve) => setTimeout(resolve, 20));
        await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
        const film = [...(await viewer.tracer!.read('beauty'))];
        const png = await viewer.toBlob();
        const file = new Uint8Array(await png.arrayBuffer());
        const bitmap = await createImageBitmap(png);
        const saved = codesOf(bitmap, bitmap.width, bitmap.height);
        const small = await viewer.toBlob({ width: 40, height: 25, samples: 2 });
        const exr = window.decodeExr(
          new Uint8Array(await (await viewer.toBlob({ type: 'image/x-exr' })).arrayBuffer()),
        );
        viewer.destroy();
        const text = (some: Uint8Array) => new TextDecoder('latin1').decode(some);
        return {
          shown,
          saved,
          film,
          frames,
          samples,
          exr: ['R', 'G', 'B', 'A'].map((name) => [...exr.channels.get(name)!.data]),
          text: text(file).match(/tEXtDenoised\0[\w ]+/)?.[0],
          smallText: text(new Uint8Array(await small.arrayBuffer())).includes('tEXtDenoised'),
        };
      };
      const denoise = window.denoising(window.filmDenoiser);
      return {
        noisy: await render({ samples: 2 }),
        denoised: await render({ samples: 2, denoise }),
        reference: await render({ samples: 64 }),
      };
    },
    [shadowed.toString('base64'), common] as const,
  );
  const { noisy, denoised, reference } = result;
  // Of surfaces in half shadow: edges are a matter of pixels.
  const inside = (i: number) => {
    const [x, y] = [Math.floor(i / 4) % 80, Math.floor(i / 320)];
    return y >= 12 && y < 38 && ((x >= 7 && x < 19) || (x >= 61 && x < 73));
  };
  const error = (one: readonly number[]) => {
    const squares = one.map((code, i) => (code - (reference.shown[i] as number)) ** 2).filter((_, i) => inside(i));
    return Math.sqrt(squares.reduce((sum, square) => sum + square, 0) / squares.length);
  };
  expect(error(noisy.shown)).toBeGreaterThan(3);
  expect(error(denoised.shown)).toBeLessThan(0.6 * error(noisy.shown));
  expect(error(denoised.saved)).toBeLessThan(0.6 * error(noisy.saved));
  expect(Math.max(...denoised.saved.map((code, i) => Math.abs(code - (denoised.shown[i] as number))))).toBeLessThan(3);
  expect(denoised.film).toEqual(noisy.film);
  expect(denoised.exr).toEqual(noisy.exr);
  expect(denoised.text).toBe('tEXtDenoised\0Open Image Denoise');
  expect(denoised.smallText).toBe(true);
  expect(noisy.text).toBeUndefined();
  expect(denoised.frames.at(-1)).toBe(true);
  expect(noisy.frames).not.toContain(true);
  expect(noisy.samples).not.toContain(true);
});

test('a converged image is the film', async ({ page }) => {
  await page.goto(served.origin);
  const result = await page.evaluate(
    async ([bytes, options]) => {
      const read: Float32Array[] = [];
      const denoise = window.denoising(async (device) => {
        const own = await window.filmDenoiser(device);
        return {
          denoiseTracer: async (...given) => {
            const image = await own.denoiseTracer(...given);
            read.push(await own.read(image));
            return image;
          },
          read: (image) => own.read(image),
          destroy: () => own.destroy(),
        };
      });
      // Done, it waits for the denoiser: among many samples that may come so late that the first image is the last one.
      const viewer = window.make({ ...(options as ViewerOptions), pixelRatio: 0.1, samples: 1, denoise });
      await viewer.load(window.file(bytes as string, 'model.glb'));
      for (const samples of [1, 1024]) {
        viewer.samples = samples;
        for (let i = 0; (viewer.state !== 'done' || viewer.sampleCount < samples) && i < 5000; i++)
          await new Promise((resolve) => setTimeout(resolve, 20));
      }
      const film = await viewer.tracer!.read('beauty');
      const share = (one: Float32Array) => one.filter((value, i) => value === film[i]).length / film.length;
      const last = read.at(-1)!;
      viewer.destroy();
      return {
        first: share(read[0]!),
        last: share(last),
        difference: Math.max(...last.map((value, i) => Math.abs(value - film[i]!))),
      };
    },
    [base64, common] as const,
  );
  // Alpha is the film's in any case. What is left of the network lies below what 8 bits show of a white sky.
  expect(result.first).toBeLessThan(0.9);
  expect(result.last).toBeGreaterThan(0.95);
  expect(result.difference).toBeLessThan(0.004);
});

/** A viewer whose denoiser gives a grey image, and notes in `window.asked` what it is asked for. */
async function openFake(
  page: Page,
  {
    fail = '',
    wait = false,
    loaded = true,
    ...options
  }: ViewerOptions & { readonly fail?: string; readonly wait?: boolean; readonly loaded?: boolean } = {},
): Promise<void> {
  await page.goto(served.origin);
  await page.evaluate(
    async ([bytes, given, failing, waiting]) => {
      const asked: (string | number)[] = (window.asked = []);
      const waited = waiting ? new Promise<void>((resolve) => (window.come = resolve)) : undefined;
      const denoise = window.denoising(async (device) => {
        asked.push('create');
        await waited;
        if (failing === 'create') throw Object.assign(new Error('no archive'), { code: 'denoise/weights' });
        let image: GPUBuffer | undefined;
        return {
          denoiseTracer: async ({ samples, width, height, aovs }, { signal }) => {
            if (failing === 'memory' && width > 60) throw Object.assign(new Error('full'), { code: 'denoise/memory' });
            if (!aovs.includes('albedo') || !aovs.includes('normal')) asked.push('no guides');
            asked.push(samples);
            await new Promise((resolve) => setTimeout(resolve, 5));
            signal.throwIfAborted();
            image?.destroy();
            image = device.createBuffer({ size: 16 * width * height, usage: 0x80, mappedAtCreation: true });
            new Float32Array(image.getMappedRange()).fill(0.18);
            image.unmap();
            return { buffer: image, width, height };
          },
          read: async ({ width, height }) => new Float32Array(4 * width * height).fill(0.18),
          destroy: () => {
            image?.destroy();
            asked.push('destroy');
          },
        };
      });
      window.heard = [];
      const viewer = (window.viewer = window.make({ ...(given as ViewerOptions), pixelRatio: 0.25, denoise }));
      for (const type of ['warning', 'error', 'frame', 'sample', 'converged'] as const)
        viewer.on(type, (detail) => {
          const { error, ...rest } = { error: undefined, ...detail } as { error?: { cause?: { code?: string } } };
          window.heard.push({ ...rest, cause: error?.cause?.code, type });
        });
      await viewer.load(window.file(bytes as string, 'model.glb'));
    },
    [base64, { ...common, samples: 12, ...options }, fail, wait] as const,
  );
  if (loaded) await done(page);
  await settled(page);
}

const asked = (page: Page) => page.evaluate(() => window.asked);
const lastFrame = async (page: Page) => (await heard(page, 'frame')).at(-1)!['denoised'];

test('denoises as samples double and at the end; again after edits and where the film is shown otherwise', async ({
  page,
}) => {
  await openFake(page);
  const samples = (await asked(page)).filter((one) => typeof one === 'number');
  expect(await asked(page)).toEqual(['create', ...samples]);
  expect(samples.at(-1)).toBe(12);
  samples.slice(1, -1).forEach((one, i) => expect(one).toBeGreaterThanOrEqual(2 * samples[i]!));
  expect(await lastFrame(page)).toBe(true);
  const converged = (await heard(page, 'converged')).length;
  expect(converged).toBe(1);

  await page.evaluate(() => window.viewer.setMaterial('left', { base_color: [0, 0, 1] }));
  await done(page);
  await settled(page);
  const after = await page.evaluate(() =>
    window.heard.map(({ type, denoised }) => (type === 'frame' ? denoised : type)),
  );
  // Between the images before and after the edit the film itself was shown.
  expect(after.slice(after.indexOf('converged')).includes(false)).toBe(true);
  expect(after.at(-1)).toBe(true);

  const before = (await asked(page)).length;
  await page.evaluate(() => window.viewer.redraw());
  await expect.poll(async () => (await asked(page)).slice(before)).toEqual([12]);
  // It was asked, but has not answered yet.
  await done(page);
  await settled(page);
  expect(await lastFrame(page)).toBe(true);
  // Exposure changes nothing that a denoiser sees.
  await page.evaluate(() => void (window.viewer.exposure = 1));
  await settled(page);
  expect((await asked(page)).length).toBe(before + 1);
  expect(await lastFrame(page)).toBe(true);
});

test('switched off it shows the film, switched on the denoised one; destroy() frees the denoiser', async ({ page }) => {
  await openFake(page);
  await page.evaluate(() => {
    const { denoise } = window.viewer;
    window.viewer.denoise = denoise;
    window.viewer.denoise = undefined;
    Object.assign(window, { denoise });
  });
  await settled(page);
  expect(await lastFrame(page)).toBe(false);
  expect((await asked(page)).filter((one) => typeof one === 'string')).toEqual(['create', 'destroy']);
  await page.evaluate(() => {
    window.viewer.denoise = (window as unknown as Pick<Viewer, 'denoise'>).denoise;
  });
  await expect.poll(() => lastFrame(page)).toBe(true);
  await page.evaluate(() => window.viewer.destroy());
  expect((await asked(page)).filter((one) => typeof one === 'string')).toEqual([
    'create',
    'destroy',
    'create',
    'destroy',
  ]);
});

test('a lost device takes its denoiser along, and the next one gets another', async ({ page }) => {
  await injectFaults(page);
  await openFake(page);
  await page.evaluate(() => window.loseGpu());
  await expect.poll(async () => (await asked(page)).filter((one) => one === 'create').length).toBe(2);
  await done(page);
  await settled(page);
  expect((await asked(page)).filter((one) => typeof one === 'string')).toEqual(['create', 'destroy', 'create']);
  expect((await asked(page)).at(-1)).toBe(12);
  expect(await lastFrame(page)).toBe(true);
  expect(await heard(page, 'warning')).toEqual([]);
  expect(await heard(page, 'error')).toEqual([]);
});

test('an image that is done waits for a denoiser that comes late; one that is destroyed meanwhile frees it', async ({
  page,
}) => {
  await openFake(page, { wait: true, loaded: false });
  await expect.poll(() => page.evaluate(() => window.viewer.sampleCount)).toBe(12);
  expect(await asked(page)).toEqual(['create']);
  expect(await heard(page, 'converged')).toEqual([]);
  expect(await lastFrame(page)).toBe(false);
  await page.evaluate(() => window.come());
  await done(page);
  await settled(page);
  expect(await asked(page)).toEqual(['create', 12]);
  expect(await lastFrame(page)).toBe(true);

  await openFake(page, { wait: true, loaded: false });
  await expect.poll(() => asked(page)).toEqual(['create']);
  await page.evaluate(() => (window.viewer.destroy(), window.come()));
  await expect.poll(() => asked(page)).toEqual(['create', 'destroy']);
});

test('what fails is reported once, and the film is shown', async ({ page }) => {
  await openFake(page, { fail: 'create' });
  const warnings = await heard(page, 'warning');
  expect(warnings).toEqual([expect.objectContaining({ code: 'viewer/denoise', cause: 'denoise/weights' })]);
  expect(warnings[0]!['message']).toContain('no archive');
  expect(await lastFrame(page)).toBe(false);
  const saved = await page.evaluate(async () => {
    const film = await window.viewer.toBlob();
    window.viewer.exposure = 0.5;
    return new TextDecoder('latin1').decode(await film.arrayBuffer()).includes('tEXtDenoised');
  });
  expect(saved).toBe(false);
  expect((await heard(page, 'warning')).length).toBe(1);
  expect(await heard(page, 'error')).toEqual([]);

  // Memory that is missing for one size may do for a smaller one.
  await openFake(page, { fail: 'memory' });
  expect(await heard(page, 'warning')).toEqual([
    expect.objectContaining({ code: 'viewer/denoise', cause: 'denoise/memory' }),
  ]);
  expect(await lastFrame(page)).toBe(false);
  await page.evaluate(() => void (window.viewer.pixelRatio = 0.125));
  await expect.poll(() => lastFrame(page)).toBe(true);
  expect((await heard(page, 'warning')).length).toBe(1);

  const codes = await page.evaluate(() => {
    const codeOf = (run: () => void) => {
      try {
        run();
        return 'taken';
      } catch (error) {
        return (error as { code?: string }).code;
      }
    };
    const { viewer } = window;
    return [
      codeOf(() => void (viewer.denoise = true as never)),
      codeOf(() => window.make({ denoise: {} as never }).destroy()),
    ];
  });
  expect(codes).toEqual(['viewer/option', 'viewer/option']);
});
