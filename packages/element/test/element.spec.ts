import { checkAccessibility, hdr, injectFaults, pixelsOf, quads, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import { done, FAST, heard, model, open as openAt, put, serveStrictly, shot, viewer, type TestWindow } from './open';
import { dracoModel, ktx2Model } from './packed';

declare const window: TestWindow & typeof globalThis;

let served: Served;
test.beforeAll(async ({ deviceHost }) => {
  served = await serveStrictly();
  deviceHost.origin = served.origin;
});
test.afterAll(() => served.close());
test.use({ viewport: { width: 640, height: 480 } });
// The last of the long files: by one worker alone it would leave a core idle.
test.describe.configure({ mode: 'parallel' });

let complaints: string[] = [];
test.beforeEach(async ({ page }) => {
  complaints = watch(page, served.origin);
  await page.route('**/*.glb', async (route) => {
    const name = new URL(route.request().url()).pathname;
    // A server that does not answer.
    if (name.includes('never')) return undefined;
    if (name.includes('bad')) return route.fulfill({ body: Buffer.from('no model') });
    const packed = name.includes('draco') ? await dracoModel() : name.includes('ktx2') ? ktx2Model() : undefined;
    return route.fulfill({ body: packed ?? (name.includes('other') ? other : model) });
  });
  await page.route('**/*.hdr', (route) =>
    route.fulfill({ body: route.request().url().includes('bad') ? Buffer.from('no image') : hdr([128, 0, 0, 129]) }),
  );
});
test.afterEach(() => expect(complaints).toEqual([]));

const other = quads([{ name: 'one', colour: [0.9, 0.9, 0.02] }]);

const state = (page: Page) => page.evaluate(() => document.querySelector('glanz-viewer')!.viewer?.state);
const open = (page: Page, attributes?: Record<string, string>, children?: string) =>
  openAt(page, served.origin, attributes, children);

test('a model by markup alone, over the page, under a strict content security policy', async ({ page }) => {
  await open(page);
  const { cells } = await shot(page);
  expect(cells[3]![0]).toBeGreaterThan(1.5 * cells[3]![1]);
  expect(cells[5]![1]).toBeGreaterThan(1.5 * cells[5]![0]);
  // Behind it is the page.
  const clip = { x: 2, y: 42, width: 8, height: 8 };
  const corner = await pixelsOf(page, await page.screenshot({ clip, animations: 'disabled' }));
  expect(corner.mean.map(Math.round)).toEqual([0x20, 0x40, 0x80]);
  expect(await heard(page, 'load')).toHaveLength(1);
  expect(await heard(page, 'converged')).toEqual([expect.objectContaining({ samples: 8 })]);
  expect((await heard(page, 'progress')).at(-1)).toMatchObject({ totalProgress: 1 });
  expect(await heard(page, 'poster-dismissed')).toHaveLength(1);
  expect(
    await page.evaluate(() => [
      document.querySelector('glanz-viewer')!.loaded,
      document.querySelector('glanz-viewer')!.availableVariants,
    ]),
  ).toEqual([true, ['night']]);
});

test('attributes and properties reflect, and reach the image', async ({ page }) => {
  await open(page);
  const day = await shot(page);
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.variantName = 'night'));
  await expect(viewer(page)).toHaveAttribute('variant-name', 'night');
  await expect.poll(() => heard(page, 'variant-applied')).toEqual([{ variantName: 'night' }]);
  await done(page);
  const night = await shot(page);
  expect(night.cells[5]![2]).toBeGreaterThan(day.cells[5]![2] + 20);

  await page.evaluate(() => document.querySelector('glanz-viewer')!.removeAttribute('variant-name'));
  await expect
    .poll(async () => {
      await done(page);
      return Math.abs((await shot(page)).cells[5]![1] - day.cells[5]![1]);
    })
    .toBeLessThan(3);

  const exposure = () => page.evaluate(() => document.querySelector('glanz-viewer')!.viewer!.exposure);
  await viewer(page).evaluate((element) => element.setAttribute('exposure-ev', '-2'));
  expect(await exposure()).toBe(-2);
  await expect.poll(async () => (await shot(page)).cells[3]![0]).toBeLessThan(0.8 * day.cells[3]![0]);
  expect(complaints).toEqual([]);
  // The factor of model-viewer: exposure-ev comes first, and the page is warned once.
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.exposure = 0.5));
  expect(await exposure()).toBe(-2);
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.exposureEv = null));
  expect(await exposure()).toBe(-1);
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.exposure = 4));
  expect(await exposure()).toBe(2);
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.exposure = null));
  expect(await exposure()).toBe(0);
  expect(complaints.splice(0)).toEqual([
    expect.stringMatching(/^warning: .*"exposure", a factor, is deprecated; use "exposure-ev"/),
  ]);

  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.skyboxImage = 'red.hdr'));
  await expect
    .poll(async () => {
      await done(page);
      const { mean } = await shot(page);
      return mean[0] / (mean[1] + 1);
    })
    .toBeGreaterThan(3);

  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.cameraOrbit = '90deg 90deg 5m'));
  await expect
    .poll(() => page.evaluate(() => document.querySelector('glanz-viewer')!.getCameraOrbit()!.theta))
    .toBeCloseTo(Math.PI / 2, 6);
  await expect.poll(async () => (await heard(page, 'camera-change')).length).toBeGreaterThan(0);

  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.src = 'other.glb'));
  await expect.poll(async () => (await heard(page, 'load')).length).toBe(2);
  expect(await page.evaluate(() => document.querySelector('glanz-viewer')!.availableVariants)).toEqual([]);
});

