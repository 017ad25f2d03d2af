// The parameter table out of the sources of @glanz/openpbr; no copy of it lies here.
import type { OpenPbrParameterInfo } from '@glanz/openpbr/parameters';
import { defineLoader } from 'vitepress';
import { parameterRows } from '../src/parameter-rows';
import { readExport } from '../src/read-export';

type Rows = ReturnType<typeof parameterRows>;

declare const data: Rows;
export { data };

export default defineLoader({
  watch: ['../../../packages/openpbr/src/{parameters,wgsl}/*.ts'],
  async load(): Promise<Rows> {
    const table = (await readExport('@glanz/openpbr/parameters', 'OPENPBR_PARAMETERS')) as Record<
      string,
      OpenPbrParameterInfo
    >;
    const acting = (await readExport('./acting', 'actingParameters')) as () => string[];
    return parameterRows(table, acting());
  },
});
