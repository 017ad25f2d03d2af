import { expect, test, type Page } from '@playwright/test';
import { triangle } from '@glanz/browser/files';
import { checkAccessibility, dataOf, drop, finished, imageOf, onePage, restarting, tab, themesAt } from './page';

let page: Page;

onePage({ width: 1440, height: 900 }, 'model=cornell-box&scale=0.125&samples=1&max-depth=2', async (opened) => {
  page = opened;
  await expect(page.locator('#parts')).not.toHaveClass(/nested/);
  await show('boat.glb', boat());
});

async function show(name: string, bytes: Buffer): Promise<void> {
  await drop(page, [{ name, bytes }]);
  await expect.poll(() => dataOf(page, 'scene')).toBe(name);
  await finished(page);
}

/** A boat: a rig of two sails, one of which has two materials, and a hull; beside it a buoy that is in no group. */
const boat = () =>
  triangle([0.8, 0.8, 0.8], (json) => {
    const primitive = (material: number) => ({ attributes: { POSITION: 0 }, material });
    const colour = (name: string, baseColorFactor: readonly number[]) => ({
      name,
      pbrMetallicRoughness: { baseColorFactor, metallicFactor: 0, roughnessFactor: 1 },
    });
    Object.assign(json, {
      scenes: [{ nodes: [0, 5] }],
      nodes: [
        { name: 'Boat', children: [1, 4] },
        { name: 'Rig', children: [2, 3], translation: [0, 1, 0] },
        { name: 'Main sail', mesh: 0, translation: [-1.2, 0, 0] },
        { name: 'Jib', mesh: 1, translation: [1.2, 0, 0] },
        { name: 'Hull', mesh: 1, translation: [0, -1.2, 0] },
        { name: 'Buoy', mesh: 1, translation: [3.5, -1.2, 0] },
      ],
      meshes: [{ primitives: [primitive(0), primitive(1)] }, { primitives: [primitive(2)] }],
      materials: [
        colour('canvas', [0.8, 0.8, 0.7, 1]),
        colour('stripe', [0.8, 0.1, 0.1, 1]),
        colour('wood', [0.4, 0.2, 0.1, 1]),
      ],
    });
  });

const parts = () => page.locator('#parts');
const row = (name: string) => parts().getByRole('button', { name, exact: true });
const eye = (name: string) => parts().getByRole('button', { name: `Show ${name}`, exact: true });
const twisty = (name: string) => parts().getByRole('button', { name: `Parts of ${name}`, exact: true });
/** Names in the tree as they are seen, with a dash for each group around them. */
const shown = () =>
  parts()
    .locator('.part > span')
    .evaluateAll((names) =>
      names.map((name) => {
        let depth = 0;
        for (let list = name.closest('ul'); list && list.id !== 'parts'; list = list.parentElement!.closest('ul'))
          depth++;
        return `${'-'.repeat(depth)}${name.textContent}`;
      }),
    );
const chosen = () => parts().locator('.part[aria-pressed=true] > span').allInnerTexts();

const ALL = ['Boat', '-Rig', '--Main sail', '---canvas', '---stripe', '--Jib', '-Hull', 'Buoy'];

test('parts are shown in the groups of their file; groups open and close', async () => {
  await expect.poll(shown).toEqual(ALL);
  await twisty('Rig').click();
  expect(await shown()).toEqual(['Boat', '-Rig', '-Hull', 'Buoy']);
  await expect(twisty('Rig')).toHaveAttribute('aria-expanded', 'false');
  await twisty('Boat').click();
  await twisty('Boat').click();
  // What was closed in it stays so.
  expect(await shown()).toEqual(['Boat', '-Rig', '-Hull', 'Buoy']);
  await twisty('Rig').click();
  expect(await shown()).toEqual(ALL);
});

