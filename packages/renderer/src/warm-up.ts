import { loadPart } from '@glanz/wgsl';
import { createScene } from '@glanz/scene';
import { loadGpuTrees } from './geometry/hierarchies';
import { buildsOnGpu } from './geometry/hierarchy';
import { PathTracer } from './path-tracer';
import type { WarmUpOptions } from './warm-up-scene';

export type { WarmUpOptions } from './warm-up-scene';

/**
 * Does work in advance that only the first scene on a page or in a process needs, for example while a model loads. It
 * prepares a small scene and renders a sample, so that the JavaScript engine has compiled the code for meshes and
 * lights, and the device the kernels that most scenes share. Then it frees everything.
 *
 * It takes as much time of the thread as it saves, in slices of a few milliseconds; with `hierarchies` it warms up the
 * workers too. Not worth it on a software adapter, whose kernels are as slow as the work that they prepare.
 *
 * @param device The one that tracers will be made on.
 * @param options `signal` ends it at once: abort it when the model is there.
 * @returns When it is done or was aborted. Never rejects: `PathTracer.create` reports what is wrong with the device.
 * @example
 * const device = await requestDevice();
 * const warm = warmUp(device, { hierarchies });
 * const scene = await loadGltf(url);
 * await warm;
 * const tracer = await PathTracer.create(device, scene, { width, height, hierarchies });
 */
export async function warmUp(device: GPUDevice, options: WarmUpOptions = {}): Promise<void> {
  // JavaScript engines discard compiled code for typed arrays when the first buffer is detached, as transfers to workers
  // and reads from the GPU do. So one is detached before anything is compiled.
  const gone = new ArrayBuffer(8);
  structuredClone(gone, { transfer: [gone] });
  try {
    // The small scene is built on the CPU; the shaders that build large meshes compile meanwhile.
    if (buildsOnGpu(device, options.bvhBuilder))
      void loadGpuTrees()
        .then(({ gpuBuilder }) => gpuBuilder(device))
        .catch(() => {});
    // Loaded here only: most of what this takes, and not every page warms up.
    await (
      await loadPart('warm-up-scene', import('./warm-up-scene'))
    ).renderSample(PathTracer, device, createScene(), options);
  } catch {
    // Given up, or a device that nothing can be done with.
  }
}
