import type { Blas } from '@glanz/bvh';
import type { BuildBoxes } from '@glanz/bvh/dynamic-tlas';
import { blasInOrder, GpuBuilder } from '@glanz/bvh/gpu';
import type { Mesh } from '@glanz/scene';
import { inErrorScopes, lossOr, withErrorScopes } from '../device/error-scopes';
import { DeviceError } from '../errors';
import { GPU_BUFFER_COPY_DST, GPU_BUFFER_COPY_SRC, GPU_BUFFER_STORAGE, type PagedArray } from '../storage/buffers';
import { readBuffer } from '../storage/read-buffer';
import { uploadPace } from '../storage/upload-pace';
import { encodeRecords, RECORD_BYTES, recordsPipeline } from './compact-records';
import type { CompactShapes } from './compact-shapes';
import type { GpuBuilds, Hierarchy, HierarchyOnGpu, MeshRegion } from './hierarchy';

// In the same chunk: what poses rigs shares the most with it.
export { discardPoser, poseOnGpu } from './pose/pose-mesh';

/** Bytes of a node, of a packed triangle, and of a word of the attributes. */
const NODE_BYTES = 64;
const TRIANGLE_BYTES = 48;
const WORD_BYTES = 4;

/** Meshes that are uploaded or built at the same time: the GPU builds one while the next is written. */
const LANES = 3;

/** Bytes of a mesh that are written at once. */
const SLICE_BYTES = 1 << 20;

/** Errors of a GPU that cannot build a mesh which the CPU can. */
const CPU_CAN = /^(bvh\/(limit|memory|pipeline|too-many)|renderer\/(limit|out-of-memory)|wgsl\/compile)$/;

const cpuCan = (error: unknown) => CPU_CAN.test(String((error as { readonly code?: unknown }).code));

/** One builder a device: its shaders are compiled once. */
const builders = /* @__PURE__ */ new WeakMap<GPUDevice, Promise<GpuBuilder>>();

/** The device's builder, which may still compile. */
export function gpuBuilder(device: GPUDevice): Promise<GpuBuilder> {
  let builder = builders.get(device);
  if (!builder) {
    builders.set(device, (builder = GpuBuilder.create(device)));
    builder.catch(() => builders.delete(device));
  }
  return builder;
}

/**
 * Writes arrays into buffers of their own, in slices, so that other work of the thread comes in between.
 *
 * @param what For errors: what has no room on the GPU.
 */
function uploader(
  { device, memory }: Pick<GpuBuilds, 'device' | 'memory'>,
  what: string,
  signal: AbortSignal | undefined,
) {
  const pace = uploadPace(device);
  return async (label: string, data: Float32Array | Uint32Array): Promise<GPUBuffer> => {
    const buffer = await withErrorScopes(device, what, () =>
      memory.buffer(label, data.byteLength, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_DST | GPU_BUFFER_COPY_SRC),
    );
    const written: Promise<void>[] = [];
    try {
      for (let at = 0; at < data.byteLength; at += SLICE_BYTES) {
        signal?.throwIfAborted();
        const bytes = Math.min(SLICE_BYTES, data.byteLength - at);
        const slice = new Uint8Array(data.buffer as ArrayBuffer, data.byteOffset + at, bytes);
        written.push(inErrorScopes(device, what, () => memory.write(buffer, slice, at)).verified);
        await pace(bytes);
      }
      await Promise.all(written);
      return buffer;
    } catch (error) {
      memory.release(buffer);
      throw error;
    }
  };
}

/** A compiler's error may come from the loss of the device, where the CPU's trees are of no use. */
const orLoss = <T>(device: GPUDevice, made: Promise<T>): Promise<T> =>
  made.catch(async (error: unknown) => {
    throw await lossOr(device, error as DeviceError);
  });

/**
 * Makes a function that builds a tree over boxes on the GPU and reads it back, for `DynamicTlas.create`. It gives none
 * where this GPU cannot build it and the CPU can, frees the builder's memory, and throws {@link DeviceError}
 * `renderer/device-lost` or the signal's reason.
 */
