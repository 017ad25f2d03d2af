import { fileURLToPath } from 'node:url';
import { quads, servePage, watch, type Served } from '@glanz/browser';
import { expect, test } from '@playwright/test';
import { done, heard, open, shot } from './open';

let served: Served;
test.beforeAll(async () => void (served = await servePage(fileURLToPath(new URL('page', import.meta.url)))));
test.afterAll(() => served.close());
test.use({ viewport: { width: 640, height: 480 } });

let complaints: string[] = [];
test.beforeEach(({ page }) => void (complaints = watch(page, served.origin)));
test.afterEach(() => expect(complaints).toEqual([]));

// A red square on the left and a green one on the right, which "swap" exchanges within 0.2 seconds; "away" moves the
// vertices of the red one up, out of the image, by a morph target.
const SWAP = [-1.2, 0, 0, 1.2, 0, 0];
const numbers = Float32Array.of(
  0,
  0.2,
  ...SWAP,
  ...SWAP.map((x) => 0 - x),
  0,
  1,
  ...[0, 1, 2, 3].flatMap(() => [0, 9, 0]),
);
const animated = quads(
  [
    { name: 'left', colour: [0.9, 0.02, 0.02], at: [-1.2, 0, 0] },
    { name: 'right', colour: [0.02, 0.8, 0.02], at: [1.2, 0, 0] },
  ],
  (json) => {
    const view = (first: number, count: number) =>
      (json['bufferViews'] as object[]).push({ buffer: 0, byteOffset: 72 + 4 * first, byteLength: 4 * count }) - 1;
    const accessor = (first: number, type: 'SCALAR' | 'VEC3', count: number) =>
      (json['accessors'] as object[]).push({
        bufferView: view(first, count * (type === 'VEC3' ? 3 : 1)),
        componentType: 5126,
        type,
        count,
        ...(first === 0 ? { min: [0], max: [0.2] } : first === 16 ? { min: [0, 9, 0], max: [0, 9, 0] } : {}),
      }) - 1;
    const times = accessor(0, 'SCALAR', 2);
    const [there, back] = [accessor(2, 'VEC3', 2), accessor(8, 'VEC3', 2)];
    const weights = accessor(14, 'SCALAR', 2);
    const [mesh] = json['meshes'] as { primitives: Record<string, unknown>[] }[];
    mesh!.primitives[0]!['targets'] = [{ POSITION: accessor(16, 'VEC3', 4) }];
    const channel = (node: number, path: string) => ({ sampler: node, target: { node, path } });
    json['animations'] = [
      {
        name: 'swap',
        samplers: [
          { input: times, output: there },
          { input: times, output: back },
        ],
        channels: [channel(0, 'translation'), channel(1, 'translation')],
      },
      { name: 'away', samplers: [{ input: times, output: weights }], channels: [channel(0, 'weights')] },
    ];
    (json['buffers'] as { byteLength: number }[])[0]!.byteLength += numbers.byteLength;
  },
  Buffer.from(numbers.buffer),
);

/** Whether a cell of the image is red, green or the white sky. */
const colour = ([red, green, blue]: readonly number[]) =>
  red! > 2 * green! ? 'red' : green! > 2 * red! ? 'green' : blue! > 0.7 * red! ? 'white' : 'another';

test('an animation plays in previews, and the pose that it ends in is rendered to its end', async ({ page }) => {
  await open(page, served.origin, {}, animated);
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
  expect(events.findLast(({ type }) => type === 'converged')).toMatchObject({ samples: 12 });
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

test('morph targets and skins deform meshes; the rest pose comes back, and survives a loss of the GPU', async ({
  page,
}) => {
  await open(page, served.origin, {}, animated);
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
  await expect.poll(() => page.evaluate(() => window.heard.some(({ type }) => type === 'state'))).toBe(true);
  await expect.poll(sides).toEqual(['white', 'green']);
  await page.evaluate(async () => void ((await window.viewer.animation()).name = undefined));
  await expect.poll(sides).toEqual(['red', 'green']);
});

test('without animations there is nothing to play, and a model that is replaced stands still', async ({ page }) => {
  await open(page, served.origin, {}, animated);
  const result = await page.evaluate(async () => {
    const { viewer } = window;
    const animation = await viewer.animation();
    animation.play();
    const { animations: _, animatedParts: __, ...still } = viewer.scene!;
    await viewer.load(still);
    const code = await viewer.animation().catch((error: { code: string }) => error.code);
    return [animation.paused, code];
  });
  expect(result).toEqual([true, 'viewer/animation']);
  await done(page);
});
