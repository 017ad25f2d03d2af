import { fileURLToPath } from 'node:url';
import { quads, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import type { ViewerOptions } from '@glanz/viewer';
import { done, heard, model, open, shot } from './open';

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

/** Turned by half a turn about +Y. */
const TURNED = [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1];

test('modelTransform places the model, at once and with the next load, and lights move with it', async ({ page }) => {
  await open(page, served.origin);
  const sides = async () => {
    await done(page);
    const { cells } = await shot(page);
    return [cells[3]!, cells[5]!].map(([red, green]) => (red! > 2 * green! ? 'red' : green! > 2 * red! ? 'green' : ''));
  };
  expect(await sides()).toEqual(['red', 'green']);
  await page.evaluate((transform) => void (window.viewer.modelTransform = transform), TURNED);
  await expect.poll(sides).toEqual(['green', 'red']);
  expect(await page.evaluate(() => window.viewer.scene!.instances[0]!.transform[12])).toBeCloseTo(1.2, 6);
  // The loader's scene is placed, too.
  const [placed, back] = await page.evaluate(async (base64) => {
    const { viewer } = window;
    const scene = await viewer.load(window.file(base64, 'model.glb'));
    const at = Array.from(scene.instances[0]!.transform).slice(12, 15);
    viewer.modelTransform = undefined;
    return [at, viewer.modelTransform];
  }, model.toString('base64'));
  expect(placed![0]).toBeCloseTo(1.2, 6);
  expect(back).toBeUndefined();
  await expect.poll(sides).toEqual(['red', 'green']);
  const code = await page.evaluate(() => {
    try {
      window.viewer.modelTransform = new Array<number>(16).fill(0);
      return undefined;
    } catch (error) {
      return (error as { code: string }).code;
    }
  });
  expect(code).toBe('viewer/option');
});

// A board that stands, and the ground in front of its foot, seen from above. A black one gives the ground no light that
// would brighten its shadow.
const board = (colour: readonly [number, number, number]) => quads([{ name: 'board', colour }]);
const [c, s] = [Math.cos(0.5), Math.sin(0.5)];
const above: ViewerOptions['camera'] = {
  type: 'perspective',
  name: 'above',
  transform: [1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, 6 * s - 1, 6 * c + 0.3, 1],
  yfov: 0.15,
  aspect: 1.6,
};

/** Mean of the film's red and alpha in front of the board's foot: linear, premultiplied. */
const foot = (page: Page) =>
  page.evaluate(async () => {
    const { viewer } = window;
    const tracer = viewer.tracer!;
    const at = viewer.project([0, -1, 0.3])!;
    const film = await tracer.read('beauty');
    const sum = { red: 0, alpha: 0 };
    const [x, y] = [Math.round(at.x * tracer.width), Math.round(at.y * tracer.height)];
    for (let row = y - 2; row < y + 2; row++)
      for (let column = x - 6; column < x + 6; column++) {
        const pixel = 4 * (row * tracer.width + column);
        sum.red += film[pixel]! / 48;
        sum.alpha += film[pixel + 3]! / 48;
      }
    return sum;
  });

test('a ground catches shadows as strong as asked for, at the foot of the model, and is not framed', async ({
  page,
}) => {
  const options: ViewerOptions = { background: 'transparent', camera: above, samples: 64, pixelRatio: 0.1 };
  await open(page, served.origin, options, board([0, 0, 0]));
  expect((await foot(page)).alpha).toBe(0);
  const { instances } = await page.evaluate(() => ({ instances: window.viewer.scene!.instances.length }));
  expect(instances).toBe(1);

  // Another tracer brings it; after that it changes by edits.
  await page.evaluate(() => void (window.viewer.ground = {}));
  await expect.poll(() => page.evaluate(() => window.viewer.scene!.instances.length)).toBe(2);
  await done(page);
  const full = await foot(page);
  expect(full.alpha).toBeGreaterThan(0.15);
  await page.evaluate(() => void (window.viewer.ground = { shadow: 0.5 }));
  await expect
    .poll(async () => {
      await done(page);
      return (await foot(page)).alpha / full.alpha;
    })
    .toBeCloseTo(0.5, 1);
  await page.evaluate(() => void (window.viewer.ground = undefined));
  await expect
    .poll(async () => {
      await done(page);
      return (await foot(page)).alpha;
    })
    .toBe(0);

  // It lies beneath the model, which alone is framed.
  const [ground, before, after] = await page.evaluate(async () => {
    const { viewer } = window;
    viewer.frame({ immediate: true });
    const without = viewer.orbit!.radius;
    viewer.ground = {};
    await viewer.edit(() => undefined);
    viewer.frame({ immediate: true });
    return [Array.from(viewer.scene!.instances[1]!.transform), without, viewer.orbit!.radius] as const;
  });
  expect(ground[13]).toBeCloseTo(-1, 2);
  expect(after).toBeCloseTo(before, 6);
  expect(await heard(page, 'error')).toEqual([]);
});

test('a ground of a load reflects the model on request', async ({ page }) => {
  const options: ViewerOptions = { background: 'transparent', camera: above, samples: 16, pixelRatio: 0.1, ground: {} };
  await open(page, served.origin, { ...options, environment: 'none' }, board([0.9, 0.02, 0.02]));
  // Lit from the front, under a black sky: what the ground reflects besides is the board alone.
  await page.evaluate(async () => {
    const { viewer } = window;
    const { instances, meshes, materials, ...rest } = viewer.scene!;
    const board = { meshes: meshes.slice(0, 1), materials: materials.slice(0, 1), instances: instances.slice(0, 1) };
    const sun = {
      type: 'directional' as const,
      name: 'sun',
      color: [1, 1, 1] as const,
      intensity: 3,
      direction: [0, -0.28, -0.96] as const,
    };
    await viewer.load({ ...rest, ...board, lights: [sun] });
  });
  await done(page);
  const matt = await foot(page);
  expect(matt.red).toBeGreaterThan(0.02);
  await page.evaluate(() => void (window.viewer.ground = { reflection: 1 }));
  await expect
    .poll(async () => {
      await done(page);
      return (await foot(page)).red - matt.red;
    })
    .toBeGreaterThan(0.01);
});

test('an environment of 8 bits is read as sRGB; what only begins like one is refused', async ({ page }) => {
  await open(page, served.origin);
  const result = await page.evaluate(async () => {
    const { viewer } = window;
    const canvas = new OffscreenCanvas(4, 2);
    const context = canvas.getContext('2d')!;
    context.fillStyle = 'rgb(188 0 255)';
    context.fillRect(0, 0, 4, 2);
    const read = async (type: string) => {
      await viewer.setEnvironment(await canvas.convertToBlob({ type, quality: 1 }));
      const environment = viewer.scene!.environment as { width: number; height: number; data: Float32Array };
      return [environment.width, environment.height, ...environment.data.subarray(9, 12)];
    };
    const broken = await viewer
      .setEnvironment(new Blob([Uint8Array.of(0xff, 0xd8, 1, 2)]))
      .catch((error: { code: string }) => error.code);
    return { png: await read('image/png'), jpeg: await read('image/jpeg'), broken };
  });
  expect(result.broken).toBe('viewer/environment');
  // 188 is 0.5029 of linear light (IEC 61966-2-1).
  expect(result.png.slice(0, 2)).toEqual([4, 2]);
  [0.5029, 0, 1].forEach((value, k) => expect(result.png[2 + k]).toBeCloseTo(value, 3));
  [0.5029, 0, 1].forEach((value, k) => expect(result.jpeg[2 + k]).toBeCloseTo(value, 1));
});

test('the gain map of an Ultra HDR JPEG is applied, by XMP or ISO 21496-1: a white sun of radiance 16', async ({
  page,
}) => {
  await open(page, served.origin);
  const read = await page.evaluate(async () => {
    const { viewer } = window;
    /** 16 × 8 pixels, grey, with another grey on the right half. */
    const jpeg = async (left: number, right: number) => {
      const canvas = new OffscreenCanvas(16, 8);
      const context = canvas.getContext('2d')!;
      context.fillStyle = `rgb(${left} ${left} ${left})`;
      context.fillRect(0, 0, 8, 8);
      context.fillStyle = `rgb(${right} ${right} ${right})`;
      context.fillRect(8, 0, 8, 8);
      const blob = await canvas.convertToBlob({ type: 'image/jpeg', quality: 1 });
      return new Uint8Array(await blob.arrayBuffer());
    };
    const map = await jpeg(0, 255);
    const xmp = new TextEncoder().encode(
      'http://ns.adobe.com/xap/1.0/\0<rdf:Description xmlns:hdrgm="http://ns.adobe.com/hdr-gain-map/1.0/" hdrgm:GainMapMax="4"' +
        ' hdrgm:OffsetSDR="0" hdrgm:OffsetHDR="0"/>',
    );
    // ISO 21496-1: versions, flags, and rational numbers: headrooms 0 and 4, gains of 0 to 4 stops, gamma 1, no offsets.
    const numbers = [0, 1, 4, 1, 0, 1, 4, 1, 1, 1, 0, 1, 0, 1].flatMap((value) => [0, 0, 0, value]);
    const name = new TextEncoder().encode('urn:iso:std:iso:ts:21496:-1\0');
    const iso = Uint8Array.of(...name, 0, 0, 0, 0, 64, ...numbers);
    const base = await jpeg(188, 255);
    const environment = async (marker: number, segment: Uint8Array<ArrayBuffer>) => {
      const length = segment.length + 2;
      const head = Uint8Array.of(0xff, 0xd8, 0xff, marker, length >> 8, length & 255);
      await viewer.setEnvironment(new Blob([base, head, segment, map.subarray(2)]));
      const { data } = viewer.scene!.environment as { data: Float32Array };
      return [data[3 * 18], data[3 * 29]] as [number, number];
    };
    const broken = await environment(0xe2, iso.slice(0, 50)).catch((error: { code: string }) => error.code);
    return { xmp: await environment(0xe1, xmp), iso: await environment(0xe2, iso), broken };
  });
  expect(read.broken).toBe('image/truncated');
  // 188 is 0.5029 of linear light; the map adds nothing on the left and four stops on the right.
  for (const [sky, sun] of [read.xmp, read.iso]) {
    expect(sky).toBeCloseTo(0.5029, 1);
    expect(sun).toBeCloseTo(16, 0);
  }
});
