import type { Scene } from '@glanz/scene';
import type { isShown } from '../geometry/placement';
import type { Integrator, LightTracing } from '../integrator/integrator';
import { CASTERS, castersOf } from '../lights/casters';
import type { TracerSettings } from '../option-checks';
import type { parametersOf } from '../materials/parameters';
import type { GpuScene } from '../scene/gpu-scene';
import type { GpuMemory } from '../storage/buffers';
import type { BindGroupName } from '../storage/resources';
import type { Batch } from '../schedule/scheduler';

/** What {@link lightTracing} works with. */
export interface LightSource {
  readonly device: GPUDevice;
  readonly memory: GpuMemory;
  readonly scene: Scene;
  readonly gpuScene: GpuScene;
  readonly integrator: Integrator;
  readonly options: TracerSettings;
}

/** What the renderer has anyway: see `GuideTools`. */
export type LightTools = readonly [typeof Integrator, typeof isShown, typeof parametersOf];

/** Light paths of a batch at most. */
const BATCH = 1 << 20;
/** Pixels of all samples that are traced at once: of small images several samples, so that GPUs have enough to do. */
const PIXELS = 1 << 22;
/** Samples that are traced at once at most. */
const SAMPLES = 1 << 10;
/** Three sums of 64 bits. */
const SPLAT_BYTES = 24;
const SPLATS = 'light paths';

// GPUBufferUsage, which Node does not define.
const STORAGE = 0x0080 | 0x0008;
const UNIFORM = 0x0040 | 0x0008;

/**
 * Traces the light paths of each sample (light_trace.wesl) before the sample's paths from the camera. What they add to a
 * pixel is a part of the sample: they depend on the seed and on the sample's number alone. A batch that has a part of the
 * image traces all light paths of its samples, and keeps what falls on its pixels.
 */
