// Reads the parameter table out of the sources of @glanz/openpbr when the site is built; no copy of it lies here.
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { defineLoader } from 'vitepress';
import { parameterRows } from '../src/parameter-rows';

type Rows = ReturnType<typeof parameterRows>;

declare const data: Rows;
export { data };

export default defineLoader({
  watch: ['../../../packages/openpbr/src/parameters/*.ts'],
  async load(): Promise<Rows> {
    const bundle = await build({
      stdin: { contents: `export { OPENPBR_PARAMETERS } from '@glanz/openpbr/parameters';`, resolveDir: fileURLToPath(new URL('..', import.meta.url)) },
      conditions: ['@glanz/source'],
      bundle: true,
      format: 'esm',
      write: false,
    });
    const { OPENPBR_PARAMETERS } = (await import(`data:text/javascript;base64,${Buffer.from(bundle.outputFiles[0]!.contents).toString('base64')}`)) as typeof import('@glanz/openpbr/parameters');
    return parameterRows(OPENPBR_PARAMETERS);
  },
});
