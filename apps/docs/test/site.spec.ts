import { readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { checkAccessibility, photograph, type Pixels } from '@glanz/browser';
import { expect, test, type Page } from '@playwright/test';
import { WITHOUT_GPU } from '@glanz/browser/launch';
import { buildSite, DIST, fileFor, serveSite, sitePages } from './site';
import { readExport } from '../src/read-export';

let origin = '';
let close: () => void = () => undefined;

test.beforeAll(async () => {
  // The site is built here, which takes minutes on a busy machine.
  test.setTimeout(600_000);
  await buildSite();
  const site = await serveSite();
  origin = site.origin;
  close = () => void site.server.close();
});

test.afterAll(() => close());

/** Collects the errors and warnings of a page, and requests that leave the site. */
function watchPage(page: Page): string[] {
  const complaints: string[] = [];
  page.on('console', (message) => {
    if (message.type() === 'error' || message.type() === 'warning')
      complaints.push(`${page.url()}: ${message.type()}: ${message.text()}`);
  });
  page.on('pageerror', (error) => complaints.push(`${page.url()}: ${error.message}`));
  page.on('requestfailed', (request) => {
    // Pages prefetch what they link to, and a navigation drops that.
    const reason = request.failure()?.errorText;
    if (reason !== 'net::ERR_ABORTED') complaints.push(`${request.url()} failed: ${reason}`);
  });
  page.on('response', (response) => {
    if (response.status() >= 400) complaints.push(`${response.url()}: ${response.status()}`);
  });
  page.on('request', (request) => {
    if (!request.url().startsWith(origin) && !/^(data|blob):/.test(request.url()))
      complaints.push(`${page.url()} asks the network for ${request.url()}`);
  });
  return complaints;
}

/** Waits until a page's controls react: its script takes over what was served, perhaps after the page has loaded. */
const takenOver = (page: Page) =>
  page.evaluate(async () => {
    while (!('__vue_app__' in document.querySelector('#app')!)) await new Promise((resolve) => setTimeout(resolve, 10));
  });

const WIDTHS = [360, 768, 1280] as const,
  SCHEMES = ['light', 'dark'] as const;
const LOOKS = WIDTHS.flatMap((width) => SCHEMES.map((scheme) => [width, scheme] as const));
/**
 * One page of each kind: home, guide, package, reference of an entry and of a package, parameters, results, table, live
 * examples, gallery, list, images to compare.
 */
const KINDS = [
  '/',
  '/guide/getting-started',
  '/packages/viewer',
  '/api/',
  '/api/viewer',
  '/api/viewer/orbit',
  '/api/openpbr/presets',
  '/openpbr/coat',
  '/openpbr/parameters',
  '/openpbr/presets',
  '/results/',
  '/results/assets',
  '/guide/viewers',
  '/how/hierarchies',
  '/live',
  '/gallery',
  '/guide/denoising',
];

const isFull = process.env['GLANZ_FULL'] !== undefined;

/** Navigation that all pages share, often most of a page: axe looks at it on one page of each kind, else at the rest. */
const SHARED = ['.VPNav', '.VPSidebar', '.VPLocalNav', '.VPDocAside', '.VPFooter'];

interface Look {
  readonly width: number;
  readonly scheme: 'light' | 'dark';
  /** What axe looks at, too; else only the page's width is compared with the window's. */
  readonly axe?: 'all' | 'without contrasts';
}

/**
 * In which widths and themes a page is looked at: one of each kind in all three widths, by axe in one of them, so that six
 * kinds have all six pairs; others in one pair, alternately, and so each tenth page of the generated reference. Each second
 * of these is looked at by axe, one in six with its contrasts: the style sheets are those of the kinds. `npm test -- --full`
 * opens all pages, in all six, each with all of axe.
 */
function looksOf(path: string, index: number): readonly Look[] {
  if (isFull) return LOOKS.map(([width, scheme]) => ({ width, scheme, axe: 'all' }));
  const kind = KINDS.indexOf(path);
  if (kind >= 0)
    return WIDTHS.map((width, i) => ({
      width,
      scheme: SCHEMES[Math.floor(kind / 3) % 2]!,
      ...(i === kind % 3 ? { axe: 'all' as const } : {}),
    }));
  const nth = path.startsWith('/api/') ? index / 10 : index;
  if (!Number.isInteger(nth)) return [];
  const [width, scheme] = LOOKS[(nth + Math.floor(nth / LOOKS.length)) % LOOKS.length]!;
  if (nth % 2 !== 0) return [{ width, scheme }];
  return [{ width, scheme, axe: nth % 6 === 0 ? 'all' : 'without contrasts' }];
}

/** What a document says for itself, its links as they stand. Runs in the page. */
function inspect(document: Document) {
  return {
    headings: document.querySelectorAll('h1').length,
    ids: [...document.querySelectorAll('[id]')].map((element) => element.id),
    hrefs: [...document.querySelectorAll('a[href]')].map((anchor) => anchor.getAttribute('href') ?? ''),
    text: document.querySelector('main, #VPContent')?.textContent?.trim().length ?? 0,
    raw: document.querySelector('.vp-doc')?.textContent?.match(/<!--|@include|\{\{|<<< /)?.[0],
  };
}

/** {@link inspect} of a page as it is served, before any script has run. */
async function inspectServed(page: Page, path: string): Promise<ReturnType<typeof inspect>> {
  const html = readFileSync(fileFor(path)!, 'utf8');
  const handle = await page.evaluateHandle((text) => new DOMParser().parseFromString(text, 'text/html'), html);
  return handle.evaluate(inspect);
}

test('all pages load without an error, every internal link and anchor leads somewhere, and axe finds nothing, light and dark, at three widths', async ({
  playwright,
  launchOptions,
}) => {
  // Dozens of pages, several times each.
  test.setTimeout(isFull ? 7_200_000 : 900_000);
  // Text and axe need no GPU; a software one would take a quarter of the time to paint the pages.
  const browser = await playwright.chromium.launch({ ...launchOptions, args: WITHOUT_GPU });
  const page = await browser.newPage();
  const complaints = watchPage(page);
  const parser = await browser.newPage();
  const pages = sitePages();
  expect(pages.length).toBeGreaterThan(25);
  expect(
    KINDS.filter((path) => !pages.includes(path)),
    'kinds without a page',
  ).toEqual([]);
  const anchors = new Map<string, Set<string>>();
  const links: { from: string; to: URL }[] = [];
  const note = (path: string, found: ReturnType<typeof inspect>) => {
    expect.soft(found.headings, `${path} has one heading`).toBe(1);
    expect.soft(found.text, `${path} has text`).toBeGreaterThan(200);
    expect.soft(found.raw, `${path} shows markup`).toBeUndefined();
    anchors.set(path, new Set([...(anchors.get(path) ?? []), ...found.ids]));
    links.push(...found.hrefs.map((href) => ({ from: path, to: new URL(href, `${origin}${path}`) })));
  };
  // The live page starts a GPU; it has a test of its own.
  await page.addInitScript(() => Object.defineProperty(navigator, 'gpu', { value: undefined, configurable: true }));
  // Colours that fade from one theme to the other are looked at when they have.
  await page.addInitScript(() =>
    document.addEventListener('DOMContentLoaded', () =>
      document.head.append(
        Object.assign(document.createElement('style'), { textContent: '* { transition: none !important }' }),
      ),
    ),
  );
  const faults = new Map<string, string[]>();
  const report = (fault: string, where: string) => void faults.set(fault, [...(faults.get(fault) ?? []), where]);
  for (const [index, path] of pages.entries()) {
    note(path, await inspectServed(parser, path));
    const looks = looksOf(path, index);
    if (looks.length === 0) continue;
    await page.emulateMedia({ colorScheme: looks[0]!.scheme });
    await page.setViewportSize({ width: looks[0]!.width, height: 800 });
    await page.goto(`${origin}${path}`, { waitUntil: 'load' });
    // Tables behind a plot fold; they are looked at, too.
    await page.locator('.result-table').evaluateAll((all) => all.forEach((one) => one.setAttribute('open', '')));
    for (const { width, scheme, axe } of looks) {
      await page.emulateMedia({ colorScheme: scheme });
      await page.setViewportSize({ width, height: 800 });
      await expect(page.locator('html.dark')).toHaveCount(scheme === 'dark' ? 1 : 0);
      const shown = isFull || KINDS.includes(path) ? [] : SHARED;
      for (const fault of axe ? await checkAccessibility(page, shown, axe === 'all') : [])
        report(fault, `${path} ${width} ${scheme}`);
      if ((await page.evaluate(() => document.documentElement.scrollWidth)) > width)
        report('wider than the window', `${path} ${width}`);
    }
    // Again as scripts have made it.
    note(path, await (await page.evaluateHandle(() => document)).evaluate(inspect));
  }
  const lost = links
    .filter(({ to }) => to.origin === origin)
    .filter(({ to }) => {
      // What is no page of the site.
      if (/^\/playground\/|\.\w+$/.test(to.pathname)) return fileFor(to.pathname) === undefined;
      const ids = anchors.get(to.pathname);
      return !ids || (to.hash !== '' && !ids.has(decodeURIComponent(to.hash.slice(1))));
    });
  await browser.close();
  expect.soft([...new Set(lost.map(({ from, to }) => `${from} → ${to.pathname}${to.hash}`))]).toEqual([]);
  expect.soft(complaints).toEqual([]);
  expect(Object.fromEntries([...faults].map(([fault, where]) => [fault, where.slice(0, 4)]))).toEqual({});
});

test('the home page fetches at most 150 kB of script before the demo is asked for, other pages with what they fetch ahead not much more', async ({
  page,
}) => {
  const heavy: string[] = [];
  for (const [path, max] of [
    ['/', 150_000],
    ['/openpbr/coat', 180_000],
    ['/guide/getting-started', 180_000],
  ] as const) {
    const scripts = new Set<string>();
    const hear = (request: { url(): string }) =>
      void (new URL(request.url()).pathname.endsWith('.js') && scripts.add(new URL(request.url()).pathname));
    page.on('request', hear);
    await page.goto(`${origin}${path}`, { waitUntil: 'networkidle' });
    page.off('request', hear);
    // Nothing starts by itself on a software GPU.
    if (path === '/') await expect(page.locator('.home-viewer')).toHaveAttribute('data-stage', 'idle');
    const bytes = [...scripts].reduce((sum, script) => sum + gzipSync(readFileSync(DIST + script)).length, 0);
    expect(scripts.size, `${path} has a script`).toBeGreaterThan(0);
    if (bytes > max) heavy.push(`${path}: ${Math.round(bytes / 1000)} kB`);
  }
  expect(heavy).toEqual([]);
});

test('the OpenPBR page lists the table of the package', async ({ page }) => {
  await page.goto(`${origin}/openpbr/parameters`);
  const table = (await readExport('@glanz/openpbr/parameters', 'OPENPBR_PARAMETERS')) as object;
  const names = await page.locator('.parameters tbody tr').evaluateAll((rows) => rows.map((row) => row.id));
  expect(names).toEqual(Object.keys(table));
  await expect(page.locator('#specular_ior td').nth(2)).toHaveText('1.5');
});

test('search finds a guide without the network', async ({ page }) => {
  const complaints = watchPage(page);
  await page.goto(`${origin}/`);
  const input = page.locator('.VPLocalSearchBox input');
  // Keys are heard once the page's script has run.
  await expect(async () => {
    if (!(await input.isVisible())) await page.keyboard.press('Control+k');
    await expect(input).toBeVisible({ timeout: 2000 });
  }).toPass();
  await input.fill('depth of field');
  await expect(page.locator('.VPLocalSearchBox .result', { hasText: 'Cameras and framing' }).first()).toBeVisible();
  expect(complaints).toEqual([]);
});

test('search finds "next.js" and "nextjs", in the guide about React first', async ({ page }) => {
  await page.goto(`${origin}/`);
  const input = page.locator('.VPLocalSearchBox input');
  await expect(async () => {
    if (!(await input.isVisible())) await page.keyboard.press('Control+k');
    await expect(input).toBeVisible({ timeout: 2000 });
  }).toPass();
  for (const words of ['next.js', 'nextjs', 'NextJS', 'Next.js App Router']) {
    await input.fill(words);
    const first = page.locator('.VPLocalSearchBox .result').first();
    await expect(first, words).toContainText('Next.js');
    await expect(first).toHaveAttribute('href', /\/guide\/react/);
  }
});

test('reference pages begin with what can be called, not with an error or a helper', async ({ page }) => {
  for (const [path, name] of [
    ['viewer', 'createViewer'],
    ['renderer', 'requestDevice'],
    ['element', 'defineGlanzViewer'],
    ['three', 'fromThree'],
  ] as const) {
    await page.goto(`${origin}/api/${path}`);
    await expect(page.locator('.vp-doc h3').first(), path).toContainText(name);
  }
});

test('pages show a version, those of packages their own and how stable it is', async ({ page }) => {
  const { version } = JSON.parse(
    readFileSync(new URL('../../../packages/viewer/package.json', import.meta.url), 'utf8'),
  ) as { version: string };
  await page.goto(`${origin}/guide/viewer`);
  await expect(page.locator('.VPNavBarTitle .site-version')).toHaveText(version);
  await page.goto(`${origin}/packages/viewer`);
  await expect(page.locator('.package-facts')).toHaveText(`Version ${version} · beta`);
});

test('the playground is one click away', async ({ page }) => {
  await page.addInitScript(() => Object.defineProperty(navigator, 'gpu', { value: undefined, configurable: true }));
  await page.goto(`${origin}/`);
  await page.getByRole('link', { name: 'Playground' }).first().click();
  await expect(page).toHaveURL(`${origin}/playground/index.html`);
  await expect(page.locator('canvas').first()).toBeAttached();
});

test('noisy and denoised images are compared by keys and by dragging, and nothing moves', async ({ page }) => {
  const complaints = watchPage(page);
  await page.setViewportSize({ width: 380, height: 900 });
  await page.goto(`${origin}/guide/denoising`);
  await takenOver(page);
  const frame = page.locator('.compare-frame');
  const slider = frame.getByRole('slider');
  const images = frame.getByRole('img');
  const layout = () => page.locator('.compare').evaluate((figure) => JSON.stringify(figure.getBoundingClientRect()));
  const before = await layout();
  const visible = () => images.nth(1).evaluate((image) => getComputedStyle(image).clipPath);
  expect(await visible()).toBe('inset(0px 50% 0px 0px)');
  await slider.focus();
  await page.keyboard.press('ArrowLeft');
  expect(await visible()).toBe('inset(0px 51% 0px 0px)');
  await expect(slider).toHaveAttribute('aria-valuetext', '49 %: 4 samples; the rest: 4 samples, denoised');
  const box = (await frame.boundingBox())!;
  await page.mouse.click(box.x + 0.25 * box.width, box.y + 0.5 * box.height);
  expect(await visible()).toMatch(/^inset\(0px 7[456]% 0px 0px\)$/);

  const shown = new Set<string>();
  for (const samples of ['1', '4', '16', '64'])
    for (const pair of ['noisy | denoised', 'denoised | reference', 'noisy | reference']) {
      await page.getByRole('radio', { name: samples, exact: true }).check();
      await page.getByRole('radio', { name: pair, exact: true }).check();
      for (const image of await images.all()) {
        await image.evaluate((one) => (one as HTMLImageElement).decode());
        const natural = await image.evaluate((one) => [
          (one as HTMLImageElement).naturalWidth,
          (one as HTMLImageElement).naturalHeight,
        ]);
        expect(natural).toEqual([528, 396]);
        shown.add((await image.getAttribute('alt'))!.replace(/^.*?\. /, ''));
      }
      expect(await layout()).toBe(before);
    }
  expect(shown.size).toBe(9);
  expect(complaints).toEqual([]);
});

test('dark and light', async ({ page }) => {
  await page.emulateMedia({ colorScheme: 'light' });
  await page.goto(`${origin}/guide/materials`);
  await takenOver(page);
  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await background();
  await page.locator('.VPSwitchAppearance').first().click();
  await expect.poll(background).not.toBe(light);
});

test('a browser without WebGPU shows what to do', async ({ page }) => {
  const complaints = watchPage(page);
  await page.addInitScript(() => Object.defineProperty(navigator, 'gpu', { value: undefined, configurable: true }));
  await page.goto(`${origin}/live`);
  await expect(page.getByRole('alert').first()).toContainText('renderer/no-webgpu');
  await expect(page.getByRole('alert').first()).toContainText('https');
  // The poster stays, and nothing claims to be on its way.
  const live = page.locator('.live').first();
  await expect(live.locator('.live-poster')).toBeVisible();
  await expect(live.locator('figcaption')).toHaveText('An illuminated push-button, path-traced');
  expect(complaints).toEqual([]);
});

test.describe('live', () => {
  // A quarter of the pixels: the software GPU is slow.
  test.use({ deviceScaleFactor: 0.5 });

  test("the home page's viewer starts by itself on a GPU, turns under the pointer, and shows another model", async ({
    page,
  }) => {
    const complaints = watchPage(page);
    // The software GPU under another name; a small window makes a small film.
    await page.addInitScript(() =>
      Object.defineProperty(GPUAdapter.prototype, 'info', {
        value: { vendor: 'test', architecture: 'test', device: '', description: '', isFallbackAdapter: false },
      }),
    );
    await page.setViewportSize({ width: 360, height: 900 });
    await page.goto(`${origin}/`);
    const live = page.locator('.home-viewer');
    const canvas = live.locator('canvas');
    await live.scrollIntoViewIfNeeded();
    await expect(live).toHaveAttribute('data-stage', 'render', { timeout: 90_000 });
    // A drag shows the canvas at once: its poster has another view.
    const box = (await canvas.boundingBox())!;
    const middle = [box.x + box.width / 2, box.y + box.height / 2] as const;
    await page.mouse.move(...middle);
    await page.mouse.down();
    await page.mouse.move(middle[0] + 60, middle[1], { steps: 4 });
    await page.mouse.up();
    await expect(live.locator('.live-poster')).toHaveCount(0);
    await expect.poll(async () => (await photograph(canvas)).leading.green, { timeout: 60_000 }).toBeGreaterThan(0.1);
    await page.getByRole('radio', { name: 'Push-buttons' }).check();
    await expect(live.locator('.live-poster')).toHaveAttribute('src', /button-panel/);
    await expect(live).toHaveAttribute('data-stage', 'render', { timeout: 90_000 });
    expect(complaints).toEqual([]);
  });

  test('the live page path-traces the push-button, and a new lens colour restarts it', async ({ page }) => {
    const complaints = watchPage(page);
    // A small window makes a small film.
    await page.setViewportSize({ width: 380, height: 800 });
    await page.goto(`${origin}/live`);
    const live = page.locator('.live').first();
    await expect(live).toHaveAttribute('data-stage', /render|done|error/, { timeout: 90_000 });
    await expect(live.getByRole('alert')).toHaveCount(0);
    expect(Number(await live.getAttribute('data-samples'))).toBeGreaterThanOrEqual(1);
    const canvas = live.locator('canvas');
    // Few samples are worse than the poster, which so stays. An edit shows what the poster does not.
    expect(
      await live.evaluate(
        (figure) =>
          (figure.querySelector('.live-poster') !== null) === Number((figure as HTMLElement).dataset['samples']) < 64,
      ),
    ).toBe(true);
    await page.getByRole('slider', { name: 'Exposure' }).fill('0.25');
    await expect(live.locator('.live-poster')).toHaveCount(0);
    const green = await photograph(canvas);
    expect(green.colours).toBeGreaterThan(1000);
    expect(green.deviation).toBeGreaterThan(15);
    expect(green.mean[1]).toBeGreaterThan(20);
    expect(green.mean[1]).toBeLessThan(235);
    expect(green.leading.green).toBeGreaterThan(0.01);

    await page.getByRole('radio', { name: 'red' }).check();
    await expect
      .poll(async () => (await photograph(canvas)).leading.red, { timeout: 60_000 })
      .toBeGreaterThan(green.leading.red + 0.01);
    expect(complaints).toEqual([]);
  });

  test('a parameter page path-traces a sphere, and its controls change it', async ({ page }) => {
    const complaints = watchPage(page);
    await page.setViewportSize({ width: 380, height: 900 });
    await page.goto(`${origin}/openpbr/coat`);
    await takenOver(page);
    const table = (await readExport('@glanz/openpbr/parameters', 'OPENPBR_PARAMETERS')) as Record<
      string,
      { group: string }
    >;
    expect(await page.locator('.parameters tbody tr').evaluateAll((rows) => rows.map((row) => row.id))).toEqual(
      Object.values(table).flatMap(({ group }, i) => (group === 'coat' ? [Object.keys(table)[i]] : [])),
    );
    const live = page.locator('.live').first();
    // Nothing is fetched or compiled before one asks for it.
    await expect(live).toHaveAttribute('data-stage', 'idle');
    await live.getByRole('button', { name: 'Path-trace it here' }).click();
    await expect(live).toHaveAttribute('data-stage', /render|done|error/, { timeout: 90_000 });
    await expect(live.getByRole('alert')).toHaveCount(0);
    const canvas = live.locator('canvas');
    const red = await photograph(canvas);
    expect(red.colours).toBeGreaterThan(1000);
    expect(red.leading.red).toBeGreaterThan(0.1);
    expect(red.leading.green).toBeLessThan(0.02);
    // Through a green coat a red base is dark, and the edges are green.
    await page.locator('label', { hasText: 'coat_color' }).locator('input').fill('#20ff20');
    await page.locator('label', { hasText: 'coat_color' }).locator('input').dispatchEvent('change');
    await expect
      .poll(async () => (await photograph(canvas)).leading.red, { timeout: 60_000 })
      .toBeLessThan(red.leading.red / 2);
    await page.getByRole('button', { name: 'Reset' }).click();
    await expect
      .poll(async () => (await photograph(canvas)).leading.red, { timeout: 60_000 })
      .toBeGreaterThan(0.8 * red.leading.red);
    expect(complaints).toEqual([]);
  });

  test('views that move are compared side by side, as sampled and filtered, with one camera', async ({ page }) => {
    const complaints = watchPage(page);
    await page.setViewportSize({ width: 380, height: 800 });
    await page.goto(`${origin}/guide/denoising`);
    await takenOver(page);
    const live = page.locator('.live-moving');
    await expect(live).toHaveAttribute('data-stage', 'idle');
    await live.getByRole('button', { name: 'Compare here' }).click();
    await expect(live).toHaveAttribute('data-stage', /render|error/, { timeout: 120_000 });
    await expect(live.getByRole('alert')).toHaveCount(0);
    const sides = live.locator('.live-moving-side');
    await expect(sides).toHaveCount(2);
    const before = await Promise.all([0, 1].map((i) => photograph(sides.nth(i).locator('canvas'))));
    // Whichever of both is moved, the other follows, and only one is filtered.
    for (const moved of [0, 1]) {
      await live.evaluate((figure) => {
        const seen = ((figure as HTMLElement & { seen?: Set<string> }).seen = new Set<string>());
        new MutationObserver(() => {
          for (const side of figure.querySelectorAll<HTMLElement>('.live-moving-side')) {
            const index = [...side.parentElement!.children].indexOf(side);
            if (side.dataset['moving'] === 'true') seen.add(`${index} ${side.dataset['denoised']}`);
          }
        }).observe(figure, { attributes: true, subtree: true });
      });
      const canvas = sides.nth(moved).locator('canvas');
      await canvas.focus();
      const seen = () => live.evaluate((figure) => [...(figure as HTMLElement & { seen: Set<string> }).seen].sort());
      // The filter is loaded and compiled with the first movement; until then frames are raw.
      await expect(async () => {
        for (const key of ['ArrowLeft', 'ArrowUp', 'ArrowRight', 'ArrowDown']) await canvas.press(key);
        expect(await seen()).toEqual(expect.arrayContaining(['0 false', '1 true']));
      }).toPass({ timeout: 60_000 });
      expect(await seen()).not.toContain('0 true');
    }
    for (let i = 0; i < 10; i++) await sides.first().locator('canvas').press('ArrowLeft');
    for (const i of [0, 1]) await expect(sides.nth(i)).toHaveAttribute('data-moving', 'false', { timeout: 60_000 });
    // At rest they are one image but for the last movement's remains, and another one than before.
    for (const i of [0, 1])
      await expect
        .poll(async () => Number(await sides.nth(i).getAttribute('data-samples')), { timeout: 90_000 })
        .toBeGreaterThan(3);
    const after = await Promise.all([0, 1].map((i) => photograph(sides.nth(i).locator('canvas'))));
    const apart = (a: Pixels, b: Pixels) =>
      Math.max(...a.cells.flatMap((cell, i) => cell.map((value, c) => Math.abs(value - b.cells[i]![c]!))));
    // The turn moves the model through the image, 60 codes and more in a cell; what noise is left is 10.
    expect(apart(after[0]!, after[1]!)).toBeLessThan(25);
    expect(apart(after[0]!, before[0]!)).toBeGreaterThan(35);
    expect(complaints).toEqual([]);
  });
});

test("the rasteriser's ball is drawn as the page opens", async ({ page }) => {
  const complaints = watchPage(page);
  await page.goto(`${origin}/openpbr/rasteriser`);
  const canvas = page.locator('.live-ball canvas');
  await expect(canvas).toHaveAttribute('data-drawn', 'yes');
  const { colours, leading } = await photograph(canvas);
  expect(colours).toBeGreaterThan(200);
  expect(leading.red).toBeGreaterThan(0.15);
  expect(complaints).toEqual([]);
});

test('the page about hierarchies builds trees, maps their cost, shows their levels, and keeps them', async ({
  page,
}) => {
  const complaints = watchPage(page);
  await page.goto(`${origin}/how/hierarchies`);
  await takenOver(page);
  const live = page.locator('.live-hierarchy');
  const done = () => expect(live).toHaveAttribute('data-stage', 'done', { timeout: 60_000 });
  const cost = async () => Number(await live.getAttribute('data-cost'));
  /** Changes a choice and waits for its image; until that begins, the page is done with the image before. */
  const choose = async (name: string, value: string) => {
    const begun = await live.evaluateHandle((figure) => {
      const seen = { change: false };
      new MutationObserver(() => (seen.change = true)).observe(figure, { attributeFilter: ['data-stage'] });
      return seen;
    });
    await live.getByLabel(name).selectOption(value);
    await expect.poll(() => begun.evaluate((seen) => seen.change)).toBe(true);
    await done();
  };
  await expect(live).toHaveAttribute('data-stage', 'idle');
  await live.getByRole('button', { name: 'Build it here' }).click();
  await done();
  await expect(live).toHaveAttribute('data-source', 'built');
  const map = await photograph(live.locator('canvas'));
  expect(map.colours).toBeGreaterThan(100);
  expect(map.leading.red).toBeGreaterThan(0.02);
  const balanced = await cost();
  expect(balanced).toBeGreaterThan(5);

  // What the builders promise, counted in the page.
  await choose('Builder', 'best');
  await expect.poll(cost).toBeLessThan(balanced);
  await choose('Model', 'needles');
  await expect.poll(cost).not.toBe(balanced);
  const whole = await cost();
  await choose('Builder', 'best-split');
  await expect.poll(cost).toBeLessThan(whole);

  await choose('Show', 'levels');
  for (const level of [0, 3]) {
    await live.getByRole('slider', { name: 'Level' }).fill(String(level));
    await expect(live).toHaveAttribute('data-boxes', String(2 ** level));
    await expect(live.locator('figcaption')).toHaveText(`${2 ** level} boxes on level ${level}`);
  }
  await done();
  expect((await photograph(live.locator('canvas'))).colours).toBeGreaterThan(50);

  // Another visit reads what this one has built.
  await page.reload();
  await takenOver(page);
  await live.getByRole('button', { name: 'Build it here' }).click();
  await done();
  await expect(live).toHaveAttribute('data-source', 'store');
  expect(await cost()).toBe(balanced);
  await expect(live.locator('table')).toContainText('Read from the browser’s cache in');
  expect(complaints).toEqual([]);
});
