import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Machine } from '../machine';
import type { ContestantName } from './contestants';
import { plot, type Series } from './plot';
import type { Point } from './measure';
import { fairQuantity, measurementOf, overall, ratios, timeAt, valueAt, type EqualTimeDetails, type Quantity, type SceneInfo } from './summary';

/** What the pages need of a report. */
export interface EqualTimeReport {
  readonly machine: Machine;
  readonly gpu?: { readonly name: string; readonly software: boolean };
  readonly quick: boolean;
  readonly details: EqualTimeDetails;
}

const PEER: ContestantName = 'three-gpu-pathtracer';
const PEER_DEFAULTS: ContestantName = 'three-gpu-pathtracer (defaults)';
const STYLES: Readonly<Record<ContestantName, { readonly colour: string; readonly dashed?: boolean }>> = {
  glanz: { colour: '#e2631e' },
  [PEER]: { colour: '#2563a8' },
  [PEER_DEFAULTS]: { colour: '#2563a8', dashed: true },
} as Record<ContestantName, { colour: string; dashed?: boolean }>;

const seconds = (ms: number) => `${ms / 1000} s`;
const small = (value: number) => (value === 0 || !Number.isFinite(value) ? '–' : value >= 0.01 && value < 1000 ? String(Number(value.toPrecision(2))) : value.toExponential(1).replace('e', '·10^').replace(/\^\+?(-?\d+)/, '<sup>$1</sup>'));
const times = (ratio: number) => `${ratio >= 100 ? ratio.toFixed(0) : ratio.toPrecision(2)}×`;
const row = (cells: readonly string[]) => `| ${cells.join(' | ')} |`;

function table(head: readonly string[], body: readonly (readonly string[])[]): string[] {
  return [row(head), row(head.map((_, i) => (i === 0 ? '---' : '--:'))), ...body.map(row)];
}

/** A cell: ours, theirs, how many times lower. */
function comparison(details: EqualTimeDetails, { name }: SceneInfo, peer: ContestantName, quantity: Quantity): string[] | undefined {
  const [ours, theirs, factors] = [measurementOf(details, name, 'glanz'), measurementOf(details, name, peer), ratios(details, name, peer, quantity)];
  if (!ours || !theirs || !factors) return undefined;
  return factors.map((factor, b) => `${small(valueAt(ours, quantity, b))} : ${small(valueAt(theirs, quantity, b))} (**${times(factor)}**)`);
}

function comparisonTable(details: EqualTimeDetails, peer: ContestantName, quantity: (scene: SceneInfo) => Quantity | undefined): string[] {
  const body = details.scenes.flatMap((scene) => {
    const what = quantity(scene);
    const cells = what && comparison(details, scene, peer, what);
    return cells ? [[`\`${scene.name}\`: ${scene.title}`, ...cells]] : [];
  });
  return body.length === 0 ? ['Not measured.'] : table(['scene', ...details.budgetsMs.map(seconds)], body);
}

const catalogue = (quantity: Quantity) => (scene: SceneInfo) => (scene.truth === 'catalogue' ? quantity : undefined);
const always = (quantity: Quantity) => () => quantity;

function overallLine(details: EqualTimeDetails, peer: ContestantName, text: string, quantity: (scene: SceneInfo) => Quantity | undefined, clock: 'gpuMs' | 'wallMs' = 'gpuMs'): string[] {
  const result = overall(details, peer, quantity, clock);
  return result ? [`- ${text}: **${times(result.mean)}** (${times(result.least)} to ${times(result.most)}, ${result.count} comparisons)`] : [];
}

