import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { BenchError } from '../error';
import { gridScene } from './scene';

/** What one process renders. */
export interface ScalePlan {
  readonly triangles: number;
  /** Whether the device has WebGPU's default limits rather than those of its adapter. */
  readonly defaultLimits: boolean;
  readonly size: number;
  readonly samples: number;
  /** `memory.compactAboveMiB` of the tracer; absent: its default. */
  readonly compactAboveMiB?: number;
  readonly gpu?: string;
}

/** An array of shapes on the GPU. */
export interface ShapeArrayUse {
  readonly name: string;
  readonly bytes: number;
  /** Layers of a texture; 0 for a buffer. */
  readonly pages: number;
}

/** What a process has rendered, and what it took. */
export interface ScaleResult {
  readonly triangles: number;
  readonly adapter: { readonly name: string; readonly software: boolean };
  /** `maxStorageBufferBindingSize` of the device. */
  readonly bindingBytes: number;
  readonly arrays: readonly ShapeArrayUse[];
  readonly gpuBytes: number;
  readonly bytesPerTriangle: number;
  /** Of the process, with the mesh; memory of a software GPU is in it. */
  readonly peakBytes: number;
  readonly createMs: number;
  readonly renderMs: number;
  readonly badSamples: number;
  /** The linear film, RGBA floats in base64: all its bits. */
  readonly film: string;
}

/** Records the arrays of shapes that are made on a device. */
function watchArrays(device: GPUDevice): ShapeArrayUse[] {
  const arrays: ShapeArrayUse[] = [];
  const nameOf = (label = '') => /^glanz (nodes|triangles|attributes)$/.exec(label)?.[1];
  const [createBuffer, createTexture] = [device.createBuffer.bind(device), device.createTexture.bind(device)];
  device.createBuffer = (descriptor) => {
    const name = nameOf(descriptor.label);
    if (name) arrays.push({ name, bytes: descriptor.size, pages: 0 });
    return createBuffer(descriptor);
  };
  device.createTexture = (descriptor) => {
    const name = nameOf(descriptor.label);
    const texture = createTexture(descriptor);
    const texel = descriptor.format === 'r32uint' ? 4 : 16;
    const pages = texture.depthOrArrayLayers;
    if (name) arrays.push({ name, bytes: texel * texture.width * texture.height * pages, pages });
    return texture;
  };
  return arrays;
}

/**
 * Renders the grid on one device. Hierarchies are built on the CPU on every device: those of the GPU differ, and default
 * limits leave no room to build large ones there.
 */
export async function renderAtScale(plan: ScalePlan, log: (line: string) => void): Promise<ScaleResult> {
  const { size, samples, defaultLimits } = plan;
  const { gpu, adapterName, software } = await createGpu(plan.gpu === undefined ? {} : { gpu: plan.gpu });
  const faults: string[] = [];
  const device = await requestDevice({ gpu, defaultLimits, onError: ({ message }) => faults.push(message) });
  const arrays = watchArrays(device);
  const scene = gridScene(plan.triangles);
  const started = performance.now();
  const tracer = await PathTracer.create(device, scene, {
    width: size,
    height: size,
    camera: scene.cameras[0]!,
    maxDepth: 4,
    pathsInFlight: Math.min(1 << 16, size * size),
    bvhBuilder: 'cpu',
    ...(plan.compactAboveMiB === undefined ? {} : { memory: { compactAboveMiB: plan.compactAboveMiB } }),
  });
  const created = performance.now();
  log(`${defaultLimits ? 'default limits' : "the adapter's limits"}: created in ${Math.round(created - started)} ms`);
  for await (const progress of tracer.render({ samples, maxSubmitMs: 1000 })) void progress;
  const film = await tracer.read('beauty');
  const rendered = performance.now();
  const { triangles, gpuBytes, memory, badSamples } = tracer.statistics;
  tracer.destroy();
  await device.queue.onSubmittedWorkDone();
  if (faults.length > 0)
    throw new BenchError('bench/gpu-error', `${faults.length} GPU errors, the first: ${faults[0]}`);
  return {
    triangles,
    adapter: { name: adapterName, software },
    bindingBytes: device.limits.maxStorageBufferBindingSize,
    arrays,
    gpuBytes,
    bytesPerTriangle: memory.perTriangle,
    peakBytes: process.resourceUsage().maxRSS * 1024,
    createMs: created - started,
    renderMs: rendered - created,
    badSamples,
    film: Buffer.from(film.buffer, film.byteOffset, film.byteLength).toString('base64'),
  };
}
