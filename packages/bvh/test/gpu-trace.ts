import { runCompute } from '@glanz/gpu';
import { compose, wgslModule, type WgslModule } from '@glanz/wgsl';
import { buildBlas, buildTlas, packTriangles, type Blas, type Tlas, type TriangleMesh } from '../src/index';
import { bvhInstanceStruct } from '../src/wgsl/index';

/** A mesh in the world. */
export interface Placed {
  readonly mesh: TriangleMesh;
  readonly transform: ArrayLike<number>;
}

type Words = Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>;

/** A layout of nodes: what becomes of a BLAS and a TLAS, and the modules that go through it. */
export interface Layout {
  readonly blas: (blas: Blas) => { readonly nodes: Words; readonly nodeCount: number; readonly triangleIndices: Uint32Array<ArrayBuffer> };
  readonly tlas: (tlas: Tlas) => { readonly nodes: Words; readonly nodeCount: number; readonly instanceOrder: Uint32Array };
  readonly modules: readonly WgslModule[];
}

/** Puts arrays one after the other. */
function join(arrays: readonly Words[]): Uint8Array<ArrayBuffer> {
  const all = new Uint8Array(arrays.reduce((sum, a) => sum + a.byteLength, 0));
  let at = 0;
  for (const a of arrays) {
    all.set(new Uint8Array(a.buffer, a.byteOffset, a.byteLength), at);
    at += a.byteLength;
  }
  return all;
}

/** Buffers of a scene as a host lays them out: nodes of the TLAS first, then of each BLAS. */
export function upload(placed: readonly Placed[], layout: Layout) {
  const parts = placed.map(({ mesh, transform }) => ({ mesh, transform, blas: buildBlas(mesh) }));
  const tlas = buildTlas(parts.map(({ blas, transform }) => ({ bounds: blas.bounds, transform })));
  const upper = layout.tlas(tlas);
  const nodes = [upper.nodes];
  const triangles: Float32Array<ArrayBuffer>[] = [];
  const starts: [number, number][] = [];
  let node = upper.nodeCount, triangle = 0;
  for (const { blas, mesh } of parts) {
    const tree = layout.blas(blas);
    starts.push([node, triangle]);
    nodes.push(tree.nodes);
    triangles.push(packTriangles(tree, mesh));
    node += tree.nodeCount;
    triangle += tree.triangleIndices.length;
  }
  const instances = bvhInstanceStruct.allocate(upper.instanceOrder.length);
  upper.instanceOrder.forEach((given, slot) => {
    const row = (r: number) => tlas.toObject.subarray(12 * given + 4 * r, 12 * given + 4 * r + 4);
    bvhInstanceStruct.write(instances, slot, { to_object_0: row(0), to_object_1: row(1), to_object_2: row(2), blas_node: starts[given]![0], triangle_offset: starts[given]![1], id: given, flags: 0 });
  });
  return { parts, tlas, nodes: join(nodes), triangles: join(triangles), instances };
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
export async function trace(device: GPUDevice, layout: Layout, placed: readonly Placed[], rays: Float32Array<ArrayBuffer>, accept?: string): Promise<GpuHit[]> {
  const { nodes, triangles, instances } = upload(placed, layout);
  const count = rays.length / 8;
  const host = wgslModule(
    'test/host',
    `@group(0) @binding(0) var<storage, read> nodes: array<BvhNode>;
@group(0) @binding(1) var<storage, read> triangles: array<vec4f>;
@group(0) @binding(2) var<storage, read> instances: array<BvhInstance>;
@group(0) @binding(3) var<storage, read> rays: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> result: array<u32>;
fn bvh_node(index: u32) -> BvhNode { return nodes[index]; }
fn bvh_instance(index: u32) -> BvhInstance { return instances[index]; }
fn bvh_triangle(index: u32) -> BvhTriangle {
  let a = triangles[3u * index];
  return BvhTriangle(a.xyz, bitcast<u32>(a.w), triangles[3u * index + 1u].xyz, triangles[3u * index + 2u].xyz);
}
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
    result[at + 4u] = instances[hit.instance].id;
  } else { result[at + 4u] = 0xffffffffu; }
  result[at + 5u] = select(0u, 1u, bvh_any_hit(o.xyz, d.xyz, o.w, d.w));
}`,
    [...layout.modules],
  );
  const { code } = compose([host], { flags: { BVH_FILTER: accept !== undefined } });
  const bytes = await runCompute(device, code, { inputs: [nodes, triangles, instances, rays], outputBytes: count * 32, workgroups: Math.ceil(count / 64) });
  const f = new Float32Array(bytes), u = new Uint32Array(bytes);
  return Array.from({ length: count }, (_, i) => ({ t: f[8 * i]!, u: f[8 * i + 1]!, v: f[8 * i + 2]!, triangle: u[8 * i + 3]!, instance: u[8 * i + 4]!, any: u[8 * i + 5] === 1 }));
}