export function boxTreesOnGpu({ device, memory }: GpuBuilds, signal: AbortSignal | undefined): BuildBoxes {
  // Compiled while meshes are built.
  gpuBuilder(device).catch(() => {});
  return async (data, count) => {
    if (count === 0) return undefined;
    const own: GPUBuffer[] = [];
    let builder: GpuBuilder | undefined;
    try {
      builder = await gpuBuilder(device);
      const boxes = await uploader({ device, memory }, 'the instances of this scene', signal)('build boxes', data);
      own.push(boxes);
      const built = await builder.buildBoxes({ boxes, count }, signal ? { signal } : {});
      for (const buffer of [built.nodes, built.order]) {
        memory.adopt('build result', buffer);
        own.push(buffer);
      }
      if (built.count < count) return undefined;
      const { nodeCount } = built;
      // Copies that have no memory are the CPU's to build.
      const [nodes, order] = await Promise.all([
        readBuffer(device, built.nodes, NODE_BYTES * nodeCount),
        readBuffer(device, built.order, WORD_BYTES * count),
      ]);
      return { nodes: new Float32Array(nodes), nodeCount, order: new Uint32Array(order) };
    } catch (error) {
      if (signal?.aborted) throw error;
      const fault = await lossOr(device, error as DeviceError);
      if (cpuCan(fault)) return undefined;
      throw fault;
    } finally {
      for (const buffer of own) memory.release(buffer);
      await builder?.releaseMemory();
    }
  };
}

/** What {@link buildOnGpu} has built. */
export interface GpuTrees {
  /** In the order of the meshes; undefined for what this GPU cannot build, and the CPU can. */
  readonly trees: readonly (Hierarchy | undefined)[];
  /** Bytes that the builds took at most besides meshes and results; freed. */
  readonly temporaryBytes: number;
}

/**
 * Builds hierarchies on the GPU, and leaves them there. Their memory, and that of the meshes, is counted; it is freed
 * where this fails.
 *
 * @throws {DeviceError} `renderer/device-lost`; the signal's reason.
 */
export async function buildOnGpu(
  { device, memory }: GpuBuilds,
  meshes: readonly Mesh[],
  {
    signal,
    onProgress,
    compact,
  }: {
    readonly compact?: CompactShapes | undefined;
    readonly signal: AbortSignal;
    readonly onProgress: (done: number) => void;
  },
): Promise<GpuTrees> {
  const trees: (Hierarchy | undefined)[] = [];
  const total = meshes.reduce((sum, { indices }) => sum + indices.length, 0);
  let [done, temporaryBytes] = [0, 0];
  let failed = false;
  // Compiled while the first mesh is written.
  const creating = orLoss(device, gpuBuilder(device));
  creating.catch(() => {});
  const compiling = compact && orLoss(device, recordsPipeline(device));
  compiling?.catch(() => {});

  const upload = uploader({ device, memory }, 'the meshes of this scene', signal);

  const build = async (mesh: Mesh): Promise<Hierarchy> => {
    const own: GPUBuffer[] = [];
    try {
      const positions = await upload('build positions', mesh.positions);
      own.push(positions);
      const indices = await upload('build indices', mesh.indices);
      own.push(indices);
      const [builder, records] = await Promise.all([creating, compiling]);
      const built = await builder.buildBlas(
        {
          positions,
          vertexCount: mesh.positions.length / 3,
          indices,
          triangleCount: mesh.indices.length / 3,
        },
        { packTriangles: !compact, signal },
      );
      temporaryBytes = Math.max(temporaryBytes, builder.memoryBytes);
      const { nodes, triangles, triangleIndices: order, triangleCount, nodeCount, bounds } = built;
      for (const buffer of [nodes, order, ...(triangles ? [triangles] : [])]) {
        memory.adopt('build result', buffer);
        own.push(buffer);
      }
      // Lights name stored triangles, and queries on the CPU ask for them.
      const triangleIndices = new Uint32Array(await readBuffer(device, order, order.size)).subarray(0, triangleCount);
      signal.throwIfAborted();
      memory.release(positions);
      if (triangles) memory.release(order);
      const base = { nodeCount, triangleIndices, bounds };
      const left = triangles ? { nodes, triangles, indices } : { nodes, order, indices };
      return { ...base, gpu: onGpu({ device, memory }, mesh, base, left, records) };
    } catch (error) {
      for (const buffer of own) memory.release(buffer);
      throw error;
    }
  };

  const next = meshes.entries();
  const lane = async () => {
    try {
      for (const [i, mesh] of next) {
        if (failed) return;
        trees[i] = await build(mesh).catch((error: unknown) => {
          if (signal.aborted || !cpuCan(error)) throw error;
          return undefined;
        });
        onProgress((done += mesh.indices.length) / total);
      }
    } catch (error) {
      failed = true;
      throw error;
    }
  };
  const lanes = await Promise.allSettled(Array.from({ length: LANES }, lane));
  // A builder that could not be made has nothing to free.
  await creating.then((builder) => builder.releaseMemory()).catch(() => {});
  const fault = lanes.find((result) => result.status === 'rejected');
  if (!fault) return { trees, temporaryBytes };
  for (const tree of trees) tree?.gpu?.free();
  const { reason } = fault as { readonly reason: unknown };
  throw signal.aborted || reason instanceof DeviceError ? reason : await lossOr(device, reason as DeviceError);
}

