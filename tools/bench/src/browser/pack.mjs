// npm run bench:pack -- --browser — what the benchmarks in Chromium need on a machine that has nothing but a GPU, in
// two folders that can be carried one after the other: .gpu-browser/1 and .gpu-browser/2.
//   mkdir -p /tmp/browser && cp .gpu-browser/1/* /tmp/browser        first
//   . .gpu/setup.sh && . .gpu-browser/2/setup.sh && $GPU_NODE .gpu-bench/preview-chromium.mjs --hardware yes
import { execFileSync } from 'node:child_process';
import { createRequire } from 'node:module';
import { cpSync, existsSync, mkdirSync, readFileSync, realpathSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { bundle } from '../bundle.mjs';

const root = fileURLToPath(new URL('../../../..', import.meta.url));
const out = join(root, '.gpu-browser');
const kept = join(root, '.cache/chromium.tar.xz');

const SETUP = `# Source this there, after .gpu/setup.sh: unpacks Chromium and the pages, and sets where the benchmarks find them.
browser=\${GLANZ_BROWSER:-/tmp/browser}
here=$(cd "$(dirname "\${BASH_SOURCE[0]}")" && pwd)
if [ ! -x "$browser/chromium" ]; then
  cat "$browser/chromium.1" "$here/chromium.2" | tar xJ -C "$browser"
  printf '<?xml version="1.0"?><fontconfig><dir>%s/fonts</dir><cachedir>%s/fonts-cache</cachedir></fontconfig>\\n' "$browser" "$browser" > "$browser/fonts.conf"
fi
tar xJf "$here/pages.tar.xz" -C "$browser"
export GLANZ_BROWSER=$browser
`;

/** Packs Chromium, as the tests inflate it, and the pages of the benchmarks. */
export async function packBrowser() {
  rmSync(out, { recursive: true, force: true });
  const pages = join(out, 'pages');
  for (const folder of ['1', '2', 'pages']) mkdirSync(join(out, folder), { recursive: true });
  const packer = join(root, 'tools/bench/.cache/pack-pages.mjs');
  await bundle(
    "export { buildPlayground } from './browser/playground';\nexport { buildLoaders } from './loading/chromium';",
    packer,
  );
  const { buildPlayground, buildLoaders } = await import(pathToFileURL(packer).href);
  await buildPlayground(join(pages, 'playground'));
  await buildLoaders(join(pages, 'loaders'), false);
  await buildLoaders(join(pages, 'loaders-legible'), true);
  const playwright = createRequire(realpathSync(join(root, 'node_modules/playwright/package.json')));
  const core = dirname(playwright.resolve('playwright-core/package.json'));
  cpSync(core, join(pages, 'node_modules/playwright-core'), {
    recursive: true,
    filter: (path) => !/\/(lib\/vite|types)$/.test(path),
  });
  execFileSync('tar', ['cJf', join(out, '2/pages.tar.xz'), '-C', pages, '.']);
  rmSync(pages, { recursive: true });
  if (!existsSync(kept)) {
    const inflated = join(root, '.cache/browser');
    if (!existsSync(inflated))
      throw new Error('bench:pack --browser: run a test in the browser first; that inflates Chromium');
    execFileSync('tar', [
      'cf',
      kept,
      '-I',
      'xz -6 -T0',
      '-C',
      inflated,
      '--exclude=fonts.conf',
      '--exclude=fonts-cache',
      '.',
    ]);
  }
  const bytes = readFileSync(kept),
    half = bytes.length >> 1;
  writeFileSync(join(out, '1/chromium.1'), bytes.subarray(0, half));
  writeFileSync(join(out, '2/chromium.2'), bytes.subarray(half));
  writeFileSync(join(out, '2/setup.sh'), SETUP);
  process.stdout.write(`.gpu-browser ${(bytes.length / 2 ** 20).toFixed(1)} MiB of Chromium in two halves\n`);
}
