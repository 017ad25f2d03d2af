import { fileURLToPath } from 'node:url';
import { photograph, quads, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import type { GlanzViewerElement, GlanzViewerProps } from '@glanz/react';
import { createElement } from 'react';
import { renderToString } from 'react-dom/server';
import { GlanzViewer } from '../src/index';

interface TestWindow {
  heard: string[];
  seen: { element: GlanzViewerElement | null };
  give: (props: GlanzViewerProps | null) => void;
  file: (base64: string, name: string) => File;
  start: (first: GlanzViewerProps, html?: string) => void;
}
declare const window: TestWindow & typeof globalThis;

let served: Served;
test.beforeAll(async ({ deviceHost }) => {
  served = await servePage(fileURLToPath(new URL('page', import.meta.url)));
  deviceHost.origin = served.origin;
});
test.afterAll(() => served.close());
test.use({ viewport: { width: 640, height: 480 } });

let complaints: string[] = [];
test.beforeEach(async ({ page }) => {
  complaints = watch(page, served.origin);
  await page.route('**/*.glb', (route) => route.fulfill({ body: red }));
  await page.goto(served.origin);
});
test.afterEach(() => expect(complaints).toEqual([]));

const red = quads([{ name: 'red', colour: [0.9, 0.02, 0.02], variants: { night: [0.02, 0.02, 0.9] } }]);
const green = quads([{ name: 'green', colour: [0.02, 0.8, 0.02] }]);
const FAST: GlanzViewerProps = {
  alt: 'A card',
  samples: 6,
  maxDepth: 3,
  pixelRatio: 0.25,
  cameraOrbit: '0deg 90deg 3m',
  fieldOfView: '35deg',
};
const heard = (page: Page) => page.evaluate(() => window.heard);
const middle = async (page: Page) => {
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  return (await photograph(page.locator('glanz-viewer'))).cells[4]!;
};

test('under Strict Mode it loads once, converges, follows its props, and lets go', async ({ page }) => {
  await page.evaluate((props) => window.start(props), { src: 'red.glb', cameraControls: true, ...FAST });
  await expect.poll(() => heard(page)).toEqual(['load', 'converged 6']);
  const day = await middle(page);
  expect(day[0]).toBeGreaterThan(2 * day[1]);
  expect(await page.evaluate(() => [window.seen.element?.cameraControls, window.seen.element?.viewer?.state])).toEqual([
    true,
    'done',
  ]);

  await page.evaluate((props) => window.give(props), { src: 'red.glb', variantName: 'night', ...FAST });
  await expect.poll(() => heard(page)).toEqual(['load', 'converged 6', 'converged 6']);
  const night = await middle(page);
  const edits = await page.evaluate(async () => {
    const viewer = window.seen.element!.viewer!;
    const edit = (parameters: object) =>
      viewer.setMaterial('red', parameters).then(
        () => 'taken',
        ({ code }: { code: string }) => code,
      );
    return [
      await edit({ base_colour: 'red' }),
      await edit({ base_metalness: 2 }),
      await edit({ base_color: 'reddish' }),
      await edit({ base_color: 'rgb(255 0 0)' }),
    ];
  });
  expect(edits).toEqual(['renderer/material', 'renderer/material', 'tonemap/color', 'taken']);
  expect(night[2]).toBeGreaterThan(2 * night[0]);
  // What is not given any more is taken away.
  await expect(page.locator('glanz-viewer')).not.toHaveAttribute('camera-controls');

  const device = await page.evaluateHandle(() => window.seen.element!.viewer!.device!);
  await page.evaluate(() => window.give(null));
  await expect(page.getByText('gone')).toBeVisible();
  expect(await device.evaluate(async (lost) => (await lost.lost).reason)).toBe('destroyed');
  expect(await page.evaluate(() => window.seen.element)).toBeNull();
});

test('a file as src', async ({ page }) => {
  await page.evaluate(
    ([base64, props]) =>
      window.start({ src: window.file(base64 as string, 'green.glb'), ...(props as GlanzViewerProps) }),
    [green.toString('base64'), FAST] as const,
  );
  await expect.poll(() => heard(page)).toEqual(['load', 'converged 6']);
  const [r, g] = await middle(page);
  expect(g).toBeGreaterThan(1.5 * r);
  await page.route('**/bad.hdr', (route) => route.fulfill({ body: 'no image' }));
  await page.evaluate(
    (props) => window.give({ src: window.seen.element!.viewer!.scene!, environmentImage: 'bad.hdr', ...props }),
    FAST,
  );
  await expect.poll(async () => (await heard(page)).filter((what) => what.startsWith('warning'))).not.toEqual([]);
  await page.evaluate((props) => window.give({ src: new File(['no'], 'bad.glb'), ...props }), FAST);
  // The model that stays may converge after the error.
  await expect.poll(() => heard(page)).toContainEqual(expect.stringMatching(/^error gltf\//));
});

test('what a server rendered is hydrated without an error', async ({ page }) => {
  const props: GlanzViewerProps = { src: 'red.glb', cameraControls: true, ...FAST };
  const html = renderToString(createElement(GlanzViewer, props));
  await page.evaluate(([given, text]) => window.start(given as GlanzViewerProps, text as string), [
    props,
    html,
  ] as const);
  await expect.poll(() => heard(page)).toEqual(['load', 'converged 6']);
});

test('HTML attributes and handlers reach the element, and change with the props', async ({ page }) => {
  await page.evaluate(
    (props) =>
      window.start({
        src: 'red.glb',
        title: 'first',
        tabIndex: 0,
        onClick: ({ currentTarget }) => window.heard.push(`click ${currentTarget.localName}`),
        ...props,
      }),
    FAST,
  );
  await expect.poll(() => heard(page)).toEqual(['load', 'converged 6']);
  const viewer = page.locator('glanz-viewer');
  await viewer.click();
  expect(await heard(page)).toEqual(['load', 'converged 6', 'click glanz-viewer']);
  expect(await viewer.getAttribute('tabindex')).toBe('0');
  await page.evaluate(
    (props) =>
      window.give({
        src: 'red.glb',
        title: 'second',
        hidden: true,
        inert: true,
        draggable: false,
        spellCheck: false,
        ...props,
      }),
    FAST,
  );
  await expect(viewer).toHaveAttribute('title', 'second');
  await expect(viewer).toHaveAttribute('hidden', '');
  const state = () =>
    viewer.evaluate(({ inert, draggable, spellcheck, title, tabIndex }: HTMLElement) => ({
      inert,
      draggable,
      spellcheck,
      title,
      tabIndex,
    }));
  expect(await state()).toEqual({ inert: true, draggable: false, spellcheck: false, title: 'second', tabIndex: -1 });
  await page.evaluate((props) => window.give({ src: 'red.glb', hidden: false, draggable: true, ...props }), FAST);
  await expect(viewer).not.toHaveAttribute('hidden');
  expect(await state()).toMatchObject({ inert: false, draggable: true, title: '' });
});

test('materials and parts are as they are declared, and as in the file when they are left out again', async ({
  page,
}) => {
  const two = quads([
    { name: 'seat', colour: [0.9, 0.02, 0.02] },
    { name: 'lid', colour: [0.02, 0.02, 0.9], at: [0, 0, 0.1] },
  ]);
  await page.route('**/two.glb', (route) => route.fulfill({ body: two }));
  const props: GlanzViewerProps = { src: 'two.glb', ...FAST };
  const scene = () =>
    page.evaluate(() => {
      const { materials, instances } = window.seen.element!.viewer!.scene!;
      const { base_color, base_metalness, coat_weight } = materials.find(({ name }) => name === 'seat')!.parameters;
      const round = (color?: readonly number[]) => color?.map((value) => Math.round(100 * value) / 100);
      return [
        round(base_color),
        base_metalness,
        coat_weight ?? 0,
        ...instances.map(({ visible }) => visible !== false),
      ];
    });
  const own = [[0.9, 0.02, 0.02], 0, 0, true, true];
  await page.evaluate((given) => window.start(given), {
    ...props,
    materials: { seat: { base_color: 'rgb(0 255 0)', coat_weight: 1 } },
    parts: { lid: false },
  } satisfies GlanzViewerProps);
  await expect.poll(() => heard(page)).toContain('converged 6');
  await expect.poll(scene).toEqual([[0, 1, 0], 0, 1, true, false]);
  await expect.poll(async () => (await middle(page))[1] > 2 * (await middle(page))[0]).toBe(true);

  await page.evaluate((given) => window.give(given), {
    ...props,
    materials: { seat: { base_metalness: 1 } },
    parts: {},
  } satisfies GlanzViewerProps);
  await expect.poll(scene).toEqual([[0.9, 0.02, 0.02], 1, 0, true, true]);
  await page.evaluate((given) => window.give(given), props);
  await expect.poll(scene).toEqual(own);

  // To another model the look is applied again; what it does not have is an error.
  const look: GlanzViewerProps = { materials: { red: { base_metalness: 1 }, seat: { base_metalness: 1 } } };
  await page.evaluate((given) => window.give(given), { ...props, ...look, src: 'red.glb' });
  await expect.poll(async () => (await heard(page)).at(-1)).not.toBe('load');
  const metal = () => page.evaluate(() => window.seen.element!.viewer!.scene!.materials[0]!);
  await expect.poll(metal).toMatchObject({ name: 'red', parameters: { base_metalness: 1 } });
  await expect.poll(() => heard(page)).toContain('error renderer/material');
});