test('a group stands for all of its parts: selection, material, visibility, transform', async () => {
  await row('Rig').click();
  expect(await chosen()).toEqual(['Rig', 'Main sail', 'canvas', 'stripe', 'Jib']);
  await expect(row('Boat')).toHaveAttribute('aria-pressed', 'mixed');
  await expect(page.locator('#outline')).toHaveAttribute('data-part', '0 1 2');
  await expect(page.locator('#material-part')).toHaveText(
    'Selected: Main sail and 2 more, 3 materials; edits apply to all.',
  );
  const swatch = (name: string) => row(name).locator('.swatch');
  await restarting(page, () => page.locator('#parameter-base_color').fill('#0000ff'));
  for (const name of ['canvas', 'stripe', 'Jib'])
    await expect(swatch(name)).toHaveCSS('background-color', 'rgb(0, 0, 255)');
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Color' }).click());
  await expect(swatch('Jib')).not.toHaveCSS('background-color', 'rgb(0, 0, 255)');

  await restarting(page, async () => {
    await page.getByRole('spinbutton', { name: 'Position Y, m' }).fill('0.5');
    await page.keyboard.press('Enter');
  });
  for (const [name, value] of [
    ['Jib', '0.5'],
    ['stripe', '0.5'],
    ['Hull', '0'],
  ] as const) {
    await row(name).click();
    await expect(page.getByRole('spinbutton', { name: 'Position Y, m' })).toHaveValue(value);
  }
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Position' }).click());

  // The hull is chosen; a group beside it is hidden alone.
  await eye('Main sail').click();
  await expect(eye('Main sail')).toHaveAttribute('aria-pressed', 'false');
  await expect(eye('Rig')).toHaveAttribute('aria-pressed', 'mixed');
  await expect(eye('Hull')).toHaveAttribute('aria-pressed', 'true');
  // What is hidden in part is hidden first.
  await eye('Rig').click();
  await expect(page.getByRole('button', { name: 'Show all (3 hidden)' })).toBeVisible();
  await eye('Rig').click();
  await expect(page.getByRole('button', { name: /Show all/ })).toBeHidden();
  await eye('Rig').click({ modifiers: ['Alt'] });
  await expect(page.getByRole('button', { name: 'Show all (2 hidden)' })).toBeVisible();
  await eye('Rig').click({ modifiers: ['Alt'] });
  await expect(page.getByRole('button', { name: /Show all/ })).toBeHidden();
  await finished(page);
});

test('with Ctrl and Shift: groups are added and taken away, ranges go over groups', async () => {
  await row('Buoy').click();
  await row('Main sail').click({ modifiers: ['ControlOrMeta'] });
  expect(await chosen()).toEqual(['Main sail', 'canvas', 'stripe', 'Buoy']);
  await row('Rig').click({ modifiers: ['ControlOrMeta'] });
  await row('Main sail').click({ modifiers: ['ControlOrMeta'] });
  expect(await chosen()).toEqual(['Jib', 'Buoy']);
  await row('Jib').click();
  await row('Hull').click({ modifiers: ['Shift'] });
  expect(await chosen()).toEqual(['Jib', 'Hull']);
  // From a part up to a group that is closed, and over one that is open.
  await row('Buoy').click();
  await row('Main sail').click({ modifiers: ['Shift'] });
  expect(await chosen()).toEqual(['Boat', 'Rig', 'Main sail', 'canvas', 'stripe', 'Jib', 'Hull', 'Buoy']);
  await row('Boat').click();
  await row('Rig').click({ modifiers: ['Shift'] });
  await twisty('Rig').click();
  await row('Buoy').click();
  await row('Rig').click({ modifiers: ['Shift'] });
  expect(await chosen()).toEqual(['Boat', 'Rig', 'Hull', 'Buoy']);
  await twisty('Rig').click();
});

test('by the keyboard: arrows open, close and move, Home and End, H', async () => {
  await row('Boat').click();
  await page.keyboard.press('ArrowLeft');
  expect(await shown()).toEqual(['Boat', 'Buoy']);
  await page.keyboard.press('ArrowRight');
  expect(await shown()).toEqual(ALL);
  await page.keyboard.press('ArrowRight');
  await expect(row('Rig')).toBeFocused();
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('ArrowDown');
  await expect(row('canvas')).toBeFocused();
  await page.keyboard.press('ArrowLeft');
  await expect(row('Main sail')).toBeFocused();
  await page.keyboard.press('End');
  await expect(row('Buoy')).toBeFocused();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowLeft');
  await expect(row('Buoy')).toBeFocused();
  await page.keyboard.press('Home');
  await expect(row('Boat')).toBeFocused();
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  expect(await chosen()).toEqual(['Rig', 'Main sail', 'canvas', 'stripe', 'Jib']);
  await page.keyboard.press('h');
  await expect(eye('Rig')).toHaveAttribute('aria-pressed', 'false');
  await page.keyboard.press('h');
  await expect(eye('Rig')).toHaveAttribute('aria-pressed', 'true');
  await page.keyboard.press('Control+a');
  expect(await chosen()).toEqual(ALL.map((name) => name.replace(/^-+/, '')));
  // Columns: the eye of the next row.
  await eye('Rig').focus();
  await page.keyboard.press('ArrowDown');
  await expect(eye('Main sail')).toBeFocused();
  await page.keyboard.press('ArrowDown');
  await expect(eye('canvas')).toBeFocused();
  await twisty('Boat').focus();
  await page.keyboard.press('Space');
  expect(await shown()).toEqual(['Boat', 'Buoy']);
  await page.keyboard.press('Enter');
  expect(await shown()).toEqual(ALL);
});

