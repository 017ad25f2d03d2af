import { existsSync, mkdirSync, mkdtempSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import type { LaunchOptions } from '@playwright/test';

// All five, or a canvas stays blank on the software GPU.
const GPU_FLAGS = [
  '--enable-unsafe-webgpu',
  '--use-webgpu-adapter=swiftshader',
  '--enable-features=Vulkan',
  '--use-vulkan=swiftshader',
  '--use-angle=swiftshader',
];
const QUIET_FLAGS = [
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

/** How Chromium is started on the software GPU. */
export const SOFTWARE_GPU = ['--no-sandbox', ...GPU_FLAGS, ...QUIET_FLAGS];

/**
 * For tests, whose processor time is a fifth less with these: the software GPU compiles programs without Dawn's bounds
 * checks, and with a loop that clears workgroup memory in place of a constant, of which it compiles a store for each
 * element.
 */
export const FAST_COMPILATION = [
  '--enable-dawn-features=disable_robustness',
  '--disable-dawn-features=use_vulkan_zero_initialize_workgroup_memory_extension',
];

/** How Chromium is started without any GPU, for tests of what pages say: to paint them costs more than to read them. */
export const WITHOUT_GPU = ['--no-sandbox', '--disable-gpu', ...QUIET_FLAGS];

/**
 * How to start the Chromium of the npm package on the software GPU; elsewhere than on x86-64 Linux, Playwright's own.
 *
 * @param folder Where the package is inflated to, once: a bare machine has neither Chromium nor the libraries that it
 * needs.
 */
export async function launchOptions(folder: string): Promise<LaunchOptions> {
  if (process.platform !== 'linux' || process.arch !== 'x64') return { args: SOFTWARE_GPU };
  if (!existsSync(folder)) await inflate(folder);
  return { ...inflated(folder), args: SOFTWARE_GPU };
}

/** How to start a Chromium that lies inflated in a folder. */
export function inflated(folder: string): LaunchOptions {
  // Drivers that are named for other programs would hide the software GPU that comes with the browser.
  const { LD_LIBRARY_PATH, VK_DRIVER_FILES: _, VK_ICD_FILENAMES: __, ...others } = process.env;
  return {
    executablePath: `${folder}/chromium`,
    env: {
      ...(others as Record<string, string>),
      LD_LIBRARY_PATH: [`${folder}/al2023/lib`, LD_LIBRARY_PATH].filter(Boolean).join(':'),
      FONTCONFIG_FILE: `${folder}/fonts.conf`,
    },
  };
}

/**
 * Two processes may come at once (the unit tests start a browser too): each inflates into a folder of its own, which
 * takes its place whole; a browser that is being written cannot be started.
 */
async function inflate(folder: string): Promise<void> {
  mkdirSync(dirname(folder), { recursive: true });
  const work = mkdtempSync(`${folder}-`);
  const { TMPDIR, AWS_LAMBDA_JS_RUNTIME, LD_LIBRARY_PATH, FONTCONFIG_PATH, HOME } = process.env;
  // The package inflates into the system's temporary folder, and adds its libraries where it takes the machine for a
  // bare one.
  process.env['TMPDIR'] = work;
  process.env['AWS_LAMBDA_JS_RUNTIME'] = 'nodejs20.x';
  try {
    const { default: chromium } = await import('@sparticuz/chromium');
    await chromium.executablePath();
    // The package's own list of font folders names none of these; without any font a page has no text.
    writeFileSync(
      `${work}/fonts.conf`,
      `<?xml version="1.0"?><fontconfig><dir>${folder}/fonts</dir><cachedir>${folder}/fonts-cache</cachedir></fontconfig>\n`,
    );
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
