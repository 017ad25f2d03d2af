// The presets out of the sources of @glanz/openpbr, with their images where there are any.
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { OpenPbrParameters } from '@glanz/openpbr/parameters';
import { defineLoader } from 'vitepress';
import { readExport } from '../src/read-export';

/** One preset: its name, its parameters to print, and the address of its image. */
interface Card {
  readonly name: string;
  readonly text: string;
  readonly image: string | undefined;
}

declare const data: readonly Card[];
export { data };

const number = (value: number) => String(Math.round(value * 1000) / 1000);
const print = (value: unknown) =>
  Array.isArray(value)
    ? `[${value.map(number).join(', ')}]`
    : typeof value === 'number'
      ? number(value)
      : String(value);

export default defineLoader({
  watch: ['../../../packages/openpbr/src/presets/*.ts', '../public/presets/*.webp'],
  async load(): Promise<readonly Card[]> {
    const presets = (await readExport('@glanz/openpbr/presets', 'OPENPBR_PRESETS')) as Record<
      string,
      Partial<OpenPbrParameters>
    >;
    return Object.entries(presets).map(([name, parameters]) => ({
      name,
      text: Object.entries(parameters)
        .map(([key, value]) => `${key}: ${print(value)}`)
        .join('\n'),
      image: existsSync(fileURLToPath(new URL(`../public/presets/${name}.webp`, import.meta.url)))
        ? `/presets/${name}.webp`
        : undefined,
    }));
  },
});
