import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { weslSource } from '../../../tools/pipeline/wesl.mjs';

/**
 * Evaluates one export of a module of this repository, from sources, at build time: pages that document code read it
 * instead of copying it.
 *
 * @param specifier A package entry, or a path relative to this folder.
 */
export async function readExport(specifier: string, name: string): Promise<unknown> {
  const { outputFiles } = await build({
    stdin: {
      contents: `export { ${name} as value } from '${specifier}';`,
      resolveDir: fileURLToPath(new URL('.', import.meta.url)),
    },
    conditions: ['@glanz/source'],
    bundle: true,
    format: 'esm',
    platform: 'neutral',
    plugins: [weslSource()],
    write: false,
  });
  const { value } = (await import(
    `data:text/javascript;base64,${Buffer.from(outputFiles[0]!.contents).toString('base64')}`
  )) as { value: unknown };
  return value;
}
