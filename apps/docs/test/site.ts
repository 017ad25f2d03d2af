import { execFile } from 'node:child_process';
import { createReadStream, existsSync, readdirSync, statSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { createRequire } from 'node:module';
import { dirname, extname, join, normalize, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { buildApp } from '@glanz/browser';

const docs = fileURLToPath(new URL('..', import.meta.url));

/** Where VitePress puts the built site. */
export const DIST = join(docs, '.vitepress/dist');

const TYPES: Readonly<Record<string, string>> = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.json': 'application/json',
  '.svg': 'image/svg+xml',
  '.webp': 'image/webp',
  '.png': 'image/png',
  '.woff2': 'font/woff2',
};

/**
 * Builds the site, as a release would, with the playground that its own tests build, too. Throws with VitePress's
 * output where it fails, dead links included.
 */
export async function buildSite(): Promise<void> {
  const vitepress = dirname(createRequire(join(docs, 'package.json')).resolve('vitepress/package.json'));
  const playground = await buildApp(join(docs, '../playground/'));
  try {
    // Most of what it allocates is garbage soon: in a larger young generation that is collected less often.
    const argv = ['--max-semi-space-size=64', join(vitepress, 'bin/vitepress.js'), 'build', docs];
    await promisify(execFile)(process.execPath, argv, {
      cwd: docs,
      env: { ...process.env, GLANZ_PLAYGROUND: playground.outDir },
      maxBuffer: 1 << 24,
    });
  } finally {
    playground.remove();
  }
}

/** Every page of the built site, as a path of its address, less the playground, which has tests of its own. */
export function sitePages(folder = DIST): string[] {
  return readdirSync(folder, { withFileTypes: true })
    .flatMap((entry) => {
      const path = join(folder, entry.name);
      if (entry.isDirectory()) return entry.name === 'playground' ? [] : sitePages(path);
      if (!entry.name.endsWith('.html') || entry.name === '404.html') return [];
      return [
        `/${relative(DIST, path)
          .replace(/\.html$/, '')
          .replace(/(^|\/)index$/, '$1')}`,
      ];
    })
    .sort();
}

/** The file that a static host with clean addresses answers a path with; `undefined` if there is none. */
export function fileFor(path: string): string | undefined {
  const base = join(DIST, normalize(decodeURIComponent(path)));
  if (!base.startsWith(DIST)) return undefined;
  return [base, `${base}.html`, join(base, 'index.html')].find((file) => existsSync(file) && statSync(file).isFile());
}

/** Serves the built site on a free port of this machine. */
export async function serveSite(): Promise<{ readonly origin: string; readonly server: Server }> {
  const server = createServer((request, response) => {
    const file = fileFor(new URL(request.url ?? '/', 'http://localhost').pathname);
    response.writeHead(file ? 200 : 404, {
      'content-type': TYPES[extname(file ?? '.html')] ?? 'application/octet-stream',
    });
    createReadStream(file ?? join(DIST, '404.html')).pipe(response);
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { origin: `http://127.0.0.1:${(server.address() as AddressInfo).port}`, server };
}
