import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { geometricMean } from '../loading/report';
import { TINYBVH } from './tinybvh';

/** Smallest, middle and largest of repeated times, milliseconds. */
export interface Spread {
  readonly min: number;
  readonly median: number;
  readonly max: number;
}

/** A mesh with every builder's times, costs, and what diffuse rays look at. */
export interface MeshRow {
  readonly name: string;
  readonly triangles: number;
  readonly times: Readonly<Record<string, Spread>>;
  readonly costs: Readonly<Record<string, number>>;
  /** Nodes and triangles per diffuse ray. */
  readonly diffuse: Readonly<Record<string, number>>;
}

/** What the page of the docs is made of. */
export interface BvhDetails {
  readonly runs: number;
  readonly rows: readonly MeshRow[];
  readonly threads: { readonly mesh: string; readonly cold: number; readonly warm: Spread; readonly one: Spread; readonly two: Spread; readonly alone: Spread; readonly together: Spread; readonly sliced: Spread; readonly longest: Spread };
}

interface Report<T> {
  readonly quick: boolean;
  readonly machine: { readonly cpu: string; readonly cores: number; readonly node: string; readonly commit?: string | undefined; readonly date: string };
  readonly details?: T;
  readonly figures?: readonly { readonly name: string; readonly unit: string; readonly mean?: number; readonly ci95?: number; readonly median?: number }[];
}

export function spreadOf(values: readonly number[]): Spread {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = (sorted.length - 1) / 2;
  return { min: sorted[0]!, median: (sorted[Math.floor(middle)]! + sorted[Math.ceil(middle)]!) / 2, max: sorted[sorted.length - 1]! };
}

const digits = (value: number) => (value < 10 ? value.toFixed(2) : value < 100 ? value.toFixed(1) : Math.round(value).toLocaleString('en'));
const spread = ({ min, median, max }: Spread) => `${digits(median)} (${digits(min)} – ${digits(max)})`;
const times = (value: number) => `${value.toFixed(2)}×`;

const SAH = 'three-mesh-bvh SAH', SAH_10 = 'three-mesh-bvh SAH, leaves of 10', CENTER = 'three-mesh-bvh CENTER';

/** How many times as long as tinybvh's our builds take, linked by three-mesh-bvh's times, each way that there is. */
export function overTinybvh(rows: readonly MeshRow[]): { readonly mesh: string; readonly byCenter: number; readonly bySah: number }[] {
  return TINYBVH.flatMap(({ here, avx2, center, sah10 }) => {
    const row = rows.find(({ name }) => name === here);
    if (!row?.times[SAH_10] || !row.times[CENTER] || !row.times['balanced']) return [];
    const own = row.times['balanced'].min;
    return [{ mesh: here, byCenter: center / avx2 / (row.times[CENTER].min / own), bySah: sah10 / avx2 / (row.times[SAH_10].min / own) }];
  });
}

const table = (head: readonly string[], rows: readonly (readonly string[])[]) => [`| ${head.join(' | ')} |`, `| ${head.map((_, i) => (i === 0 ? '---' : '--:')).join(' | ')} |`, ...rows.map((row) => `| ${row.join(' | ')} |`)].join('\n');

