import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Machine } from '../machine';
import type { ContestantName } from './contestants';
import { plot, type Series } from './plot';
import type { Point } from './measure';
import {
  fairQuantity,
  measurementOf,
  overall,
  ratios,
  timeAt,
  valueAt,
  type EqualTimeDetails,
  type Quantity,
  type SceneInfo,
} from './summary';

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
const small = (value: number) =>
  value === 0 || !Number.isFinite(value)
    ? '–'
    : value >= 0.01 && value < 1000
      ? String(Number(value.toPrecision(2)))
      : value
          .toExponential(1)
          .replace('e', '·10^')
          .replace(/\^\+?(-?\d+)/, '<sup>$1</sup>');
const times = (ratio: number) => `${ratio >= 99.5 ? ratio.toFixed(0) : ratio.toPrecision(2)}×`;
const row = (cells: readonly string[]) => `| ${cells.join(' | ')} |`;

function table(head: readonly string[], body: readonly (readonly string[])[]): string[] {
  return [row(head), row(head.map((_, i) => (i === 0 ? '---' : '--:'))), ...body.map(row)];
}

/** A cell: ours, theirs, how many times lower. */
function comparison(
  details: EqualTimeDetails,
  { name }: SceneInfo,
  peer: ContestantName,
  quantity: Quantity,
): string[] | undefined {
  const [ours, theirs, factors] = [
    measurementOf(details, name, 'glanz'),
    measurementOf(details, name, peer),
    ratios(details, name, peer, quantity),
  ];
  if (!ours || !theirs || !factors) return undefined;
  return factors.map(
    (factor, b) =>
      `${small(valueAt(ours, quantity, b))} : ${small(valueAt(theirs, quantity, b))} (**${times(factor)}**)`,
  );
}

function comparisonTable(
  details: EqualTimeDetails,
  peer: ContestantName,
  quantity: (scene: SceneInfo) => Quantity | undefined,
): string[] {
  const body = details.scenes.flatMap((scene) => {
    const what = quantity(scene);
    const cells = what && comparison(details, scene, peer, what);
    return cells ? [[`\`${scene.name}\`: ${scene.title}`, ...cells]] : [];
  });
  return body.length === 0 ? ['Not measured.'] : table(['scene', ...details.budgetsMs.map(seconds)], body);
}

const ofReferences = (quantity: Quantity) => (scene: SceneInfo) =>
  scene.truth === 'references' ? quantity : undefined;
const always = (quantity: Quantity) => () => quantity;

function overallLine(
  details: EqualTimeDetails,
  peer: ContestantName,
  text: string,
  quantity: (scene: SceneInfo) => Quantity | undefined,
  clock: 'gpuMs' | 'wallMs' = 'gpuMs',
): string[] {
  const result = overall(details, peer, quantity, clock);
  return result
    ? [
        `- ${text}: **${times(result.mean)}** (${times(result.min)} to ${times(result.max)}, ${result.count} comparisons)`,
      ]
    : [];
}

