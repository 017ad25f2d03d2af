import { BvhError } from '../error';
import { BLAS_MAX_DEPTH, LEAF_MAX, TLAS_MAX_DEPTH, type Aabb } from '../layout';
import { COPY_DST, COPY_SRC, PassClock, STORAGE, createBuffers, readBuffer, type Kernel } from './device';
import { compileCommon, compilePrimitives, compileTriangles, type CommonKernels, type InputKind } from './kernels';
import type {
  GpuBlas,
  GpuBlasOptions,
  GpuBoxes,
  GpuBoxTree,
  GpuBuildOptions,
  GpuBuildTimes,
  GpuMesh,
  GpuTree,
} from './options';
import { expectBuffer, inputOf, whole } from './input';
import { listPhases, submitPhases, type Params } from './passes';
import { checkPlan, GLOBALS_BYTES, planBuild, planBytes, type BuildPlan, type ScratchName } from './plan';

/** What is built over. */
interface Input {
  readonly kind: InputKind;
  readonly buffers: Readonly<Record<number, GPUBuffer>>;
  readonly params: Params;
}

/** What a build has found. */
interface Built extends Omit<GpuTree, 'destroy'> {
  readonly order: GPUBuffer;
  readonly count: number;
}

/** Memory that the next build of about the same size reuses. */
interface Scratch {
  readonly plan: BuildPlan;
  readonly buffers: Record<ScratchName, GPUBuffer>;
}

const PHASES = ['primitives', 'sort', 'cluster', 'layout'] as const;

/**
 * Builds hierarchies on the GPU, in the layout of the builders on the CPU, so that every traversal, query and tool
 * applies: parallel locally-ordered clustering (Meister and Bittner 2018) of the primitives in Morton order, in a
 * hierarchy of blocks that are each clustered within one workgroup, after Benthin et al. 2022, "PLOC++", and 2024,
 * "H-PLOC". Of pairs with about the same surface, those of lower trees are joined first. On the benchmark's meshes the
 * surface area cost is 0.9 to 1.07 times that of the builder `balanced`, and the depth 0.85 to 1.
 *
 * - Within WebGPU's default limits, without subgroups or other features. No step waits for the CPU, and no workgroup
 *   for another.
 * - Deterministic: the same input gives the same bits on the same device. Devices may differ in how they round areas.
 * - As on the CPU, triangles with a coordinate that is not finite are left out, and no path from the root has more than
 *   `BLAS_MAX_DEPTH` inner nodes (`TLAS_MAX_DEPTH` over boxes).
 * - Temporary memory: {@link gpuBuildMemory}; kept for the next build, until `releaseMemory()`.
 *
 * @example
 * const builder = await GpuBuilder.create(device);
 * const blas = await builder.buildBlas({ positions, vertexCount, indices, triangleCount });
 */
export class GpuBuilder {
  readonly #device: GPUDevice;
  readonly #common: CommonKernels;
  readonly #kernels = new Map<string, Promise<Kernel>>();
  #scratch: Scratch | undefined;
  #last: Promise<unknown> = Promise.resolve();
  #destroyed = false;

  private constructor(device: GPUDevice, common: CommonKernels) {
    this.#device = device;
    this.#common = common;
  }

  /**
   * Compiles the shaders.
   *
   * @throws {BvhError} `bvh/pipeline`.
   */
  static async create(device: GPUDevice): Promise<GpuBuilder> {
    return new GpuBuilder(device, await compileCommon(device));
  }

  /** Bytes on the GPU that are kept for the next build. */
  get memoryBytes(): number {
    return this.#scratch ? planBytes(this.#scratch.plan) : 0;
  }

