import { join, resolve } from 'node:path';
import type { Page } from 'playwright';
import { BenchError } from '../error';
import { packedBrowser } from './chromium';
import { serveFolders } from './serve';

/** Builds the playground from the sources of the workspace into a folder. */
export async function buildPlayground(outDir: string, legible = false): Promise<void> {
  const { build } = await import('vite');
  await build({
    root: resolve('apps/playground'),
    logLevel: 'error',
    build: { outDir, emptyOutDir: true, ...(legible ? { minify: false } : {}) },
  });
}

/**
 * Serves the playground: built from the sources of the workspace, or as it was packed for a bare machine.
 *
 * @param legible Whether functions keep their names, for profiles; not for a packed one.
 */
export async function servePlayground(
  legible = false,
): Promise<{ readonly origin: string; readonly close: () => Promise<void> }> {
  const packed = packedBrowser();
  if (packed !== undefined) return serveFolders({ '/': join(packed, 'playground') });
  const outDir = resolve('.cache/bench-playground');
  await buildPlayground(outDir, legible);
  return serveFolders({ '/': outDir });
}

/**
 * Waits until the playground has drawn something.
 *
 * @throws {BenchError} `bench/browser` with what the page says where it cannot.
 */
export async function firstFilm(page: Page): Promise<void> {
  await page.waitForSelector('#image[data-film], #image[data-state="unavailable"]', {
    state: 'attached',
    timeout: 300_000,
  });
  const { state } = await page.locator('#image').evaluate((image: HTMLElement) => ({ ...image.dataset }));
  if (state === 'unavailable')
    throw new BenchError(
      'bench/browser',
      `The playground has no GPU here: ${(await page.locator('#notice').textContent()) ?? ''}`,
    );
}
