import { existsSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import type { Browser, BrowserType, LaunchOptions } from 'playwright';
import { inflated, launchOptions, SOFTWARE_GPU } from '@glanz/browser/launch';
import { BenchError } from '../error';

/** Where a bare machine keeps what {@link ../browser/pack} packed; unset where the workspace itself is there. */
export const packedBrowser = (): string | undefined => process.env['GLANZ_BROWSER'];

/** What is used of Playwright's core. */
interface Playwright {
  readonly chromium: BrowserType;
}

/** The machine's own GPU, without a screen; `GLANZ_CHROMIUM_FLAGS` names others. */
const GPU_FLAGS = [
  '--no-sandbox',
  '--enable-unsafe-webgpu',
  '--enable-features=Vulkan,WebGPU',
  '--use-vulkan=native',
  '--use-angle=vulkan',
  '--disable-vulkan-surface',
  '--ignore-gpu-blocklist',
];

/** What a browser of the benchmarks runs on. */
export interface Chromium {
  readonly browser: Browser;
  /** `software`: SwiftShader, which shares the processor with the page. */
  readonly gpu: 'software' | 'hardware';
}

/**
 * Chromium, headless: as the tests start it, or from the folder that `GLANZ_BROWSER` names.
 *
 * @param gpu `hardware` for the machine's own GPU.
 * @throws {BenchError} `bench/browser` where the named folder has none.
 */
export async function launchChromium(gpu: Chromium['gpu'] = 'software'): Promise<Chromium> {
  const packed = packedBrowser();
  const options =
    packed === undefined ? await launchOptions(resolve('.cache/browser')) : packedOptions(resolve(packed));
  // A bare machine has Playwright's core beside the browser, and nothing else of it.
  const { chromium } =
    packed === undefined
      ? await import('playwright')
      : (
          (await import(
            pathToFileURL(createRequire(join(resolve(packed), 'x.js')).resolve('playwright-core')).href
          )) as { default: Playwright }
        ).default;
  const { VK_DRIVER_FILES, GLANZ_CHROMIUM_FLAGS } = process.env;
  const hardware = {
    ...options,
    args: GLANZ_CHROMIUM_FLAGS?.split(' ') ?? GPU_FLAGS,
    env: { ...options.env, ...(VK_DRIVER_FILES === undefined ? {} : { VK_DRIVER_FILES }) },
  };
  return { browser: await chromium.launch(gpu === 'hardware' ? hardware : { ...options, args: SOFTWARE_GPU }), gpu };
}

function packedOptions(folder: string): LaunchOptions {
  const options = inflated(folder);
  if (!existsSync(options.executablePath!))
    throw new BenchError('bench/browser', `GLANZ_BROWSER names ${folder}, where no chromium is.`);
  return options;
}
