import { bvhAnyHit, bvhClosestHit } from '@glanz/bvh/wgsl';
import { wgslModule, type WgslModule } from '@glanz/wgsl';

/**
 * The ray traversal over the scene's buffers: what @glanz/bvh asks its host for, and the traversal itself.
 *
 * @param kind The query that the kernel makes; the other's text stays out.
 * @param accept Module with `bvh_accept`, for scenes with surfaces that some rays pass.
 */
export function traversalModule(kind: 'closest' | 'any', accept: WgslModule | undefined): WgslModule {
  const query = kind === 'any' ? bvhAnyHit : bvhClosestHit;
  return wgslModule(
    `renderer/traversal-${kind}`,
    /* wgsl */ `
//#if CATCHER
// Node 0 stands for the root of the hierarchy to go through.
var<private> traversal_root: u32;
fn bvh_node(index: u32) -> BvhNode { return nodes[select(index, traversal_root, index == 0u)]; }
//#else
fn bvh_node(index: u32) -> BvhNode { return nodes[index]; }
//#endif
fn bvh_instance(index: u32) -> BvhInstance { return instances[index].traversal; }
fn bvh_triangle(index: u32) -> BvhTriangle {
  let a = triangles[3u * index];
  return BvhTriangle(a.xyz, bitcast<u32>(a.w), triangles[3u * index + 1u].xyz, triangles[3u * index + 2u].xyz);
}
`,
    accept ? [query, accept] : [query],
  );
}
