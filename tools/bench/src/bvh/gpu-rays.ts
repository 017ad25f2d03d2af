import { buildTlas, type Blas } from '@glanz/bvh';
import { widenBlas, widenTlas } from '@glanz/bvh/wide';
import * as binary from '@glanz/bvh/wgsl';
import * as wide from '@glanz/bvh/wgsl-wide';
import { compose, wgslModule } from '@glanz/wgsl';
import type { BenchMesh } from './meshes';
import { plainQuery } from './plain-kernel';

/** Layouts of nodes in the GPU's memory with their traversals; `plain` is BVH2 with the usual traversal. */
export const LAYOUTS = ['BVH2', 'wide', 'plain'] as const;
export type Layout = (typeof LAYOUTS)[number];

/** Words of a ray (origin, tMin, direction, tMax) and of a result (t, triangle of the mesh or 0xffffffff). */
export const RAY_WORDS = 8;
export const RESULT_WORDS = 2;

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

const kernel = (layout: Layout, query: 'closest' | 'any', stackSize: number) => {
  const modules = layout === 'wide' ? wide : binary;
  const traversal = layout === 'plain' ? plainQuery(query) : modules.bvhTraversal(query, stackSize);
  const host = wgslModule(
    'bench/rays',
    `@group(0) @binding(3) var<storage, read> rays: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> results: array<vec2u>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= arrayLength(&rays) / 2u) { return; }
  let o = rays[2u * id.x];
  let d = rays[2u * id.x + 1u];
  ${
    query === 'any'
      ? 'results[id.x] = vec2u(0u, select(0xffffffffu, 0u, bvh_any_hit(o.xyz, d.xyz, o.w, d.w)));'
      : `let hit = bvh_closest_hit(o.xyz, d.xyz, o.w, d.w);
  var id_of_triangle = 0xffffffffu;
  if (hit.instance != BVH_MISS) { id_of_triangle = bvh_triangle(hit.triangle).id; }
  results[id.x] = vec2u(bitcast<u32>(hit.t), id_of_triangle);`
  }
}`,
    [traversal, binary.bvhBuffers()],
  );
  return compose([host], { flags: { BVH_FILTER: false } }).code;
};

/** Traces rays through one mesh, placed once, on a GPU. */
export class GpuRays {
  /** Bytes of all nodes, both levels. */
  readonly nodeBytes: number;
  readonly #device: GPUDevice;
  readonly #buffers: GPUBuffer[] = [];
  readonly #scene: readonly GPUBuffer[];
  readonly #pipelines: Readonly<Record<'closest' | 'any', GPUComputePipeline>>;
  readonly #layout: GPUBindGroupLayout;
  readonly #query: GPUQuerySet | undefined;

