// The table of render options out of the sources of @glanz/renderer; no copy of it lies here.
import type { RenderOption, RenderOptionText } from '@glanz/renderer/options';
import { defineLoader } from 'vitepress';
import { optionRows, type OptionRow } from '../src/option-rows';
import { readExport } from '../src/read-export';

declare const data: OptionRow[];
export { data };

export default defineLoader({
  watch: ['../../../packages/renderer/src/render-options/*.ts', '../../../packages/element/src/attributes.ts'],
  load: async (): Promise<OptionRow[]> =>
    optionRows(
      (await readExport('@glanz/renderer/options', 'RENDER_OPTIONS')) as Record<string, RenderOption>,
      (await readExport('@glanz/renderer/options', 'RENDER_OPTION_TEXTS')) as Record<string, RenderOptionText>,
      Object.keys((await readExport('../../../packages/element/src/attributes.ts', 'ATTRIBUTES')) as object),
      (await readExport('../../../packages/cli/src/help.ts', 'HELP')) as string,
    ),
});
