import { mergeFilmSources, readFilmState } from '@glanz/renderer/film';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createScene, GlanzError, type Camera, type Scene } from '@glanz/scene';
import { onTestFinished } from 'vitest';
import type { Backend, FilmState, PathTracerOptions, RenderStatistics, Tracer } from '../src/backend';
import { runCli, type CliIo, type Interrupt } from '../src/index';

/** A folder that is gone after the test, with the given files. */
export function temporaryFolder(files: Readonly<Record<string, string | Uint8Array>> = {}): string {
  const folder = mkdtempSync(join(tmpdir(), 'glanz-cli-'));
  onTestFinished(() => rmSync(folder, { recursive: true, force: true }));
  for (const [name, content] of Object.entries(files)) writeFileSync(join(folder, name), content);
  return folder;
}

/** One triangle seen by a camera called "front". */
export function triangleScene(): Scene {
  return {
    ...createScene('triangle'),
    meshes: [
      {
        name: 'triangle',
        positions: new Float32Array([-1, 0, 0, 1, 0, 0, 0, 1, 0]),
        indices: new Uint32Array([0, 1, 2]),
      },
    ],
    materials: [{ name: 'white', parameters: {} }],
    instances: [{ name: 'part', mesh: 0, material: 0, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }],
    cameras: [
      { type: 'perspective', name: 'front', transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.5, 4, 1], yfov: 0.8 },
    ],
  };
}

const STATISTICS: RenderStatistics = {
  triangles: 1,
  instances: 1,
  lights: 0,
  checkMs: 0.5,
  textMs: 0.5,
  bvhMs: 1,
  builds: [],
  uploadMs: 2,
  lightMs: 1,
  compileMs: 3,
  gpuBytes: 4,
  memory: {
    shapes: 1,
    lights: 0,
    materials: 1,
    textures: 0,
    fullTextures: 0,
    reducedTextures: [],
    environment: 0,
    paths: 1,
    film: 1,
    other: 0,
    pathsInFlight: 1,
    perPath: 1,
    perTriangle: 1,
    perPixel: 1,
    perTexel: 0,
  },
  badSamples: 0,
};

const filmOf = (samples: number, width: number, height: number) =>
  ({ samples, width, height, sums: {} }) as unknown as FilmState;

/**
 * A tracer that counts samples and whose every pixel holds (x/width, y/height, 0.25); what was asked of it is recorded.
 */
export interface FakeRun {
  backend: Backend;
  created: { scene: Scene; options: PathTracerOptions }[];
  destroyed: string[];
  /** What tracers were changed to, in order. */
  edits: (readonly [what: string, to: unknown])[];
}

export const FAKE_GPUS = [
  { name: 'Fake 3000', backend: 'vulkan', driver: 'fakedrv 1.2', software: false },
  { name: 'SwiftShader Device', backend: 'vulkan', driver: '', software: true },
];

/** The part of a device that the command touches; it can be lost. */
export interface FakeDevice extends GPUDevice {
  /** Loses it, as a driver does. Gives the error that the renderer then throws. */
  lose(): GlanzError;
}

class DeviceError extends GlanzError {}

export function fakeDevice(onDestroy: () => void = () => undefined): FakeDevice {
  let lost: (info: GPUDeviceLostInfo) => void = () => undefined;
  const device = {
    lost: new Promise<GPUDeviceLostInfo>((done) => (lost = done)),
    queue: { onSubmittedWorkDone: async () => undefined },
    destroy: onDestroy,
    lose() {
      lost({ reason: 'unknown', message: 'injected' } as GPUDeviceLostInfo);
      return new DeviceError('renderer/device-lost', 'The GPU device was lost.');
    },
  };
  return device as unknown as FakeDevice;
}

