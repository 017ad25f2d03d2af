import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { describe, expect, it } from 'vitest';
import { GlanzError } from '@glanz/wgsl';

type ErrorModule = { readonly GlanzError: new (code: string, message: string) => Error };

const PAGE = 'https://glanz.example/guide/errors';

/** The module as it is published, then bundled by a user whose bundler replaces the mode. */
async function bundled(mode: string | undefined, page: string | undefined): Promise<ErrorModule> {
  const define = {
    ...(page === undefined ? {} : { GLANZ_ERRORS_PAGE: JSON.stringify(page) }),
    ...(mode === undefined ? {} : { 'process.env.NODE_ENV': JSON.stringify(mode) }),
  };
  const source = fileURLToPath(new URL('../src/error.ts', import.meta.url));
  const { outputFiles } = await build({
    entryPoints: [source],
    bundle: true,
    format: 'esm',
    platform: 'neutral',
    minifySyntax: true,
    define,
    write: false,
  });
  return import(`data:text/javascript,${encodeURIComponent(outputFiles[0]!.text)}`) as Promise<ErrorModule>;
}

describe('GlanzError', () => {
  it('has its code, its message and the name of its class', () => {
    class MeshError extends GlanzError {}
    const error = new MeshError('mesh/empty', 'The mesh has no triangles.', { cause: 7, location: { file: 'a.glb' } });
    expect(error).toMatchObject({
      name: 'MeshError',
      code: 'mesh/empty',
      message: 'The mesh has no triangles.',
      cause: 7,
      location: { file: 'a.glb' },
    });
  });

  it('ends with the address of its paragraph in development builds', async () => {
    const development = await bundled('development', PAGE);
    expect(new development.GlanzError('mesh/no-uvs', 'No.').message).toBe(`No. See ${PAGE}#mesh-no-uvs`);
  });

  it('has the message alone in production, without a bundler, and while the project has no address', async () => {
    for (const [mode, page] of [
      ['production', PAGE],
      [undefined, PAGE],
      ['development', undefined],
    ] as const) {
      const module = await bundled(mode, page);
      expect(new module.GlanzError('mesh/no-uvs', 'No.').message, `${mode}, ${page}`).toBe('No.');
    }
  });
});
