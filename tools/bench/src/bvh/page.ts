import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { geometricMean } from '../geometric-mean';
import { TINYBVH } from './tinybvh';

/** Minimum, median and maximum of repeated times, milliseconds. */
export interface Spread {
  readonly min: number;
  readonly median: number;
  readonly max: number;
}

/** A mesh with the build times, the tree costs and the traversal cost of diffuse rays, by builder. */
export interface MeshRow {
  readonly name: string;
  readonly triangles: number;
  readonly times: Readonly<Record<string, Spread>>;
  readonly costs: Readonly<Record<string, number>>;
  /** Nodes and triangles that a diffuse ray visits, mean. */
  readonly diffuse: Readonly<Record<string, number>>;
}

/** The data of the documentation page. */
export interface BvhDetails {
  readonly runs: number;
  readonly rows: readonly MeshRow[];
  readonly threads: {
    readonly mesh: string;
    readonly cold: number;
    readonly warm: Spread;
    readonly one: Spread;
    readonly two: Spread;
    readonly parts?: { readonly name: string; readonly one: Spread; readonly two: Spread };
    readonly alone: Spread;
    readonly together: Spread;
    readonly sliced: Spread;
    readonly longest: Spread;
  };
}

/** Results of the comparison with brute force. */
export interface BruteDetails {
  readonly seed: number;
  readonly scenes: number;
  readonly rays: number;
  readonly wrong: number;
  readonly gpuRays: number;
  readonly gpuWrong: number;
}

interface Report<T> {
  readonly quick: boolean;
  readonly machine: {
    readonly cpu: string;
    readonly cores: number;
    readonly node: string;
    readonly commit?: string | undefined;
    readonly date: string;
  };
  readonly details?: T;
  readonly notes?: readonly string[];
  readonly figures?: readonly {
    readonly name: string;
    readonly unit: string;
    readonly mean?: number;
    readonly ci95?: number;
    readonly median?: number;
  }[];
}

export function spreadOf(values: readonly number[]): Spread {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = (sorted.length - 1) / 2;
  return {
    min: sorted[0]!,
    median: (sorted[Math.floor(middle)]! + sorted[Math.ceil(middle)]!) / 2,
    max: sorted[sorted.length - 1]!,
  };
}

const digits = (value: number) =>
  value < 10 ? value.toFixed(2) : value < 100 ? value.toFixed(1) : Math.round(value).toLocaleString('en');
const spread = ({ min, median, max }: Spread) => `${digits(median)} (${digits(min)} – ${digits(max)})`;
const times = (value: number) => `${value.toFixed(2)}×`;

const SAH = 'three-mesh-bvh SAH',
  SAH_10 = 'three-mesh-bvh SAH, leaves of 10',
  CENTER = 'three-mesh-bvh CENTER';

/** Build times of `balanced` over those of tinybvh, estimated through three-mesh-bvh's times: see {@link TINYBVH}. */
export function overTinybvh(
  rows: readonly MeshRow[],
): { readonly mesh: string; readonly byCenter: number; readonly bySah: number }[] {
  return TINYBVH.flatMap(({ here, avx2, center, sah10 }) => {
    const row = rows.find(({ name }) => name === here);
    if (!row?.times[SAH_10] || !row.times[CENTER] || !row.times['balanced']) return [];
    const own = row.times['balanced'].min;
    return [
      {
        mesh: here,
        byCenter: center / avx2 / (row.times[CENTER].min / own),
        bySah: sah10 / avx2 / (row.times[SAH_10].min / own),
      },
    ];
  });
}

const table = (head: readonly string[], rows: readonly (readonly string[])[]) =>
  [
    `| ${head.join(' | ')} |`,
    `| ${head.map((_, i) => (i === 0 ? '---' : '--:')).join(' | ')} |`,
    ...rows.map((row) => `| ${row.join(' | ')} |`),
  ].join('\n');

/** Minimum times of a builder over those of `balanced`, mesh by mesh. */
const ratiosOf = (rows: readonly MeshRow[], name: string) =>
  rows.map((row) => row.times[name]!.min / row.times['balanced']!.min);

/** Times and tree costs beside three-mesh-bvh's, with their ratios. */
function beside(rows: readonly MeshRow[]): string {
  const sah = ratiosOf(rows, SAH),
    center = ratiosOf(rows, CENTER);
  const costs = rows.map((row) => row.costs['balanced']! / row.costs[SAH]!);
  return `${table(
    [
      'mesh',
      'triangles',
      'balanced, ms',
      `SAH, ms`,
      'CENTER, ms',
      'SAH : balanced',
      'CENTER : balanced',
      'cost of balanced : SAH',
    ],
    rows.map((row, i) => [
      row.name,
      row.triangles.toLocaleString('en'),
      spread(row.times['balanced']!),
      spread(row.times[SAH]!),
      spread(row.times[CENTER]!),
      times(sah[i]!),
      times(center[i]!),
      costs[i]!.toFixed(3),
    ]),
  )}

- SAH : balanced, geometric mean **${times(geometricMean(sah))}**, minimum **${times(Math.min(...sah))}** (target: mean at least 4×, every mesh at least 3×)
- CENTER : balanced, geometric mean **${times(geometricMean(center))}** (target: at least 1×)
- cost of balanced : SAH, geometric mean **${geometricMean(costs).toFixed(3)}** (target: at most 1)`;
}