/** The page of the documentation. */
export function bvhMarkdown({ machine, details }: Report<BvhDetails> & { readonly details: BvhDetails }, paper?: Report<unknown>): string {
  const { rows, runs, threads } = details;
  const ratio = (name: string) => rows.map((row) => row.times[name]!.min / row.times['balanced']!.min);
  const costs = rows.map((row) => row.costs['balanced']! / row.costs[SAH]!);
  const tiny = overTinybvh(rows);
  const ratios = (name: string) => table(
    ['mesh', 'triangles', 'balanced, ms', `SAH, ms`, 'CENTER, ms', 'SAH : balanced', 'CENTER : balanced', 'cost of balanced : SAH'],
    rows.map((row, i) => [row.name, row.triangles.toLocaleString('en'), spread(row.times['balanced']!), spread(row.times[name]!), spread(row.times[CENTER]!), times(ratio(name)[i]!), times(ratio(CENTER)[i]!), costs[i]!.toFixed(3)]),
  );
  const shownBuilders = ['balanced', 'fast', 'best', 'best-split', SAH, CENTER];
  const shown = paper?.figures?.filter(({ mean }) => mean !== undefined) ?? [];
  return `# Hierarchies

How long [@glanz/bvh](../packages/bvh) builds, beside [three-mesh-bvh](https://github.com/gkjohnson/three-mesh-bvh) on the same meshes in the same process, in turns, one thread, after a first round that does not count. Median (least – largest) of ${runs} builds; ratios are of the least times. SAH has leaves of 4 triangles as ours have; one evaluator gives the surface area cost of all trees (1 a node, 1 a triangle).

${ratios(SAH)}

- SAH : balanced, geometric mean **${times(geometricMean(ratio(SAH)))}**, least **${times(Math.min(...ratio(SAH)))}** (asked: 4×, never under 3×)
- CENTER : balanced, geometric mean **${times(geometricMean(ratio(CENTER)))}** (asked: 1×)
- cost of balanced : SAH, geometric mean **${geometricMean(costs).toFixed(3)}** (asked: at most 1)

## Builders

Nodes and triangles that a diffuse ray looks at (counted, the same rays for all), and least times.

${table(['mesh', ...shownBuilders], rows.map((row) => [row.name, ...shownBuilders.map((name) => `${row.diffuse[name]!.toFixed(1)} in ${digits(row.times[name]!.min)} ms`)]))}

## Beside C++

tinybvh's AVX2 builder does not run here: three-mesh-bvh links it. Ours over tinybvh's is three-mesh-bvh's over tinybvh's, measured once on one machine, over three-mesh-bvh's over ours in this run.

${table(['mesh', 'linked by CENTER', 'linked by SAH with leaves of 10'], tiny.map(({ mesh, byCenter, bySah }) => [mesh, times(byCenter), times(bySah)]))}

Geometric mean: **${times(geometricMean(tiny.flatMap(({ byCenter, bySah }) => [byCenter, bySah])))}** of tinybvh's AVX2 time (asked: at most 2×).

## Threads

With ${threads.mesh}:

- first build in a fresh thread ${digits(threads.cold)} ms, further ones ${spread(threads.warm)} ms: **${times(threads.cold / threads.warm.median)}** (asked: at most 2×)
- one mesh on one worker ${spread(threads.alone)} ms, on two together ${spread(threads.together)} ms: **${times(threads.alone.min / threads.together.min)}** as fast (asked: 1.6×)
- four such meshes on one worker ${spread(threads.one)} ms, on two ${spread(threads.two)} ms: **${times(threads.one.min / threads.two.min)}** as fast (asked: 1.6×)
- in slices on the main thread ${spread(threads.sliced)} ms, the longest slice ${spread(threads.longest)} ms (asked: at most 16)
${shown.length === 0 ? '' : `
## The paper's table

Setting up the hierarchy of a push-button in three resolutions, everything up to buffers that can be uploaded; strahl (2025) does so by three-mesh-bvh's CENTER split. Mean ± half of the 95 % interval of 30 runs.

${table(['what', 'mean ± 95 %'], shown.map(({ name, unit, mean, ci95 }) => [name, unit === '1' ? `${times(mean!)} ± ${ci95!.toFixed(2)}` : `${digits(mean!)} ± ${digits(ci95!)} ${unit}`]))}

Measured on ${paper!.machine.cpu}, Node ${paper!.machine.node}, commit ${paper!.machine.commit ?? 'unknown'}, ${paper!.machine.date.slice(0, 10)}.
`}
Measured on ${machine.cpu}, ${machine.cores} cores, Node ${machine.node}, commit ${machine.commit ?? 'unknown'}, ${machine.date.slice(0, 10)}. \`npm run bench -- bvh --pages apps/docs/results\` and \`npm run bench -- paper-cpu --pages apps/docs/results\` write this page; the data are in \`bvh.json\`${shown.length === 0 ? '' : ' and `paper-cpu.json`'}.
`;
}

/** Writes a report into the folder, and the page from all that is there. */
export function writeBvhPage(name: 'bvh' | 'paper-cpu', report: object, folder: string): string[] {
  mkdirSync(folder, { recursive: true });
  const file = (which: string) => join(folder, `${which}.json`);
  writeFileSync(file(name), `${JSON.stringify(report, null, 1)}\n`);
  const read = <T>(which: string) => (existsSync(file(which)) ? (JSON.parse(readFileSync(file(which), 'utf8')) as Report<T>) : undefined);
  const bvh = read<BvhDetails>('bvh');
  if (!bvh?.details) return [file(name)];
  writeFileSync(join(folder, 'bvh.md'), bvhMarkdown({ ...bvh, details: bvh.details }, read('paper-cpu')));
  return [file(name), join(folder, 'bvh.md')];
}
