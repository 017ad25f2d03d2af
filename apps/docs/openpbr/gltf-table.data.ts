// The table of the mapping out of the comment of `fromGltf`; no copy of it lies here.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineLoader } from 'vitepress';

/** One line: what glTF has, what it becomes, what is lost. */
type Row = readonly [gltf: string, openpbr: string, lost: string];

declare const data: readonly Row[];
export { data };

const SOURCE = fileURLToPath(new URL('../../../packages/openpbr/src/gltf/from-gltf.ts', import.meta.url));

export default defineLoader({
  watch: ['../../../packages/openpbr/src/gltf/from-gltf.ts'],
  load(): readonly Row[] {
    const rows = readFileSync(SOURCE, 'utf8').matchAll(/^ \* \|(.*)\|$/gm);
    // The first two lines are the head.
    return [...rows].slice(2).map(([, cells = '']) => cells.split('|').map((cell) => cell.trim()) as unknown as Row);
  },
});