export function lightTracing(source: LightSource, tools: LightTools): LightTracing {
  const [Paths, isVisible, parameters] = tools;
  const { device, memory, scene, gpuScene, integrator: main, options } = source;
  let casters: GPUBuffer | undefined;
  let splats: GPUBuffer | undefined;
  let paths: Integrator | undefined;
  /** Those that were given up; memory that they had asked for may still arrive. */
  const dropped: Integrator[] = [];
  /** Whether memory for the sums of more samples is being asked for, and a number of samples that it was refused for. */
  let growing = false;
  let refused = Infinity;
  let kernels = main.kernels;
  let frame: ArrayBuffer | undefined;
  let count = 0;
  let table: ReturnType<typeof castersOf> | undefined;
  /** What the table was made from. */
  let changes = 0;
  let wasGlossy: boolean | undefined;
  const buffers: Readonly<Record<string, () => GPUBuffer>> = {
    light_casters: () => (casters ??= memory.buffer('light casters', 16 * (2 * CASTERS + 1), UNIFORM)),
    light_splats: () => (splats ??= memory.buffer(SPLATS, SPLAT_BYTES * main.pixels, STORAGE)),
  };
  const buffer = (name: string) => buffers[name]?.();
  /** Bytes of the sums of a sample. */
  const sampleBytes = () => {
    const { features } = main.kernels;
    return SPLAT_BYTES * main.pixels * features.lightPasses;
  };
  /** How many of a batch's samples are traced at once: those whose sums fit into the memory that there is. */
  const samplesAtOnce = (samples: number) => {
    const bytes = sampleBytes();
    if (!splats || splats.size < bytes) {
      memory.release(splats);
      splats = memory.buffer(SPLATS, bytes, STORAGE);
      main.rebind('film');
    }
    const { maxBufferSize, maxStorageBufferBindingSize } = device.limits;
    const max = Math.min(PIXELS / main.pixels, Math.min(maxBufferSize, maxStorageBufferBindingSize) / bytes, SAMPLES);
    const requested = Math.min(samples, Math.floor(max));
    if (requested * bytes > splats.size && requested < refused && !growing) void grow(requested, bytes);
    return Math.min(samples, Math.floor(splats.size / bytes));
  };
  /** Asks for more. Where it is refused, all goes on as before: it is only faster. */
  const grow = async (samples: number, bytes: number) => {
    growing = true;
    device.pushErrorScope('out-of-memory');
    const made = memory.buffer(SPLATS, samples * bytes, STORAGE);
    const error = await device.popErrorScope().catch((lost: unknown) => lost);
    growing = false;
    if (error) refused = samples;
    if (error || memory.destroyed || bytes !== sampleBytes()) return memory.release(made);
    memory.release(splats);
    splats = made;
    main.rebind('film');
  };
  const release = () => {
    for (const { buffers: made } of dropped) for (const buffer of Object.values(made)) memory.release(buffer);
  };
  const bring = () => {
    if (paths && kernels === main.kernels) return paths;
    kernels = main.kernels;
    // Light paths ask for no light samples.
    const features = { ...kernels.features, flags: { ...kernels.features.flags, NEXT_EVENT: false } };
    const { intersect, advance, light_begin: begin, light_start: generate, light_trace: shade } = kernels.kernels;
    const own = { features, kernels: { begin, generate, intersect, shade, advance } as typeof kernels.kernels };
    if (!paths) {
      const pixels = Math.min(BATCH, Math.max(count, 1));
      const film = { pixels, buffer, bytes: ({ size }: GPUBuffer) => size };
      paths = new Paths(device, memory, gpuScene, features, film, BATCH, options);
      if (frame) paths.writeFrame(frame);
    }
    paths.prepare(own).use();
    paths.rebind();
    return paths;
  };
  return {
    buffer,
    writeFrame(data) {
      frame = data;
      count = Math.min(0xffffff, Math.max(1, Math.round(options.lightPaths * main.pixels)));
      // They do not know how measured lights shine, and not what light samples pass.
      const isGlossy =
        !main.kernels.features.flags.NULL_SURFACES && !scene.lights.some(({ type }) => type === 'profile');
      // A look at each instance: not for each move of the camera.
      if (!table || changes !== gpuScene.changes || wasGlossy !== isGlossy)
        table = castersOf(scene, (instance) => isVisible(scene, instance), parameters, {
          isSmooth: options.shadowTerminator === 'smooth',
          isGlossy,
        });
      ({ changes } = gpuScene);
      wasGlossy = isGlossy;
      table[1] = count;
      memory.write(buffer('light_casters') as GPUBuffer, table);
      if (table[0] === 0) count = 0;
      paths?.writeFrame(data);
    },
    rebind(group?: BindGroupName) {
      if (group) return paths?.rebind(group);
      // The GPU has refused something, perhaps these.
      if (paths) dropped.push(paths);
      release();
      memory.release(splats);
      paths = splats = undefined;
    },
    submit(batch: Batch, trace: (part: Batch) => void) {
      if (!main.kernels.features.flags.LIGHT_PATHS) return trace(batch);
      release();
      const { sampleOffset, sampleCount } = batch;
      const bytes = sampleBytes();
      const atOnce = samplesAtOnce(sampleCount);
      for (let first = 0; first < sampleCount; first += atOnce) {
        const samples = Math.min(atOnce, sampleCount - first);
        const part = { ...batch, sampleOffset: sampleOffset + first, sampleCount: samples };
        const encoder = device.createCommandEncoder({ label: 'glanz light paths' });
        encoder.clearBuffer(splats as GPUBuffer, 0, samples * bytes);
        device.queue.submit([encoder.finish()]);
        if (count > 0) {
          const light = bring();
          const step = Math.max(1, Math.floor(light.room(Math.min(BATCH, count * samples)) / samples));
          for (let offset = 0; offset < count; offset += step) {
            const own = { ...part, pixelOffset: offset, pixelCount: Math.min(step, count - offset) };
            light.submit(own, { begin: 0, end: 0, only: true });
          }
        }
        trace(part);
      }
    },
  };
}
