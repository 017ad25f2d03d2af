import { resolve } from 'node:path';
import type { Camera, Scene } from '@glanz/scene';
import type { Backend, OpenedGpu, RenderStatistics, Tracer } from '../backend';
import { chooseCamera } from '../camera';
import { chooseEnvironment } from '../environment';
import { CliError, EXIT } from '../errors';
import { checkInput } from '../input';
import type { CliIo, Interrupt } from '../io';
import type { RenderCommandOptions } from '../options';
import type { Picture, PictureLayers } from '../output/picture';
import { checkWritable, writePicture, type WrittenFile } from '../output/write';
import { duration, rate, type ProgressReporter } from '../progress';
import { version } from '../version';

/** Milliseconds per stage. */
export interface RenderTimings {
  loadMs: number;
  environmentMs: number;
  deviceMs: number;
  /** All of the preparation; its parts are in the statistics. */
  prepareMs: number;
  renderMs: number;
  readMs: number;
  writeMs: number;
  totalMs: number;
}

/** What `--json` prints. */
export interface RenderResult {
  readonly ok: true;
  readonly version: string;
  readonly model: string;
  readonly files: readonly WrittenFile[];
  readonly width: number;
  readonly height: number;
  /** Paths per pixel in the picture. */
  readonly samples: number;
  readonly targetSamples: number;
  /** Relative error of the picture when it was last looked at; only with `--noise`. */
  readonly noise?: number;
  readonly samplesPerSecond: number;
  /** The signal that ended it early, if one did. */
  readonly interrupted: Interrupt | null;
  readonly depth: number;
  readonly seed: number;
  readonly camera: string;
  readonly environment: string;
  readonly adapter: { readonly name: string; readonly software: boolean };
  readonly timings: RenderTimings;
  readonly statistics: RenderStatistics;
  readonly warnings: readonly string[];
}

/** A result and what the process should end with. */
export interface RenderOutcome {
  /** `undefined` if it was interrupted before there was anything to write. */
  readonly result: RenderResult | undefined;
  readonly exitCode: number;
}

const MAX_WARNINGS = 5;

