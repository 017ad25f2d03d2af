import { existsSync, readdirSync } from 'node:fs';
import { homedir, constants } from 'node:os';
import { dirname, join } from 'node:path';
import { isMainThread } from 'node:worker_threads';

/** A Vulkan driver that can be switched to by name of its manifest. */
export interface VulkanDriver {
  /** For messages. */
  readonly name: string;
  /** The driver's manifest (`*_icd.json`). */
  readonly icd: string;
  /** A Vulkan loader to use if the machine has none. */
  readonly loader?: string;
}

/** Variables that tell the Vulkan loader which drivers to use; loaders before 1.3.207 know the second only. */
const VARIABLES = ['VK_DRIVER_FILES', 'VK_ICD_FILENAMES'] as const;

/** Values of {@link VARIABLES}, to be put back. */
export type DriverEnvironment = Readonly<Record<(typeof VARIABLES)[number], string | undefined>>;

/** The driver choice now in the environment. */
export function driverEnvironment(): DriverEnvironment {
  return { VK_DRIVER_FILES: process.env['VK_DRIVER_FILES'], VK_ICD_FILENAMES: process.env['VK_ICD_FILENAMES'] };
}

/** Puts a driver choice back. */
export function restoreDriverEnvironment(environment: DriverEnvironment): void {
  for (const name of VARIABLES) {
    if (environment[name] === undefined) delete process.env[name];
    else process.env[name] = environment[name];
  }
}

/**
 * Whether drivers can be switched here: the environment of a worker thread is a copy that the Vulkan loader never sees.
 */
export function canSwitchDrivers(): boolean {
  return isMainThread && process.platform === 'linux';
}

const RTLD_NODELETE = 0x1000;

/** Makes the Vulkan loader use this driver alone, from the next instance on. */
export function switchToDriver(driver: VulkanDriver): void {
  for (const name of VARIABLES) process.env[name] = driver.icd;
  if (!driver.loader || !existsSync(driver.loader)) return;
  try {
    process.dlopen(
      { exports: {} },
      driver.loader,
      constants.dlopen.RTLD_NOW | constants.dlopen.RTLD_GLOBAL | RTLD_NODELETE,
    );
  } catch {
    // It always throws, a Vulkan loader being no Node add-on, but stays mapped, where Dawn finds it by its name.
  }
}

const list = (folder: string): string[] => {
  try {
    return readdirSync(folder).sort();
  } catch {
    return [];
  }
};

/** Mesa's software rasteriser, where it is installed. */
export function installedLavapipe(): VulkanDriver | undefined {
  for (const folder of ['/etc/vulkan/icd.d', '/usr/local/share/vulkan/icd.d', '/usr/share/vulkan/icd.d']) {
    const file = list(folder).find((name) => /^lvp_icd.*\.json$/.test(name));
    if (file) return { name: 'lavapipe', icd: join(folder, file) };
  }
  return undefined;
}

/** SwiftShader as installed Chromium and Chrome browsers bring it, Playwright's among them. */
export function chromiumSwiftShaders(): VulkanDriver[] {
  const playwright = process.env['PLAYWRIGHT_BROWSERS_PATH'] ?? join(homedir(), '.cache', 'ms-playwright');
  const folders = [
    '/usr/lib/chromium',
    '/usr/lib/chromium-browser',
    '/usr/lib64/chromium-browser',
    '/opt/google/chrome',
    '/opt/chromium.org/chromium',
    '/snap/chromium/current/usr/lib/chromium-browser',
    ...list(playwright)
      .filter((name) => name.startsWith('chromium'))
      .flatMap((name) => list(join(playwright, name)).map((inner) => join(playwright, name, inner))),
  ];
  return folders
    .map((folder) => join(folder, 'vk_swiftshader_icd.json'))
    .filter((icd) => existsSync(icd))
    .map((icd) => ({ name: `SwiftShader of ${dirname(icd)}`, icd, loader: join(dirname(icd), 'libvulkan.so.1') }));
}