test('pointer and keys move it where camera-controls is, within limits, and the new view is spoken', async ({
  page,
}) => {
  await open(page, { 'camera-controls': '', 'max-camera-orbit': '30deg auto auto', 'interpolation-decay': '0' });
  const orbit = () => page.evaluate(() => document.querySelector('glanz-viewer')!.getCameraOrbit()!);
  await page.keyboard.press('Tab');
  await page.keyboard.press('ArrowLeft');
  expect((await orbit()).theta).toBeCloseTo(-Math.PI / 24, 6);
  for (let i = 0; i < 9; i++) await page.keyboard.press('ArrowRight');
  expect((await orbit()).theta).toBeCloseTo(Math.PI / 6, 6);
  await expect
    .poll(() => viewer(page).evaluate((element) => element.shadowRoot!.querySelector('[role=status]')!.textContent))
    .toBe('Two cards, seen from the front right.');
  await page.mouse.move(160, 140);
  await page.mouse.down();
  await page.mouse.move(260, 140, { steps: 3 });
  await page.mouse.up();
  expect((await orbit()).theta).toBeLessThan(-0.5);
  // Without it, a page that scrolls stays a page that scrolls.
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.cameraControls = false));
  const before = await orbit();
  await page.mouse.wheel(0, 200);
  await page.mouse.move(160, 140);
  await page.mouse.down();
  await page.mouse.move(60, 140);
  await page.mouse.up();
  expect(await orbit()).toEqual(before);
});

test('back-face-culling shows what is behind the backs of faces, and without it they are there', async ({ page }) => {
  await open(page, { 'camera-orbit': '180deg 90deg 5m' });
  // Seen from behind, the right card is on the left.
  const card = (cells: readonly (readonly number[])[]) => cells[3]!.map((value) => Math.round(value));
  expect(card((await shot(page)).cells)).not.toEqual([0x20, 0x40, 0x80]);
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.backFaceCulling = 'camera'));
  await expect.poll(async () => (await heard(page, 'load')).length).toBe(2);
  await done(page);
  expect(card((await shot(page)).cells)).toEqual([0x20, 0x40, 0x80]);
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.cameraOrbit = '0deg 90deg 5m'));
  await expect
    .poll(async () => {
      await done(page);
      return card((await shot(page)).cells)[0]!;
    })
    .toBeGreaterThan(0x60);
});

test('shadow-softness softens the shadow on the ground, and without it the image is as before', async ({ page }) => {
  await open(page, { 'shadow-intensity': '1', 'camera-orbit': '20deg 65deg 6m', samples: '6' });
  const hard = (await shot(page)).cells;
  const set = async (softness: number | null, loads: number) => {
    await page.evaluate((value) => {
      const element = document.querySelector('glanz-viewer')!;
      if (value === null) element.removeAttribute('shadow-softness');
      else element.setAttribute('shadow-softness', String(value));
    }, softness);
    await expect.poll(async () => (await heard(page, 'load')).length).toBe(loads);
    await done(page);
    return (await shot(page)).cells;
  };
  expect(await set(1, 2)).not.toEqual(hard);
  expect(await set(null, 3)).toEqual(hard);
});

