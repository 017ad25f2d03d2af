import { execFile } from 'node:child_process';
import { existsSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { createPushButton } from '@glanz/models';
import { PathTracer, requestDevice, warmUp, type RenderStatistics } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { benchWorkers, servesBenchmark } from '../bvh/threads';
import { BenchError } from '../error';
import { estimated, timed, type Benchmark, type BenchmarkContext, type Figure } from '../benchmark';

/** Set in the processes that this benchmark starts: the GPU to use, or empty. */
const CHILD = 'GLANZ_BENCH_FIRST_IMAGE';

/** What is compared with another bundle: the whole, and the stages that take longest. */
const COMPARED: ReadonlySet<string> = new Set([
  'process start to first image',
  'scene in memory to first sample',
  'hierarchies',
  'pipelines',
]);

/** Milliseconds since the process began, at the end of each stage, and the tracer's own figures. */
interface Stages {
  readonly adapterName: string;
  readonly software: boolean;
  readonly loaded: number;
  readonly device: number;
  /** When code and device were warmed up, where they were. */
  readonly warmed: number;
  readonly scene: number;
  /** When the first-light kernel's image was there; absent where the others were faster. */
  readonly firstLight?: number;
  /** When the hierarchies were there, and when all was on the GPU. */
  readonly built: number;
  readonly uploaded: number;
  readonly prepared: number;
  readonly sampled: number;
  /** When the image was on the CPU. */
  readonly read: number;
  readonly times: Pick<RenderStatistics, 'checkMs' | 'textMs' | 'bvhMs' | 'lightMs' | 'compileMs'>;
}

async function firstImage(gpu: string, size: number, threads: number, warm: boolean): Promise<Stages> {
  const loaded = performance.now();
  // As the viewer does: they start while the device and the model are on their way.
  const workers = threads > 0 ? await benchWorkers(threads, true) : undefined;
  const { gpu: api, adapterName, software } = await createGpu(gpu === '' ? {} : { gpu });
  const graphics = await requestDevice({ gpu: api });
  const device = performance.now();
  const hierarchies = workers ? { hierarchies: workers } : {};
  if (warm) await warmUp(graphics, hierarchies);
  const warmed = performance.now();
  const model = createPushButton({ level: 'medium' });
  model.environment = { type: 'constant', radiance: [1, 1, 1] };
  const scene = performance.now();
  let firstLight: number | undefined;
  let [built, uploaded] = [scene, scene];
  const tracer = await PathTracer.create(graphics, model, {
    width: size,
    height: size,
    maxDepth: 5,
    camera: 0,
    ...hierarchies,
    onProgress: ({ stage, done }) => {
      if (stage !== 'upload') return;
      if (done === 0) built = performance.now();
      else uploaded = performance.now();
    },
    onFirstLight: () => void graphics.queue.onSubmittedWorkDone().then(() => (firstLight = performance.now())),
  });
  const prepared = performance.now();
  for await (const progress of tracer.render({ samples: 1 })) void progress;
  const sampled = performance.now();
  await tracer.read('beauty');
  const read = performance.now();
  const { checkMs, textMs, bvhMs, lightMs, compileMs } = tracer.statistics;
  tracer.destroy();
  workers?.destroy();
  graphics.destroy();
  return {
    adapterName,
    software,
    loaded,
    device,
    warmed,
    scene,
    ...(firstLight === undefined ? {} : { firstLight }),
    built,
    uploaded,
    prepared,
    sampled,
    read,
    times: { checkMs, textMs, bvhMs, lightMs, compileMs },
  };
}

async function measure({ log, quick, gpu, values }: BenchmarkContext) {
  const size = quick ? 64 : 512;
  // As many as the viewer has.
  const threads = Number(values['workers'] ?? Math.min(8, availableParallelism()));
  if (!Number.isInteger(threads) || threads < 0)
    throw new BenchError('bench/option', `--workers ${values['workers']}: it must be a whole number, 0 for none.`);
  const repeats = Number(values['repeats'] ?? (quick ? 1 : 7));
  if (!Number.isInteger(repeats) || repeats < 1)
    throw new BenchError('bench/option', `--repeats ${values['repeats']}: it must be a whole number from 1.`);
  const against = values['against'] === undefined ? undefined : resolve(values['against']);
  if (against !== undefined && !existsSync(against))
    throw new BenchError('bench/option', `--against ${against}: there is no such file.`);
  if (against !== undefined && repeats < 2)
    throw new BenchError('bench/option', '--against needs at least two --repeats.');
  const run = async (warm: boolean, file = fileURLToPath(import.meta.url)) => {
    const env = { ...process.env, [CHILD]: JSON.stringify([gpu ?? '', size, threads, warm]) };
    const { stdout } = await promisify(execFile)(process.execPath, [file], { env });
    const stages = JSON.parse(stdout.slice(stdout.indexOf('{'))) as Stages;
    log(
      `first sample ${(stages.sampled - stages.scene).toFixed(0)} ms after the scene was in memory${warm ? ', warmed up' : ''}${file === against ? ', the other bundle' : ''}`,
    );
    return stages;
  };
  const cold = await run(false);
  const plain: Stages[] = [];
  const ready: Stages[] = [];
  const others: Stages[] = [];
  const otherReady: Stages[] = [];
  const turns = [
    async () => plain.push(await run(false)),
    async () => ready.push(await run(true)),
    ...(against === undefined
      ? []
      : [async () => others.push(await run(false, against)), async () => otherReady.push(await run(true, against))]),
  ];
  // In turns, so that a disturbance of the machine meets all alike, each second time in the opposite order, so that
  // neither gains where the machine gets slower or faster.
  for (let i = 0; i < repeats; i++) for (const turn of i % 2 === 0 ? turns : [...turns].reverse()) await turn();
  const rows: readonly (readonly [string, (stages: Stages) => number])[] = [
    ['process start to first image', ({ read }) => read],
    ['program loaded', ({ loaded }) => loaded],
    ['driver and device', ({ loaded, device }) => device - loaded],
    ['warming up', ({ device, warmed }) => warmed - device],
    ['model made', ({ warmed, scene }) => scene - warmed],
    ['scene in memory to first light', ({ scene, firstLight, sampled }) => (firstLight ?? sampled) - scene],
    ['scene in memory to first sample', ({ scene, sampled }) => sampled - scene],
    ['scene prepared', ({ scene, prepared }) => prepared - scene],
    ['of that, checks', ({ times }) => times.checkMs],
    ['of that, the text of kernels', ({ times }) => times.textMs],
    [
      'of that, hierarchies, or what was left to wait for them',
      ({ scene, built, times }) => built - scene - times.checkMs - times.textMs,
    ],
    ['of that, shapes written to the GPU', ({ built, uploaded, times }) => uploaded - built - times.lightMs],
    ['of that, lights, environment and tables', ({ times }) => times.lightMs],
    ['of that, waiting for pipelines', ({ uploaded, prepared }) => prepared - uploaded],
    ['hierarchies', ({ times }) => times.bvhMs],
    ['pipelines', ({ times }) => times.compileMs],
    ['first sample', ({ prepared, sampled }) => sampled - prepared],
    ['first sample copied to the CPU', ({ sampled, read }) => read - sampled],
  ];
  const goal = (asked: boolean, value: number): Figure['target'] =>
    asked && !cold.software && !quick ? { value, relation: '<=', source: 'asked for' } : undefined;
  const figures: Figure[] = rows.flatMap(([name, value]) => [
    timed(name, 'ms', plain.map(value), goal(name === 'scene in memory to first sample', 150)),
    timed(`${name}, warmed up`, 'ms', ready.map(value), goal(name === 'scene in memory to first sample', 150)),
    timed(`${name}, first process`, 'ms', [value(cold)], goal(name === 'pipelines', 1000)),
  ]);
  if (against !== undefined)
    for (const [name, value] of rows.filter(([row]) => COMPARED.has(row)))
      for (const [suffix, ours, theirs] of [
        ['', plain, others],
        [', warmed up', ready, otherReady],
      ] as const)
        figures.push(
          estimated(
            `${name}${suffix}, over the other bundle's`,
            '1',
            ours.map((stages, i) => value(stages) / value(theirs[i]!)),
          ),
        );
  return {
    settings: {
      model: 'push-button medium',
      repeats,
      ...(against === undefined ? {} : { against }),
      workers: threads,
      width: size,
      height: size,
      maxDepth: 5,
      environment: 'constant, radiance 1',
    },
    gpu: { name: cold.adapterName, software: cold.software },
    figures,
    notes: [
      'warmed up: `warmUp()` before the model is made, as while one is loading',
      'the first process may find the cache of the driver cold; the others find it warm',
      'pipelines compile while hierarchies are built and the scene is uploaded: their time counts from when they are asked for',
    ],
  };
}

/** From the start of a process to its first image, each time in a new process. */
export const benchmark: Benchmark = {
  description: 'from the start of a process to the first sample of the push-button with 107 k triangles',
  options: {
    workers: {
      type: 'string',
      help: 'threads that build hierarchies, 0 for the main thread alone; default: one a core, at most 8',
    },
    repeats: { type: 'string', help: 'processes of each kind; default: 7' },
    against: {
      type: 'string',
      help: 'a bundle of this benchmark from another state of the sources, whose processes alternate with these',
    },
  },
  async run(context) {
    // A worker of the process below.
    if (servesBenchmark()) return { settings: {}, figures: [] };
    const child = process.env[CHILD];
    if (child === undefined) return measure(context);
    const [gpu, size, threads, warm] = JSON.parse(child) as [string, number, number, boolean];
    process.stdout.write(JSON.stringify(await firstImage(gpu, size, threads, warm)));
    // The parent wants this line alone: no report.
    process.exit(0);
  },
};
