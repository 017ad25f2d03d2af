import { fileURLToPath } from 'node:url';
import { photograph, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect } from '@playwright/test';
import type { ThreePathTracer } from '@glanz/three';
import type { PathTracerProps } from '@glanz/three/fiber';

interface TestWindow {
  show: (color: string, props?: PathTracerProps) => void;
  hide: () => void;
  ref: { readonly current: ThreePathTracer | null };
  samples: number[];
  errors: string[];
}
declare const window: TestWindow & typeof globalThis;

let served: Served;
test.beforeAll(async ({ deviceHost }) => {
  served = await servePage(fileURLToPath(new URL('fiber-page', import.meta.url)));
  deviceHost.origin = served.origin;
});
test.afterAll(() => served.close());
test.use({ viewport: { width: 200, height: 150 } });

test('a component among the children of a Canvas path-traces what they show, and follows their props', async ({
  page,
}, info) => {
  const complaints = watch(page, served.origin);
  await page.goto(served.origin);
  await page.evaluate(() => window.show('#ff2000', { samples: 3, toneMap: 'linear', options: { maxDepth: 2 } }));
  // Above fiber's canvas lies ours, which does not take its events.
  const canvas = page.locator('canvas').nth(1);
  await expect(canvas).toBeVisible();
  await expect.poll(() => page.evaluate(() => window.ref.current?.samples)).toBe(3);
  expect(await page.evaluate(() => window.errors)).toEqual([]);
  expect(await canvas.evaluate((element) => getComputedStyle(element).pointerEvents)).toBe('none');
  await info.attach('red', { body: await page.screenshot(), contentType: 'image/png' });
  const centre = async () => {
    const { cells } = await photograph(canvas);
    return cells[Math.floor(cells.length / 2)]!;
  };
  const red = await centre();
  expect(red[0]).toBeGreaterThan(4 * red[2]!);

  // Another colour is an edit of the material: the tracer stays.
  await page.evaluate(() => {
    (window as { before?: unknown }).before = window.ref.current!.tracer;
    window.samples.length = 0;
    window.show('#0020ff', { samples: 3, toneMap: 'linear', options: { maxDepth: 2 } });
  });
  await expect.poll(() => page.evaluate(() => window.samples.at(-1))).toBe(3);
  expect(await page.evaluate(() => (window as { before?: unknown }).before === window.ref.current!.tracer)).toBe(true);
  await expect.poll(async () => (await centre())[2]! > 4 * (await centre())[0]!).toBe(true);

  await page.evaluate(() => window.show('#0020ff', { enabled: false }));
  await expect(canvas).toBeHidden();
  await page.evaluate(() => {
    (window as { last?: unknown }).last = window.ref.current;
    window.hide();
  });
  await expect(page.locator('canvas')).toHaveCount(0);
  // React runs the effects' ends after it has removed the elements.
  await expect
    .poll(() => page.evaluate(() => (window as unknown as { last: ThreePathTracer }).last.destroyed))
    .toBe(true);
  // fiber's own clock is deprecated in this version of three.
  expect(complaints.filter((complaint) => !/GPU stall|THREE.Clock/.test(complaint))).toEqual([]);
});
