import { defineConfig } from 'tsup';
import rootManifest from './package.json' with { type: 'json' };
import { emitDeclarations } from './tools/pipeline/declarations.mjs';
import { errorsPage } from './tools/pipeline/manifest.mjs';
import { publishedSource } from './tools/pipeline/published-source.mjs';

const page = errorsPage(rootManifest);

/**
 * One build recipe for every package: ESM with declarations, one file per entry, chunks shared between entries.
 * `entries` maps the name of the output file to its source file. `client` writes `'use client'` into each file, which a
 * package of React components needs under server components; `directives` keeps those that sources of entries begin with.
 */
export function glanzPackage(
  entries: Record<string, string>,
  options: {
    readonly external?: readonly string[];
    readonly platform?: 'node' | 'neutral';
    readonly client?: boolean;
    readonly directives?: boolean;
  } = {},
) {
  let declarations: Record<string, string> | undefined;
  return defineConfig({
    entry: entries,
    format: ['esm'],
    target: 'es2022',
    platform: options.platform ?? 'neutral',
    sourcemap: true,
    clean: true,
    // Rollup, which does this second pass, removes directives, banner included; esbuild's own pass keeps them.
    treeshake: !options.client && !options.directives,
    ...(options.client ? { banner: { js: "'use client';" } } : {}),
    splitting: true,
    // Without an address the name stays, and errors end without a link.
    define: page === undefined ? {} : { GLANZ_ERRORS_PAGE: JSON.stringify(page) },
    external: [...(options.external ?? [])],
    esbuildPlugins: [publishedSource],
    dts: {
      // When tsup asks for it: tools read these recipes without building.
      get entry() {
        return (declarations ??= emitDeclarations(process.cwd(), entries));
      },
      compilerOptions: { ignoreDeprecations: '6.0', customConditions: [], types: [] },
    },
  });
}
