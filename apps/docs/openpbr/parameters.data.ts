// The parameter table out of the sources of @glanz/openpbr; no copy of it lies here.
import type { OpenPbrParameterInfo } from '@glanz/openpbr/parameters';
import { defineLoader } from 'vitepress';
import { parameterRows } from '../src/parameter-rows';
import { readExport } from '../src/read-export';

type Rows = ReturnType<typeof parameterRows>;

declare const data: Rows;
export { data };

export default defineLoader({
  watch: ['../../../packages/openpbr/src/parameters/*.ts'],
  load: async (): Promise<Rows> => parameterRows((await readExport('@glanz/openpbr/parameters', 'OPENPBR_PARAMETERS')) as Record<string, OpenPbrParameterInfo>),
});
