import { readdirSync, readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { GlanzError, loadPart } from '../src/index';

it('gives what a part exports', async () => {
  expect(await loadPart('data', Promise.resolve({ value: 3 }))).toEqual({ value: 3 });
});

it('reports a file that cannot be loaded by a code, with the part, what the browser says, and what to do', async () => {
  const cause = new TypeError('Failed to fetch dynamically imported module: https://a.example/stage-1a2b.js');
  const error: unknown = await loadPart('stage', Promise.reject(cause)).catch((reason: unknown) => reason);
  expect(error).toBeInstanceOf(GlanzError);
  expect(error).toMatchObject({ code: 'wgsl/chunk', cause });
  expect((error as Error).message).toMatch(/"stage".*stage-1a2b\.js.*In a page, reload it/);
});

/** Imports whose failure has no consequence, or another one: file and module. */
const OTHERS = new Set([
  // Prefetched: what needs it asks again.
  'renderer/src/session/film-session.ts ../film/film-data',
  // Without it, threads do the work; frames keep their noise; there is no prompt; the page's thread reads the model.
  'denoise/src/layer-shapes.ts ./kernels/choose-matrices',
  'viewer/src/preview-reuse.ts ./realtime',
  'element/src/element.ts ./prompt',
  'viewer/src/load.ts @glanz/gltf/workers',
  // The component imports no value: what it loads brings the first ones.
  'react/src/declared-look.ts @glanz/openpbr/parameters',
  'react/src/glanz-viewer.ts ./declared-look',
  'react/src/glanz-viewer.ts @glanz/element',
  // `element/decoder`.
  'element/src/decoders/index.ts ./draco',
  'element/src/decoders/index.ts ./basis',
]);

it('is asked for all parts that pages load later', () => {
  const found = new Set<string>();
  const packages = new URL('../../', import.meta.url);
  for (const name of [
    'renderer',
    'viewer',
    'element',
    'gltf',
    'denoise',
    'three',
    'react',
    'openpbr',
    'scene',
    'bvh',
    'formats',
    'image',
  ])
    for (const file of readdirSync(new URL(`${name}/src/`, packages), { recursive: true, encoding: 'utf8' })) {
      if (!file.endsWith('.ts') || /(^|[\\/])node\b/.test(file)) continue;
      const text = readFileSync(new URL(`${name}/src/${file}`, packages), 'utf8').replaceAll(/^\s*(\*|\/\/).*$/gm, '');
      for (const [, before, module] of text.matchAll(/(loadPart\(\s*'[\w-]+',\s*)?\bimport\('([^']+)'\)/g))
        if (!before && /^(\.|@glanz\/)/.test(module!)) found.add(`${name}/src/${file.replaceAll('\\', '/')} ${module}`);
    }
  expect([...found].sort()).toEqual([...OTHERS].sort());
});
