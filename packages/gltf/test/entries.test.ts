import { execFile } from 'node:child_process';
import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { build } from 'esbuild';
import { describe, expect, test, vi } from 'vitest';
import type { GltfError } from '../src/index';

const source = (name: string) => fileURLToPath(new URL(`../src/${name}.ts`, import.meta.url));

describe('importing an entry does nothing', () => {
  test.each(['index', 'node'])(
    '%s: in a bare Node without browser globals, and no optional package is loaded',
    async (name) => {
      const { outputFiles } = await build({
        entryPoints: [source(name)],
        bundle: true,
        write: false,
        format: 'esm',
        platform: 'node',
        conditions: ['@glanz/source'],
        external: ['sharp', 'draco3dgltf', 'meshoptimizer'],
        logLevel: 'silent',
      });
      // A static import of an optional package would stand at the start of a line of the bundle.
      expect(outputFiles[0]!.text).not.toMatch(/^import .*["'](sharp|draco3dgltf|meshoptimizer)/m);
      const folder = await mkdtemp(join(tmpdir(), 'gltf-'));
      try {
        await writeFile(join(folder, 'entry.mjs'), outputFiles[0]!.contents);
        await writeFile(
          join(folder, 'main.mjs'),
          `const before = Object.keys(globalThis).length; await import('./entry.mjs'); console.log(Object.keys(globalThis).length - before);`,
        );
        const { stdout, stderr } = await promisify(execFile)(process.execPath, [join(folder, 'main.mjs')]);
        expect([stdout.trim(), stderr]).toEqual(['0', '']);
      } finally {
        await rm(folder, { recursive: true });
      }
    },
  );
});

test('without sharp, the error names it', async () => {
  vi.resetModules();
  vi.doMock('sharp', () => {
    throw new Error('Cannot find package');
  });
  const { decodeImage } = await import('../src/node');
  const error: unknown = await decodeImage(new Uint8Array(8), 'image/png').catch((e: unknown) => e);
  vi.doUnmock('sharp');
  expect((error as GltfError).code).toBe('gltf/missing-decoder');
  expect((error as GltfError).message).toMatch(/"sharp": npm install sharp/);
});

test('without a browser, loadGltf says what decodes images', async () => {
  const { decodeImageInBrowser } = await import('../src/browser-images');
  await expect(decodeImageInBrowser(new Uint8Array(8), 'image/png')).rejects.toThrow(/loadGltfFile\(\)/);
});