/** The report as markdown, without a heading of its own. */
export function equalTimeMarkdown({ machine, gpu, quick, details }: EqualTimeReport): string {
  const { budgetsMs, scenes, size, runs } = details;
  const where = `${gpu?.name ?? 'unknown GPU'}${gpu?.software ? ', **a software GPU: these figures do not predict those of a real one**' : ''}, ${machine.cpu}, Node ${machine.node}, commit ${machine.commit ?? 'unknown'}, ${machine.date.slice(0, 10)}`;
  const facts = scenes.flatMap(({ name }) =>
    (['glanz', PEER, PEER_DEFAULTS] as const).flatMap((contestant) => {
      const m = measurementOf(details, name, contestant);
      if (!m) return [];
      const last = budgetsMs.length - 1;
      const [gpuMs, wallMs] = [timeAt(m, last, 'gpuMs'), timeAt(m, last, 'wallMs')];
      const mean = (of: (point: Point) => number) =>
        m.points.reduce((sum, run) => sum + of(run[last]!), 0) / m.points.length;
      return [
        [
          `\`${name}\``,
          contestant,
          mean((p) => p.samples).toFixed(1),
          (gpuMs / mean((p) => p.samples)).toPrecision(3),
          (wallMs / gpuMs).toFixed(2),
          mean((p) => p.brightness).toFixed(4),
          m.setUpMs.toFixed(0),
        ],
      ];
    }),
  );
  return [
    `Measured on ${where}. ${size} × ${size} pixels, ${runs} independent run${runs === 1 ? '' : 's'}, one of three-gpu-pathtracer with its defaults${quick ? '; **a quick run, not a measurement**' : ''}.`,
    '',
    'The ratio of the error of three-gpu-pathtracer to that of Glanz at equal GPU time, geometric mean over scenes and times:',
    '',
    ...overallLine(
      details,
      PEER,
      'relMSE against the reference set, biased options of three-gpu-pathtracer off',
      ofReferences('relMSE'),
    ),
    ...overallLine(details, PEER, 'the same at equal wall time', ofReferences('relMSE'), 'wallMs'),
    ...overallLine(details, PEER, 'noise alone, all scenes', always('noise')),
    ...overallLine(details, PEER, 'FLIP against the reference set', ofReferences('FLIP')),
    ...overallLine(
      details,
      PEER_DEFAULTS,
      'relMSE against the reference set, three-gpu-pathtracer with its defaults',
      ofReferences('relMSE'),
    ),
    ...overallLine(details, PEER_DEFAULTS, 'FLIP, three-gpu-pathtracer with its defaults', ofReferences('FLIP')),
    '',
    '## Error by GPU time, biased options off',
    '',
    'relMSE of Glanz : relMSE of three-gpu-pathtracer (ratio). For the two product scenes it is the noise alone: they have no independent reference that could decide between the two material models.',
    '',
    ...comparisonTable(details, PEER, fairQuantity),
    '',
    '## Noise alone',
    '',
    ...comparisonTable(details, PEER, always('noise')),
    '',
    '## FLIP',
    '',
    ...comparisonTable(details, PEER, ofReferences('FLIP')),
    '',
    '## With the defaults of three-gpu-pathtracer',
    '',
    'By default three-gpu-pathtracer clamps radiance and widens sharp lobes. This lowers the noise, but the image does not converge to the reference. The first table is relMSE, the second FLIP.',
    '',
    ...comparisonTable(details, PEER_DEFAULTS, ofReferences('relMSE')),
    '',
    ...comparisonTable(details, PEER_DEFAULTS, ofReferences('FLIP')),
    '',
    `## After ${seconds(budgetsMs[budgetsMs.length - 1] ?? 0)}`,
    '',
    ...table(
      ['scene', 'renderer', 'samples a pixel', 'GPU ms a sample', 'wall : GPU', 'brightness : reference', 'set-up ms'],
      facts,
    ),
    ...(details.crossChecks.length === 0
      ? []
      : [
          '',
          '## References of the product scenes',
          '',
          ...table(
            ['scene', 'samples', 'another estimator : reference', 'blocks outside 3 σ'],
            details.crossChecks.map((c) => [
              `\`${c.scene}\``,
              String(c.samples),
              `${c.ratio.toFixed(5)} ± ${c.ratio95?.toFixed(5) ?? '?'}`,
              `${c.outside} of ${c.blocks}`,
            ]),
          ),
        ]),
    '',
  ].join('\n');
}

function panels(details: EqualTimeDetails, quantity: (scene: SceneInfo) => Quantity | undefined) {
  return details.scenes.flatMap((scene) => {
    const what = quantity(scene);
    if (!what) return [];
    const series = (Object.keys(STYLES) as ContestantName[]).flatMap((name): Series[] => {
      const m = measurementOf(details, scene.name, name);
      return m
        ? [
            {
              name,
              ...STYLES[name],
              points: details.budgetsMs.map((_, b) => [timeAt(m, b, 'gpuMs') / 1000, valueAt(m, what, b)] as const),
            },
          ]
        : [];
    });
    return series.length === 0 ? [] : [{ title: `${scene.name}${what === 'noise' ? ' (noise alone)' : ''}`, series }];
  });
}

