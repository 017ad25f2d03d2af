import { resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { createScene, frameCamera, GlanzError, type Instance, type Material, type Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import type { Backend, RenderStatistics } from '../backend';
import { CliError, EXIT, EXIT_OF_INTERRUPT } from '../errors';
import { checkInput } from '../input';
import type { CliIo, Interrupt } from '../io';
import { GPU_ADVICE } from '../render/gpu';
import type { ReportOptions } from '../options';
import { rate, type ProgressReporter } from '../progress';
import { version } from '../version';
import { jsonLine, visible } from '../visible';

/** `glanz bench`. */
export interface BenchCommand extends ReportOptions {
  readonly kind: 'bench';
  /** `undefined`: the scene that is built in. */
  readonly model: string | undefined;
  readonly width: number;
  readonly height: number;
  readonly samples: number;
  readonly runs: number;
  readonly gpu: string | undefined;
}

const usage = (message: string) => new CliError('cli/usage', message);

/**
 * Reads the arguments behind `bench`.
 * @throws {CliError} `cli/usage`
 */
export function parseBench(argv: readonly string[]): BenchCommand {
  let parsed;
  try {
    parsed = parseArgs({
      args: [...argv],
      allowPositionals: true,
      strict: true,
      options: {
        size: { type: 'string' },
        samples: { type: 'string' },
        runs: { type: 'string' },
        gpu: { type: 'string' },
        json: { type: 'boolean' },
        quiet: { type: 'boolean', short: 'q' },
      },
    });
  } catch (cause) {
    throw usage(`${((cause as Error).message.split('\n')[0] as string).replace(/\.?$/, '.')} See glanz help bench.`);
  }
  const {
    values,
    positionals: [model, ...rest],
  } = parsed;
  if (rest.length > 0) throw usage(`One model at a time: unexpected argument "${rest[0]}".`);
  const [, width, height] = /^(\d{1,5})[xX×](\d{1,5})$/.exec(values.size ?? '512x512') ?? [];
  if (!(Number(width) >= 1 && Number(height) >= 1)) throw usage(`--size must be like 512x512, not "${values.size}".`);
  const whole = (name: string, text: string | undefined, fallback: number, max: number) => {
    const value = text === undefined ? fallback : Number(text);
    if (!(Number.isInteger(value) && value >= 1 && value <= max))
      throw usage(`--${name} must be a whole number from 1 to ${max}, not "${text}".`);
    return value;
  };
  return {
    kind: 'bench',
    json: values.json ?? false,
    quiet: values.quiet ?? false,
    model,
    width: Number(width),
    height: Number(height),
    samples: whole('samples', values.samples, 64, 1e6),
    runs: whole('runs', values.runs, 3, 100),
    gpu: values.gpu,
  };
}

/** What `--json` prints. */
export interface BenchResult {
  readonly ok: true;
  readonly version: string;
  /** The file, or `built-in`. */
  readonly model: string;
  readonly adapter: { readonly name: string; readonly software: boolean };
  readonly width: number;
  readonly height: number;
  readonly samples: number;
  readonly depth: number;
  readonly triangles: number;
  readonly loadMs: number;
  /** From a scene to a tracer: hierarchies, upload, kernels. */
  readonly prepareMs: number;
  /** Until the first sample is there, which does not count in the runs: drivers finish kernels with it. */
  readonly firstSampleMs: number;
  /** Wall time of a sample of all pixels, milliseconds: of each run. */
  readonly msPerSample: readonly number[];
  /** Middle of the runs. */
  readonly samplesPerSecond: number;
  /** Millions of paths a second: pixels times samples. */
  readonly megapathsPerSecond: number;
  readonly statistics: RenderStatistics;
}

const DEPTH = 8;

/** A ball of triangles, smooth. */
function ball(segments: number): {
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  indices: Uint32Array<ArrayBuffer>;
} {
  const normals: number[] = [],
    indices: number[] = [];
  for (let y = 0; y <= segments; y++) {
    for (let x = 0; x <= 2 * segments; x++) {
      const a = (Math.PI * x) / segments,
        b = (Math.PI * y) / segments;
      normals.push(Math.sin(b) * Math.cos(a), Math.cos(b), -Math.sin(b) * Math.sin(a));
      if (y === segments || x === 2 * segments) continue;
      const at = y * (2 * segments + 1) + x,
        below = at + 2 * segments + 1;
      indices.push(at, below, at + 1, at + 1, below, below + 1);
    }
  }
  const made = new Float32Array(normals);
  return { positions: made, normals: made.slice(), indices: new Uint32Array(indices) };
}

/** 49 balls on a table: plastics, metals, glasses and coats, one mesh of 33,124 triangles. Always the same. */
export function benchScene(): Scene {
  const materials: Material[] = [
    { name: 'table', parameters: { base_color: [0.6, 0.6, 0.6], specular_roughness: 0.4 } },
  ];
  const instances: Instance[] = [
    { name: 'table', mesh: 1, material: 0, transform: [12, 0, 0, 0, 0, 1, 0, 0, 0, 0, 12, 0, 0, -1, 0, 1] },
  ];
  for (let i = 0; i < 49; i++) {
    const [column, row] = [i % 7, Math.floor(i / 7)];
    const hue = (2 * Math.PI * i) / 49;
    const color = [0, 2, 4].map((k) => 0.5 + 0.4 * Math.cos(hue + k)) as [number, number, number];
    const parameters = [
      { base_color: color, specular_roughness: 0.1 + 0.1 * row },
      { base_color: color, base_metalness: 1, specular_roughness: 0.05 + 0.1 * row },
      { transmission_weight: 1, specular_roughness: 0.02 * row, transmission_color: color, transmission_depth: 1 },
      { base_color: color, coat_weight: 1, specular_roughness: 0.6 },
    ][i % 4] as Material['parameters'];
    instances.push({
      name: `ball ${i}`,
      mesh: 0,
      material: materials.push({ name: `ball ${i}`, parameters }) - 1,
      transform: [0.9, 0, 0, 0, 0, 0.9, 0, 0, 0, 0, 0.9, 0, 2.2 * (column - 3), -0.1, 2.2 * (row - 3), 1],
    });
  }
  const table = {
    name: 'table',
    positions: new Float32Array([-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1]),
    indices: new Uint32Array([0, 2, 1, 0, 3, 2]),
  };
  return {
    ...createScene('bench'),
    meshes: [{ name: 'ball', ...ball(91) }, table],
    materials,
    instances,
    environment: studioEnvironment(),
  };
}

/** `glanz bench`: how fast this machine renders. Gives the exit code. */
export async function benchCommand(
  { model, width, height, samples, runs, gpu: name, json }: BenchCommand,
  io: CliIo,
  backend: Backend,
  progress: ProgressReporter,
): Promise<number> {
  if (model !== undefined) await checkInput(model, io.cwd, 'the model');
  const abort = new AbortController();
  const failures: Error[] = [];
  let interrupted: Interrupt | undefined;
  const stopListening = io.onInterrupt((signal) => {
    interrupted = signal;
    abort.abort();
  });
  try {
    const begun = io.now();
    const loaded = model === undefined ? benchScene() : await backend.loadModel(resolve(io.cwd, model), abort.signal);
    const scene: Scene = { ...loaded, environment: loaded.environment ?? studioEnvironment() };
    const loadMs = io.now() - begun;
    const { device, adapterName, software } = await backend.openGpu(name, (error) => failures.push(error));
    progress.line(`${software ? 'no GPU: rendering on the CPU, ' : ''}${adapterName}`);
    try {
      const preparing = io.now();
      const tracer = await backend.createTracer(device, scene, {
        width,
        height,
        maxDepth: DEPTH,
        seed: 0,
        camera: scene.cameras[0] ?? frameCamera(scene, { aspect: width / height }),
        signal: abort.signal,
      });
      try {
        const prepareMs = io.now() - preparing;
        const msPerSample: number[] = [];
        progress.stage('first sample');
        const warming = io.now();
        // Drivers finish kernels when they first run.
        for await (const _ of tracer.render({ samples: 1, signal: abort.signal }));
        await tracer.read('beauty');
        const firstSampleMs = io.now() - warming;
        for (let run = 0; run < runs; run++) {
          tracer.reset();
          progress.prefix = `[${run + 1}/${runs}] `;
          const start = io.now();
          for await (const state of tracer.render({ samples, signal: abort.signal, maxSubmitMs: 200 })) {
            progress.samples(state);
          }
          if (interrupted) return EXIT_OF_INTERRUPT[interrupted];
          // The film is read so that nothing is still under way.
          await tracer.read('beauty');
          msPerSample.push((io.now() - start) / samples);
        }
        progress.prefix = '';
        if (failures[0]) throw failures[0];
        const middle = [...msPerSample].sort((a, b) => a - b)[runs >> 1] as number;
        const { statistics } = tracer;
        const samplesPerSecond = 1000 / middle;
        const result: BenchResult = {
          ok: true,
          version: version(),
          model: model ?? 'built-in',
          adapter: { name: adapterName, software },
          width,
          height,
          samples,
          depth: DEPTH,
          triangles: statistics.triangles,
          loadMs,
          prepareMs,
          firstSampleMs,
          msPerSample,
          samplesPerSecond,
          megapathsPerSecond: (samplesPerSecond * width * height) / 1e6,
          statistics,
        };
        progress.clear();
        if (json) io.stdout(jsonLine(result));
        else {
          const spread = `${Math.min(...msPerSample).toFixed(2)} – ${Math.max(...msPerSample).toFixed(2)}`;
          io.stdout(
            `${visible(`${result.model}, ${width}×${height}, ${statistics.triangles.toLocaleString('en')} triangles, ${adapterName}`)}\n  ${middle.toFixed(2)} ms a sample (${spread}, ${runs} runs of ${samples}) · ${rate(samplesPerSecond)} samples/s · ${result.megapathsPerSecond.toFixed(2)} million paths/s\n  load ${loadMs.toFixed(0)} ms · prepare ${prepareMs.toFixed(0)} ms · first sample ${firstSampleMs.toFixed(0)} ms · GPU memory ${(statistics.gpuBytes / 1e6).toFixed(0)} MB\n`,
          );
        }
        return EXIT.ok;
      } finally {
        tracer.destroy();
      }
    } finally {
      device.destroy();
    }
  } catch (error) {
    if (interrupted && abort.signal.aborted && (error as Error | undefined)?.name === 'AbortError')
      return EXIT_OF_INTERRUPT[interrupted];
    if (error instanceof GlanzError && error.code === 'renderer/device-lost')
      throw new CliError(
        'cli/gpu-lost',
        `The GPU was lost while it was measured (${error.message.split('.')[0] as string}). ${GPU_ADVICE}`,
        { cause: error },
      );
    throw error;
  } finally {
    stopListening();
    progress.clear();
  }
}