export interface FakeOptions {
  readonly scene?: Scene;
  /** Called before each sample is yielded, with the device that makes it. */
  readonly onSample?: (sample: number, device: FakeDevice) => void;
  /** Called before a layer is read. */
  readonly onRead?: (layer: string, device: FakeDevice) => void;
  /** Called when an image is to be denoised. */
  readonly onDenoise?: () => void;
  /** Called when a film is copied. */
  readonly onSave?: () => void;
  /** Whether tracers take films of others. */
  readonly resumes?: boolean;
  /** Called before an edit. */
  readonly onEdit?: (what: string, to: unknown, device: FakeDevice) => void;
  /** Gives the event loop, and files that are being written, time between samples. */
  readonly slowly?: boolean;
  readonly lightGroups?: readonly {
    readonly name: string;
    readonly intensity: number;
    readonly color: readonly [number, number, number];
  }[];
  readonly loadModel?: Backend['loadModel'];
  readonly openAnimations?: Backend['openAnimations'];
  /** Called when a tracer's camera is set, with the samples that the film has. */
  readonly onCamera?: (camera: Camera, samples: number) => void;
  readonly openGpu?: Backend['openGpu'];
  readonly listGpus?: Backend['listGpus'];
}

export function fakeBackend(fake: FakeOptions = {}): FakeRun {
  const created: FakeRun['created'] = [];
  const destroyed: string[] = [];
  const edits: FakeRun['edits'] = [];
  const createTracer = async (device: GPUDevice, scene: Scene, options: PathTracerOptions): Promise<Tracer> => {
    created.push({ scene, options });
    options.signal?.throwIfAborted();
    const { width, height } = options;
    let samples = 0;
    const interleaved = (f: (x: number, y: number, k: number) => number) =>
      Float32Array.from({ length: width * height * 4 }, (_, i) =>
        f((i >> 2) % width, Math.floor((i >> 2) / width), i & 3),
      );
    const edited = (what: string, to: unknown) => {
      edits.push([what, to]);
      if (!tracer.accumulates) samples = 0;
    };
    const tracer = {
      accumulates: false,
      get samples() {
        return samples;
      },
      statistics: STATISTICS,
      async *render({ samples: target = 64, signal }: { samples?: number; signal?: AbortSignal } = {}) {
        for (let s = samples + 1; s <= target; s++) {
          if (fake.slowly) await new Promise((done) => setTimeout(done, 2));
          fake.onSample?.(s, device as FakeDevice);
          if (signal?.aborted) return;
          samples = s;
          yield {
            samples: s,
            targetSamples: target,
            elapsedMs: s * 100,
            remainingMs: (target - s) * 100,
            samplesPerSecond: 10,
          };
        }
      },
      async read(layer: string) {
        fake.onRead?.(layer, device as FakeDevice);
        if (layer === 'beauty')
          return interleaved(
            (x, y, k) => [x / width, y / height, 0.25, options.background === 'transparent' ? 0.5 : 1][k] as number,
          );
        if (layer === 'albedo') return interleaved((_x, _y, k) => [0.5, 0.25, 0.125, 1][k] as number);
        if (layer === 'normal') return interleaved((_x, _y, k) => [0, 0, 1, 0][k] as number);
        if (layer === 'position') return interleaved((x, y, k) => [x, y, -2, 1][k] as number);
        if (layer === 'variance') return interleaved((_x, _y, k) => [1e-9, 2e-9, 3e-9, samples][k] as number);
        if (layer === 'depth') return Float32Array.from({ length: width * height }, (_, i) => i * 0.1);
        return Uint32Array.from({ length: width * height }, (_, i) => (i === 0 ? 0xffffffff : i));
      },
      reset() {
        samples = 0;
      },
      async saveFilm() {
        fake.onSave?.();
        return filmOf(samples, width, height);
      },
      async restoreFilm(state: FilmState) {
        if (state.width !== width || fake.resumes === false)
          throw new DeviceError('renderer/film-state', 'The saved film cannot be resumed here.');
        samples = state.samples;
        edits.push(['film', samples]);
      },
      async setCamera(camera: unknown) {
        fake.onCamera?.(camera as Camera, samples);
        edited('camera', (camera as { name?: string }).name);
      },
      async setVariant(variant: unknown) {
        fake.onEdit?.('variant', variant, device as FakeDevice);
        edited('variant', variant);
      },
      setInstanceTransforms: async (list: readonly (readonly [number, unknown])[]) => {
        for (const [instance, transform] of list) edited(`instance ${instance}`, transform);
      },
      lightGroups: fake.lightGroups ?? [{ name: 'rest', intensity: 1, color: [1, 1, 1] }],
      async readLightGroup(name: string) {
        return interleaved((_x, _y, k) => (k === 3 ? 1 : name.length));
      },
      destroy: () => void destroyed.push('tracer'),
    };
    return tracer as unknown as Tracer;
  };
  return {
    created,
    destroyed,
    edits,
    backend: {
      loadModel: fake.loadModel ?? (async () => fake.scene ?? triangleScene()),
      openAnimations:
        fake.openAnimations ??
        (async () => {
          throw new Error('no animations');
        }),
      compressedFormats: async () => [],
      openGpu:
        fake.openGpu ??
        (async () => ({
          device: fakeDevice(() => destroyed.push('device')),
          adapterName: 'Fake 3000',
          software: false,
        })),
      listGpus: fake.listGpus ?? (async () => FAKE_GPUS),
      createTracer,
      createDenoiser: async (_device, quality) => ({
        async denoise(tracer, signal) {
          fake.onDenoise?.();
          signal.throwIfAborted();
          const beauty = (await (tracer as Tracer).read('beauty')) as Float32Array;
          return beauty.map((value, i) => (i % 4 === 3 ? value : quality === 'fast' ? 0.5 : 0.125));
        },
        destroy: () => void destroyed.push('denoiser'),
      }),
      filmCodec: async () => ({
        encode: ({ samples, width, height }) => [new TextEncoder().encode(JSON.stringify([samples, width, height]))],
        decode: (bytes) => filmOf(...(JSON.parse(new TextDecoder().decode(bytes)) as [number, number, number])),
        merge: mergeFilmSources,
        layer: readFilmState,
      }),
    },
  };
}

