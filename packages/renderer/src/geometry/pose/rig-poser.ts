import type { Blas } from '@glanz/bvh';
import { GpuRefitter, type PreparedRefit } from '@glanz/bvh/gpu';
import type { MeshPose, MeshRig } from '@glanz/scene';
import { GlanzError } from '@glanz/wgsl';
import { lossOr, withErrorScopes } from '../../device/error-scopes';
import { DeviceError, RenderError } from '../../errors';
import {
  GPU_BUFFER_COPY_DST,
  GPU_BUFFER_COPY_SRC,
  GPU_BUFFER_STORAGE,
  GPU_BUFFER_UNIFORM,
  GpuMemory,
  type PagedArray,
} from '../../storage/buffers';
import type { ShapeArray } from '../../storage/shape-arrays';
import type { GpuBuilds, MeshRegion } from '../hierarchy';
import { pipelineFor } from '../pipeline-for';
import pose from './pose.wesl';
import treeCost from './tree_cost.wesl';
import { PoseBounds } from './pose-bounds';
import { TreeCost } from './tree-cost';
import { packRig, posedAttributes, setsOf } from './rig-data';

/** Bytes of a node, of a packed triangle, and of a word of the attributes. */
const NODE_BYTES = 64;
const TRIANGLE_BYTES = 48;
const WORD_BYTES = 4;
/** No hierarchy of triangles is higher (`BLAS_MAX_DEPTH` of `@glanz/bvh`). */
const MAX_DEPTH = 40;
/** Vertices of a workgroup. */
const GROUP = 64;
/** Cost over that of the tree as it was built, above which it is to be built again; as `RefitQuality` has it. */
const REBUILD_ABOVE = 1.5;
/** The cost is measured at every so many poses. */
const MEASURED = 8;

/** A pose that can be written to the GPU. */
export interface PackedPose {
  readonly data: Float32Array<ArrayBuffer>;
  readonly targets: number;
}

/**
 * Poses a rig on the GPU: computes its vertices, fits its hierarchy to them, and copies both to the mesh's region. It
 * keeps the rig, the hierarchy and the results in buffers of its own, about 250 bytes a triangle with a skin and normals.
 * All of them are within the limits of one binding: {@link suitsPoser}.
 */
export class RigPoser {
  readonly rig: MeshRig;
  readonly #device: GPUDevice;
  /** The tracer's, which frees the poser with everything else. */
  readonly #memory: GpuMemory;
  /** The poser's own buffers. */
  readonly #own: GpuMemory;
  /** What the tracer's memory holds of the poser. */
  readonly #held: { readonly size: number; readonly destroy: () => void };
  readonly #buffers: Readonly<Record<string, GPUBuffer>>;
  readonly #pipeline: GPUComputePipeline;
  readonly #group: GPUBindGroup;
  readonly #refit: PreparedRefit;
  readonly #cost: TreeCost;
  readonly #bounds: PoseBounds;
  readonly #base: Blas;
  /** Of the hierarchy as it was built. */
  #builtCost = Infinity;
  #poses = 0;
  #isMeasuring = false;
  #needsRebuild = false;
  #measured: Promise<unknown> = Promise.resolve();

