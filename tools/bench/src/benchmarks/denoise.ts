import { Denoiser, type DenoiserOptions, type DenoiserStorage, type KernelFamily } from '@glanz/denoise';
import { shapesFrom, tuneShapes, type TunedShapes } from '@glanz/denoise/tune';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { timed, wallTimes, type Benchmark, type Figure } from '../benchmark';
import { flopOf, layersOf, randomArchive, type NetworkSize } from '../denoise/networks';
import { OnnxRuntime } from '../denoise/onnx-runtime';
import { measurePeak } from '../denoise/peak';
import { qualityCase } from '../denoise/quality-case';
import { QUALITY_SCENES } from '../denoise/quality-set';
import { VARIANTS, familyName } from '../denoise/variants';
import { BenchError } from '../error';
import { GpuClock } from '../gpu-clock';
import { KernelClock } from '../kernel-clock';

const SIZES = { '512': [512, 512], '1080p': [1920, 1080], '2160p': [3840, 2160], '128': [128, 128] } as const;
type SizeName = keyof typeof SIZES;

/** Milliseconds on an H200: what is aimed at, and what Open Image Denoise 2.5.1 takes there with its tensor cores. */
const AIMS: Readonly<Record<string, number>> = {
  'small 1080p': 6,
  'base 512': 2.2,
  'base 1080p': 12,
  'large 1080p': 32,
};
const OIDN: Readonly<Record<string, number>> = {
  'small 512': 0.41,
  'small 1080p': 2.17,
  'small 2160p': 8.6,
  'base 512': 0.6,
  'base 1080p': 3.33,
  'base 2160p': 13.5,
  'large 512': 1.09,
  'large 1080p': 6.5,
  'large 2160p': 26.9,
};

function listOf<T extends string>(option: string, text: string | undefined, known: readonly T[], usual: readonly T[]) {
  if (text === undefined) return usual;
  const names = text.split(',');
  for (const name of names)
    if (!known.includes(name as T))
      throw new BenchError('bench/option', `--${option} ${name}: there are ${known.join(', ')}.`);
  return names as T[];
}

/** Images of a size, and what is measured on them. */
class Subject {
  readonly #device: GPUDevice;
  readonly #buffers: Readonly<Record<'color' | 'albedo' | 'normal' | 'output', GPUBuffer>>;
  readonly width: number;
  readonly height: number;

  constructor(device: GPUDevice, size: SizeName) {
    this.#device = device;
    [this.width, this.height] = SIZES[size];
    const make = (low: number, high: number) => {
      const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST;
      const buffer = device.createBuffer({ size: this.width * this.height * 16, usage });
      let state = 1;
      const data = new Float32Array(this.width * this.height * 4);
      for (let i = 0; i < data.length; i++) {
        state = (state * 48271) % 2147483647;
        data[i] = low + ((high - low) * state) / 2147483647;
      }
      device.queue.writeBuffer(buffer, 0, data);
      return buffer;
    };
    this.#buffers = { color: make(0, 1), albedo: make(0, 1), normal: make(-1, 1), output: make(0, 0) };
  }