/** Traversal cost of diffuse rays in the trees of all builders, and build times. */
function buildersTable(rows: readonly MeshRow[]): string {
  const shown = ['balanced', 'fast', 'best', 'best-split', SAH, CENTER];
  const relative = (name: string) => {
    const list = ratiosOf(rows, name);
    return `${times(geometricMean(list))} (${times(Math.min(...list))} – ${times(Math.max(...list))})`;
  };
  return table(
    ['mesh', ...shown],
    [
      ...rows.map((row) => [
        row.name,
        ...shown.map((name) => `${row.diffuse[name]!.toFixed(1)} in ${digits(row.times[name]!.min)} ms`),
      ]),
      [
        'time : balanced, geometric mean (min – max)',
        ...shown.map((name) => (name === 'balanced' ? '1' : relative(name))),
      ],
    ],
  );
}

function threadsList({
  mesh,
  cold,
  warm,
  alone,
  together,
  one,
  two,
  parts,
  sliced,
  longest,
}: BvhDetails['threads']): string {
  return `With ${mesh}:

- first build in a new thread ${digits(cold)} ms, later builds ${spread(warm)} ms: **${times(cold / warm.median)}** (target: at most 2×)
- one mesh: ${spread(alone)} ms on one worker, ${spread(together)} ms on two workers that build it together: **${times(alone.min / together.min)}** as fast (target: at least 1.6×)
- four such meshes: ${spread(one)} ms on one worker, ${spread(two)} ms on two: **${times(one.min / two.min)}** as fast (target: at least 1.6×)${
    parts
      ? `
- ${parts.name}: ${spread(parts.one)} ms on one worker, ${spread(parts.two)} ms on two: **${times(parts.one.min / parts.two.min)}** as fast (target: at least 1.6×)`
      : ''
  }
- in slices on the main thread: ${spread(sliced)} ms, longest slice ${spread(longest)} ms (target: at most 16 ms)`;
}

function tinyList(rows: readonly MeshRow[]): string {
  const tiny = overTinybvh(rows);
  return `${table(
    ['mesh', 'estimate through CENTER', 'estimate through SAH, leaves of 10'],
    tiny.map(({ mesh, byCenter, bySah }) => [mesh, times(byCenter), times(bySah)]),
  )}

Geometric mean: \`balanced\` takes **${times(geometricMean(tiny.flatMap(({ byCenter, bySah }) => [byCenter, bySah])))}** the time of tinybvh's AVX2 builder (target: at most 2×).`;
}

/** Meshes of parts, as CAD programs write them. */
const CAD_LIKE = /push-button|CAD/;

/** How many visits diffuse rays save in the trees of `best`. */
function gains(rows: readonly MeshRow[]): string {
  const of = (some: readonly MeshRow[]) =>
    (1 - geometricMean(some.map(({ diffuse }) => diffuse['best']! / diffuse['balanced']!))) * 100;
  const parts = rows.filter(({ name }) => CAD_LIKE.test(name));
  return `In CAD-like meshes, which consist of many parts (${parts.map(({ name }) => name).join(', ')}), diffuse rays visit **${of(parts).toFixed(1)} %** fewer nodes and triangles in trees of \`best\` than in those of \`balanced\` (target: at least 15 %).`;
}

