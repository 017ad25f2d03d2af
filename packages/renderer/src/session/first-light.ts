import type { Camera } from '@glanz/scene';
import { packFrame } from './frame';
import {
  GPU_BUFFER_COPY_DST,
  GPU_BUFFER_COPY_SRC,
  GPU_BUFFER_STORAGE,
  GPU_BUFFER_UNIFORM,
  GpuMemory,
} from '../storage/buffers';
import { inErrorScopes } from '../device/error-scopes';
import type { GpuScene } from '../scene/gpu-scene';
import type { KernelCache } from '../integrator/kernel-cache';
import { forBands } from '../integrator/bands';
import { batchStruct } from '../storage/layout';
import { createBindGroup } from '../storage/resources';
import type { Kernel, KernelFeatures } from '../integrator/pipelines';
import type { TracerSettings } from '../option-checks';
import type { FirstLight } from '../options';
import type { Geometry } from '../geometry/geometry';

/** What {@link showFirstLight} shows. */
export interface FirstLightSource {
  readonly device: GPUDevice;
  readonly scene: GpuScene;
  readonly geometry: Geometry;
  readonly camera: Camera;
  readonly cache: KernelCache;
  readonly features: KernelFeatures;
  readonly options: TracerSettings;
}

/**
 * Draws the scene with the first-light kernel, as soon as its shapes are there, and passes the image on, unless
 * `late` says that there is something better by then.
 *
 * @returns Frees the image; to be called when the tracer is there.
 */
export function showFirstLight(
  source: FirstLightSource,
  show: (image: FirstLight) => void,
  late: () => boolean,
): () => void {
  const { device, scene, geometry, camera, cache, features, options } = source;
  const { width, height } = options;
  // Its own accounts: it is gone before they can be read.
  const memory = new GpuMemory(device);
  const draw = async () => {
    const kernel = await cache.kernel('first', { ...features, pages: scene.pages });
    if (late()) return;
    const { result: beauty, verified } = inErrorScopes(device, 'the first image', () => encode(kernel));
    await verified;
    if (!late()) show({ buffer: beauty, width, height });
  };
  const encode = (kernel: Kernel): GPUBuffer => {
    const own: Record<string, GPUBuffer> = {
      frame: memory.upload(
        'first frame',
        packFrame(camera, { width, height }, scene, geometry, options),
        GPU_BUFFER_UNIFORM,
      ),
      batch: memory.buffer('first batch', batchStruct.size, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST),
      beauty: memory.buffer('first image', 16 * width * height, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC),
    };
    const groups = kernel.groups.map((group, index) =>
      createBindGroup(device, kernel.layouts[index] as GPUBindGroupLayout, group, (name) =>
        own[name] ? { buffer: own[name] } : scene.resource(name),
      ),
    );
    forBands(width * height, ({ pixelOffset, pixelCount }) => {
      const data = batchStruct.allocate();
      batchStruct.write(data, 0, { pixel_offset: pixelOffset, pixel_count: pixelCount, path_count: pixelCount });
      memory.write(own['batch'] as GPUBuffer, data);
      const encoder = device.createCommandEncoder({ label: 'glanz first' });
      const pass = encoder.beginComputePass();
      pass.setPipeline(kernel.pipeline);
      groups.forEach((group, index) => pass.setBindGroup(index, group));
      pass.dispatchWorkgroups(Math.ceil(pixelCount / 64));
      pass.end();
      device.queue.submit([encoder.finish()]);
    });
    return own['beauty'] as GPUBuffer;
  };
  // Nobody waits for it: what is wrong with the device, the tracer will say itself.
  draw().catch(() => {});
  return () => memory.destroy();
}
