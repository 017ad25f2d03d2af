import { buildBlas, closestHit } from '@glanz/bvh';
import { bestSplit } from '@glanz/bvh/best';
import { expect, test } from 'vitest';
import { assembly } from '../src/bvh/meshes';
import { diffuseRays, inRoom, primaryRays } from '../src/bvh/ray-sets';
import { buildThree } from '../src/bvh/three-mesh-bvh';
import { plainBlas, plainThree, traversalCost } from '../src/bvh/traversal-cost';

const { mesh, bounds } = inRoom(assembly('assembly', 30, 12));

test('the trees that rays are counted in give the hits of the package, of both libraries and for all builders', () => {
  const blas = buildBlas(mesh);
  const trees = [
    plainBlas(blas, mesh),
    plainBlas(buildBlas(mesh, { builder: bestSplit }), mesh),
    plainThree(buildThree(mesh, 'SAH', 4)),
    plainThree(buildThree(mesh, 'CENTER')),
  ];
  const primary = primaryRays(bounds, 32);
  const expected = Array.from({ length: 1024 }, (_, i) =>
    closestHit(blas, mesh, {
      origin: primary.subarray(8 * i, 8 * i + 3),
      direction: primary.subarray(8 * i + 4, 8 * i + 7),
    }),
  );
  for (const tree of trees) {
    const { nodes, triangles, hits } = traversalCost(tree, mesh, primary, false);
    // A ray through the edge of two triangles may be missed by this test, which is not watertight.
    expect(expected.filter((hit, i) => Math.abs(hit!.t - hits[2 * i]!) > 1e-9 * hit!.t)).toHaveLength(0);
    expect(nodes).toBeGreaterThan(3);
    expect(triangles).toBeGreaterThan(1);
    const any = traversalCost(tree, mesh, primary, true);
    expect(any.hits.filter((x, i) => i % 2 === 1 && x < 0)).toHaveLength(0);
    expect(any.nodes).toBeLessThan(nodes);
  }
});

test('a tree of one node: every triangle counts', () => {
  const tree = {
    boxes: [...bounds.min, ...bounds.max].map((x) => 10 * x),
    children: [-1, -1],
    leaves: [0, mesh.indices.length / 3],
    vertices: mesh.indices,
  };
  const primary = primaryRays(bounds, 8),
    results = new Uint32Array(128);
  const { nodes, triangles, hits } = traversalCost(tree, mesh, primary, false);
  expect([nodes, triangles]).toEqual([0, mesh.indices.length / 3]);
  const t = new Float32Array(results.buffer);
  for (let i = 0; i < 64; i++) {
    t[2 * i] = hits[2 * i]!;
    results[2 * i + 1] = hits[2 * i + 1]!;
  }
  // Off every point hit, on the side the ray came from, there is another point: the room is closed.
  const diffuse = diffuseRays(bounds, primary, results, mesh, 1);
  expect(traversalCost(tree, mesh, diffuse, false).hits.filter((x, i) => i % 2 === 1 && x < 0)).toHaveLength(0);
});
