import { wgslModule, type WgslModule } from '@glanz/wgsl/module';
import records from './records.wesl';
import { BvhInstance } from './structs';

/** Where {@link bvhBuffers} binds its three buffers. */
export interface BvhBindings {
  /** Bind group. Default 0. */
  readonly group?: number;
  /** Binding of the nodes; triangles and instances have the next two. Default 0. */
  readonly binding?: number;
}

/**
 * The functions that the traversal needs from its host, for three read-only storage buffers as `packHierarchy` fills
 * them: `bvh_nodes`, `bvh_triangles` and `bvh_instances` with `bvh_node`, `bvh_triangle` and `bvh_instance`. For hosts
 * that keep their scenes in buffers of their own, these three functions are a few lines. Either layout: a module of one
 * of them must be there too.
 */
export const bvhBuffers = ({ group = 0, binding = 0 }: BvhBindings = {}): WgslModule =>
  wgslModule(
    'bvh/buffers',
    /* wgsl */ `
@group(${group}) @binding(${binding}) var<storage, read> bvh_nodes: array<BvhNode>;
// Three for each: corners, and in the first one's fourth word the triangle of the mesh.
@group(${group}) @binding(${binding + 1}) var<storage, read> bvh_triangles: array<vec4f>;
@group(${group}) @binding(${binding + 2}) var<storage, read> bvh_instances: array<BvhInstance>;
fn bvh_node(index: u32) -> BvhNode { return bvh_nodes[index]; }
fn bvh_instance(index: u32) -> BvhInstance { return bvh_instances[index]; }
fn bvh_triangle(index: u32) -> BvhTriangle {
  let first = bvh_triangles[3u * index];
  return BvhTriangle(first.xyz, bitcast<u32>(first.w), bvh_triangles[3u * index + 1u].xyz, bvh_triangles[3u * index + 2u].xyz);
}
`,
    [BvhInstance, records],
  );