  /** Creates a denoiser, gives it to `use`, and destroys it. */
  async with<T>(
    network: NetworkSize,
    options: DenoiserOptions,
    use: (run: () => Promise<void>, denoiser: Denoiser) => Promise<T>,
  ): Promise<T> {
    const denoiser = await Denoiser.create(this.#device, randomArchive(network), {
      maxSubmitMs: Infinity,
      webAssembly: false,
      ...options,
    });
    try {
      const { width, height } = this;
      return await use(async () => void (await denoiser.denoise({ ...this.#buffers, width, height })), denoiser);
    } finally {
      denoiser.destroy();
    }
  }

  /** Measures shapes. */
  async tune(network: NetworkSize, storage: DenoiserStorage): Promise<{ shapes: TunedShapes; measured: number }> {
    const { width, height } = this;
    let measured = 0;
    const onProgress = (done: number) => void (measured = done);
    const shapes = await tuneShapes(this.#device, randomArchive(network), { storage, width, height, onProgress });
    return { shapes, measured };
  }

  destroy(): void {
    for (const buffer of Object.values(this.#buffers)) buffer.destroy();
  }
}

/** GPU milliseconds of an image by ONNX Runtime Web and by ours, alternating. */
async function alternate(
  subject: Subject,
  onnx: OnnxRuntime,
  network: NetworkSize,
  storage: DenoiserStorage,
  gpuTime: (work: () => Promise<void>) => Promise<number>,
  { rounds, settle }: { readonly rounds: number; readonly settle: number },
) {
  const theirs: number[] = [];
  const ours: number[] = [];
  const width = 16 * Math.ceil(subject.width / 16);
  const height = 16 * Math.ceil(subject.height / 16);
  await subject.with(network, { storage }, (runOurs) =>
    onnx.with(network, width, height, async (runTheirs) => {
      // Compiles, and brings the GPU to its clock.
      await warmUp(runTheirs, settle);
      for (let i = 0; i < rounds; i++) {
        const times = [await gpuTime(runTheirs), await gpuTime(runOurs)] as const;
        theirs.push(times[0]);
        ours.push(times[1]);
      }
    }),
  );
  return { theirs, ours };
}

/** Wall milliseconds of an image by WebAssembly and by shaders, alternating. */
async function besideShaders(subject: Subject, network: NetworkSize, storage: DenoiserStorage, rounds: number) {
  const wasm: number[] = [];
  const shaders: number[] = [];
  await subject.with(network, { storage, webAssembly: true }, (runWasm) =>
    subject.with(network, { storage, webAssembly: false }, async (runShaders) => {
      // Compiles.
      for (const run of [runWasm, runShaders]) await run();
      for (let i = 0; i < rounds; i++) {
        wasm.push(...(await wallTimes(1, 0, runWasm)));
        shaders.push(...(await wallTimes(1, 0, runShaders)));
      }
    }),
  );
  return { wasm, shaders };
}

/** GPU milliseconds of each kernel, run `repeats` times on end: the smallest of several runs. */
async function kernelTimes(device: GPUDevice, runs: number, repeats: number, run: () => Promise<void>) {
  const times = new Map<string, { pipeline: string; ms: number }>();
  const clock = KernelClock.create(device);
  if (!clock) return times;
  for (let i = 0; i < runs; i++)
    for (const { kernel, pipeline, milliseconds } of await clock.measure(run, repeats)) {
      const known = times.get(kernel);
      if (!known || known.ms > milliseconds) times.set(kernel, { pipeline, ms: milliseconds });
    }
  clock.destroy();
  return times;
}

/** Runs until the GPU has come to its clock. */
async function warmUp(run: () => Promise<void>, milliseconds: number): Promise<void> {
  const start = performance.now();
  do await run();
  while (performance.now() - start < milliseconds);
}

/** The denoiser's networks at several sizes: whole images, layer by layer, and ways to share a layer among threads. */
export const benchmark: Benchmark = {
  description:
    'the denoiser: milliseconds an image by network and size, of each layer with its share of the peak of arithmetic, and kernel variants side by side',
  options: {
    networks: { type: 'string', help: 'of small,base,large; default all' },
    sizes: { type: 'string', help: 'of 128,512,1080p,2160p; default 512,1080p, on software GPUs 128' },
    storage: { type: 'string', help: 'f16 (default) or f32' },
    webassembly: {
      type: 'string',
      help: '"beside": only WebAssembly, as on software GPUs, and shaders beside it; "yes" or "no": which is measured; default no',
    },
    variants: { type: 'string', help: '"no": only the usual kernels; or numbers of variants, 0,3,…' },
    tune: { type: 'string', help: '"yes": besides, with the shapes that tuneShapes finds within its default time' },
    onnxruntime: {
      type: 'string',
      help: 'folder of the npm package onnxruntime-web: its WebGPU evaluates the same networks, alternating with ours',
    },
    toggles: {
      type: 'string',
      help: 'toggles of Dawn: allow_unsafe_apis,vulkan_enable_f16_on_nvidia for subgroup matrices on NVIDIA GPUs',
    },
    quality: {
      type: 'string',
      help: 'folder of the quality set: where subgroup matrices are used, errors with and without them beside those of Open Image Denoise; needs --weights',
    },
    weights: { type: 'string', help: 'folder of Open Image Denoise’s .tza archives, for --quality' },
    deadline: { type: 'string', help: 'seconds after which no further variant is tried; default 480' },
  },
  async run({ log, quick, gpu, values }) {
    const started = performance.now();
    const {
      gpu: api,
      adapterName,
      software,
    } = await createGpu({
      ...(gpu === undefined ? {} : { gpu }),
      ...(values['toggles'] === undefined ? {} : { toggles: values['toggles'].split(',') }),
    });
    const device = await requestDevice({ gpu: api });
    const small = quick || software;
    const networks = listOf('networks', values['networks'], ['small', 'base', 'large'], [
      'base',
      'small',
      'large',
    ] as NetworkSize[]);
    const sizes = listOf(
      'sizes',
      values['sizes'],
      Object.keys(SIZES) as SizeName[],
      small ? ['128'] : ['1080p', '512'],
    );
    const storage = listOf('storage', values['storage'], ['f16', 'f32'] as DenoiserStorage[], ['f16'])[0]!;
    const deadline = 1e3 * Number(values['deadline'] ?? 480);
    const variants =
      values['variants'] === 'no' || (small && values['variants'] === undefined)
        ? []
        : values['variants'] === undefined
          ? VARIANTS
          : values['variants'].split(',').map((i) => VARIANTS[Number(i)]!);
    const runs = small ? 3 : 30;
    const repeats = small ? 1 : 20;
    const settle = small ? 0 : 300;
    const figures: Figure[] = [];
    const notes: string[] = ['weights are random: they do not change the speed'];
    const gpuClock = GpuClock.create(device);
    if (!gpuClock) notes.push('no timestamp queries: wall times alone');
    const gpuTime = async (work: () => Promise<void>) =>
      gpuClock ? (await gpuClock.measure(work)).busy : (await wallTimes(1, 0, work))[0]!;
    const peak = await measurePeak(device, gpuTime, small ? 64 : 16384);
    figures.push(timed('peak of f32 multiply-adds, measured', 'TFLOP/s', [peak / 1e12]));
    log(`peak ${(peak / 1e12).toFixed(1)} TFLOP/s`);
    const details: unknown[] = [];
    const folder = values['onnxruntime'];
    const onnx = folder === undefined ? undefined : await OnnxRuntime.load(folder, api, device);
    if (onnx) notes.push(`ONNX Runtime Web ${onnx.version}: encoding and decoding are not in its times`);

    /** A whole image: GPU time, the mean of several in a row for each value, and wall time. */
    const whole = async (name: string, key: string, run: () => Promise<void>) => {
      await warmUp(run, settle);
      const busy: number[] = [];
      const images = small ? 1 : 8;
      for (let i = 0; i < runs; i++)
        busy.push((await gpuTime(async () => void (await wallTimes(images, 0, run)))) / images);
      const value = AIMS[key];
      const aim =
        value === undefined || small ? undefined : { value, relation: '<=' as const, source: 'aim for an H200' };
      figures.push(
        timed(`${name}: GPU time`, 'ms', busy, aim),
        timed(`${name}: wall time`, 'ms', await wallTimes(runs, 1, run)),
      );
      const { median = NaN } = figures.at(-2)!;
      const native = OIDN[key];
      if (native !== undefined && !small)
        figures.push(timed(`${name}: GPU time over that of Open Image Denoise on an H200`, '1', [median / native]));
      log(`${name}: ${median.toFixed(3)} ms (${busy.map((ms) => ms.toFixed(2)).join(' ')})`);
    };

    const jobs = sizes.flatMap((size) => networks.map((network) => ({ size, network })));
    for (const { size, network } of jobs) {
      const subject = new Subject(device, size);
      const key = `${network} ${size}`;
      if (values['webassembly'] === 'beside') {
        const { wasm, shaders } = await besideShaders(subject, network, storage, runs);
        const ratios = shaders.map((ms, i) => ms / wasm[i]!);
        figures.push(
          timed(`${key}, WebAssembly: wall time`, 'ms', wasm),
          timed(`${key}, shaders beside it: wall time`, 'ms', shaders),
          timed(`${key}: wall time of shaders over that of WebAssembly`, '1', ratios),
        );
        const list = (numbers: readonly number[]) => numbers.map((ms) => ms.toFixed(1)).join(' ');
        log(`${key}: WebAssembly ${list(wasm)} ms, shaders ${list(shaders)} ms, ratio ${list(ratios)}`);
        subject.destroy();
        continue;
      }
      const compile = performance.now();
      await subject.with(network, { storage, webAssembly: values['webassembly'] === 'yes' }, async (run, denoiser) => {
        await denoiser.prepare(subject.width, subject.height);
        figures.push(timed(`${key}: prepare`, 'ms', [performance.now() - compile]));
        await whole(key, key, run);
        figures.push(timed(`${key}: GPU memory`, 'MB', [denoiser.memoryBytes / 1e6]));
        const layers = layersOf(network);
        for (const [kernel, { pipeline, ms }] of await kernelTimes(device, small ? 1 : 5, repeats, run)) {
          const layer = layers.find(({ name }) => name === kernel);
          const flop = layer && flopOf(layer, subject.width, subject.height);
          const share = flop === undefined ? undefined : flop / (ms / 1e3) / peak;
          figures.push(timed(`${key}, ${kernel}`, 'ms', [ms]));
          if (share !== undefined) figures.push(timed(`${key}, ${kernel}: share of the peak`, '%', [100 * share]));
          details.push({ network, size, kernel, pipeline, ms, gflop: flop && flop / 1e9, share });
          log(
            `  ${kernel}: ${ms.toFixed(3)} ms${share === undefined ? '' : `, ${(100 * share).toFixed(0)} % of the peak`} (${pipeline})`,
          );
        }
      });
      // Once more without matrices, which are used where the device has them.
      if (device.features.has('chromium-experimental-subgroup-matrix'))
        await subject.with(network, { storage, subgroupMatrices: false, webAssembly: false }, (run) =>
          whole(`${key}, without subgroup matrices`, key, run),
        );
      if (onnx) {
        figures.push(
          timed(`${network}: largest difference of ONNX Runtime's WebGPU from its CPU`, '1', [
            await onnx.difference(network),
          ]),
        );
        const { theirs, ours } = await alternate(subject, onnx, network, storage, gpuTime, {
          rounds: small ? 1 : 20,
          settle: small ? 0 : 1000,
        });
        figures.push(
          timed(`${key}: ONNX Runtime Web, GPU time`, 'ms', theirs),
          timed(`${key}: ours beside it, GPU time`, 'ms', ours),
          timed(
            `${key}: GPU time of ONNX Runtime Web over ours`,
            '1',
            theirs.map((ms, i) => ms / ours[i]!),
            small ? undefined : { value: 3, relation: '>=', source: 'aim' },
          ),
        );
        log(`${key}: ONNX Runtime Web ${theirs.map((ms) => ms.toFixed(2)).join(' ')} ms`);
        log(`${key}: ours beside it ${ours.map((ms) => ms.toFixed(2)).join(' ')} ms`);
      }
      if (values['tune'] === 'yes') {
        const before = performance.now();
        const { shapes, measured } = await subject.tune(network, storage);
        figures.push(
          timed(`${key}: tuneShapes`, 'ms', [performance.now() - before]),
          timed(`${key}: tuneShapes, part of the work that was measured`, '%', [100 * measured]),
        );
        details.push({ network, size, shapes });
        for (const [layer, family] of Object.entries(shapes)) log(`  ${layer}: ${familyName(family)}`);
        await subject.with(network, { storage, shapeOf: shapesFrom(shapes) }, (run) =>
          whole(`${key}, tuned`, key, run),
        );
        // Once more, for what changes from one moment to another.
        await subject.with(network, { storage }, (run) => whole(`${key}, not tuned, again`, key, run));
      }
      subject.destroy();
    }

    // Variants, layer by layer; then all layers with what was best for each.
    for (const { size, network } of variants.length === 0 ? [] : jobs) {
      const subject = new Subject(device, size);
      const key = `${network} ${size}`;
      const best = new Map<string, { family: KernelFamily; ms: number }>();
      for (const family of variants) {
        if (performance.now() - started > deadline) {
          notes.push(`${key}: not all variants were tried before the deadline`);
          break;
        }
        await subject.with(network, { storage, shapeOf: () => family }, async (run) => {
          const begin = performance.now();
          await warmUp(run, settle / 3);
          const prepared = performance.now() - begin;
          const times = await kernelTimes(device, small ? 1 : 3, repeats, run);
          const wall = Math.min(...(await wallTimes(small ? 1 : 5, 0, run)));
          log(`${key}, ${familyName(family)}: ${wall.toFixed(2)} ms (compiled in ${prepared.toFixed(0)} ms)`);
          for (const [kernel, { pipeline, ms }] of times) {
            details.push({ network, size, kernel, pipeline, ms, variant: familyName(family), wall });
            // What did not fit was passed over.
            if (!pipeline.includes(`threads of 4x${family.rows}x${family.outputs}`)) continue;
            if (ms < (best.get(kernel)?.ms ?? Infinity)) best.set(kernel, { family, ms });
          }
        });
      }
      const layers = layersOf(network);
      for (const [kernel, { family, ms }] of best) {
        const layer = layers.find(({ name }) => name === kernel)!;
        const share = flopOf(layer, subject.width, subject.height) / (ms / 1e3) / peak;
        log(`  best for ${key}, ${kernel}: ${ms.toFixed(3)} ms, ${(100 * share).toFixed(0)} %: ${familyName(family)}`);
      }
      await subject.with(network, { storage, shapeOf: ({ name }) => best.get(name)?.family }, (run) =>
        whole(`${key}, best variant for each layer`, key, run),
      );
      subject.destroy();
    }
    const { quality, weights } = values;
    if (quality !== undefined) {
      if (weights === undefined) throw new BenchError('bench/option', '--quality needs --weights.');
      for (const scene of QUALITY_SCENES)
        for (const samples of [1, 4, 16])
          for (const row of ['oidn alb_nrm small', 'oidn alb_nrm base'] as const)
            for (const subgroupMatrices of [true, false]) {
              const subject = await qualityCase(quality, scene, samples, row);
              const errors = await subject.errors(device, weights, { subgroupMatrices });
              const name = `${scene}, ${samples} samples, ${row}${subgroupMatrices ? '' : ', without subgroup matrices'}`;
              for (const kind of ['relmse', 'flip'] as const)
                figures.push(
                  timed(`${name}: ${kind} over the real library's`, '1', [errors[kind] / subject.expected[kind]]),
                );
            }
    }
    gpuClock?.destroy();
    onnx?.destroy();
    device.destroy();
    return {
      settings: { networks, sizes, storage, channels: 9, runs, repeats, variants: variants.map(familyName) },
      gpu: { name: adapterName, software },
      figures,
      notes,
      details,
    };
  },
};