  private constructor(
    { device, memory }: GpuBuilds,
    rig: MeshRig,
    base: Blas,
    own: GpuMemory,
    made: {
      readonly buffers: Readonly<Record<string, GPUBuffer>>;
      readonly pipeline: GPUComputePipeline;
      readonly refitter: GpuRefitter;
      readonly refit: PreparedRefit;
      readonly cost: TreeCost;
    },
  ) {
    this.rig = rig;
    this.#device = device;
    this.#memory = memory;
    this.#own = own;
    this.#base = base;
    this.#buffers = made.buffers;
    this.#pipeline = made.pipeline;
    this.#refit = made.refit;
    this.#cost = made.cost;
    this.#bounds = new PoseBounds(rig);
    const { numbers, bind, influences, targets, pose, positions, shading } = made.buffers;
    const bound = [numbers, bind, influences, targets, pose, positions, ...(rig.bind.normals ? [shading] : [])];
    this.#group = device.createBindGroup({
      label: 'glanz pose',
      layout: made.pipeline.getBindGroupLayout(0),
      entries: bound.map((buffer, binding) => ({ binding, resource: { buffer: buffer as GPUBuffer } })),
    });
    this.#held = {
      // The refitter has 4 bytes a node.
      size: own.bytes + 4 * base.nodeCount,
      destroy: () => {
        made.refit.destroy();
        made.refitter.destroy();
        own.destroy();
      },
    };
    memory.adopt('pose', this.#held);
  }

  /**
   * @param base The hierarchy to refit, of any pose.
   * @throws {DeviceError} `renderer/device-lost`, `renderer/out-of-memory`, `renderer/gpu-error`; {RenderError}
   * `renderer/destroyed` where the tracer was destroyed meanwhile; {BvhError} as `GpuRefitter.create`.
   */
  static async create(builds: GpuBuilds, rig: MeshRig, base: Blas): Promise<RigPoser> {
    const { device, memory } = builds;
    const { bind, influences, targets } = packRig(rig);
    const { positions, indices, normals, tangents } = rig.bind;
    const storage = GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_DST | GPU_BUFFER_COPY_SRC;
    // An account of its own: the tracer may be destroyed while the GPU is still to use these buffers.
    const own = new GpuMemory(device);
    const make = (name: string, bytes: number, usage = storage) => own.buffer(`pose ${name}`, bytes, usage);
    const expectAlive = () => {
      if (memory.destroyed) throw new RenderError('renderer/destroyed', 'This tracer was destroyed.');
    };
    const upload = (name: string, data: Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>) => {
      const buffer = make(name, data.byteLength);
      own.write(buffer, data);
      return buffer;
    };
    let refitter: GpuRefitter | undefined;
    let refit: PreparedRefit | undefined;
    try {
      expectAlive();
      const attributes = posedAttributes(rig.bind);
      const compiled = Promise.all([
        pipelineFor(device, 'glanz pose', pose, { RIG_NORMALS: attributes > 1, RIG_TANGENTS: attributes > 2 }),
        pipelineFor(device, 'glanz tree cost', treeCost),
      ]);
      compiled.catch(() => undefined);
      const buffers = await withErrorScopes(device, 'the poses of this mesh', () => ({
        numbers: make('numbers', 16, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST),
        bind: upload('bind', bind),
        influences: upload('influences', influences),
        targets: upload('targets', targets),
        pose: make('joints', 48 * (rig.skin?.jointCount ?? 0) + 8 * rig.targets.length),
        positions: make('positions', positions.byteLength),
        shading: make('shading', (normals?.byteLength ?? 0) + ((normals && tangents)?.byteLength ?? 0)),
        indices: upload('indices', indices),
        nodes: upload('nodes', base.nodes.subarray(0, (base.nodeCount * NODE_BYTES) / 4)),
        order: upload('order', base.triangleIndices as Uint32Array<ArrayBuffer>),
        triangles: make('triangles', TRIANGLE_BYTES * base.triangleIndices.length),
      }));
      expectAlive();
      const { nodes, order: triangleIndices, triangles } = buffers;
      const { nodeCount } = base;
      refitter = await GpuRefitter.create(device, { nodes, nodeCount, triangleIndices, depth: MAX_DEPTH });
      expectAlive();
      const mesh = {
        positions: buffers.positions,
        vertexCount: positions.length / 3,
        indices: buffers.indices,
        triangleCount: indices.length / 3,
      };
      refit = await refitter.prepare(mesh, triangles);
      const [pipeline, costs] = await compiled;
      expectAlive();
      const cost = await withErrorScopes(
        device,
        'the poses of this mesh',
        () => new TreeCost(device, own, costs, nodes),
      );
      const encoder = device.createCommandEncoder({ label: 'glanz tree cost' });
      cost.encode(encoder);
      device.queue.submit([encoder.finish()]);
      const builtCost = await cost.read();
      expectAlive();
      const poser = new RigPoser(builds, rig, base, own, { buffers, pipeline, refitter, refit, cost });
      poser.#builtCost = builtCost;
      return poser;
    } catch (error) {
      refit?.destroy();
      refitter?.destroy();
      own.destroy();
      throw await faultOf(device, error);
    }
  }

  /** The hierarchy that is refitted: topology, and boxes of an earlier pose. */
  get base(): Blas {
    return this.#base;
  }

  /** Whether poses have moved so far from the one that the hierarchy was built for that it should be built again. */
  get needsRebuild(): boolean {
    return this.#needsRebuild;
  }

  get isDestroyed(): boolean {
    return this.#own.destroyed;
  }

  /** Settles when the poses so far have been measured. */
  get measured(): Promise<unknown> {
    return this.#measured;
  }

  /** The box around a pose, not smaller than its vertices are on the GPU. */
  boundsOf(pose: MeshPose): ReturnType<PoseBounds['of']> {
    return this.#bounds.of(pose);
  }

  /** Writes a pose to a mesh's region. The commands are submitted at once. */
  run({ data, targets }: PackedPose, arrayOf: (name: ShapeArray) => GPUBuffer | PagedArray, region: MeshRegion): void {
    const { numbers, pose, shading, nodes, triangles } = this.#buffers;
    const { bind, skin } = this.rig;
    const vertices = bind.positions.length / 3;
    const write = (buffer: GPUBuffer, words: Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>) =>
      this.#own.write(buffer, words);
    write(numbers as GPUBuffer, Uint32Array.of(vertices, setsOf(this.rig), skin?.jointCount ?? 0, targets));
    if (data.length > 0) write(pose as GPUBuffer, data);
    const encoder = this.#device.createCommandEncoder({ label: 'glanz pose' });
    const pass = encoder.beginComputePass({ label: 'glanz pose' });
    pass.setPipeline(this.#pipeline);
    pass.setBindGroup(0, this.#group);
    const groups = Math.ceil(vertices / GROUP);
    const rows = Math.ceil(groups / this.#device.limits.maxComputeWorkgroupsPerDimension);
    pass.dispatchWorkgroups(Math.ceil(groups / rows), rows);
    pass.end();
    this.#refit.encode(encoder);
    const copy = (name: ShapeArray, from: GPUBuffer | undefined, offset: number, bytes: number) => {
      const to = arrayOf(name);
      if (!from || bytes === 0) return;
      if ('view' in to) to.copyFrom(encoder, from, offset, bytes);
      else encoder.copyBufferToBuffer(from, 0, to, offset, bytes);
    };
    const { triangleIndices, nodeCount } = this.#base;
    copy('nodes', nodes, NODE_BYTES * region.firstNode, NODE_BYTES * nodeCount);
    copy('triangles', triangles, TRIANGLE_BYTES * region.firstTriangle, TRIANGLE_BYTES * triangleIndices.length);
    // Normals and tangents follow the indices among a mesh's attributes.
    const words = (bind.normals?.length ?? 0) + ((bind.normals && bind.tangents)?.length ?? 0);
    copy('attributes', shading, WORD_BYTES * (region.firstWord + bind.indices.length), WORD_BYTES * words);
    const isMeasured = this.#poses++ % MEASURED === 0 && !this.#isMeasuring;
    if (isMeasured) this.#cost.encode(encoder);
    this.#device.queue.submit([encoder.finish()]);
    if (isMeasured) this.#measure();
  }

  /** Finds out what the hierarchy costs; the answer comes while frames are rendered. */
  #measure(): void {
    this.#isMeasuring = true;
    this.#measured = this.#cost.read().then(
      (cost) => {
        this.#isMeasuring = false;
        this.#needsRebuild ||= cost > REBUILD_ABOVE * this.#builtCost;
      },
      // Destroyed, or the device was lost.
      () => undefined,
    );
  }

  destroy(): void {
    this.#memory.release(this.#held);
  }
}

/** The typed error of what failed; a lost device makes anything fail. */
async function faultOf(device: GPUDevice, error: unknown): Promise<unknown> {
  if (error instanceof DeviceError || error instanceof RenderError) return error;
  const { message } = error as Error;
  return lossOr(
    device,
    error instanceof GlanzError
      ? error
      : new DeviceError('renderer/gpu-error', `The GPU failed at the poses of this mesh: ${message}`, { cause: error }),
  );
}

/** Whether a device can bind all that a rig's poser needs. */
export function suitsPoser({ device: { limits } }: GpuBuilds, rig: MeshRig, { nodeCount }: Blas): boolean {
  const { positions, indices } = rig.bind;
  const vertices = positions.length / 3;
  const bytes = [
    NODE_BYTES * nodeCount,
    16 * indices.length,
    40 * vertices,
    6 * (rig.skin?.joints.length ?? 0),
    4 * rig.targets.length * posedAttributes(rig.bind) * positions.length,
  ];
  return Math.max(...bytes) <= Math.min(limits.maxStorageBufferBindingSize, limits.maxBufferSize);
}
