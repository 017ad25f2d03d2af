import { runCompute } from '@glanz/gpu';
import { compose, wgslModule, type WgslModule } from '@glanz/wgsl';
import { buildBlas, buildTlas, type Blas, type Tlas, type TriangleMesh } from '../src/index';
import { bvhBuffers, packHierarchy } from '../src/wgsl/index';
import type { WideBlas, WideTlas } from '../src/wide/index';

/** A mesh in the world. */
export interface Placed {
  readonly mesh: TriangleMesh;
  readonly transform: ArrayLike<number>;
}

/** A layout of nodes: how a BLAS and a TLAS are packed, and the modules that traverse it. */
export interface Layout {
  readonly blas: (blas: Blas) => Blas | WideBlas;
  readonly tlas: (tlas: Tlas) => Tlas | WideTlas;
  readonly traversal: (query: 'closest' | 'any', stackSize: number) => WgslModule;
}

/** Buffers of a scene, with what they were made of. */
export function upload(placed: readonly Placed[], layout: Layout) {
  const parts = placed.map(({ mesh, transform }) => ({ mesh, transform, blas: buildBlas(mesh) }));
  const tlas = buildTlas(parts.map(({ blas, transform }) => ({ bounds: blas.bounds, transform })));
  return {
    parts,
    tlas,
    ...packHierarchy(
      layout.tlas(tlas),
      parts.map(({ blas, mesh }) => ({ blas: layout.blas(blas), mesh })),
    ),
  };
}

/** What a ray has met; `instance` is 0xffffffff for nothing. */
export interface GpuHit {
  readonly t: number;
  readonly u: number;
  readonly v: number;
  readonly triangle: number;
  readonly instance: number;
  readonly any: boolean;
}

/**
 * Traces rays (origin xyz, tMin, direction xyz, tMax) on the GPU.
 *
 * @param accept The text of `bvh_accept`, if candidates are to be asked about.
 */
export async function trace(
  device: GPUDevice,
  layout: Layout,
  placed: readonly Placed[],
  rays: Float32Array<ArrayBuffer>,
  accept?: string,
): Promise<GpuHit[]> {
  const { nodes, triangles, instances, stackSize } = upload(placed, layout);
  const count = rays.length / 8;
  const host = wgslModule(
    'test/host',
    `@group(0) @binding(3) var<storage, read> rays: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> result: array<u32>;
${accept ?? ''}
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= ${count}u) { return; }
  let o = rays[2u * id.x];
  let d = rays[2u * id.x + 1u];
  let hit = bvh_closest_hit(o.xyz, d.xyz, o.w, d.w);
  let at = 8u * id.x;
  result[at] = bitcast<u32>(hit.t);
  result[at + 1u] = bitcast<u32>(hit.u);
  result[at + 2u] = bitcast<u32>(hit.v);
  if (hit.instance != BVH_MISS) {
    result[at + 3u] = bvh_triangle(hit.triangle).id;
    result[at + 4u] = bvh_instance(hit.instance).id;
  } else { result[at + 4u] = 0xffffffffu; }
  result[at + 5u] = select(0u, 1u, bvh_any_hit(o.xyz, d.xyz, o.w, d.w));
}`,
    [layout.traversal('closest', stackSize), layout.traversal('any', stackSize), bvhBuffers()],
  );
  const { code } = compose([host], { flags: { BVH_FILTER: accept !== undefined } });
  const bytes = await runCompute(device, code, {
    inputs: [nodes, triangles, instances, rays],
    outputBytes: count * 32,
    workgroups: Math.ceil(count / 64),
  });
  const f = new Float32Array(bytes),
    u = new Uint32Array(bytes);
  return Array.from({ length: count }, (_, i) => ({
    t: f[8 * i]!,
    u: f[8 * i + 1]!,
    v: f[8 * i + 2]!,
    triangle: u[8 * i + 3]!,
    instance: u[8 * i + 4]!,
    any: u[8 * i + 5] === 1,
  }));
}