test('hotspots stay on the model, hide behind it, and can be moved', async ({ page }) => {
  await open(
    page,
    {},
    '<button slot="hotspot-a" data-position="-1.2 0 0" data-normal="0 0 1" data-visibility-attribute="visible">Left</button><button slot="hotspot-back" data-position="1.2 0 0" data-normal="0 0 -1" data-visibility-attribute="visible">Back</button>',
  );
  const centre = async (name: string) => {
    const box = (await page.getByRole('button', { name }).boundingBox())!;
    return [box.x + box.width / 2, box.y + box.height / 2 - 40];
  };
  // Seen from (0, 0, 5) with 35° over the height of 200 pixels.
  const scale = 100 / (5 * Math.tan((17.5 * Math.PI) / 180));
  const [x, y] = await centre('Left');
  expect(x).toBeCloseTo(160 - 1.2 * scale, 0);
  expect(y).toBeCloseTo(100, 0);
  await expect(page.getByRole('button', { name: 'Left' })).toHaveAttribute('data-visible', '');
  await expect(page.getByRole('button', { name: 'Back' })).not.toHaveAttribute('data-visible');
  await page.evaluate(() =>
    document.querySelector('glanz-viewer')!.updateHotspot({ name: 'hotspot-a', position: '0m 0.5m 0m' }),
  );
  await expect.poll(async () => Math.round((await centre('Left'))[0]!)).toBe(160);
  expect((await centre('Left'))[1]).toBeCloseTo(100 - 0.5 * scale, 0);
  // From behind, the other one is seen.
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.cameraOrbit = '180deg 90deg 5m'));
  await expect(page.getByRole('button', { name: 'Back' })).toHaveAttribute('data-visible', '');
  await expect(page.getByRole('button', { name: 'Left' })).not.toHaveAttribute('data-visible');
});

test('a poster waits for the image, or for the page; loading waits for the eye', async ({ page }) => {
  await page.goto(served.origin);
  await page.evaluate(() => void (document.querySelector<HTMLElement>('#place')!.style.paddingTop = '3000px'));
  await put(page, { src: 'model.glb', alt: 'Two cards', reveal: 'manual', ...FAST }, '<p slot="poster">Wait</p>');
  await page.waitForTimeout(400);
  expect(await state(page)).toBeUndefined();
  await page.evaluate(() => void (document.querySelector<HTMLElement>('#place')!.style.paddingTop = '0'));
  await done(page);
  await expect(page.getByText('Wait')).toBeVisible();
  expect(await heard(page, 'poster-dismissed')).toEqual([]);
  await page.evaluate(() => document.querySelector('glanz-viewer')!.dismissPoster());
  await expect(page.getByText('Wait')).toBeHidden();

  // By itself it goes when the image is better.
  const dismissedAfter = () =>
    page.evaluate(() => window.heard.find(({ type }) => type === 'poster-dismissed')?.samples);
  const again = async (attributes: Record<string, string>) => {
    await page.evaluate(() => {
      document.querySelector('glanz-viewer')!.remove();
      window.heard.length = 0;
    });
    await put(page, { src: 'model.glb', alt: 'Two cards', ...FAST, ...attributes }, '<p slot="poster">Wait</p>');
  };
  await again({ samples: '100000', 'poster-samples': '20' });
  await expect.poll(dismissedAfter).toBeGreaterThanOrEqual(20);
  expect(await dismissedAfter()).toBeLessThan(100_000);
  // Or when it is finished before, or when the user moves the model.
  await again({});
  await expect.poll(dismissedAfter).toBe(8);
  await again({ samples: '100000', 'poster-samples': '100000', 'camera-controls': '' });
  await expect.poll(async () => (await heard(page, 'sample')).length).toBeGreaterThan(0);
  expect(await dismissedAfter()).toBeUndefined();
  await page.mouse.move(160, 140);
  await page.mouse.down();
  await page.mouse.move(200, 140, { steps: 3 });
  await page.mouse.up();
  await expect(page.getByText('Wait')).toBeHidden();
});

