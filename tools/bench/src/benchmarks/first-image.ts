import { execFile } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { createPushButton } from '@glanz/models';
import { PathTracer, requestDevice, type RenderStatistics } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { benchWorkers, servesBenchmark } from '../bvh/threads';
import { BenchError } from '../error';
import { timed, type Benchmark, type BenchmarkContext, type Figure } from '../benchmark';

/** Set in the processes that this benchmark starts: the GPU to use, or empty. */
const CHILD = 'GLANZ_BENCH_FIRST_IMAGE';

/** Milliseconds since the process began, at the end of each stage, and the tracer's own figures. */
interface Stages {
  readonly adapterName: string;
  readonly software: boolean;
  readonly loaded: number;
  readonly device: number;
  readonly scene: number;
  /** When the first-light kernel's picture was there; absent where the others were faster. */
  readonly firstLight?: number;
  readonly prepared: number;
  readonly sampled: number;
  /** When the picture was on the CPU. */
  readonly read: number;
  readonly times: Pick<RenderStatistics, 'checkMs' | 'bvhMs' | 'uploadMs' | 'lightMs' | 'compileMs'>;
}

async function firstImage(gpu: string, size: number, threads: number): Promise<Stages> {
  const loaded = performance.now();
  // As the viewer does: they start while the device and the model are on their way.
  const workers = threads > 0 ? await benchWorkers(threads, true) : undefined;
  const { gpu: api, adapterName, software } = await createGpu(gpu === '' ? {} : { gpu });
  const graphics = await requestDevice({ gpu: api });
  const device = performance.now();
  const model = createPushButton({ level: 'medium' });
  model.environment = { type: 'constant', radiance: [1, 1, 1] };
  const scene = performance.now();
  let firstLight: number | undefined;
  const tracer = await PathTracer.create(graphics, model, { width: size, height: size, maxDepth: 5, camera: 0, ...(workers ? { hierarchies: workers } : {}), onFirstLight: () => void graphics.queue.onSubmittedWorkDone().then(() => (firstLight = performance.now())) });
  const prepared = performance.now();
  for await (const progress of tracer.render({ samples: 1 })) void progress;
  const sampled = performance.now();
  await tracer.read('beauty');
  const read = performance.now();
  const { checkMs, bvhMs, uploadMs, lightMs, compileMs } = tracer.statistics;
  tracer.destroy();
  workers?.destroy();
  graphics.destroy();
  return { adapterName, software, loaded, device, scene, ...(firstLight === undefined ? {} : { firstLight }), prepared, sampled, read, times: { checkMs, bvhMs, uploadMs, lightMs, compileMs } };
}

async function measure({ log, quick, gpu, values }: BenchmarkContext) {
  const size = quick ? 64 : 512;
  const threads = Number(values['workers'] ?? 0);
  if (!Number.isInteger(threads) || threads < 0) throw new BenchError('bench/option', `--workers ${values['workers']}: it must be a whole number, 0 for none.`);
  const runs: Stages[] = [];
  for (let i = 0; i < (quick ? 2 : 8); i++) {
    const env = { ...process.env, [CHILD]: JSON.stringify([gpu ?? '', size, threads]) };
    const { stdout } = await promisify(execFile)(process.execPath, [fileURLToPath(import.meta.url)], { env });
    const stages = JSON.parse(stdout.slice(stdout.indexOf('{'))) as Stages;
    runs.push(stages);
    log(`first sample ${(stages.sampled - stages.scene).toFixed(0)} ms after the scene was in memory`);
  }
  const [cold, ...warm] = runs as [Stages, ...Stages[]];
  const rows: readonly (readonly [string, (stages: Stages) => number])[] = [
    ['process start to first image', ({ read }) => read],
    ['program loaded', ({ loaded }) => loaded],
    ['driver and device', ({ loaded, device }) => device - loaded],
    ['model made', ({ device, scene }) => scene - device],
    ['scene in memory to first light', ({ scene, firstLight, sampled }) => (firstLight ?? sampled) - scene],
    ['scene in memory to first sample', ({ scene, sampled }) => sampled - scene],
    ['scene prepared', ({ scene, prepared }) => prepared - scene],
    ['of that, checks and the text of kernels', ({ times }) => times.checkMs],
    ['of that, hierarchies', ({ times }) => times.bvhMs],
    ['of that, shapes written to the GPU', ({ times }) => times.uploadMs - times.lightMs],
    ['of that, lights, surroundings and tables', ({ times }) => times.lightMs],
    ['of that, waiting for pipelines', ({ scene, prepared, times }) => prepared - scene - times.checkMs - times.bvhMs - times.uploadMs],
    ['pipelines', ({ times }) => times.compileMs],
    ['first sample', ({ prepared, sampled }) => sampled - prepared],
    ['first sample copied to the CPU', ({ sampled, read }) => read - sampled],
  ];
  const goal = (asked: boolean, value: number): Figure['target'] => (asked && !cold.software && !quick ? { value, relation: '<=', source: 'asked for' } : undefined);
  const figures: Figure[] = rows.flatMap(([name, value]) => [
    timed(name, 'ms', warm.map(value), goal(name === 'scene in memory to first sample', 150)),
    timed(`${name}, first process`, 'ms', [value(cold)], goal(name === 'pipelines', 1000)),
  ]);
  return {
    settings: { model: 'push-button medium', workers: threads, width: size, height: size, maxDepth: 5, environment: 'constant, radiance 1' },
    gpu: { name: cold.adapterName, software: cold.software },
    figures,
    notes: ['the first process may find the cache of the driver cold; the others find it warm', 'pipelines compile while hierarchies are built and the scene is uploaded: their time counts from when they are asked for'],
  };
}

/** From the start of a process to its first image, each time in a new process. */
export const benchmark: Benchmark = {
  description: 'from the start of a process to the first sample of the push-button with 107 k triangles',
  options: { workers: { type: 'string', help: 'threads that build hierarchies; default 0: the main thread' } },
  async run(context) {
    // A worker of the process below.
    if (servesBenchmark()) return { settings: {}, figures: [] };
    const child = process.env[CHILD];
    if (child === undefined) return measure(context);
    const [gpu, size, threads] = JSON.parse(child) as [string, number, number];
    process.stdout.write(JSON.stringify(await firstImage(gpu, size, threads)));
    // The parent wants this line alone: no report.
    process.exit(0);
  },
};
