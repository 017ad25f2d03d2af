// The manual page out of the command's own sources.
import { defineLoader } from 'vitepress';
import { readExport } from '../src/read-export';

declare const data: string;
export { data };

export default defineLoader({
  watch: ['../../../packages/cli/src/{help,render-flags}.ts', '../../../packages/renderer/src/render-options/*.ts'],
  load: async (): Promise<string> => (await readExport('../../../packages/cli/src/help.ts', 'HELP')) as string,
});
