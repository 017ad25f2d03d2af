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

/** What was tried against brute force. */
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

/** How many times as long as tinybvh's our builds take, linked by three-mesh-bvh's times, each way that there is. */
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

/** Least times of a builder over those of `balanced`, mesh by mesh. */
const ratiosOf = (rows: readonly MeshRow[], name: string) =>
  rows.map((row) => row.times[name]!.min / row.times['balanced']!.min);

/** Times beside three-mesh-bvh's, and what is made of them. */
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

- SAH : balanced, geometric mean **${times(geometricMean(sah))}**, least **${times(Math.min(...sah))}** (asked: 4×, never under 3×)
- CENTER : balanced, geometric mean **${times(geometricMean(center))}** (asked: 1×)
- cost of balanced : SAH, geometric mean **${geometricMean(costs).toFixed(3)}** (asked: at most 1)`;
}

/** What diffuse rays look at in the trees of all builders, and how long those take. */
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
        'time : balanced, geometric mean (least – most)',
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

- first build in a fresh thread ${digits(cold)} ms, further ones ${spread(warm)} ms: **${times(cold / warm.median)}** (asked: at most 2×)
- one mesh on one worker ${spread(alone)} ms, on two together ${spread(together)} ms: **${times(alone.min / together.min)}** as fast (asked: 1.6×)
- four such meshes on one worker ${spread(one)} ms, on two ${spread(two)} ms: **${times(one.min / two.min)}** as fast (asked: 1.6×)${
    parts
      ? `
- ${parts.name} on one worker ${spread(parts.one)} ms, on two ${spread(parts.two)} ms: **${times(parts.one.min / parts.two.min)}** as fast (asked: 1.6×)`
      : ''
  }
- in slices on the main thread ${spread(sliced)} ms, the longest slice ${spread(longest)} ms (asked: at most 16)`;
}

function tinyList(rows: readonly MeshRow[]): string {
  const tiny = overTinybvh(rows);
  return `${table(
    ['mesh', 'linked by CENTER', 'linked by SAH with leaves of 10'],
    tiny.map(({ mesh, byCenter, bySah }) => [mesh, times(byCenter), times(bySah)]),
  )}

Geometric mean: **${times(geometricMean(tiny.flatMap(({ byCenter, bySah }) => [byCenter, bySah])))}** of tinybvh's AVX2 time (asked: at most 2×).`;
}

/** Meshes of parts, as CAD programs write them. */
const CAD_LIKE = /push-button|CAD/;

/** What rays save in the trees of `best`. */
function gains(rows: readonly MeshRow[]): string {
  const of = (some: readonly MeshRow[]) =>
    (1 - geometricMean(some.map(({ diffuse }) => diffuse['best']! / diffuse['balanced']!))) * 100;
  const parts = rows.filter(({ name }) => CAD_LIKE.test(name));
  return `In meshes of parts (${parts.map(({ name }) => name).join(', ')}) diffuse rays look at **${of(parts).toFixed(1)} %** less in trees of \`best\` than in those of \`balanced\` (asked: 15 %).`;
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

How long [@glanz/bvh](../packages/bvh) builds, beside [three-mesh-bvh](https://github.com/gkjohnson/three-mesh-bvh) on the same meshes in the same process, in turns, one thread, after a first round that does not count. Median (least – largest) of ${runs} builds; ratios are of the least times. SAH has leaves of 4 triangles as ours have; one evaluator gives the surface area cost of all trees (1 a node, 1 a triangle).

${beside(rows)}

## Builders

Nodes and triangles that a diffuse ray looks at (counted, the same rays for all), and least times.

${buildersTable(rows)}

${gains(rows)}

## Beside C++

tinybvh's AVX2 builder does not run here: three-mesh-bvh links it. Ours over tinybvh's is three-mesh-bvh's over tinybvh's, measured once on one machine, over three-mesh-bvh's over ours in this run.

${tinyList(rows)}

## Threads

${threadsList(threads)}
${
  alone?.details
    ? `
With several meshes, as scenes have them, two workers share the builds; of one mesh each takes the next part of every stage. By themselves, on ${alone.machine.cpu}, ${alone.machine.cores} cores, Node ${alone.machine.node}, commit ${alone.machine.commit ?? 'unknown'}, ${alone.machine.date.slice(0, 10)}, a machine that others shared:

${threadsList(alone.details.threads)}
`
    : ''
}${
    brief?.details
      ? `
## Scanned and CAD meshes too

\`balanced\` beside three-mesh-bvh alone, on ${brief.machine.cpu}, ${brief.machine.cores} cores, Node ${brief.machine.node}, commit ${brief.machine.commit ?? 'unknown'}, ${brief.machine.date.slice(0, 10)}${(brief.notes ?? []).map((note) => `; ${note}`).join('')}.

${beside(brief.details.rows)}

${threadsList(brief.details.threads)}
`
      : ''
  }${
    small?.details
      ? `
## Two cores

The same on ${small.machine.cpu}, ${small.machine.cores} cores, Node ${small.machine.node}, commit ${small.machine.commit ?? 'unknown'}, ${small.machine.date.slice(0, 10)}. Two workers have no core to spare there: the thread that asked for the build, the compiler and the system take their time from them.

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

${brute.details.rays.toLocaleString('en')} rays through ${brute.details.scenes.toLocaleString('en')} random scenes from 1 mm to 10 km, every builder in turn, each ray against every triangle: **${brute.details.wrong} wrong** on the CPU; ${brute.details.gpuRays.toLocaleString('en')} of them in WGSL as well, in both layouts: **${brute.details.gpuWrong} wrong**. \`npm run bench -- bvh-brute --seed ${brute.details.seed}\`, ${brute.machine.date.slice(0, 10)}, commit ${brute.machine.commit ?? 'unknown'}; other seeds, other scenes.
`
      : ''
  }${
    shown.length === 0
      ? ''
      : `
## The paper's table

Setting up the hierarchy of a push-button in three resolutions, everything up to buffers that can be uploaded; strahl (2025) does so by three-mesh-bvh's CENTER split. Mean ± half of the 95 % interval of 30 runs.

${table(
  ['what', 'mean ± 95 %'],
  shown.map(({ name, unit, mean, ci95 }) => [
    name,
    unit === '1' ? `${times(mean!)} ± ${ci95!.toFixed(2)}` : `${digits(mean!)} ± ${digits(ci95!)} ${unit}`,
  ]),
)}

Measured on ${paper!.machine.cpu}, Node ${paper!.machine.node}, commit ${paper!.machine.commit ?? 'unknown'}, ${paper!.machine.date.slice(0, 10)}.
`
  }
Measured on ${machine.cpu}, ${machine.cores} cores, Node ${machine.node}, commit ${machine.commit ?? 'unknown'}, ${machine.date.slice(0, 10)}. \`npm run bench -- bvh --pages apps/docs/results\` and \`npm run bench -- paper-cpu --pages apps/docs/results\` write this page; the data are in \`bvh.json\`${brief ? ', `bvh-brief.json` (`--brief yes`)' : ''}${alone ? ', `bvh-threads.json` (`--threads yes`)' : ''}${small ? ' and `bvh-two-cores.json` (`--two-cores yes`)' : ''}${shown.length === 0 ? '' : ' and `paper-cpu.json`'}.
`;
}

/** Writes a report into the folder, and the page from all that is there. */
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