/** The report as markdown, without a heading of its own. */
export function equalTimeMarkdown({ machine, gpu, quick, details }: EqualTimeReport): string {
  const { budgetsMs, scenes, size, runs } = details;
  const where = `${gpu?.name ?? 'unknown GPU'}${gpu?.software ? ', **a software GPU: these figures say nothing about real ones**' : ''}, ${machine.cpu}, Node ${machine.node}, commit ${machine.commit ?? 'unknown'}, ${machine.date.slice(0, 10)}`;
  const facts = scenes.flatMap(({ name }) =>
    (['glanz', PEER, PEER_DEFAULTS] as const).flatMap((contestant) => {
      const m = measurementOf(details, name, contestant);
      if (!m) return [];
      const last = budgetsMs.length - 1;
      const [gpuMs, wallMs] = [timeAt(m, last, 'gpuMs'), timeAt(m, last, 'wallMs')];
      const mean = (of: (point: Point) => number) => m.points.reduce((sum, run) => sum + of(run[last]!), 0) / m.points.length;
      return [[`\`${name}\``, contestant, mean((p) => p.samples).toFixed(1), (gpuMs / mean((p) => p.samples)).toPrecision(3), (wallMs / gpuMs).toFixed(2), mean((p) => p.brightness).toFixed(4), m.setUpMs.toFixed(0)]];
    }),
  );
  return [
    `Measured on ${where}. ${size} × ${size} pixels, ${runs} independent run${runs === 1 ? '' : 's'}${quick ? '; **a quick run, no measurement**' : ''}.`,
    '',
    'How many times lower the error of Glanz is at equal GPU time, geometric mean over scenes and times:',
    '',
    ...overallLine(details, PEER, 'relMSE against the catalogue’s references, their biased options off', catalogue('relMSE')),
    ...overallLine(details, PEER, 'the same at equal wall time', catalogue('relMSE'), 'wallMs'),
    ...overallLine(details, PEER, 'noise alone, all scenes', always('noise')),
    ...overallLine(details, PEER, 'FLIP against the catalogue’s references', catalogue('FLIP')),
    ...overallLine(details, PEER_DEFAULTS, 'relMSE against the catalogue’s references, the peer as its users get it', catalogue('relMSE')),
    ...overallLine(details, PEER_DEFAULTS, 'FLIP, the peer as its users get it', catalogue('FLIP')),
    '',
    '### Error by GPU time, biased options off',
    '',
    'Glanz : three-gpu-pathtracer (times lower). relMSE; for the two product scenes noise alone, since no independent reference says whose material model is right there.',
    '',
    ...comparisonTable(details, PEER, fairQuantity),
    '',
    '### Noise alone',
    '',
    ...comparisonTable(details, PEER, always('noise')),
    '',
    '### FLIP',
    '',
    ...comparisonTable(details, PEER, catalogue('FLIP')),
    '',
    '### The peer as its users get it',
    '',
    'With the clamp and the blurred gloss that it has on by default: less noise, and a picture that does not converge to the truth. relMSE, then FLIP.',
    '',
    ...comparisonTable(details, PEER_DEFAULTS, catalogue('relMSE')),
    '',
    ...comparisonTable(details, PEER_DEFAULTS, catalogue('FLIP')),
    '',
    `### After ${seconds(budgetsMs[budgetsMs.length - 1] ?? 0)}`,
    '',
    ...table(['scene', 'renderer', 'samples a pixel', 'GPU ms a sample', 'wall : GPU', 'brightness : reference', 'set-up ms'], facts),
    ...(details.crossChecks.length === 0 ? [] : ['', '### References of the product scenes', '', ...table(['scene', 'samples', 'check with independent random numbers : reference', 'blocks outside 3 σ'], details.crossChecks.map((c) => [`\`${c.scene}\``, String(c.samples), `${c.ratio.toFixed(5)} ± ${c.ratio95?.toFixed(5) ?? '?'}`, `${c.outside} of ${c.blocks}`]))]),
    '',
  ].join('\n');
}

function panels(details: EqualTimeDetails, quantity: (scene: SceneInfo) => Quantity | undefined) {
  return details.scenes.flatMap((scene) => {
    const what = quantity(scene);
    if (!what) return [];
    const series = (Object.keys(STYLES) as ContestantName[]).flatMap((name): Series[] => {
      const m = measurementOf(details, scene.name, name);
      return m ? [{ name, ...STYLES[name], points: details.budgetsMs.map((_, b) => [timeAt(m, b, 'gpuMs') / 1000, valueAt(m, what, b)] as const) }] : [];
    });
    return series.length === 0 ? [] : [{ title: `${scene.name}${what === 'noise' ? ' (noise alone)' : ''}`, series }];
  });
}

/** Writes `equal-time.table.md`, `equal-time-relmse.svg` and `equal-time-flip.svg` into a folder, and gives their names. */
export function writePages(report: EqualTimeReport, folder: string): string[] {
  mkdirSync(folder, { recursive: true });
  const { details, gpu } = report;
  const on = gpu?.software ? `${gpu.name} (software GPU)` : (gpu?.name ?? 'unknown GPU');
  const files: [string, string][] = [['equal-time.table.md', equalTimeMarkdown(report)]];
  const errors = panels(details, (scene) => (fairQuantity(scene) === 'noise' && details.runs < 2 ? undefined : fairQuantity(scene)));
  if (errors.length > 0) files.push(['equal-time-relmse.svg', plot(errors, { title: `Error at equal GPU time, ${on}`, x: 'seconds of GPU time', y: 'relMSE' })]);
  const flips = panels(details, catalogue('FLIP'));
  if (flips.length > 0) files.push(['equal-time-flip.svg', plot(flips, { title: `FLIP at equal GPU time, ${on}`, x: 'seconds of GPU time', y: 'mean FLIP' })]);
  for (const [name, contents] of files) writeFileSync(join(folder, name), contents);
  return files.map(([name]) => join(folder, name));
}