test('a bad file is reported; the former image stays; the next good one clears the message', async ({ page }) => {
  await open(page);
  const before = await shot(page);
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.src = 'bad.glb'));
  await expect.poll(async () => (await heard(page, 'error')).length).toBe(1);
  expect((await heard(page, 'error'))[0]!['code']).toMatch(/^gltf\//);
  const alert = page.locator('glanz-viewer').getByRole('alert');
  await expect(alert).toHaveText(/bad\.glb/);
  await done(page);
  expect(Math.abs((await shot(page)).cells[3]![0] - before.cells[3]![0])).toBeLessThan(2);
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.src = 'other.glb'));
  await expect(alert).toBeHidden();
});

test('resized, hidden, shown, moved in the page, taken out and put back', async ({ page }) => {
  await open(page);
  await viewer(page).evaluate((element) => void (element.style.width = '200px'));
  await expect.poll(() => page.evaluate(() => document.querySelector('glanz-viewer')!.viewer!.tracer!.width)).toBe(50);
  await done(page);
  await viewer(page).evaluate((element) => void (element.style.display = 'none'));
  await expect.poll(() => state(page)).toBe('hidden');
  await viewer(page).evaluate((element) => void (element.style.display = 'block'));
  await done(page);
  // Moved: the same viewer continues. Taken out: everything is released. Put back: it loads again.
  const kept = await page.evaluate(async () => {
    const element = document.querySelector('glanz-viewer')!;
    const before = element.viewer;
    document.querySelector('main')!.prepend(element);
    await Promise.resolve();
    return before === element.viewer;
  });
  expect(kept).toBe(true);
  const gone = await page.evaluate(async () => {
    const element = document.querySelector('glanz-viewer')!;
    const { viewer: before } = element;
    Object.assign(window, { taken: element });
    element.remove();
    await Promise.resolve();
    return [before!.state, element.viewer];
  });
  expect(gone).toEqual(['destroyed', undefined]);
  await page.evaluate(() => document.querySelector('#place')!.append((window as unknown as { taken: Element }).taken));
  await done(page);
  expect((await shot(page)).cells[3]![0]).toBeGreaterThan(40);
});

test('a lost device comes back by itself', async ({ page }) => {
  await injectFaults(page);
  await open(page);
  const before = await shot(page);
  await page.evaluate(() => window.loseGpu());
  await expect.poll(async () => (await heard(page, 'device-restored')).length).toBe(1);
  expect(await heard(page, 'device-lost')).toHaveLength(1);
  expect(await heard(page, 'error')).toEqual([]);
  await done(page);
  expect(Math.abs((await shot(page)).cells[3]![0] - before.cells[3]![0])).toBeLessThan(2);
});

test("toBlob, by our names and by model-viewer's", async ({ page }) => {
  await open(page);
  const files = await page.evaluate(async () => {
    const element = document.querySelector('glanz-viewer')!;
    const [png, jpeg] = [
      await element.toBlob(),
      await element.toBlob({ mimeType: 'image/jpeg', qualityArgument: 0.8 }),
    ];
    const { width, height } = await createImageBitmap(png);
    return [png.type, jpeg.type, width, height];
  });
  expect(files).toEqual(['image/png', 'image/jpeg', 80, 50]);
});

test('without WebGPU the poster stays and the reason is reported', async ({ page }) => {
  await page.addInitScript(() => Object.defineProperty(navigator, 'gpu', { value: undefined }));
  await page.goto(served.origin);
  // Said at once: the model is not waited for.
  await put(page, { src: 'never.glb', alt: 'Two cards', ...FAST }, '<p slot="poster">Instead</p>');
  await expect.poll(async () => (await heard(page, 'error')).map(({ code }) => code)).toEqual(['renderer/no-webgpu']);
  await expect(page.getByText('Instead')).toBeVisible();
  await expect(page.getByRole('alert')).toContainText('WebGPU');
});

