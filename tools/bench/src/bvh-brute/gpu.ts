import type { BlasMesh, Tlas } from '@glanz/bvh';
import { bvhAnyHit, bvhBuffers, bvhClosestHit, packHierarchy, type HierarchyPart } from '@glanz/bvh/wgsl';
import { bvhAnyHit as wideAnyHit, bvhClosestHit as wideClosestHit } from '@glanz/bvh/wgsl-wide';
import { widenBlas, widenTlas } from '@glanz/bvh/wide';
import { compose, wgslModule } from '@glanz/wgsl';

/** The layouts that there is WGSL for. */
export type Layout = 'binary' | 'wide';

const host = (layout: Layout) =>
  wgslModule(
    'bench/bvh-brute',
    /* wgsl */ `
@group(0) @binding(3) var<storage, read> rays: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> result: array<vec4u>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (2u * id.x >= arrayLength(&rays)) { return; }
  let o = rays[2u * id.x];
  let d = rays[2u * id.x + 1u];
  let hit = bvh_closest_hit(o.xyz, d.xyz, o.w, d.w);
  var triangle = 0u;
  var instance = BVH_MISS;
  if (hit.instance != BVH_MISS) {
    triangle = bvh_triangle(hit.triangle).id;
    instance = bvh_instance(hit.instance).id;
  }
  result[2u * id.x] = vec4u(bitcast<u32>(hit.t), bitcast<u32>(hit.u), bitcast<u32>(hit.v), triangle);
  result[2u * id.x + 1u] = vec4u(instance, select(0u, 1u, bvh_any_hit(o.xyz, d.xyz, o.w, d.w)), 0u, 0u);
}`,
    [bvhBuffers(), ...(layout === 'binary' ? [bvhClosestHit, bvhAnyHit] : [wideClosestHit, wideAnyHit])],
  );

/** What the GPU has found. */
export interface GpuHits {
  readonly t: Float32Array;
  readonly u: Float32Array;
  readonly v: Float32Array;
  readonly triangle: Uint32Array;
  /** 0xffffffff: a miss. */
  readonly instance: Uint32Array;
  readonly any: Uint8Array;
}

/** Each BLAS in the wide layout, once. */
function widened(parts: readonly BlasMesh[]): HierarchyPart[] {
  const wide = new Map([...new Set(parts.map(({ blas }) => blas))].map((blas) => [blas, widenBlas(blas)]));
  return parts.map(({ blas, mesh }) => ({ blas: wide.get(blas)!, mesh }));
}

/** Traces rays through two-level scenes by the package's WGSL. */
export class GpuTracer {
  readonly #device: GPUDevice;
  readonly #pipeline: GPUComputePipeline;
  readonly layout: Layout;

  private constructor(device: GPUDevice, pipeline: GPUComputePipeline, layout: Layout) {
    this.#device = device;
    this.#pipeline = pipeline;
    this.layout = layout;
  }

  static async create(device: GPUDevice, layout: Layout): Promise<GpuTracer> {
    const module = device.createShaderModule({
      label: 'bvh-brute',
      code: compose([host(layout)], { flags: { BVH_FILTER: false } }).code,
    });
    return new GpuTracer(
      device,
      await device.createComputePipelineAsync({
        label: 'bvh-brute',
        layout: 'auto',
        compute: { module, entryPoint: 'main' },
      }),
      layout,
    );
  }

  /** @param rays 8 numbers each: origin, tMin, direction, tMax. There must be an instance in the TLAS. */
  async trace(binary: Tlas, parts: readonly BlasMesh[], rays: Float32Array<ArrayBuffer>): Promise<GpuHits> {
    const device = this.#device;
    const count = rays.length / 8;
    const wide = this.layout === 'wide';
    const hierarchy = packHierarchy(wide ? widenTlas(binary) : binary, wide ? widened(parts) : parts);
    const buffers: GPUBuffer[] = [];
    const upload = (data: ArrayBuffer | Float32Array<ArrayBuffer>) => {
      const buffer = device.createBuffer({
        size: data.byteLength,
        usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST,
      });
      device.queue.writeBuffer(buffer, 0, data);
      buffers.push(buffer);
      return buffer;
    };
    const output = device.createBuffer({ size: 32 * count, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
    const staging = device.createBuffer({ size: 32 * count, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    const bound = [
      upload(hierarchy.nodes),
      upload(hierarchy.triangles),
      upload(hierarchy.instances),
      upload(rays),
      output,
    ];
    buffers.push(output, staging);
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(this.#pipeline);
    pass.setBindGroup(
      0,
      device.createBindGroup({
        layout: this.#pipeline.getBindGroupLayout(0),
        entries: bound.map((buffer, binding) => ({ binding, resource: { buffer } })),
      }),
    );
    pass.dispatchWorkgroups(Math.ceil(count / 64));
    pass.end();
    encoder.copyBufferToBuffer(output, 0, staging, 0, 32 * count);
    device.queue.submit([encoder.finish()]);
    await staging.mapAsync(GPUMapMode.READ);
    const words = new Uint32Array(staging.getMappedRange().slice(0)),
      floats = new Float32Array(words.buffer);
    for (const buffer of buffers) buffer.destroy();
    const pick = (k: number) => Uint32Array.from({ length: count }, (_, i) => words[8 * i + k]!);
    const pickFloat = (k: number) => Float32Array.from({ length: count }, (_, i) => floats[8 * i + k]!);
    return {
      t: pickFloat(0),
      u: pickFloat(1),
      v: pickFloat(2),
      triangle: pick(3),
      instance: pick(4),
      any: Uint8Array.from({ length: count }, (_, i) => words[8 * i + 5]!),
    };
  }
}