test('a part that is chosen in the image is shown in its group', async () => {
  await row('Buoy').click();
  await twisty('Boat').click();
  const box = (await imageOf(page).boundingBox())!;
  // The hull is the lowest in the middle.
  for (let y = 0.9; y > 0.3 && !(await chosen()).includes('Hull'); y -= 0.05)
    await imageOf(page).click({ position: { x: 0.35 * box.width, y: y * box.height } });
  expect(await chosen()).toEqual(['Hull']);
  expect(await shown()).toEqual(ALL);
});

test('search finds parts and groups; by material, there are none', async () => {
  await page.locator('#part-search').fill('sail');
  expect(await shown()).toEqual(['Boat', '-Rig', '--Main sail']);
  await expect(row('Boat').locator('small')).toHaveText('2 of 4');
  // A group is what the list shows of it.
  await row('Boat').click();
  await expect(page.locator('#outline')).toHaveAttribute('data-part', '0 1');
  await page.locator('#part-search').fill('canvas');
  expect(await shown()).toEqual(['Boat', '-Rig', '--Main sail', '---canvas']);
  await page.locator('#part-search').fill('nothing of the kind');
  await expect(parts()).toHaveText('No part has this name.');
  await page.locator('#part-search').fill('');
  expect(await shown()).toEqual(ALL);
  await page.locator('#part-order').selectOption('material');
  expect(await shown()).toEqual(['Main sail', 'Main sail', 'Jib', 'Hull', 'Buoy']);
  await page.locator('#part-order').selectOption('file');
  expect(await shown()).toEqual(ALL);
});

test('no accessibility faults, light and dark, at three sizes; nothing wider than the window', async () => {
  test.setTimeout(600_000);
  await row('Main sail').click();
  await eye('Jib').click();
  for (const [width, height] of [
    [1440, 900],
    [900, 560],
    [360, 740],
  ] as const) {
    await page.setViewportSize({ width, height });
    if (width < 1180) await tab(page, 'Scene');
    for (const colorScheme of themesAt(width)) {
      await page.emulateMedia({ colorScheme });
      await expect(row('Rig')).toBeVisible();
      expect(await checkAccessibility(page), `${colorScheme} at ${width}`).toEqual([]);
      const wider = await page.evaluate(
        () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
      );
      expect(wider).toBeLessThanOrEqual(0);
      if (process.env['GLANZ_SCREENSHOTS'])
        await page.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/groups-${width}-${colorScheme}.png` });
    }
  }
  await page.setViewportSize({ width: 1440, height: 900 });
  await eye('Jib').click();
});

test('of ten thousand nodes, only the rows of open groups are made', async () => {
  const [streets, towers] = [100, 100];
  const bytes = triangle([0.5, 0.5, 0.5], (json) => {
    const nodes: object[] = [{ name: 'City', children: Array.from({ length: streets }, (_, i) => 1 + i) }];
    for (let s = 0; s < streets; s++)
      nodes.push({
        name: `Street ${s}`,
        children: Array.from({ length: towers }, (_, h) => 1 + streets + towers * s + h),
      });
    for (let s = 0; s < streets; s++)
      for (let h = 0; h < towers; h++)
        nodes.push({ name: `Tower ${s}-${h}`, mesh: 0, translation: [2.5 * h, 0, -2.5 * s] });
    Object.assign(json, { scenes: [{ nodes: [0] }], nodes });
  });
  await show('city.glb', bytes);
  await expect.poll(shown).toEqual(['City']);
  await twisty('City').click();
  expect((await shown()).length).toBe(1 + streets);
  await twisty('Street 7').click();
  expect((await shown()).length).toBe(1 + streets + towers);
  await row('Street 7').click();
  expect((await chosen()).length).toBe(1 + towers);
  await eye('Street 7').click();
  await expect(page.getByRole('button', { name: `Show all (${towers} hidden)` })).toBeVisible();
  await restarting(page, () => page.getByRole('button', { name: /^Show all/ }).click());
  await row('City').click();
  await expect(row('Street 99')).toHaveAttribute('aria-pressed', 'true');
  await page.locator('#part-search').fill('tower 42-1');
  // Tower 42-1 and those from 42-10 to 42-19.
  expect((await shown()).length).toBe(2 + 11);
  await page.locator('#part-search').fill('');
});
