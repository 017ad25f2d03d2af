import { mkdtempSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import type { InlineConfig } from 'vite';

/** A page on a free port of this machine. */
export interface Served {
  readonly origin: string;
  readonly close: () => Promise<void>;
}

const cache = fileURLToPath(new URL('../../../.cache', import.meta.url));

/**
 * Builds the page of a folder (its index.html) from the sources of the workspace, and serves it.
 *
 * @param headers Of every answer, a content security policy say.
 */
export async function servePage(root: string, headers: Record<string, string> = {}): Promise<Served> {
  // Loaded when it is needed: benchmarks that are packed for bare machines bring this file, but no bundler.
  const { build } = await import('vite');
  const { basisModule } = await import('../../pipeline/basis-module.mjs');
  const { weslModules } = await import('../../pipeline/wesl.mjs');
  const outDir = mkdtempSync(join(cache, 'page-'));
  const resolve = { conditions: ['@glanz/source', 'module', 'browser', 'import', 'default'] };
  await build({
    root,
    base: './',
    configFile: false,
    logLevel: 'error',
    resolve,
    plugins: [weslModules(), basisModule()],
    worker: { format: 'es', plugins: () => [weslModules(), basisModule()] },
    build: { outDir, emptyOutDir: true, target: 'es2022', chunkSizeWarningLimit: 2000 },
  });
  const served = await serveBuilt({ root, configFile: false, build: { outDir } }, headers);
  const close = async () => {
    await served.close();
    rmSync(outDir, { recursive: true, force: true });
  };
  return { origin: served.origin, close };
}

/** Builds an application by its own configuration, as a release would, and serves it. */
export async function serveApp(root: string): Promise<Served> {
  const { build } = await import('vite');
  await build({ root, logLevel: 'error' });
  return serveBuilt({ root });
}

async function serveBuilt(config: InlineConfig, headers: Record<string, string> = {}): Promise<Served> {
  const { preview } = await import('vite');
  const server = await preview({
    ...config,
    logLevel: 'error',
    preview: { host: '127.0.0.1', port: 4273, strictPort: false, open: false, headers },
  });
  const origin = server.resolvedUrls?.local[0]?.replace(/\/$/, '');
  if (!origin) throw new Error('The preview server has no address.');
  return { origin, close: () => server.close() };
}

/** Collects errors of the page, and requests that leave this machine. */
export function watch(page: Page, origin: string): string[] {
  const complaints: string[] = [];
  page.on('console', (message) => {
    if (message.type() === 'error' || message.type() === 'warning')
      complaints.push(`${message.type()}: ${message.text()}`);
  });
  page.on('pageerror', (error) => complaints.push(`uncaught: ${error.message}`));
  page.on('request', (request) => {
    if (!request.url().startsWith(origin) && !/^(data|blob):/.test(request.url()))
      complaints.push(`asks the network for ${request.url()}`);
  });
  return complaints;
}
