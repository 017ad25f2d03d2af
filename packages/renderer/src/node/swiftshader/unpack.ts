import { existsSync, mkdirSync, mkdtempSync, readFileSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { homedir, tmpdir } from 'node:os';
import { basename, dirname, join } from 'node:path';
import { brotliDecompressSync } from 'node:zlib';
import { readTar } from './tar';
import type { VulkanDriver } from '../vulkan-driver';

const PACKAGE = '@sparticuz/chromium';
const ICD = 'vk_swiftshader_icd.json';
const DRIVER = 'libvk_swiftshader.so';
const LOADER = 'libvulkan.so.1';

/** Folder of the optional package, looked up beside this file first and then from the working directory. */
function packageFolder(): string | undefined {
  for (const from of [import.meta.url, join(process.cwd(), 'package.json')]) {
    try {
      let folder = dirname(createRequire(from).resolve(PACKAGE));
      while (!existsSync(join(folder, 'bin', 'swiftshader.tar.br'))) {
        const parent = dirname(folder);
        if (parent === folder || basename(folder) === 'node_modules') return undefined;
        folder = parent;
      }
      return folder;
    } catch {
      // Not installed as seen from here.
    }
  }
  return undefined;
}

const complete = (folder: string) => [ICD, DRIVER, LOADER].every((file) => existsSync(join(folder, file)));

/** A folder of another user must not be trusted: what lies in it gets loaded into this process. */
function isOwn(folder: string): boolean {
  const uid = process.getuid?.();
  const status = statSync(folder);
  return uid === undefined || (status.uid === uid && (status.mode & 0o022) === 0);
}

/** Places for the inflated files, best first. */
function cacheFolders(version: string): string[] {
  const caches = [
    process.env['XDG_CACHE_HOME'],
    join(homedir(), '.cache'),
    join(tmpdir(), `glanz-${process.getuid?.() ?? 'cache'}`),
  ];
  return caches
    .filter((folder): folder is string => !!folder && folder.startsWith('/'))
    .map((folder) => join(folder, 'glanz', `swiftshader-${version}`));
}

/** Writes the archive's files under `target`; a second process doing the same at the same time does no harm. */
function inflate(archive: string, target: string): void {
  const parent = dirname(target);
  mkdirSync(parent, { recursive: true, mode: 0o700 });
  const work = mkdtempSync(join(parent, 'inflating-'));
  try {
    for (const entry of readTar(brotliDecompressSync(readFileSync(archive)))) {
      const name = basename(entry.name);
      if (name === ICD || name === DRIVER || name === LOADER)
        writeFileSync(join(work, name), entry.data, { mode: 0o700 });
    }
    if (!complete(work)) throw new Error(`${archive} lacks ${ICD}, ${DRIVER} or ${LOADER}`);
    // An incomplete folder (a cleaner's work) is in the way of the rename; a complete one is another process's.
    if (existsSync(target) && !complete(target)) rmSync(target, { recursive: true, force: true });
    try {
      renameSync(work, target);
    } catch (error) {
      if (!complete(target)) throw error;
    }
  } finally {
    rmSync(work, { recursive: true, force: true });
  }
}

/**
 * SwiftShader, with a Vulkan loader, out of the npm package `@sparticuz/chromium` (Linux x64), inflated once into the
 * user's cache folder.
 *
 * @returns The driver, or in one sentence why there is none.
 */
export function packagedSwiftShader(): VulkanDriver | string {
  if (process.platform !== 'linux' || process.arch !== 'x64') return `${PACKAGE} serves Linux x64 only`;
  const folder = packageFolder();
  if (!folder) return `${PACKAGE} is not installed`;
  const version =
    (JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')) as { version?: string }).version ?? 'unknown';
  let reason = '';
  for (const cache of cacheFolders(version)) {
    try {
      if (!existsSync(cache) || !complete(cache)) inflate(join(folder, 'bin', 'swiftshader.tar.br'), cache);
      if (!isOwn(cache)) throw new Error(`${cache} belongs to, or can be written by, another user`);
      return { name: `SwiftShader of ${PACKAGE}`, icd: join(cache, ICD), loader: join(cache, LOADER) };
    } catch (error) {
      reason = (error as Error).message;
    }
  }
  return `${PACKAGE} cannot be inflated: ${reason}`;
}