/** A hierarchy that is on the GPU, in buffers of its own until it has its place. */
function onGpu(
  { device, memory }: Pick<GpuBuilds, 'device' | 'memory'>,
  mesh: Mesh,
  { triangleIndices, nodeCount, bounds }: Omit<Blas, 'nodes'>,
  own: Readonly<Record<'nodes' | 'indices', GPUBuffer>> & Partial<Readonly<Record<'triangles' | 'order', GPUBuffer>>>,
  records: GPUComputePipeline | undefined,
): HierarchyOnGpu {
  let queries: Blas | undefined;
  let placed: { readonly nodes: GPUBuffer | PagedArray; readonly offset: number } | undefined;
  const free = () => {
    for (const buffer of Object.values(own)) memory.release(buffer);
  };
  const readPages = async (pages: PagedArray, offset: number, bytes: number) => {
    const usage = GPU_BUFFER_COPY_DST | GPU_BUFFER_COPY_SRC;
    // Copied before this returns: an edit may write other nodes there while the GPU checks the calls.
    const { result: staging, verified } = inErrorScopes(device, 'reading back from it', () => {
      const buffer = memory.buffer('read pages', bytes, usage);
      const encoder = device.createCommandEncoder({ label: 'glanz read pages' });
      pages.copyTo(encoder, buffer, offset, bytes);
      device.queue.submit([encoder.finish()]);
      return buffer;
    });
    try {
      await verified;
      return await readBuffer(device, staging, bytes);
    } finally {
      memory.release(staging);
    }
  };
  return {
    place(arrayOf, { firstNode, firstTriangle, firstVertex, firstWord }: MeshRegion) {
      const encoder = device.createCommandEncoder({ label: 'glanz place' });
      const nodes = arrayOf('nodes');
      const copy = (from: GPUBuffer, to: GPUBuffer | PagedArray, offset: number, bytes: number) =>
        'view' in to
          ? to.copyFrom(encoder, from, offset, bytes)
          : encoder.copyBufferToBuffer(from, 0, to, offset, bytes);
      copy(own.nodes, nodes, NODE_BYTES * firstNode, NODE_BYTES * nodeCount);
      const { triangles, order, indices } = own;
      let freeRecords: (() => void) | undefined;
      if (triangles) {
        const bytes = TRIANGLE_BYTES * triangleIndices.length;
        copy(triangles, arrayOf('triangles'), TRIANGLE_BYTES * firstTriangle, bytes);
        // Indices are the first of a mesh's attributes; compact shapes have them in their records.
        copy(indices, arrayOf('attributes'), WORD_BYTES * firstWord, mesh.indices.byteLength);
      } else if (order && records) {
        const source = { order, indices, triangleCount: triangleIndices.length, firstVertex };
        const region = RECORD_BYTES * firstTriangle;
        freeRecords = encodeRecords({ device, memory }, records, encoder, source, (from, offset, bytes) =>
          copy(from, arrayOf('triangles'), region + offset, bytes),
        );
      }
      device.queue.submit([encoder.finish()]);
      freeRecords?.();
      placed = { nodes, offset: NODE_BYTES * firstNode };
      free();
    },
    async read() {
      const { nodes, offset } = placed ?? { nodes: own.nodes, offset: 0 };
      const bytes = NODE_BYTES * nodeCount;
      const data = await ('view' in nodes ? readPages(nodes, offset, bytes) : readBuffer(device, nodes, bytes, offset));
      if (!placed) free();
      return { nodes: new Float32Array(data), nodeCount, triangleIndices, bounds };
    },
    forQueries: () => (queries ??= blasInOrder(mesh, triangleIndices)),
    free,
  };
}
