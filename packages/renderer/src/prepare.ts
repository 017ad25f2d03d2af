import { yieldToEventLoop, type Camera, type Scene } from '@glanz/scene';
import { lossInfo } from './device/device-loss';
import { deviceLost } from './errors';
import type { Film } from './film/film';
import { gpuBuilds, type HierarchyBuild } from './geometry/hierarchy';
import type { Integrator } from './integrator/integrator';
import { KernelCache } from './integrator/kernel-cache';
import type { TextureFit } from './scene/texture-fit';
import { checkSize, resolveOptions, type TracerSettings } from './option-checks';
import type { PathTracerOptions, RenderStatistics } from './options';
import { preparationStages } from './preparation';
import type { GpuScene } from './scene/gpu-scene';
import { SceneEditor } from './scene/scene-editor';
import { runStages } from './schedule/stages';
import { GpuMemory } from './storage/buffers';

/** What `PathTracer.create` has put together. */
export interface Prepared {
  readonly device: GPUDevice;
  readonly memory: GpuMemory;
  readonly editor: SceneEditor;
  readonly gpuScene: GpuScene;
  readonly cache: KernelCache;
  readonly integrator: Integrator;
  readonly film: Film;
  readonly camera: Camera;
  readonly options: TracerSettings;
  readonly textures: TextureFit;
  /** Times of the preparation. */
  readonly times: Pick<
    RenderStatistics,
    'checkMs' | 'textMs' | 'bvhMs' | 'builds' | 'uploadMs' | 'lightMs' | 'compileMs'
  >;
}

/** Builds, uploads and compiles what a tracer needs, see `PathTracer.create`. */
export async function prepareTracer(device: GPUDevice, scene: Scene, given: PathTracerOptions): Promise<Prepared> {
  const begun = performance.now();
  // A lost device accepts all calls: `check` looks after each stage whether it was lost.
  lossInfo(device);
  checkSize(given.width, given.height);
  const options = resolveOptions(given);
  await yieldToEventLoop();
  const memory = new GpuMemory(device);
  const cache = new KernelCache(device);
  const builders = { hierarchies: options.hierarchies, gpu: gpuBuilds(device, memory, options.bvhBuilder) };
  const builds: HierarchyBuild[] = [];
  let late = false;
  const check = () => {
    const lost = lossInfo(device);
    if (lost) throw deviceLost(lost);
  };
  try {
    const { products, times } = await runStages(
      preparationStages({
        device,
        memory,
        cache,
        scene,
        options,
        builders: { ...builders, onBuilt: (build) => builds.push(build) },
        isLate: () => late,
      }),
      { signal: options.signal, check },
    );
    products.firstLight();
    const { scene: own, geometry, gpuScene, integrator, film, camera, textures } = products;
    return {
      device,
      memory,
      editor: new SceneEditor(own, geometry, gpuScene, builders),
      gpuScene,
      cache,
      integrator,
      film,
      camera,
      options,
      textures,
      times: {
        checkMs: times.expected.end - begun,
        textMs: times.request.end - times.request.begin,
        bvhMs: times.geometry.end - times.geometry.begin,
        builds,
        uploadMs: times.gpuScene.end - times.geometry.end,
        lightMs: times.gpuScene.end - times.firstLight.end,
        compileMs: times.kernels.end - times.request.begin,
      },
    };
  } catch (error) {
    memory.destroy();
    throw error;
  } finally {
    late = true;
  }
}
