import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, mkdtempSync, renameSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import type { InlineConfig } from 'vite';
import { RUN_FOLDER } from './run';

/** A page on a free port of this machine. */
export interface Served {
  readonly origin: string;
  /** Where the built files lie. */
  readonly folder: string;
  readonly close: () => Promise<void>;
}

const cache = fileURLToPath(new URL('../../../.cache', import.meta.url));

/**
 * Builds something into a folder of its own: once in a run of Playwright, whose setup names the place (`./run`), where
 * several spec files and workers ask for it; elsewhere each time, and `remove` deletes it.
 *
 * @param name Of what is built, different for each.
 */
async function builtOnce(
  name: string,
  build: (outDir: string) => Promise<unknown>,
): Promise<{ readonly outDir: string; readonly remove: () => void }> {
  const run = process.env[RUN_FOLDER];
  if (!run) {
    const outDir = mkdtempSync(join(cache, 'page-'));
    await build(outDir);
    return { outDir, remove: () => rmSync(outDir, { recursive: true, force: true }) };
  }
  const outDir = join(run, createHash('sha256').update(name).digest('hex').slice(0, 16));
  const lock = `${outDir}.lock`;
  // Who makes the lock builds. The others wait; if the build fails, each tries it and reports what it says.
  while (!existsSync(outDir)) {
    if (!createdFolder(lock)) {
      await new Promise((resolve) => setTimeout(resolve, 100));
      continue;
    }
    try {
      const unfinished = `${outDir}.new`;
      if (!existsSync(outDir)) {
        await build(unfinished);
        renameSync(unfinished, outDir);
      }
    } finally {
      rmSync(lock, { recursive: true, force: true });
    }
  }
  return { outDir, remove: () => undefined };
}

/** Creates a folder; false if it exists. */
function createdFolder(path: string): boolean {
  try {
    mkdirSync(path);
    return true;
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'EEXIST') return false;
    throw error;
  }
}

/**
 * Builds the page of a folder (its index.html) from the sources of the workspace, and serves it.
 *
 * @param headers Of every answer, a content security policy say.
 */
export async function servePage(root: string, headers: Record<string, string> = {}): Promise<Served> {
  const { outDir, remove } = await builtOnce(`page ${root}`, async (outDir) => {
    // Loaded when it is needed: benchmarks that are packed for bare machines bring this file, but no bundler.
    const { build } = await import('vite');
    const { basisModule } = await import('../../pipeline/basis-module.mjs');
    const { weslModules } = await import('../../pipeline/wesl.mjs');
    await build({
      root,
      base: './',
      configFile: false,
      logLevel: 'error',
      resolve: { conditions: ['@glanz/source', 'module', 'browser', 'import', 'default'] },
      plugins: [weslModules(), basisModule()],
      worker: { format: 'es', plugins: () => [weslModules(), basisModule()] },
      build: { outDir, emptyOutDir: true, target: 'es2022', chunkSizeWarningLimit: 2000 },
    });
  });
  const served = await serveBuilt({ root, configFile: false, build: { outDir } }, headers);
  const close = async () => {
    await served.close();
    remove();
  };
  return { origin: served.origin, folder: outDir, close };
}

/** Builds an application by its own configuration, as a release would, into a folder that `remove` deletes. */
export const buildApp = (root: string): Promise<{ readonly outDir: string; readonly remove: () => void }> =>
  builtOnce(`app ${root}`, async (outDir) => {
    const { build } = await import('vite');
    await build({ root, logLevel: 'error', build: { outDir, emptyOutDir: true } });
  });

/** Builds an application as {@link buildApp} does, and serves it. */
export async function serveApp(root: string): Promise<Served> {
  const { outDir, remove } = await buildApp(root);
  const served = await serveBuilt({ root, build: { outDir } });
  const close = async () => {
    await served.close();
    remove();
  };
  return { origin: served.origin, folder: outDir, close };
}

async function serveBuilt(config: InlineConfig, headers: Record<string, string> = {}): Promise<Omit<Served, 'folder'>> {
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
