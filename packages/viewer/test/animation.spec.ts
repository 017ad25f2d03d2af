import { fileURLToPath } from 'node:url';
import { animatedQuads, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect } from '@playwright/test';
import { done, heard, open, shot } from './open';

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

/** Whether a cell of the image is red, green or the white sky. */
const colour = ([red, green, blue]: readonly number[]) =>
  red! > 2 * green! ? 'red' : green! > 2 * red! ? 'green' : blue! > 0.7 * red! ? 'white' : 'another';

test('an animation plays in previews, and the pose that it ends in is rendered to its end', async ({ page }) => {
  await open(page, served.origin, {}, animatedQuads);
  // Left and right of the image's middle.
  const sides = async () =>
    (await shot(page)).cells
      .slice(3, 6)
      .map(colour)
      .filter((_, i) => i !== 1);
  expect(await sides()).toEqual(['red', 'green']);
  await page.evaluate(async () => {
    window.heard = [];
    const animation = await window.viewer.animation();
    for (const type of ['play', 'pause', 'loop', 'finished'] as const)
      window.viewer.on(type, (detail) => void window.heard.push({ ...detail, type }));
    animation.play({ repetitions: 3, pingpong: true });
  });
  await expect.poll(() => heard(page, 'finished')).toEqual([{ type: 'finished', name: 'swap' }]);
  await done(page);
  expect(await sides()).toEqual(['green', 'red']);
  const events = await page.evaluate(() => window.heard);
  expect(events.filter(({ type }) => type === 'play' || type === 'pause')).toEqual([{ type: 'play', name: 'swap' }]);
  const frames = events.filter(({ type }) => type === 'frame');
  expect(frames.some(({ preview }) => preview === true)).toBe(true);
  expect(frames.at(-1)!['preview']).toBe(false);
  expect(events.findLast(({ type }) => type === 'converged')).toMatchObject({ samples: 6 });
  // The loop sleeps: nothing moves any more.
  expect(await page.evaluate(() => window.viewer.state)).toBe('done');

  // Half way the squares lie on one another.
  await page.evaluate(async () => void ((await window.viewer.animation()).currentTime = 0.1));
  await expect
    .poll(async () => {
      await done(page);
      return sides();
    })
    .toEqual(['white', 'white']);
});

test('morph targets deform meshes; the rest pose comes back, and survives a loss of the GPU', async ({ page }) => {
  await open(page, served.origin, {}, animatedQuads);
  const sides = async () => {
    await done(page);
    return (await shot(page)).cells
      .slice(3, 6)
      .map(colour)
      .filter((_, i) => i !== 1);
  };
  await page.evaluate(async () => {
    const animation = await window.viewer.animation();
    animation.name = 'away';
    animation.currentTime = 0.2;
  });
  await expect.poll(sides).toEqual(['white', 'green']);
  // The tracer's own scene is posed: another device shows the same.
  await page.evaluate(() => window.viewer.device!.destroy());
  await expect.poll(() => heard(page, 'device-restored')).toHaveLength(1);
  await expect.poll(sides).toEqual(['white', 'green']);
  await page.evaluate(async () => void ((await window.viewer.animation()).name = undefined));
  await expect.poll(sides).toEqual(['red', 'green']);
});

test('without animations there is nothing to play, and a model that is replaced does not move', async ({ page }) => {
  await open(page, served.origin, {}, animatedQuads);
  const result = await page.evaluate(async () => {
    const { viewer } = window;
    const animation = await viewer.animation();
    animation.play();
    // Does not wait for an image that will not come.
    await viewer.toBlob({ samples: 1 });
    const { animations: _, animatedParts: __, ...still } = viewer.scene!;
    await viewer.load(still);
    const code = await viewer.animation().catch((error: { code: string }) => error.code);
    return [animation.paused, code];
  });
  expect(result).toEqual([true, 'viewer/animation']);
  await done(page);
});
