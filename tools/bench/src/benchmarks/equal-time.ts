import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { timed, type Benchmark, type BenchmarkContext, type BenchmarkResult, type Figure } from '../benchmark';
import { childJob, inChild, type ChildJobs } from '../child';
import { BenchError } from '../error';
import { CONTESTANTS, type ContestantName } from '../equal-time/contestants';
import { measure, type Measurement, type MeasurementPlan } from '../equal-time/measure';
import { makeReference, type CrossCheck, type ReferencePlan } from '../equal-time/reference';
import { equalTimeMarkdown, writePages, type EqualTimeReport } from '../equal-time/report';
import { CATALOGUE_SIZE, SCENES } from '../equal-time/scenes';
import {
  joinDetails,
  overall,
  ratios,
  type EqualTimeDetails,
  type Quantity,
  type SceneInfo,
} from '../equal-time/summary';
import { machine } from '../machine';
import { listOption, numberOption } from '../options';

/** What a child process is to do. */
type Job =
  | { readonly kind: 'measure'; readonly plan: MeasurementPlan }
  | { readonly kind: 'reference'; readonly plan: ReferencePlan };

const JOBS: ChildJobs<Job> = {
  name: 'equal-time',
  file: import.meta.url,
  run: (job, log) => (job.kind === 'measure' ? measure(job.plan, log) : makeReference(job.plan, log)),
};

const OPTIONS = {
  scenes: { type: 'string', help: 'names, separated by commas' },
  contestants: { type: 'string', help: 'names, separated by commas' },
  budgets: { type: 'string', help: 'seconds of GPU time, separated by commas (0.1,0.3,1,3)' },
  runs: { type: 'string', help: 'independent runs (2)' },
  size: { type: 'string', help: `pixels across and down, a multiple of ${CATALOGUE_SIZE} (512)` },
  'reference-samples': { type: 'string', help: 'samples a pixel of the product scenes’ references (16384)' },
  deadline: { type: 'string', help: 'seconds after which nothing new is begun' },
  from: { type: 'string', help: 'measures nothing: takes the data of these reports, separated by commas' },
  pages: { type: 'string', help: 'folder to write the table and the plots into' },
} as const;

const referencesOnly = (quantity: Quantity) => (scene: SceneInfo) =>
  scene.truth === 'references' ? quantity : undefined;

function figuresOf(details: EqualTimeDetails, judge: boolean): Figure[] {
  const figures: Figure[] = [];
  const peers = (Object.keys(CONTESTANTS) as ContestantName[]).filter((name) => name !== 'glanz');
  for (const peer of peers) {
    const whole = (
      name: string,
      quantity: (scene: SceneInfo) => Quantity | undefined,
      clock: 'gpuMs' | 'wallMs',
      goal: boolean,
    ) => {
      const result = overall(details, peer, quantity, clock);
      const target =
        goal && judge
          ? { target: { value: 10, relation: '>=' as const, source: 'ten times lower error at equal time' } }
          : {};
      if (result)
        figures.push({
          name: `${peer}: ${name}`,
          unit: '× lower',
          runs: result.count,
          min: result.min,
          median: result.mean,
          max: result.max,
          ...target,
        });
    };
    const unbiased = peer === 'three-gpu-pathtracer';
    whole('relMSE at equal GPU time, geometric mean', referencesOnly('relMSE'), 'gpuMs', unbiased);
    whole('relMSE at equal wall time, geometric mean', referencesOnly('relMSE'), 'wallMs', false);
    whole('noise at equal GPU time, geometric mean', () => 'noise', 'gpuMs', unbiased);
    whole('FLIP at equal GPU time, geometric mean', referencesOnly('FLIP'), 'gpuMs', false);
    for (const scene of details.scenes) {
      const found = ratios(details, scene.name, peer, scene.truth === 'references' ? 'relMSE' : 'noise')?.filter(
        Number.isFinite,
      );
      if (found && found.length > 0)
        figures.push(
          timed(
            `${peer}: ${scene.name}, ${scene.truth === 'references' ? 'relMSE' : 'noise'} over the budgets`,
            '× lower',
            found,
          ),
        );
    }
  }
  return figures;
}