export interface FakeIo extends CliIo {
  readonly out: string[];
  readonly err: string[];
  /** Presses Ctrl-C, or what else is named. */
  interrupt(signal?: Interrupt): void;
  /** Moves the clock. */
  time: number;
  listening: number;
  /** Milliseconds that were to be waited; nothing is. */
  readonly waits: number[];
}

export function fakeIo(
  cwd: string,
  settings: { readonly interactive?: boolean; readonly columns?: number } = {},
): FakeIo {
  const handlers = new Set<(signal: Interrupt) => void>();
  const io: FakeIo = {
    out: [],
    err: [],
    time: 0,
    get listening() {
      return handlers.size;
    },
    set listening(_value) {},
    stdout: (text) => void io.out.push(text),
    stderr: (text) => void io.err.push(text),
    interactive: settings.interactive ?? false,
    columns: () => settings.columns ?? 80,
    color: false,
    cwd,
    debug: false,
    now: () => io.time,
    wait: async (milliseconds) => {
      io.waits.push(milliseconds);
      await new Promise((done) => setImmediate(done));
    },
    waits: [],
    onInterrupt(handler) {
      handlers.add(handler);
      return () => void handlers.delete(handler);
    },
    interrupt: (signal = 'SIGINT') => {
      for (const handler of handlers) handler(signal);
    },
  };
  return io;
}

/** Runs the command against fakes and gives everything it left. */
export async function run(argv: readonly string[], cwd: string, fake: FakeOptions = {}, io: FakeIo = fakeIo(cwd)) {
  const { backend, created, destroyed, edits } = fakeBackend(fake);
  const code = await runCli(argv, io, backend);
  return { code, out: io.out.join(''), err: io.err.join(''), created, destroyed, edits, io };
}