test('without a GPU the reason is said at the first refusal, and is an error when no GPU comes', async ({ page }) => {
  await page.addInitScript(() => void (GPU.prototype.requestAdapter = async () => null));
  await page.goto(served.origin);
  await put(page, { src: 'never.glb', alt: 'Two cards', ...FAST }, '<p slot="poster">Instead</p>');
  await expect
    .poll(() => page.evaluate(() => window.heard.map(({ type, detail }) => `${type} ${String(detail['code'])}`)))
    .toEqual(['warning renderer/no-adapter', 'error renderer/no-adapter']);
  await expect(page.getByText('Instead')).toBeVisible();
  await expect(page.getByRole('alert')).toContainText('update its driver');
  expect(
    await page.evaluate(() =>
      document.querySelector('glanz-viewer')!.shadowRoot!.querySelector('.progress')!.classList.contains('gone'),
    ),
  ).toBe(true);
});

test('axe finds nothing wrong, still and with controls, hotspots and a message', async ({ page }) => {
  await open(page);
  expect(await checkAccessibility(page)).toEqual([]);
  await page.evaluate(() => document.querySelector('glanz-viewer')!.remove());
  await put(
    page,
    { src: 'bad.glb', alt: 'Two cards', 'camera-controls': '', ...FAST },
    '<button slot="hotspot-a" data-position="0 0 0">A</button><div slot="poster">Soon</div>',
  );
  await expect(page.getByRole('alert')).toBeVisible();
  expect(await checkAccessibility(page)).toEqual([]);
});

test('what a property or an attribute cannot be is a typed error, and the image stays', async ({ page }) => {
  await open(page);
  const before = await shot(page);
  const result = await page.evaluate(() => {
    const element = document.querySelector('glanz-viewer')!;
    const own = element as unknown as Record<string, unknown>;
    const attributes = () =>
      JSON.stringify(
        element
          .getAttributeNames()
          .sort()
          .map((name) => [name, element.getAttribute(name)]),
      );
    const before = attributes();
    const bad: string[] = [];
    for (const [names, values] of [
      [
        [
          'exposure',
          'exposureEv',
          'samples',
          'noise',
          'maxDepth',
          'pixelRatio',
          'environmentIntensity',
          'interpolationDecay',
          'autoRotateDelay',
        ],
        [NaN, Infinity, -65, 1e30, {}, true],
      ],
      [
        ['cameraOrbit', 'cameraTarget', 'fieldOfView', 'src', 'toneMapping'],
        [NaN, Infinity, {}, true, () => 1],
      ],
    ] as const) {
      for (const name of names) {
        for (const value of values) {
          try {
            own[name] = value;
            bad.push(`${name} = ${String(value)} was taken`);
          } catch (error) {
            if ((error as { code?: string }).code !== 'element/property')
              bad.push(`${name} = ${String(value)}: ${String(error)}`);
          }
        }
      }
    }
    return { bad, same: attributes() === before };
  });
  expect(result).toEqual({ bad: [], same: true });

  // Edits by the viewer: what is refused is not stored, and CSS colours are taken.
  const edits = await page.evaluate(async () => {
    const { viewer } = document.querySelector('glanz-viewer')!;
    const edit = (parameters: object) =>
      viewer!.setMaterial('left', parameters).then(
        () => 'taken',
        ({ code }: { code: string }) => code,
      );
    const parameters = () => viewer!.scene!.materials.find(({ name }) => name === 'left')!.parameters;
    const before = JSON.stringify(parameters());
    const refused = [
      await edit({ base_colour: 'red' }),
      await edit({ base_metalness: 2 }),
      await edit({ base_color: 'reddish' }),
    ];
    const same = JSON.stringify(parameters()) === before;
    const { base_color } = parameters();
    const taken = await edit({ base_color: 'red' });
    const red = parameters().base_color;
    await edit({ base_color });
    return { refused, same, taken, red };
  });
  expect(edits).toEqual({
    refused: ['renderer/material', 'renderer/material', 'tonemap/color'],
    same: true,
    taken: 'taken',
    red: [1, 0, 0],
  });
  await done(page);

  // In markup nothing can throw.
  const wrong: Record<string, string> = {
    'exposure-ev': 'bright',
    samples: '1e30',
    'max-depth': '2.5',
    'pixel-ratio': '-1',
    'camera-target': '1m up 2m',
    'field-of-view': '200deg',
    'max-camera-orbit': 'auto auto -3m',
    'environment-rotation': 'NaN',
    'tone-mapping': 'film',
    'camera-orbit': '0deg 90deg 1e30m',
  };
  await page.evaluate((given) => {
    for (const [name, text] of Object.entries(given)) document.querySelector('glanz-viewer')!.setAttribute(name, text);
  }, wrong);
  // A limit that leaves no distance reads well, but no camera can keep to it.
  expect((await heard(page, 'error')).map(({ code }) => code).sort()).toEqual(
    [...Array<string>(9).fill('element/attribute'), 'viewer/camera'].sort(),
  );
  const kept = await page.evaluate(() => {
    const { viewer } = document.querySelector('glanz-viewer')!;
    return [
      viewer!.exposure,
      viewer!.samples,
      viewer!.maxDepth,
      viewer!.toneMap,
      viewer!.environmentRotation,
      Number.isFinite(viewer!.orbit!.radius),
    ];
  });
  expect(kept).toEqual([0, 256, 8, 'neutral', 0, true]);
  await page.evaluate(
    ({ given, fast }) => {
      for (const name of Object.keys(given)) document.querySelector('glanz-viewer')!.removeAttribute(name);
      for (const [name, text] of Object.entries(fast)) document.querySelector('glanz-viewer')!.setAttribute(name, text);
    },
    { given: wrong, fast: FAST },
  );
  await page.evaluate(() => document.querySelector('glanz-viewer')!.jumpCameraToGoal());
  await done(page);
  expect((await shot(page)).cells).toEqual(before.cells);

  // The same from the start, and an image that is never visible is not waited for.
  const code = await page.evaluate(async () => {
    document.querySelector('glanz-viewer')!.remove();
    const element = window.put({ samples: 'many', loading: 'eager' });
    return element.toBlob().then(
      () => 'an image',
      (error: { code?: string }) => error.code,
    );
  });
  expect(code).toBe('element/no-model');
});