  private constructor(
    device: GPUDevice,
    layout: GPUBindGroupLayout,
    pipelines: Readonly<Record<'closest' | 'any', GPUComputePipeline>>,
    scene: readonly (ArrayBuffer | ArrayBufferView<ArrayBuffer>)[],
  ) {
    this.#device = device;
    this.#layout = layout;
    this.#pipelines = pipelines;
    this.#scene = scene.map((data) =>
      this.#buffer(data.byteLength, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST, data),
    );
    this.nodeBytes = (scene[0] as ArrayBuffer | ArrayBufferView).byteLength;
    if (device.features.has('timestamp-query')) this.#query = device.createQuerySet({ type: 'timestamp', count: 2 });
  }

  /** Prepares a mesh with its hierarchy. */
  static async create(device: GPUDevice, layout: Layout, blas: Blas, mesh: BenchMesh): Promise<GpuRays> {
    const tlas = buildTlas([{ bounds: blas.bounds, transform: IDENTITY }]);
    const upper = layout === 'wide' ? widenTlas(tlas) : tlas,
      lower = layout === 'wide' ? widenBlas(blas) : blas;
    const { nodes, triangles, instances, stackSize } = binary.packHierarchy(upper, [{ blas: lower, mesh }]);
    const bindGroupLayout = device.createBindGroupLayout({
      entries: [0, 1, 2, 3, 4].map((binding) => ({
        binding,
        visibility: GPUShaderStage.COMPUTE,
        buffer: { type: binding < 4 ? 'read-only-storage' : 'storage' },
      })),
    });
    const pipeline = (query: 'closest' | 'any') => {
      const module = device.createShaderModule({
        label: `bench ${layout} ${query}`,
        code: kernel(layout, query, stackSize),
      });
      return device.createComputePipelineAsync({
        layout: device.createPipelineLayout({ bindGroupLayouts: [bindGroupLayout] }),
        compute: { module, entryPoint: 'main' },
      });
    };
    const [closest, any] = await Promise.all([pipeline('closest'), pipeline('any')]);
    return new GpuRays(device, bindGroupLayout, { closest, any }, [nodes, triangles, instances]);
  }

  #buffer(size: number, usage: number, data?: ArrayBuffer | ArrayBufferView<ArrayBuffer>): GPUBuffer {
    const buffer = this.#device.createBuffer({ size, usage });
    this.#buffers.push(buffer);
    if (data) this.#device.queue.writeBuffer(buffer, 0, data);
    return buffer;
  }

  /** Rays made ready to be traced any number of times. */
  load(rays: Float32Array<ArrayBuffer>): LoadedRays {
    const count = rays.length / RAY_WORDS;
    const input = this.#buffer(rays.byteLength, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST, rays);
    const output = this.#buffer(4 * RESULT_WORDS * count, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC);
    const group = this.#device.createBindGroup({
      layout: this.#layout,
      entries: [...this.#scene, input, output].map((buffer, binding) => ({ binding, resource: { buffer } })),
    });
    return { count, output, group };
  }

  #submit(
    { count, group }: LoadedRays,
    query: 'closest' | 'any',
    times: number,
    timestampWrites?: GPUComputePassTimestampWrites,
  ): void {
    const encoder = this.#device.createCommandEncoder();
    const pass = encoder.beginComputePass(timestampWrites ? { timestampWrites } : {});
    pass.setPipeline(this.#pipelines[query]);
    pass.setBindGroup(0, group);
    for (let i = 0; i < times; i++) pass.dispatchWorkgroups(Math.ceil(count / 64));
    pass.end();
    this.#device.queue.submit([encoder.finish()]);
  }

  async #read(buffer: GPUBuffer, size: number): Promise<ArrayBuffer> {
    const staging = this.#device.createBuffer({ size, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    const encoder = this.#device.createCommandEncoder();
    encoder.copyBufferToBuffer(buffer, 0, staging, 0, size);
    this.#device.queue.submit([encoder.finish()]);
    await staging.mapAsync(GPUMapMode.READ);
    const data = staging.getMappedRange().slice(0);
    staging.destroy();
    return data;
  }

  /** Traces once and reads the results, {@link RESULT_WORDS} words a ray. */
  async results(rays: LoadedRays, query: 'closest' | 'any'): Promise<Uint32Array<ArrayBuffer>> {
    this.#submit(rays, query, 1);
    return new Uint32Array(await this.#read(rays.output, 4 * RESULT_WORDS * rays.count));
  }

  /** Milliseconds of `times` runs one after the other: of the GPU's clock where it has one, else of the wall's. */
  async time(rays: LoadedRays, query: 'closest' | 'any', times: number): Promise<number> {
    const querySet = this.#query;
    if (!querySet) {
      const start = performance.now();
      this.#submit(rays, query, times);
      await this.#device.queue.onSubmittedWorkDone();
      return performance.now() - start;
    }
    this.#submit(rays, query, times, { querySet, beginningOfPassWriteIndex: 0, endOfPassWriteIndex: 1 });
    const resolved = this.#device.createBuffer({
      size: 16,
      usage: GPUBufferUsage.QUERY_RESOLVE | GPUBufferUsage.COPY_SRC,
    });
    const encoder = this.#device.createCommandEncoder();
    encoder.resolveQuerySet(querySet, 0, 2, resolved, 0);
    this.#device.queue.submit([encoder.finish()]);
    const [begin, end] = new BigUint64Array(await this.#read(resolved, 16)) as unknown as [bigint, bigint];
    resolved.destroy();
    return Number(end - begin) / 1e6;
  }

  destroy(): void {
    this.#query?.destroy();
    for (const buffer of this.#buffers) buffer.destroy();
  }
}

/** What {@link GpuRays.load} gives. */
export interface LoadedRays {
  readonly count: number;
  readonly output: GPUBuffer;
  readonly group: GPUBindGroup;
}
