import type { Camera, Scene } from '@glanz/scene';
import type { withErrorScopes } from '../device/error-scopes';
import type { Geometry } from '../geometry/geometry';
import type { isShown } from '../geometry/placement';
import { guidePoints } from '../guiding/guide-points';
import { guideTable } from '../guiding/guide-table';
import { GUIDE_BINS, GUIDE_WIDTH } from '../guiding/guide_constants.wesl';
import { TRAINING_KERNELS } from '../integrator/guide-kernels';
import type { Integrator } from '../integrator/integrator';
import type { KernelCache } from '../integrator/kernel-cache';
import type { KernelFeatures } from '../integrator/pipelines';
import type { TracerSettings } from '../option-checks';
import type { parametersOf } from '../materials/parameters';
import type { GpuScene } from '../scene/gpu-scene';
import type { GpuMemory } from '../storage/buffers';
import type { readFloats } from '../storage/read-buffer';
import type { packFrame } from './frame';

// In the same chunk: scenes without a guide load neither.
export { paneTableSteps } from '../guiding/pane-table';

/** What {@link trainGuide} works with. */
export interface GuideSource {
  readonly device: GPUDevice;
  readonly cache: KernelCache;
  readonly scene: Scene;
  readonly geometry: Geometry;
  readonly gpuScene: GpuScene;
  /** Of the kernels that will use the guide. */
  readonly features: KernelFeatures;
  readonly camera: Camera;
  readonly options: TracerSettings;
  readonly signal: AbortSignal;
}

/**
 * What the renderer has anyway. Passed on, so that this file, which is loaded later, shares no code with it; in a list,
 * since names of members take room.
 */
export type GuideTools = readonly [
  typeof Integrator,
  typeof GpuMemory,
  typeof isShown,
  typeof packFrame,
  typeof parametersOf,
  typeof readFloats,
  typeof withErrorScopes,
];

/** Samples of a bin that a guide has at least: with fewer it has fewer leaves. */
const MIN_SAMPLES = 8;
/** More leaves take more memory than they are worth: 20 KiB each while training, 1 KiB later. */
const MAX_LEAVES = 1 << 14;
/** Paths of a batch. */
const BATCH = 1 << 18;
/** Paths between two looks at the signal. */
const STRIDE = 1 << 20;

// GPUBufferUsage, which Node does not define.
const COPY_SRC = 0x0004;
const STORAGE = 0x0080;

/**
 * Learns from where light comes to the scene's surfaces, other than straight from what light samples find, and gives
 * the scene a table of it: see guide.wesl. Paths start at points of the surfaces, a fixed number in each bin of
 * directions, and what they find is summed up for each leaf of a tree of those points. The kernels that trace them are
 * those of the film, which do not have a guide yet.
 *
 * @throws {DeviceError} `renderer/device-lost`, `renderer/out-of-memory`, `renderer/limit`, `renderer/gpu-error`
 */
export async function trainGuide(source: GuideSource, tools: GuideTools): Promise<void> {
  const [Paths, Memory, isVisible, pack, parameters, read, verified] = tools;
  const { device, cache, scene, geometry, gpuScene, camera, options, signal } = source;
  // Training paths do not begin at the camera.
  const features = {
    ...source.features,
    flags: { ...source.features.flags, LIGHT_PATHS: false, AREA_LIGHT_WEIGHTS: false },
  };
  const bins = (options.guiding * 1e6) / GUIDE_BINS;
  const leaves = 2 ** Math.floor(Math.log2(Math.min(MAX_LEAVES, Math.max(1, bins / MIN_SAMPLES))));
  // Even and odd ones: equally many.
  const samples = 2 * Math.max(1, Math.round(bins / leaves / 2));
  const m = camera.transform;
  const eye = [m[12] as number, m[13] as number, m[14] as number] as const;
  const points = guidePoints(scene, (instance) => isVisible(scene, instance), parameters, eye, leaves);
  // Until there is a guide, and where it has nothing to do: one leaf, whose share is 0.
  const setGuide = (table: Float32Array<ArrayBuffer>) =>
    verified(device, 'the guide', () => gpuScene.setGuide(table, GUIDE_WIDTH));
  const none = new Float32Array(GUIDE_WIDTH);
  none[0] = 1;
  await setGuide(none);
  if (!points) return;

  const [{ kernels }, begin, generate, resolve] = await Promise.all([
    cache.get(features),
    cache.kernel('begin', features, TRAINING_KERNELS.begin),
    cache.kernel('generate', features, TRAINING_KERNELS.generate),
    cache.kernel('resolve', features, TRAINING_KERNELS.resolve),
  ]);
  signal.throwIfAborted();
  const memory = new Memory(device);
  try {
    const pixels = leaves * GUIDE_BINS;
    const { integrator, sums } = await verified(device, 'training the guide', () => {
      const buffers: Readonly<Record<string, GPUBuffer>> = {
        guide_points: memory.upload('guide points', points.points, STORAGE),
        beauty: memory.buffer('guide sums', 16 * pixels, STORAGE | COPY_SRC),
      };
      const film = {
        pixels: Math.min(pixels, BATCH),
        buffer: (name: string) => buffers[name],
        bytes: ({ size }: GPUBuffer) => size,
      };
      const made = new Paths(device, memory, gpuScene, features, film, BATCH, options);
      made.begin({ features, kernels: { ...kernels, begin, generate, resolve } });
      // Paths begin as if they had two edges: see guide_begin.wesl.
      const settings: TracerSettings = { ...options, maxDepth: options.maxDepth + 2, background: 'environment' };
      made.writeFrame(pack(camera, { width: GUIDE_BINS, height: leaves }, gpuScene, geometry, settings));
      return { integrator: made, sums: buffers['beauty'] as GPUBuffer };
    });
    const pixelCount = Math.min(pixels, integrator.capacity);
    let traced = 0;
    for (let sampleOffset = 0; sampleOffset < samples; sampleOffset++)
      for (let pixelOffset = 0; pixelOffset < pixels; pixelOffset += pixelCount) {
        integrator.submit({ pixelOffset, pixelCount, sampleOffset, sampleCount: 1 });
        if ((traced += pixelCount) < STRIDE) continue;
        traced = 0;
        await device.queue.onSubmittedWorkDone();
        signal.throwIfAborted();
      }
    const squares = await read(device, sums);
    signal.throwIfAborted();
    await setGuide(guideTable(points, squares, samples / 2));
  } finally {
    memory.destroy();
  }
}