async function measureAll({
  log,
  quick,
  gpu,
  values,
}: BenchmarkContext): Promise<BenchmarkResult & { readonly details: EqualTimeDetails }> {
  const started = performance.now();
  const scenes = listOption(
    values['scenes'],
    SCENES.map(({ name }) => name),
    'scene',
  ).map((name) => SCENES.find((scene) => scene.name === name)!);
  const contestants = listOption(values['contestants'], Object.keys(CONTESTANTS) as ContestantName[], 'contestant');
  const size = numberOption(values, 'size', quick ? CATALOGUE_SIZE : 512);
  if (size % CATALOGUE_SIZE !== 0)
    throw new BenchError('bench/option', `--size must be a multiple of ${CATALOGUE_SIZE}, the size of the references.`);
  const runs = numberOption(values, 'runs', 2);
  const samples = numberOption(values, 'reference-samples', quick ? 64 : 16384);
  const deadline = numberOption(values, 'deadline', 1e9, false);
  const budgetsMs = (values['budgets'] ?? '0.1,0.3,1,3').split(',').map((text) => Number(text) * 1000);
  if (budgetsMs.some((budget, i) => !(budget > (budgetsMs[i - 1] ?? 0))))
    throw new BenchError('bench/option', '--budgets must be ascending seconds, e.g. 0.1,0.3,1,3.');
  const folder = mkdtempSync(join(tmpdir(), 'glanz-equal-time-'));
  const measurements: Measurement[] = [];
  const crossChecks: CrossCheck[] = [];
  const notes: string[] = [];
  const late = () => performance.now() - started > deadline * 1000;
  try {
    for (const { name, truth } of scenes) {
      const common = { scene: name, size, ...(gpu === undefined ? {} : { gpu }) };
      const referenceFile = join(folder, `${name}.reference`);
      if (truth === 'own') {
        const check = late()
          ? 'left out: the deadline had passed'
          : await inChild<CrossCheck, Job>(JOBS, {
              kind: 'reference',
              plan: { ...common, samples, file: referenceFile },
            });
        if (typeof check === 'string') {
          notes.push(`${name}: ${check}`);
          log(`${name}: ${check}`);
          continue;
        }
        crossChecks.push(check);
      }
      for (const contestant of contestants) {
        // The second table wants no noise of its own: one run of the peer's defaults will do.
        const plan: MeasurementPlan = {
          ...common,
          contestant,
          budgetsMs,
          runs: contestant.endsWith('(defaults)') ? 1 : runs,
          ...(truth === 'own' ? { referenceFile } : {}),
        };
        const result = late()
          ? 'left out: the deadline had passed'
          : await inChild<Measurement, Job>(JOBS, { kind: 'measure', plan });
        if (typeof result === 'string') {
          notes.push(`${name}, ${contestant}: ${result}`);
          log(`${name}, ${contestant}: ${result}`);
        } else {
          measurements.push(result);
          notes.push(...result.notes.map((note) => `${name}, ${contestant}: ${note}`));
        }
      }
    }
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
  const adapter = measurements[0]?.adapter;
  if (!adapter) throw new BenchError('bench/not-available', `Nothing could be measured: ${notes.join('; ')}`);
  const details: EqualTimeDetails = {
    budgetsMs,
    size,
    runs,
    scenes: scenes.map(({ name, title, truth }) => ({ name, title, truth })),
    measurements,
    crossChecks,
  };
  return {
    settings: {
      size,
      runs,
      budgetsMs,
      scenes: scenes.map(({ name }) => name),
      contestants,
      referenceSamples: samples,
      peer: 'three-gpu-pathtracer 0.0.26 (WebGPU, wavefront) on three 0.185.0',
    },
    gpu: adapter,
    figures: figuresOf(details, !quick && !adapter.software),
    notes,
    details,
  };
}

/** Reports of some scenes each, as one report. */
function joined(files: readonly string[]): EqualTimeReport & BenchmarkResult {
  const reports = files.map((file) => JSON.parse(readFileSync(file, 'utf8')) as EqualTimeReport & BenchmarkResult);
  const [first] = reports as [(typeof reports)[number], ...typeof reports];
  const details = joinDetails(reports.map((report) => report.details));
  const quick = reports.some((report) => report.quick);
  const commits = [...new Set(reports.flatMap((report) => report.machine.commit?.split(', ') ?? []))];
  return {
    ...first,
    machine: { ...first.machine, commit: commits.join(', ') },
    quick,
    details,
    settings: { ...first.settings, scenes: details.scenes.map(({ name }) => name) },
    figures: figuresOf(details, !quick && first.gpu?.software === false),
    notes: reports
      .flatMap(({ notes = [] }) => notes)
      .filter(
        (note) =>
          !details.measurements.some(
            ({ scene, contestant }) => note.startsWith(`${scene}:`) || note.startsWith(`${scene}, ${contestant}:`),
          ),
      ),
  };
}

/** Error at equal time, ours beside the strongest open competitor's, each in a process of its own on the same files. */
export const benchmark: Benchmark = {
  description: 'error after 0.1, 0.3, 1 and 3 s of GPU time against three-gpu-pathtracer',
  options: OPTIONS,
  async run(context) {
    await childJob(JOBS);
    const { values } = context;
    const from = values['from'];
    const earlier = from === undefined ? undefined : joined(from.split(','));
    const result = earlier ?? { ...(await measureAll(context)), machine: machine(), quick: context.quick };
    if (values['pages'] !== undefined)
      for (const file of writePages(result as EqualTimeReport, values['pages'])) context.log(`wrote ${file}`);
    else context.log(equalTimeMarkdown(result as EqualTimeReport));
    return result;
  },
};
