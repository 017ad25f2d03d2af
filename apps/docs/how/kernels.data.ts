// Where the time of a sample goes, as `npm run bench -- paper-gpu` measured it.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineLoader } from 'vitepress';

/** One level of detail of the push-button. */
interface Level {
  readonly triangles: number;
  /** GPU time of a sample. */
  readonly milliseconds: number;
  /** Percent of it, by kernel. */
  readonly shares: Readonly<Record<string, number>>;
}

declare const data: { readonly levels: readonly Level[]; /** The GPU. */ readonly where: string };
export { data };

interface Report {
  readonly gpu: { readonly name: string };
  readonly figures: readonly { readonly name: string; readonly mean?: number; readonly median?: number }[];
}

const FILE = '../results/paper-gpu.json';

export default defineLoader({
  watch: [FILE],
  load(): typeof data {
    const { gpu, figures } = JSON.parse(readFileSync(fileURLToPath(new URL(FILE, import.meta.url)), 'utf8')) as Report;
    const values = new Map(figures.map(({ name, mean, median }) => [name, (mean ?? median)!]));
    const levels = ['low', 'medium', 'high'].map((level): Level => {
      const start = `${level}: share of `;
      const shares = [...values].filter(([name]) => name.startsWith(start));
      return {
        triangles: values.get(`${level}: triangles`)!,
        milliseconds: values.get(`${level}: GPU time per sample`)!,
        shares: Object.fromEntries(shares.map(([name, share]) => [name.slice(start.length), share])),
      };
    });
    return { levels, where: gpu.name };
  },
});
