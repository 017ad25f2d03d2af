import { BufferAttribute, BufferGeometry } from 'three';
import { CENTER, MeshBVH, SAH } from 'three-mesh-bvh';
import type { BenchMesh } from './meshes';

/** A tree of three-mesh-bvh, as its documentation says to build one. */
export function buildThree(mesh: BenchMesh, strategy: 'CENTER' | 'SAH', targetLeafSize?: number): MeshBVH {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(mesh.positions, 3));
  // It sorts the index in place, which would give later builds an easier job.
  geometry.setIndex(new BufferAttribute(mesh.indices.slice(), 1));
  return new MeshBVH(geometry, {
    strategy: strategy === 'SAH' ? SAH : CENTER,
    ...(targetLeafSize === undefined ? {} : { targetLeafSize }),
  } as ConstructorParameters<typeof MeshBVH>[1]);
}

/** Its surface area cost by the same formula as `sahCost` of @glanz/bvh: 1 a node, 1 a triangle. */
export function threeCost(bvh: MeshBVH): number {
  let cost = 0,
    root = 0;
  bvh.traverse((depth, isLeaf, box, _offset, count) => {
    const b = box as unknown as Float32Array;
    const x = b[3]! - b[0]!,
      y = b[4]! - b[1]!,
      z = b[5]! - b[2]!;
    const area = x * y + y * z + z * x;
    if (depth === 0) root = area;
    cost += area * (isLeaf ? count : 1);
  });
  return cost / root;
}