  /**
   * Builds the hierarchy of a mesh's triangles. Builds run one after the other. The mesh must not change until the
   * promise is settled; it is not retained.
   *
   * @throws {BvhError} `bvh/options`, `bvh/positions` or `bvh/indices` for buffers that are too small or lack the usage
   * `STORAGE`, or for indices out of range; `bvh/too-many`, `bvh/limit`, `bvh/memory`, `bvh/pipeline`, `bvh/device`,
   * `bvh/destroyed`; the signal's reason where it aborts.
   */
  async buildBlas(mesh: GpuMesh, options: GpuBlasOptions = {}): Promise<GpuBlas> {
    const { maxLeafTriangles = 4, packTriangles = false } = options;
    whole('maxLeafTriangles', maxLeafTriangles, 1, LEAF_MAX);
    const { kind, buffers } = inputOf(mesh);
    const params = {
      count: mesh.triangleCount,
      vertices: mesh.vertexCount,
      maxLeaf: maxLeafTriangles,
      maxDepth: BLAS_MAX_DEPTH,
    };
    return this.#enqueue(async () => {
      const { order, count, ...tree } = await this.#build({ kind, buffers, params }, 'triangles', options);
      const own = [tree.nodes, order];
      const destroy = () => own.forEach((buffer) => buffer.destroy());
      const blas = { ...tree, triangleIndices: order, triangleCount: count, destroy };
      if (!packTriangles) return blas;
      try {
        const input = { kind, buffers, params: { ...params, count } };
        const triangles = await this.#packTriangles(input, order, options.signal);
        own.push(triangles);
        return { ...blas, triangles };
      } catch (error) {
        destroy();
        throw error;
      }
    });
  }

  /**
   * Builds a hierarchy over boxes, one box a leaf: the nodes of a TLAS, or of shapes of your own.
   *
   * @throws {BvhError} `bvh/options` for a buffer that is too small or lacks the usage `STORAGE`; `bvh/too-many` beyond 4
   * million boxes; otherwise as {@link buildBlas}.
   */
  async buildBoxes({ boxes, count }: GpuBoxes, options: GpuBuildOptions = {}): Promise<GpuBoxTree> {
    whole('count', count, 0, 2 ** 32 - 1);
    expectBuffer('bvh/options', 'boxes', boxes, 24 * count);
    if (count > 2 ** TLAS_MAX_DEPTH)
      throw new BvhError('bvh/too-many', `${count} boxes are too many; one hierarchy holds ${2 ** TLAS_MAX_DEPTH}.`);
    const params = { count, vertices: 2 * count, maxLeaf: 1, maxDepth: TLAS_MAX_DEPTH };
    return this.#enqueue(async () => {
      const built = await this.#build({ kind: 'boxes', buffers: { 1: boxes }, params }, 'boxes', options);
      return { ...built, destroy: () => [built.nodes, built.order].forEach((buffer) => buffer.destroy()) };
    });
  }

  /** Frees the memory that is kept for the next build, once the builds under way are done. */
  releaseMemory(): Promise<void> {
    return this.#enqueue(async () => this.#release());
  }

  /** Frees everything; builds that are under way end with `bvh/destroyed`. Hierarchies that were built stay. */
  destroy(): void {
    this.#destroyed = true;
    this.#release();
  }

  #release(): void {
    for (const buffer of Object.values(this.#scratch?.buffers ?? {})) buffer.destroy();
    this.#scratch = undefined;
  }

  #expectAlive(): void {
    if (this.#destroyed) throw new BvhError('bvh/destroyed', 'This GpuBuilder was destroyed: create another one.');
  }

  #enqueue<T>(work: () => Promise<T>): Promise<T> {
    const result = this.#last.then(() => {
      this.#expectAlive();
      return work();
    });
    this.#last = result.catch(() => undefined);
    return result;
  }

  #kernel(name: string, compile: () => Promise<Kernel>): Promise<Kernel> {
    let kernel = this.#kernels.get(name);
    if (!kernel) {
      this.#kernels.set(name, (kernel = compile()));
      // A failure is not kept: the next call tries again.
      kernel.catch(() => this.#kernels.delete(name));
    }
    return kernel;
  }

  async #prepare(count: number, what: string, others: Record<string, number>): Promise<Scratch> {
    const kept = this.#scratch;
    if (kept && kept.plan.count >= count && kept.plan.count <= 4 * count + 1024) return kept;
    const plan = planBuild(count);
    checkPlan(this.#device, plan, what, others);
    this.#release();
    const buffers = await createBuffers(this.#device, plan.sizes, STORAGE | COPY_SRC | COPY_DST);
    this.#scratch = { plan, buffers };
    if (this.#destroyed) this.#release();
    this.#expectAlive();
    return { plan, buffers };
  }

  async #build(input: Input, what: string, { signal, timestamps = false }: GpuBuildOptions): Promise<Built> {
    signal?.throwIfAborted();
    const device = this.#device;
    if (timestamps && !device.features.has('timestamp-query'))
      throw new BvhError('bvh/options', 'timestamps needs a device with the feature timestamp-query.');
    const { kind, params } = input;
    const given = Object.fromEntries(Object.entries(input.buffers).map(([name, { size }]) => [`input ${name}`, size]));
    const [kernel, { buffers }] = await Promise.all([
      this.#kernel(`primitives ${kind}`, () => compilePrimitives(device, kind)),
      this.#prepare(params.count, what, given),
    ]);
    this.#expectAlive();
    signal?.throwIfAborted();
    const clock = timestamps ? new PassClock(device, PHASES) : undefined;
    try {
      const phases = listPhases(planBuild(params.count), this.#common, buffers, { ...input, kernel });
      submitPhases(
        device,
        PHASES.map((name) => [name, phases[name]] as const),
        { globals: buffers.globals, clock },
      );
      const globals = await readBuffer(device, buffers.globals, GLOBALS_BYTES);
      this.#expectAlive();
      signal?.throwIfAborted();
      const times = (await clock?.read()) as GpuBuildTimes | undefined;
      return { ...(await this.#keep(globals, params, buffers)), ...(times ? { times } : {}) };
    } finally {
      clock?.destroy();
    }
  }

  /** Copies a result out of the memory that is reused. */
  async #keep(
    data: ArrayBuffer,
    params: Params,
    scratch: Record<ScratchName, GPUBuffer>,
  ): Promise<Omit<Built, 'times'>> {
    const words = new Uint32Array(data),
      floats = new Float32Array(data);
    const wrong = words[7] as number;
    if (wrong !== 0)
      throw new BvhError(
        'bvh/indices',
        `Triangle ${~wrong >>> 0} uses a vertex of which there are only ${params.vertices}.`,
      );
    const nodeCount = words[8] as number,
      count = words[9] as number;
    const sizes = { nodes: 64 * nodeCount, order: 4 * Math.max(1, count) };
    const kept = await createBuffers(this.#device, sizes, STORAGE | COPY_SRC | COPY_DST);
    const encoder = this.#device.createCommandEncoder({ label: 'bvh keep' });
    for (const name of ['nodes', 'order'] as const)
      encoder.copyBufferToBuffer(scratch[name], 0, kept[name], 0, sizes[name]);
    this.#device.queue.submit([encoder.finish()]);
    const bounds: Aabb =
      count === 0
        ? { min: new Float32Array(3).fill(Infinity), max: new Float32Array(3).fill(-Infinity) }
        : { min: floats.slice(12, 15), max: floats.slice(15, 18) };
    return {
      ...kept,
      nodeCount,
      count,
      bounds,
      sahCost: count === 0 ? 1 : (floats[10] as number),
      depth: Math.max(1, words[11] as number),
    };
  }

  async #packTriangles(
    { kind, buffers, params }: Input,
    order: GPUBuffer,
    signal: AbortSignal | undefined,
  ): Promise<GPUBuffer> {
    const size = 48 * Math.max(1, params.count);
    const { maxStorageBufferBindingSize } = this.#device.limits;
    if (size > maxStorageBufferBindingSize)
      throw new BvhError(
        'bvh/limit',
        `${params.count} packed triangles have ${size} bytes, and the device binds ${maxStorageBufferBindingSize}: request a higher maxStorageBufferBindingSize, or split the mesh.`,
      );
    const kernel = await this.#kernel(`triangles ${kind}`, () => compileTriangles(this.#device, kind));
    const { triangles } = await createBuffers(this.#device, { triangles: size }, STORAGE | COPY_SRC);
    if (signal?.aborted) {
      triangles.destroy();
      throw signal.reason;
    }
    const step = {
      kernel,
      params,
      buffers: { ...buffers, 3: order, 4: triangles },
      workgroups: Math.ceil(params.count / 256),
    };
    submitPhases(this.#device, [['triangles', [step]]]);
    return triangles;
  }
}