/** `glanz render`: loads, prepares, renders, writes. */
export async function renderCommand(options: RenderCommandOptions, io: CliIo, backend: Backend, progress: ProgressReporter): Promise<RenderOutcome> {
  const start = io.now();
  const abort = new AbortController();
  let interrupted: Interrupt | null = null;
  const stopListening = io.onInterrupt((signal) => {
    interrupted = signal;
    progress.line(signal === 'SIGINT' ? 'stopping: writing what there is (Ctrl-C again to end at once)' : 'stopping: writing what there is');
    abort.abort();
  });
  const interruptedCode = () => (interrupted === null ? EXIT.ok : interrupted === 'SIGINT' ? EXIT.interrupted : EXIT.terminated);
  let opened: OpenedGpu | undefined;
  let tracer: Tracer | undefined;
  const timings: RenderTimings = { loadMs: 0, environmentMs: 0, deviceMs: 0, prepareMs: 0, renderMs: 0, readMs: 0, writeMs: 0, totalMs: 0 };
  const timed = async <T>(key: keyof RenderTimings, run: () => Promise<T>): Promise<T> => {
    const from = io.now();
    try {
      return await run();
    } finally {
      timings[key] += io.now() - from;
    }
  };

  try {
    const { cwd } = io;
    await checkInput(options.model, cwd, 'the model');
    for (const { path } of options.outputs) await checkWritable(path, cwd);

    progress.stage('load model');
    const model = await timed('loadMs', () => backend.loadModel(resolve(cwd, options.model), abort.signal));
    const { environment, source, warnings: environmentWarnings } = await timed('environmentMs', () =>
      chooseEnvironment(model, options.env, { rotation: options.envRotation, intensity: options.envIntensity }, cwd),
    );
    const { environment: _replaced, ...rest } = model;
    const instances = markCatchers(model.instances, options.catchers);
    const scene: Scene = environment ? { ...rest, instances, environment } : { ...rest, instances };
    const camera = await chooseCamera(scene, options.camera, options.width / options.height, cwd);
    const warnings = [...scene.warnings.map(({ message, path }) => (path ? `${message} (${path})` : message)), ...environmentWarnings];
    for (const warning of warnings.slice(0, MAX_WARNINGS)) progress.warning(warning);
    if (warnings.length > MAX_WARNINGS) progress.warning(`and ${warnings.length - MAX_WARNINGS} more; --json lists them all.`);
    abort.signal.throwIfAborted();

    progress.stage('start GPU');
    const gpu = (opened = await timed('deviceMs', () => backend.openGpu(options.gpu)));
    progress.line(`${gpu.software ? 'no GPU: rendering on the processor, ' : ''}${gpu.adapterName}`);
    abort.signal.throwIfAborted();

    const labels = { bvh: 'build hierarchy', upload: 'upload', compile: 'compile kernels' } as const;
    const active = (tracer = await timed('prepareMs', () =>
      backend.createTracer(gpu.device, scene, {
        width: options.width,
        height: options.height,
        maxDepth: options.depth,
        seed: options.seed,
        camera,
        ...options.quality,
        background: options.transparent ? 'transparent' : 'environment',
        signal: abort.signal,
        onProgress: ({ stage, done }) => progress.stage(labels[stage], done),
      }),
    ));

    let noise: number | undefined;
    await timed('renderMs', async () => {
      // Nobody is looking at a canvas here: larger submissions than in a page, still far from any watchdog.
      for await (const state of active.render({ samples: options.samples, ...(options.noise === undefined ? {} : { noise: options.noise }), signal: abort.signal, maxSubmitMs: 200 })) {
        noise = state.noise ?? noise;
        progress.samples(state);
      }
    });
    const { samples } = active;
    if (samples === 0) {
      progress.line('nothing has been accumulated yet; no file written.');
      return { result: undefined, exitCode: interruptedCode() || EXIT.failure };
    }

    progress.stage('write');
    const picture = await timed('readMs', () => readPicture(active, options, samples));
    const files: WrittenFile[] = [];
    for (const target of options.outputs) files.push(await timed('writeMs', () => writePicture(picture, target, options, cwd)));
    timings.totalMs = io.now() - start;
    const { statistics } = active;
    const samplesPerSecond = timings.renderMs > 0 ? samples / (timings.renderMs / 1000) : 0;
    const names = files.map(({ path }) => path).join(', ');
    progress.line(`${names}: ${options.width}×${options.height}, ${samples}${interrupted && options.noise === undefined ? ` of ${options.samples}` : ''} ${options.samples === 1 ? 'sample' : 'samples'} at ${rate(samplesPerSecond)}/s, ${duration(timings.totalMs)} in all`);
    if (statistics.badSamples > 0) progress.warning(`${statistics.badSamples} samples were not numbers and were left out; please report the model.`);
    return {
      exitCode: interruptedCode(),
      result: {
        ok: true,
        version: version(),
        model: options.model,
        files,
        width: options.width,
        height: options.height,
        samples,
        targetSamples: options.samples,
        ...(noise === undefined ? {} : { noise }),
        samplesPerSecond,
        interrupted,
        depth: options.depth,
        seed: options.seed,
        camera: cameraName(camera),
        environment: source,
        adapter: { name: gpu.adapterName, software: gpu.software },
        timings,
        statistics,
        warnings,
      },
    };
  } catch (error) {
    // An abort that a stage answered by throwing is the user's wish, not a fault.
    if (interrupted !== null && abort.signal.aborted && (error as Error | undefined)?.name === 'AbortError') {
      progress.line('nothing has been accumulated yet; no file written.');
      return { result: undefined, exitCode: interruptedCode() };
    }
    throw error;
  } finally {
    stopListening();
    progress.clear();
    tracer?.destroy();
    opened?.device.destroy();
  }
}

/** @throws {CliError} `cli/usage` for a name that no part has. */
function markCatchers(instances: Scene['instances'], names: readonly string[]): Scene['instances'] {
  for (const name of names) {
    if (!instances.some((instance) => instance.name === name)) throw new CliError('cli/usage', `--catcher: the model has no part "${name}"; it has ${[...new Set(instances.map((instance) => `"${instance.name}"`))].join(', ')}.`);
  }
  return instances.map((instance) => (names.includes(instance.name) ? { ...instance, catcher: true } : instance));
}

const cameraName = (camera: Camera) => camera.name || camera.type;

async function lightLayers(tracer: Tracer): Promise<PictureLayers['lights']> {
  const groups = tracer.lightGroups;
  if (groups.length < 2) return [];
  return Promise.all(groups.map(async ({ name }) => ({ name, data: await tracer.readLightGroup(name) })));
}

async function readPicture(tracer: Tracer, options: RenderCommandOptions, samples: number): Promise<Picture> {
  const { width, height, outputs } = options;
  const beauty = await tracer.read('beauty');
  const base = { width, height, beauty, samples, software: `Glanz ${version()}` };
  if (!outputs.some(({ format }) => format === 'exr')) return base;
  return {
    ...base,
    layers: {
      albedo: await tracer.read('albedo'),
      normal: await tracer.read('normal'),
      position: await tracer.read('position'),
      variance: await tracer.read('variance'),
      lights: await lightLayers(tracer),
      depth: await tracer.read('depth'),
      objectId: await tracer.read('objectId'),
      materialId: await tracer.read('materialId'),
    },
  };
}
