import { existsSync, mkdirSync, mkdtempSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig, type LaunchOptions } from '@playwright/test';

// All five, or a canvas stays blank on the software GPU.
const GPU_FLAGS = ['--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader', '--enable-features=Vulkan', '--use-vulkan=swiftshader', '--use-angle=swiftshader'];
const QUIET_FLAGS = ['--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];

/**
 * Chromium and the libraries it needs out of the npm package, inflated once into .cache: a bare machine has neither.
 * Two processes may come at once (the unit tests start a browser too): each inflates into a folder of its own, which takes its
 * place whole; a browser that is being written cannot be started.
 */
async function packagedChromium(): Promise<LaunchOptions> {
  const folder = fileURLToPath(new URL('.cache/browser', import.meta.url));
  if (!existsSync(folder)) await inflateChromium(folder);
  const { LD_LIBRARY_PATH } = process.env;
  return {
    executablePath: `${folder}/chromium`,
    env: {
      ...(process.env as Record<string, string>),
      LD_LIBRARY_PATH: [`${folder}/al2023/lib`, LD_LIBRARY_PATH].filter(Boolean).join(':'),
      FONTCONFIG_FILE: `${folder}/fonts.conf`,
    },
  };
}

async function inflateChromium(folder: string): Promise<void> {
  mkdirSync(dirname(folder), { recursive: true });
  const work = mkdtempSync(`${folder}-`);
  const { TMPDIR, AWS_LAMBDA_JS_RUNTIME, LD_LIBRARY_PATH, FONTCONFIG_PATH, HOME } = process.env;
  // The package inflates into the system's temporary folder, and adds its libraries where it takes the machine for a bare one.
  process.env['TMPDIR'] = work;
  process.env['AWS_LAMBDA_JS_RUNTIME'] = 'nodejs20.x';
  try {
    const { default: chromium } = await import('@sparticuz/chromium');
    await chromium.executablePath();
    // The package's own list of font folders names none of these; without any font a page has no text.
    writeFileSync(`${work}/fonts.conf`, `<?xml version="1.0"?><fontconfig><dir>${folder}/fonts</dir><cachedir>${folder}/fonts-cache</cachedir></fontconfig>\n`);
    renameSync(work, folder);
  } catch (error) {
    // Another process was first, and its folder is as good.
    if (!['EEXIST', 'ENOTEMPTY'].includes((error as NodeJS.ErrnoException).code ?? '')) throw error;
  } finally {
    rmSync(work, { recursive: true, force: true });
    restore({ TMPDIR, AWS_LAMBDA_JS_RUNTIME, LD_LIBRARY_PATH, FONTCONFIG_PATH, HOME });
  }
}

function restore(variables: Readonly<Record<string, string | undefined>>): void {
  for (const [name, value] of Object.entries(variables)) {
    if (value === undefined) delete process.env[name];
    else process.env[name] = value;
  }
}

const packaged = process.platform === 'linux' && process.arch === 'x64' ? await packagedChromium() : {};

export default defineConfig({
  projects: ['packages/viewer', 'packages/element', 'packages/react', 'packages/three', 'apps/playground', 'apps/docs']
    .filter((folder) => existsSync(new URL(`${folder}/test`, import.meta.url)))
    .map((folder) => ({ name: folder.slice(folder.indexOf('/') + 1), testDir: `${folder}/test`, testMatch: '**/*.spec.ts' }))
    // Wants packed packages and the registry: npm run newcomer brings them.
    .concat(process.env['GLANZ_NEWCOMER'] ? [{ name: 'newcomer', testDir: 'tools/newcomer/src', testMatch: '**/*.spec.ts' }] : []),
  outputDir: '.cache/playwright',
  // The software GPU takes all cores for one page.
  workers: 1,
  timeout: 120_000,
  expect: { timeout: 60_000 },
  forbidOnly: true,
  reporter: 'list',
  use: {
    viewport: { width: 1280, height: 800 },
    launchOptions: { ...packaged, args: ['--no-sandbox', ...GPU_FLAGS, ...QUIET_FLAGS] },
  },
});
