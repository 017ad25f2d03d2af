import { expect, test, type Page } from '@playwright/test';
import { checkAccessibility, finished, imageOf, onePage, restarting, tab, themesAt } from './page';

/** One page for all; each test leaves nothing chosen that the next one minds, and no edits. */
let page: Page;

onePage({ width: 1440, height: 900 }, 'model=cornell-box&scale=0.125&samples=1&max-depth=2', async (opened) => {
  page = opened;
  await finished(page);
});

const part = (name: string) => page.locator('#parts').getByRole('button', { name, exact: true });
const chosen = () => page.locator('#parts .part[aria-pressed=true]').allInnerTexts();
const swatch = (name: string) => part(name).locator('.swatch');

test('with Ctrl one more, with Shift a range; the colour is that of all, as one step of undo', async () => {
  await part('Left wall').click();
  await part('Right wall').click({ modifiers: ['ControlOrMeta'] });
  expect(await chosen()).toEqual(['Left wall', 'Right wall']);
  await expect(part('Right wall')).toHaveAttribute('aria-current', 'true');
  await expect(page.locator('#material-part')).toHaveText(
    'Selected: Right wall and 1 more, 2 materials; edits apply to all.',
  );
  await expect(page.locator('#outline')).toHaveAttribute('data-part', '2 1');
  const before = await swatch('Left wall').evaluate((one) => getComputedStyle(one).backgroundColor);
  await restarting(page, () => page.locator('#parameter-base_color').fill('#0000ff'));
  for (const name of ['Left wall', 'Right wall'])
    await expect(swatch(name)).toHaveCSS('background-color', 'rgb(0, 0, 255)');
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Color' }).click());
  await expect(swatch('Left wall')).toHaveCSS('background-color', before);
  await expect(swatch('Right wall')).not.toHaveCSS('background-color', 'rgb(0, 0, 255)');
  await restarting(page, () => page.getByRole('button', { name: 'Redo: Color' }).click());
  await expect(swatch('Right wall')).toHaveCSS('background-color', 'rgb(0, 0, 255)');
  await restarting(page, () => page.getByRole('button', { name: 'Reset these materials' }).click());
  await expect(swatch('Left wall')).toHaveCSS('background-color', before);

  await part('Left wall').click();
  await part('Tall block').click({ modifiers: ['Shift'] });
  expect(await chosen()).toEqual(['Left wall', 'Right wall', 'Short block', 'Tall block']);
  await part('Right wall').click({ modifiers: ['ControlOrMeta'] });
  expect(await chosen()).toEqual(['Left wall', 'Short block', 'Tall block']);
  for (const [width, height] of [
    [1440, 900],
    [900, 560],
    [360, 740],
  ] as const) {
    await page.setViewportSize({ width, height });
    if (width < 1180) await tab(page, 'Scene').catch(() => undefined);
    for (const colorScheme of themesAt(width)) {
      await page.emulateMedia({ colorScheme });
      expect(await checkAccessibility(page), `${colorScheme} at ${width}`).toEqual([]);
      if (process.env['GLANZ_SCREENSHOTS'])
        await page.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/parts-${width}-${colorScheme}.png` });
    }
  }
  await page.setViewportSize({ width: 1440, height: 900 });
  await finished(page);
});

test('the eye of a chosen part hides all that are chosen', async () => {
  await part('Short block').click();
  await part('Tall block').click({ modifiers: ['Shift'] });
  await restarting(page, () => page.getByRole('button', { name: 'Show Tall block' }).click());
  await expect(page.getByRole('button', { name: 'Show all (2 hidden)' })).toBeVisible();
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Hide 2 parts' }).click());
  await expect(page.locator('#parts li.off')).toHaveCount(0);
  // One that is not chosen goes alone.
  await restarting(page, () => page.getByRole('button', { name: 'Show Left wall' }).click());
  await expect(page.locator('#parts li.off')).toHaveCount(1);
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Hide part' }).click());
});

test('by the keyboard: Shift and the arrows, Ctrl+A, H', async () => {
  await part('Left wall').press('Enter');
  await page.keyboard.press('Shift+ArrowDown');
  await page.keyboard.press('Shift+ArrowDown');
  expect(await chosen()).toEqual(['Left wall', 'Right wall', 'Short block']);
  await page.keyboard.press('Shift+ArrowUp');
  expect(await chosen()).toEqual(['Left wall', 'Right wall']);
  await expect(part('Right wall')).toBeFocused();
  await restarting(page, () => page.keyboard.press('h'));
  await expect(page.locator('#parts li.off')).toHaveCount(2);
  await restarting(page, () => page.keyboard.press('Control+z'));
  await expect(page.locator('#parts li.off')).toHaveCount(0);
  await page.keyboard.press('Control+a');
  expect((await chosen()).length).toBe(6);
});

test('in the image: Ctrl and a click choose one more part, and one less', async () => {
  const box = (await imageOf(page).boundingBox())!;
  const at = (x: number, y: number) => ({ x: x * box.width, y: y * box.height });
  await imageOf(page).click({ position: at(0.08, 0.5) });
  expect(await chosen()).toEqual(['Left wall']);
  await imageOf(page).click({ position: at(0.92, 0.5), modifiers: ['ControlOrMeta'] });
  expect(await chosen()).toEqual(['Left wall', 'Right wall']);
  await imageOf(page).click({ position: at(0.08, 0.5), modifiers: ['ControlOrMeta'] });
  expect(await chosen()).toEqual(['Right wall']);
});

const box = (name: string) => page.getByRole('spinbutton', { name });
const gizmo = () => page.locator('#gizmo');

/** A point of the screen on a handle: its tip, or a share along its line. */
const onHandle = (name: string, share = 1) =>
  gizmo()
    .locator(`[data-handle=${name}] .line`)
    .evaluate((line: SVGPathElement, part) => {
      const { left, top } = line.ownerSVGElement!.getBoundingClientRect();
      const { x, y } = line.getPointAtLength(part * line.getTotalLength());
      return { x: left + x, y: top + y };
    }, share);

async function drag(from: { x: number; y: number }, to: { x: number; y: number }, key?: string): Promise<void> {
  await page.mouse.move(from.x, from.y);
  if (key) await page.keyboard.down(key);
  await page.mouse.down();
  await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2);
  await page.mouse.move(to.x, to.y);
  await page.mouse.up();
  if (key) await page.keyboard.up(key);
}

test('a part is moved by its handles, as one step of undo; the image follows, and the camera stays', async () => {
  await part('Short block').click();
  await expect(page.locator('#transform')).toBeVisible();
  await page.locator('#home').focus();
  await page.keyboard.press('g');
  await expect(page.getByRole('button', { name: 'Move', exact: true })).toHaveAttribute('aria-pressed', 'true');
  await expect(gizmo()).toBeVisible();
  const before = await gizmo().getAttribute('data-at');
  const x = await onHandle('x');
  await restarting(page, async () => {
    await drag(x, { x: x.x + 90, y: x.y });
  });
  const moved = Number(await box('Position X, m').inputValue());
  expect(moved).toBeGreaterThan(0);
  await expect(box('Position Y, m')).toHaveValue('0');
  await expect(box('Position Z, m')).toHaveValue('0');
  const [beforeX] = before!.split(' ').map(Number) as [number];
  const [nowX, nowY] = (await gizmo().getAttribute('data-at'))!.split(' ').map(Number) as [number, number];
  // The handle keeps under the pointer.
  expect(nowX - beforeX).toBeGreaterThan(60);
  expect(nowX - beforeX).toBeLessThan(120);
  // What is seen there is the block.
  await page.keyboard.press('g');
  await part('Left wall').click();
  await imageOf(page).click({ position: { x: nowX, y: nowY } });
  expect(await chosen()).toEqual(['Short block']);
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Move' }).click());
  await expect(box('Position X, m')).toHaveValue('0');
  // One step, however many movements of the pointer it was.
  await expect(page.getByRole('button', { name: 'Undo: Move' })).toHaveCount(0);
});

test('with Shift it turns and moves in steps; numbers, reset, several parts', async () => {
  await part('Short block').click();
  await page.getByRole('button', { name: 'Rotate', exact: true }).click();
  const from = await onHandle('y', 0.1);
  const to = await onHandle('y', 0.22);
  await restarting(page, () => drag(from, to, 'Shift'));
  const degrees = Number(await box('Rotation Y, °').inputValue());
  expect(degrees).not.toBe(0);
  expect(Math.abs(degrees) % 15).toBe(0);
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Rotate' }).click());

  await page.getByRole('button', { name: 'Scale', exact: true }).click();
  await restarting(page, async () => {
    const middle = await onHandle('x', 0);
    await drag(middle, { x: middle.x + 42, y: middle.y }, 'Shift');
  });
  await expect(box('Scale X, factor')).toHaveValue('1.5');
  await expect(box('Scale Z, factor')).toHaveValue('1.5');
  await restarting(page, () => page.locator('#moves-reset').click());
  await expect(box('Scale X, factor')).toHaveValue('1');
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Reset transform' }).click());
  await expect(box('Scale X, factor')).toHaveValue('1.5');
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Scale' }).click());

  await part('Tall block').click({ modifiers: ['ControlOrMeta'] });
  await restarting(page, async () => {
    await box('Position Y, m').fill('0.25');
    await page.keyboard.press('Enter');
  });
  await part('Short block').click();
  await expect(box('Position Y, m')).toHaveValue('0.25');
  for (const [width, height] of [
    [1440, 900],
    [900, 560],
    [360, 740],
  ] as const) {
    await page.setViewportSize({ width, height });
    if (width < 1180) await tab(page, 'Scene').catch(() => undefined);
    for (const colorScheme of themesAt(width)) {
      await page.emulateMedia({ colorScheme });
      await expect(box('Position Y, m')).toBeVisible();
      expect(await checkAccessibility(page), `${colorScheme} at ${width}`).toEqual([]);
      const wider = await page.evaluate(
        () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
      );
      expect(wider).toBeLessThanOrEqual(0);
      if (process.env['GLANZ_SCREENSHOTS'])
        await page.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/moves-${width}-${colorScheme}.png` });
    }
  }
  await page.setViewportSize({ width: 1440, height: 900 });
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Position' }).click());
  await expect(box('Position Y, m')).toHaveValue('0');
});
