// What the benchmarks measured, as they wrote it with --json into this folder.
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineLoader } from 'vitepress';

/** One row of a table. */
interface Row {
  readonly name: string;
  readonly value: string;
  readonly range: string;
  readonly target: string;
}

/** One benchmark's run: where, when, and its figures. */
interface Results {
  readonly where: string;
  readonly rows: readonly Row[];
}

interface Report {
  readonly machine: { readonly cpu: string; readonly node: string; readonly commit: string; readonly date: string };
  readonly gpu?: { readonly name: string };
  readonly figures: readonly {
    readonly name: string;
    readonly unit: string;
    readonly runs: number;
    readonly min?: number;
    readonly median?: number;
    readonly max?: number;
    readonly mean?: number;
    readonly ci95?: number;
    readonly target?: { readonly value: number; readonly relation: '<=' | '>='; readonly source: string };
  }[];
}

declare const data: Readonly<Record<string, Results>>;
export { data };

const FILES = [
  'paper-cpu',
  'paper-gpu',
  'rays',
  'rays-many',
  'first-image',
  'memory',
  'furnace',
  'film-faults',
  'openpbr-cost',
  'faults-tracer',
  'faults-viewer',
  'faults-cli',
  'soak',
];

const number = (value: number, unit: string) =>
  `${Math.abs(value) >= 1e5 ? Math.round(value).toLocaleString('en') : value === 0 ? '0' : Number(value.toPrecision(4)).toString()}${unit === '1' ? '' : ` ${unit}`}`;

export default defineLoader({
  watch: FILES.map((name) => `./${name}.json`),
  load(): Readonly<Record<string, Results>> {
    const found: Record<string, Results> = {};
    for (const name of FILES) {
      const path = fileURLToPath(new URL(`./${name}.json`, import.meta.url));
      if (!existsSync(path)) continue;
      const { machine, gpu, figures } = JSON.parse(readFileSync(path, 'utf8')) as Report;
      found[name] = {
        where: [gpu?.name, machine.cpu, `Node ${machine.node}`, `commit ${machine.commit}`, machine.date.slice(0, 10)]
          .filter(Boolean)
          .join(', '),
        rows: figures.map(({ name: label, unit, runs, min, median, max, mean, ci95, target }) => ({
          name: label,
          value: number((mean ?? median) as number, unit),
          range:
            ci95 !== undefined
              ? `± ${number(ci95, '1')} (95 %), n = ${runs}`
              : runs > 1
                ? `${number(min as number, '1')} – ${number(max as number, '1')}, n = ${runs}`
                : '',
          target: target
            ? `${(target.relation === '<=' ? ((mean ?? median) as number) <= target.value : ((mean ?? median) as number) >= target.value) ? '✓' : '✗'} ${target.relation === '<=' ? '≤' : '≥'} ${number(target.value, '1')}, ${target.source}`
            : '',
        })),
      };
    }
    return found;
  },
});
