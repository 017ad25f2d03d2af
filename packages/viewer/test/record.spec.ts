import { fileURLToPath } from 'node:url';
import { animatedQuads, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect } from '@playwright/test';
import type { denoising, ImageDenoiser } from '@glanz/viewer/denoise';
import type * as Record from '@glanz/viewer/record';
import { open } from './open';

declare global {
  interface Window {
    record: typeof Record;
    denoising: typeof denoising;
    filmDenoiser: (device: GPUDevice) => Promise<ImageDenoiser>;
    /** Frames of a film as a `<video>` shows them, at the middles of their times. */
    played: (
      film: Blob,
      frames: number,
      fps: number,
    ) => Promise<{ duration: number; size: number[]; images: number[][] }>;
    /** Peak signal-to-noise ratio of two images, dB, of their colours. */
    psnr: (a: ArrayLike<number>, b: ArrayLike<number>) => number;
    packets: (film: Blob) => Promise<number>;
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

test('a turntable is a film that plays what was rendered', async ({ page }) => {
  await open(page, served.origin);
  const result = await page.evaluate(async () => {
    const { record, viewer } = window;
    const [width, height, fps] = [96, 64, 4];
    const before = [viewer.tracer, viewer.orbit, viewer.sampleCount, viewer.state, viewer.canvas.width] as const;
    const frames: number[][] = [];
    const progress: { frames: number; share: number }[] = [];
    const film = await record.recordVideo(viewer, {
      path: record.turntable({ seconds: 1, degrees: 60 }),
      width,
      height,
      fps,
      samples: 2,
      bitrate: 4e6,
      onFrame: ({ data }) => frames.push([...data]),
      onProgress: (one) => progress.push(one),
    });
    const { duration, size, images } = await window.played(film, fps, fps);
    const after = [viewer.tracer, viewer.orbit, viewer.sampleCount, viewer.state, viewer.canvas.width] as const;
    return {
      type: film.type,
      packets: await window.packets(film),
      duration,
      size,
      psnr: images.map((image) => frames.map((frame) => window.psnr(image, frame))),
      shares: progress.map(({ share }) => share),
      last: progress.at(-1),
      same: before.map((value, i) => JSON.stringify(value) === JSON.stringify(after[i]) || value === after[i]),
      tracer: before[0] === after[0],
    };
  });
  expect(result.type).toMatch(/^video\/(mp4|webm)$/);
  expect(result).toMatchObject({ packets: 4, size: [96, 64], tracer: true, last: { frames: 4, total: 4, share: 1 } });
  expect(result.duration).toBeCloseTo(1, 2);
  expect(result.same).toEqual([true, true, true, true, true]);
  expect(result.shares).toEqual(result.shares.toSorted((a, b) => a - b));
  for (const [index, row] of result.psnr.entries()) {
    // Colours have half the resolution, and the squares' edges are sharp.
    expect(row[index], `frame ${index}: ${String(row)}`).toBeGreaterThan(25);
    for (const [other, value] of row.entries()) if (other !== index) expect(value).toBeLessThan(row[index]! - 3);
  }
});

test('what is not a viewer records too, with a background of its own that follows the camera', async ({ page }) => {
  await open(page, served.origin);
  const result = await page.evaluate(async () => {
    const { record, viewer } = window;
    const { samples, background, exposure, toneMap, camera, orbit, device } = viewer;
    const source: Record.VideoSource = {
      samples,
      background,
      exposure,
      toneMap,
      camera,
      orbit,
      device,
      denoise: undefined,
      copyFor: (aspect) => viewer.copyFor(aspect),
      animation: () => viewer.animation(),
    };
    const places: number[] = [];
    const alphas: number[] = [];
    const opaque: boolean[] = [];
    const film = await record.recordVideo(source, {
      path: record.turntable({ seconds: 1, degrees: 90 }),
      width: 96,
      height: 64,
      fps: 2,
      samples: 1,
      bitrate: 4e6,
      compose: async ({ data, camera: seen }) => {
        alphas.push(data[3]!);
        places.push(seen.transform[12]!);
        // The upper half has a background, the lower one stays empty.
        for (let i = 0; i < data.length / 2; i += 4) if (data[i + 3] === 0) data.set([0, 0, 255, 255], i);
      },
      onFrame: ({ data }) => opaque.push(data.every((code, i) => i % 4 !== 3 || code === 255)),
    });
    const { images } = await window.played(film, 2, 2);
    const last = images[1]!.length - 4;
    return {
      alphas,
      opaque,
      places,
      corners: images.map((image) => [image.slice(0, 3), image.slice(last, last + 3)]),
    };
  });
  expect(result.alphas).toEqual([0, 0]);
  expect(result.opaque).toEqual([true, true]);
  expect(Math.abs(result.places[0]! - result.places[1]!)).toBeGreaterThan(0.1);
  for (const [top, bottom] of result.corners as [number[], number[]][]) {
    expect(top![2]).toBeGreaterThan(200);
    expect(top![0]).toBeLessThan(60);
    for (const code of bottom!) expect(code).toBeLessThan(25);
  }
});

test('an animation, the states of a configurator and an open shutter; the viewer does not change', async ({ page }) => {
  await open(page, served.origin, {}, animatedQuads);
  const result = await page.evaluate(async () => {
    const { record, viewer } = window;
    const player = await viewer.animation();
    player.currentTime = 0;
    const [width, height] = [40, 16];
    const common = { width, height, samples: 4, fps: 10 };
    // Red and green where they are more than twice the other: the columns of the middle row.
    const colours = (data: ArrayLike<number>) =>
      Array.from({ length: width }, (_, x) => {
        const at = 4 * (8 * width + x);
        return data[at]! > 2 * data[at + 1]! ? 'r' : data[at + 1]! > 2 * data[at]! ? 'g' : '.';
      }).join('');
    const rows = async (options: Partial<Record.FrameOptions> & Pick<Record.FrameOptions, 'path'>) => {
      const list: string[] = [];
      const bytes: number[][] = [];
      for await (const { data } of record.renderFrames(viewer, { ...common, ...options })) {
        list.push(colours(data));
        bytes.push([...data]);
      }
      return { list, bytes };
    };
    const animated = await rows({ path: record.animation({ name: 'swap' }) });
    const again = await rows({ path: record.animation({ name: 'swap' }) });
    const blurred = await rows({ path: record.animation({ name: 'swap' }), shutter: 1 });
    const walk = record.keyframes([
      { time: 0 },
      { time: 0.1, edit: (tracer: Record.VideoStage['tracer']) => tracer.setVisibility('left', false) },
      { time: 0.2 },
    ]);
    const walked = await rows({ path: walk, seconds: 0.2 });
    const hidden = viewer.scene!.instances.some(({ visible }) => visible === false);
    return {
      animated: animated.list,
      same: JSON.stringify(animated.bytes) === JSON.stringify(again.bytes),
      differs: JSON.stringify(animated.bytes) !== JSON.stringify(blurred.bytes),
      walked: walked.list,
      hidden,
      time: player.currentTime,
    };
  });
  const [first, half] = result.animated as [string, string];
  // At rest red is left and green right; half way they lie on one another.
  expect(first).toMatch(/^\.+r+\.+g+\.+$/);
  expect(half).not.toEqual(first);
  expect(result.animated.length).toBe(2);
  expect(result).toMatchObject({ same: true, differs: true, hidden: false, time: 0 });
  expect(result.walked[0]).toMatch(/^\.+r+\.+g+\.+$/);
  expect(result.walked[1]).toMatch(/^\.+g+\.+$/);
});

test('frames are denoised where the viewer denoises, by one denoiser for all of them', async ({ page }) => {
  await open(page, served.origin);
  const result = await page.evaluate(async () => {
    const { record, viewer } = window;
    const options = { path: record.turntable({ seconds: 1, degrees: 5 }), width: 24, height: 16, fps: 2 };
    const frames = async (samples: number) => {
      const list: number[][] = [];
      for await (const { data } of record.renderFrames(viewer, { ...options, samples })) list.push([...data]);
      return list;
    };
    const [reference, noisy] = [await frames(128), await frames(1)];
    let made = 0;
    viewer.denoise = window.denoising((device: GPUDevice) => {
      made++;
      return window.filmDenoiser(device);
    });
    const denoised = await frames(1);
    const better = reference.map((frame, i) => window.psnr(denoised[i]!, frame) - window.psnr(noisy[i]!, frame));
    return { made, better };
  });
  // One of the screen's, which may have begun, and one of the film's.
  expect(result.made).toBeLessThanOrEqual(2);
  expect(result.better.length).toBe(2);
  // Here noise is at the edges alone, where a denoiser is of little use.
  for (const gain of result.better) expect(gain).toBeGreaterThan(0);
});

test('an abort ends it and leaves the viewer as it was; what is missing is named', async ({ page }) => {
  await open(page, served.origin);
  const result = await page.evaluate(async () => {
    const { record, viewer } = window;
    const code = (error: { code?: string | number; name?: string }) =>
      typeof error.code === 'string' ? error.code : error.name;
    const options = { path: record.turntable(), width: 32, height: 16, samples: 1 };
    const before = [viewer.orbit, viewer.sampleCount, viewer.state];
    const abort = new AbortController();
    let frames = 0;
    const aborted = await record
      .recordVideo(viewer, { ...options, signal: abort.signal, onFrame: () => void (++frames === 2 && abort.abort()) })
      .catch(code);
    const after = [viewer.orbit, viewer.sampleCount, viewer.state];
    const refused = async (change: object) => record.recordVideo(viewer, { ...options, ...change }).catch(code);
    const errors = [
      await refused({ mediabunny: () => Promise.reject(new Error('not installed')) }),
      await refused({ width: 33 }),
      await refused({ samples: 0 }),
      await refused({ shutter: 2 }),
      await refused({ path: record.animation() }),
      await refused({ type: 'video/webm', codec: 'avc' }),
    ];
    const { VideoEncoder: encoder } = window;
    Object.assign(window, { VideoEncoder: undefined });
    errors.push(await refused({}));
    Object.assign(window, { VideoEncoder: encoder });
    return { aborted, frames, same: JSON.stringify(before) === JSON.stringify(after), errors };
  });
  expect(result).toEqual({
    aborted: 'AbortError',
    frames: 2,
    same: true,
    errors: [
      'viewer/missing-package',
      'viewer/option',
      'viewer/option',
      'viewer/option',
      'viewer/animation',
      'viewer/video',
      'viewer/video',
    ],
  });
});