test('decoders can be replaced, and one that does not start is an error that says which attribute to look at', async ({
  page,
}) => {
  await page.route('**/my-*.js', (route) =>
    route.fulfill({
      contentType: 'text/javascript',
      body: `export default () => { throw new Error('asked ${new URL(route.request().url()).pathname}'); };`,
    }),
  );
  await page.goto(served.origin);
  for (const [attribute, file] of [
    ['draco-decoder', 'draco'],
    ['ktx2-transcoder', 'ktx2'],
  ] as const) {
    await put(page, { src: `${file}.glb`, [attribute]: `my-${file}.js`, ...FAST });
    await expect
      .poll(() => heard(page, 'error'))
      .toEqual([
        expect.objectContaining({
          code: 'element/decoder',
          message: expect.stringMatching(new RegExp(`${attribute}="my-${file}\\.js".*asked /my-${file}\\.js`)),
        }),
      ]);
    // The page's policy forbids WebAssembly, so the package's own does not start either. Now the address is read again.
    await page.evaluate((name) => {
      window.heard.length = 0;
      const element = document.querySelector('glanz-viewer')!;
      element.removeAttribute(name);
      element.src = `again-${element.src}`;
    }, attribute);
    await expect
      .poll(() => heard(page, 'error'))
      .toEqual([
        expect.objectContaining({ code: 'element/decoder', message: expect.stringContaining("'wasm-unsafe-eval'") }),
      ]);
    await page.evaluate(() => {
      window.heard.length = 0;
      document.querySelector('glanz-viewer')!.remove();
    });
  }
  complaints = complaints.filter((text) => !/Content Security Policy/.test(text));
});

test('a broken environment is a warning, at the start and later, and the model is there', async ({ page }) => {
  await open(page, { 'environment-image': 'bad.hdr' });
  expect(await heard(page, 'load')).toHaveLength(1);
  await expect
    .poll(() => heard(page, 'warning'))
    .toEqual([{ code: 'viewer/environment', message: expect.stringMatching(/studio/) }]);
  const before = await shot(page);
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.environmentImage = 'bad2.hdr'));
  await expect
    .poll(() => heard(page, 'warning'))
    .toEqual([expect.anything(), { code: 'image/format', message: expect.stringMatching(/HDR/) }]);
  expect(Math.abs((await shot(page)).cells[3]![0] - before.cells[3]![0])).toBeLessThan(2);
  expect(await heard(page, 'error')).toEqual([]);
  await expect(page.locator('glanz-viewer').getByRole('alert')).toBeHidden();
});
