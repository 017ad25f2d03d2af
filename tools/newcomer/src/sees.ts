import { photograph } from '@glanz/browser';
import { expect, test, type Page } from '@playwright/test';

const only = process.env['GLANZ_NEWCOMER_ONLY'];

/** Skips the test where `GLANZ_NEWCOMER_ONLY` asks for another one. */
export const requested = (name: string): void =>
  test.skip(only !== undefined && only !== name, 'GLANZ_NEWCOMER_ONLY asks for another');

/** Opens a page and waits until the element shows a path-traced model. @returns What the page complained about. */
export async function sees(
  browser: Page,
  address: string,
  selector: string,
): Promise<{ readonly seconds: number; readonly complaints: readonly string[] }> {
  const complaints: string[] = [];
  browser.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  browser.on('pageerror', (error) => complaints.push(`uncaught: ${error.message}`));
  const from = performance.now();
  await browser.goto(address);
  await expect
    .poll(
      async () =>
        (await browser.locator(selector).count()) > 0 ? (await photograph(browser.locator(selector))).colours : 0,
      { timeout: 120_000, intervals: [100] },
    )
    .toBeGreaterThan(300);
  return { seconds: (performance.now() - from) / 1000, complaints };
}
