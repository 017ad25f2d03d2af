import { readFileSync } from 'node:fs';
import { triangle, type Pixels } from '@glanz/browser';
import { expect, test, type Page } from '@playwright/test';
import { dataOf, drop, finished, imageOf, onePage, photograph, restarting, save } from './page';

let page: Page;

onePage(
  { width: 1200, height: 700 },
  'model=cornell-box&scale=0.125&samples=4&max-depth=2',
  (opened) => void (page = opened),
);

async function show(name: string, bytes: Buffer): Promise<Pixels> {
  await drop(page, [{ name, bytes }]);
  await expect.poll(() => dataOf(page, 'scene')).toBe(name);
  await finished(page);
  return photograph(imageOf(page));
}

/** Sails in a boat that is turned and stretched, before a camera; the main sail has two materials. */
const boat = () =>
  triangle([0.8, 0.8, 0.8], (json) => {
    const primitive = (material: number) => ({ attributes: { POSITION: 0 }, material });
    const colour = (name: string, baseColorFactor: readonly number[]) => ({
      name,
      doubleSided: true,
      pbrMetallicRoughness: { baseColorFactor, metallicFactor: 0, roughnessFactor: 1 },
    });
    Object.assign(json, {
      scenes: [{ nodes: [0, 3] }],
      cameras: [{ type: 'perspective', perspective: { yfov: 0.8, znear: 0.1 } }],
      nodes: [
        { name: 'Boat', children: [1, 2], rotation: [0, 0, 0.2588190451, 0.9659258263], scale: [1, 1.5, 1] },
        { name: 'Main sail', mesh: 0, translation: [-1.2, 0, 0] },
        { name: 'Jib', mesh: 1, translation: [1.2, 0, 0], rotation: [0, 0, 0.3826834324, 0.9238795325] },
        { name: 'Front', camera: 0, translation: [0, 0, 9] },
      ],
      meshes: [{ primitives: [primitive(0), primitive(1)] }, { primitives: [primitive(2)] }],
      materials: [
        colour('canvas', [0.8, 0.8, 0.7, 1]),
        colour('stripe', [0.8, 0.1, 0.1, 1]),
        colour('wood', [0.1, 0.2, 0.7, 1]),
      ],
    });
  });

const row = (name: string) => page.locator('#parts').getByRole('button', { name, exact: true });
const setNumber = (name: string, value: string) =>
  restarting(page, async () => {
    await page.getByRole('spinbutton', { name, exact: true }).fill(value);
    await page.keyboard.press('Enter');
  });
/** Mean difference of the cells of two images, in codes. */
const difference = (a: Pixels, b: Pixels): number =>
  a.cells.reduce((sum, cell, i) => sum + cell.reduce((s, value, k) => s + Math.abs(value - b.cells[i]![k]!), 0), 0) /
  (3 * a.cells.length);

let moved: Pixels;

test('parts of a file that was opened are moved by numbers', async () => {
  const before = await show('boat.glb', boat());
  await row('stripe').click();
  await setNumber('Position Y, m', '1.5');
  await setNumber('Rotation Z, °', '35');
  await row('Jib').click();
  await setNumber('Position X, m', '0.75');
  await setNumber('Scale Y, factor', '2');
  await page.mouse.move(0, 0);
  moved = await photograph(imageOf(page));
  expect(difference(moved, before)).toBeGreaterThan(2);
});

test('the saved glTF of a file shows moved parts where they were put, when it is opened again', async () => {
  const saved = await save(page, 'Save glTF');
  expect(saved.suggestedFilename()).toBe('boat-edited.glb');
  const again = await show('again.glb', readFileSync(await saved.path()));
  expect(difference(again, moved)).toBeLessThan(0.05);
  await expect(page.locator('#parts .part > span')).toContainText(['Main sail', 'Jib']);
});