/** The page of the documentation. */
export function bvhMarkdown(
  { machine, details }: Report<BvhDetails> & { readonly details: BvhDetails },
  paper?: Report<unknown>,
  small?: Report<BvhDetails>,
  brute?: Report<BruteDetails>,
  brief?: Report<BvhDetails>,
  alone?: Report<BvhDetails>,
): string {
  const { rows, runs, threads } = details;
  const shown = paper?.figures?.filter(({ mean }) => mean !== undefined) ?? [];
  return `# Hierarchies

<ResultPlot of="bvh" />

Build times of [@glanz/bvh](../packages/bvh) and [three-mesh-bvh](https://github.com/gkjohnson/three-mesh-bvh) on the same meshes, in one process and on one thread. The builders alternate, after one warm-up round that is not counted. Times are the median (minimum – maximum) of ${runs} builds, ratios those of the minimum times. \`balanced\` is the default builder of @glanz/bvh; SAH and CENTER are split strategies of three-mesh-bvh, SAH with leaves of up to 4 triangles, as \`balanced\` has. The cost of a tree is its surface area cost, with 1 per node and 1 per triangle, by the same formula for all builders.

${beside(rows)}

## Builders

Mean number of nodes and triangles that a diffuse ray visits (the same rays for all builders), and the minimum build time.

${buildersTable(rows)}

${gains(rows)}

## Compared with C++

tinybvh's AVX2 builder is not part of this run. Its times are estimated through three-mesh-bvh: the ratio of three-mesh-bvh's time to tinybvh's was measured once, on another machine, and is divided by the ratio of three-mesh-bvh's time to \`balanced\` in this run.

${tinyList(rows)}

## Threads

${threadsList(threads)}
${
  alone?.details
    ? `
Where there are several meshes, each worker builds whole meshes. One mesh is built by both: in every stage, each worker takes the next part that is not yet done. The same measurements by themselves, without the builds above in the same run, on ${alone.machine.cpu}, ${alone.machine.cores} cores, Node ${alone.machine.node}, commit ${alone.machine.commit ?? 'unknown'}, ${alone.machine.date.slice(0, 10)}, on a shared machine:

${threadsList(alone.details.threads)}
`
    : ''
}${
    brief?.details
      ? `
## With scanned and CAD meshes

\`balanced\` and three-mesh-bvh only, on ${brief.machine.cpu}, ${brief.machine.cores} cores, Node ${brief.machine.node}, commit ${brief.machine.commit ?? 'unknown'}, ${brief.machine.date.slice(0, 10)}${(brief.notes ?? []).map((note) => `; ${note}`).join('')}.

${beside(brief.details.rows)}

${threadsList(brief.details.threads)}
`
      : ''
  }${
    small?.details
      ? `
## Two cores

The same on ${small.machine.cpu}, ${small.machine.cores} cores, Node ${small.machine.node}, commit ${small.machine.commit ?? 'unknown'}, ${small.machine.date.slice(0, 10)}. Two workers leave no core free there: the main thread, the JIT compiler and the system run on the same cores.

${beside(small.details.rows)}

${buildersTable(small.details.rows)}

${gains(small.details.rows)}

${tinyList(small.details.rows)}

${threadsList(small.details.threads)}
`
      : ''
  }${
    brute?.details
      ? `
## Against brute force

${brute.details.rays.toLocaleString('en')} rays through ${brute.details.scenes.toLocaleString('en')} random scenes of 1 mm to 10 km, with every builder in turn. Each hit is compared with an intersection of the ray with every triangle: **${brute.details.wrong} wrong hits** on the CPU. ${brute.details.gpuRays.toLocaleString('en')} of the rays are traced in WGSL too, in both layouts: **${brute.details.gpuWrong} wrong hits**. \`npm run bench -- bvh-brute --seed ${brute.details.seed}\`, ${brute.machine.date.slice(0, 10)}, commit ${brute.machine.commit ?? 'unknown'}. Other seeds give other scenes.
`
      : ''
  }${
    shown.length === 0
      ? ''
      : `
## The paper's table

The time to build the hierarchy of a push-button at three resolutions, including the buffers for the GPU. The paper's system, strahl (2025), uses three-mesh-bvh's CENTER strategy. Mean ± half of the 95 % confidence interval of 30 runs.

${table(
  ['measurement', 'mean ± 95 %'],
  shown.map(({ name, unit, mean, ci95 }) => [
    name,
    unit === '1' ? `${times(mean!)} ± ${ci95!.toFixed(2)}` : `${digits(mean!)} ± ${digits(ci95!)} ${unit}`,
  ]),
)}

Measured on ${paper!.machine.cpu}, Node ${paper!.machine.node}, commit ${paper!.machine.commit ?? 'unknown'}, ${paper!.machine.date.slice(0, 10)}.
`
  }
Measured on ${machine.cpu}, ${machine.cores} cores, Node ${machine.node}, commit ${machine.commit ?? 'unknown'}, ${machine.date.slice(0, 10)}. \`npm run bench -- bvh --pages apps/docs/results\` and \`npm run bench -- paper-cpu --pages apps/docs/results\` write this page; the data is in \`bvh.json\`${brief ? ', `bvh-brief.json` (`--brief yes`)' : ''}${alone ? ', `bvh-threads.json` (`--threads yes`)' : ''}${small ? ' and `bvh-two-cores.json` (`--two-cores yes`)' : ''}${shown.length === 0 ? '' : ' and `paper-cpu.json`'}.
`;
}

/** Writes a report into the folder, and the page from all reports in it. Returns the paths of the files written. */
export function writeBvhPage(
  name: 'bvh' | 'bvh-brief' | 'bvh-threads' | 'bvh-two-cores' | 'bvh-brute' | 'paper-cpu',
  report: object,
  folder: string,
): string[] {
  mkdirSync(folder, { recursive: true });
  const file = (which: string) => join(folder, `${which}.json`);
  writeFileSync(file(name), `${JSON.stringify(report, null, 1)}\n`);
  const read = <T>(which: string) =>
    existsSync(file(which)) ? (JSON.parse(readFileSync(file(which), 'utf8')) as Report<T>) : undefined;
  const bvh = read<BvhDetails>('bvh');
  if (!bvh?.details) return [file(name)];
  writeFileSync(
    join(folder, 'bvh.md'),
    bvhMarkdown(
      { ...bvh, details: bvh.details },
      read('paper-cpu'),
      read('bvh-two-cores'),
      read('bvh-brute'),
      read('bvh-brief'),
      read('bvh-threads'),
    ),
  );
  return [file(name), join(folder, 'bvh.md')];
}