const PAGE_HEAD = `# Error at equal time

The error of an image after a given GPU time, for Glanz and for [three-gpu-pathtracer](https://github.com/gkjohnson/three-gpu-pathtracer) 0.0.26, the path tracer for three.js (its WebGPU wavefront tracer, on three r185). Both render the same .glb file with the same camera, size, depth and environment. Each runs in a process of its own, one after the other on the same GPU, with pipelines compiled before the measurement.

`;

/** The explanation of the plots; it follows them, so that the answer comes first. */
const PAGE_NOTES = `- **References.** Small scenes whose reference images were made by another renderer, with standard errors; images are rendered at a larger size and averaged down to the reference's 128 × 128 pixels. For two product scenes the reference is a long render of Glanz in two independent halves, checked by another estimator with random numbers of its own (path guiding, light paths, light candidates). The table of these references states the ratio of the brightness with its 95 % interval, and how many blocks differ by more than three standard errors: on curved rough metal, light paths [leave the flat triangles](/guide/lighting#light-paths).
- **relMSE.** Mean over pixels of the squared error over the reference's squared brightness (plus 1 % of the image's mean). The reference's own noise is subtracted on average. *Noise alone* compares independent runs of the same renderer, so that differences between the material models do not count.
- **FLIP.** The perceived difference when a viewer flips between the image and the reference (Andersson et al. 2020), on tone-mapped images.
- **GPU time.** By timestamp queries around every submission. The cost of the queries is subtracted, which favours a renderer that submits often. three-gpu-pathtracer runs with its fastest batch size, the paths of all pixels in flight, and without its preview.
- **Biased options.** The options of three-gpu-pathtracer that lower noise at the cost of bias (clamping, widened sharp lobes) are off; a further table has its defaults, with them on. Glanz runs with its defaults, in which no biased option is on.
- **strahl 0.1.0** is not compared here: it has no textures, and it samples the BSDF only, never the lights, which no setting of Glanz does. Its time per sample is a target of the benchmark \`paper-gpu\`.

`;

const PAGE_FOOT = `
\`npm run bench -- equal-time --json FILE --pages apps/docs/results\` writes this page; the data is in \`apps/docs/results/equal-time.json\`.
`;

/** Writes the page `equal-time.md` with its plots and its data into a folder. Returns the paths of the files. */
export function writePages(report: EqualTimeReport, folder: string): string[] {
  mkdirSync(folder, { recursive: true });
  const { details, gpu } = report;
  const on = gpu?.software ? `${gpu.name} (software GPU)` : (gpu?.name ?? 'unknown GPU');
  const files: [string, string][] = [];
  const images: string[] = [];
  const draw = (file: string, what: string, y: string, quantity: (scene: SceneInfo) => Quantity | undefined) => {
    const drawn = panels(details, quantity);
    if (drawn.length === 0) return;
    files.push([file, plot(drawn, { title: `${what} at equal GPU time`, x: 'seconds of GPU time', y, note: on })]);
    images.push(`![${what} over GPU time, by scene](./${file})`, '');
  };
  draw('equal-time-relmse.svg', 'Error', 'relMSE', (scene) =>
    fairQuantity(scene) === 'noise' && details.runs < 2 ? undefined : fairQuantity(scene),
  );
  draw('equal-time-flip.svg', 'FLIP', 'mean FLIP', ofReferences('FLIP'));
  files.push(
    ['equal-time.md', `${PAGE_HEAD}${images.join('\n')}\n${PAGE_NOTES}${equalTimeMarkdown(report)}${PAGE_FOOT}`],
    ['equal-time.json', `${JSON.stringify(report, null, 1)}\n`],
  );
  for (const [name, contents] of files) writeFileSync(join(folder, name), contents);
  return files.map(([name]) => join(folder, name));
}
