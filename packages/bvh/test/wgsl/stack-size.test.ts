import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import { compose, wgslModule, type WgslModule } from '@glanz/wgsl';
import { describe, expect, it } from 'vitest';
import { buildBlas, buildTlas, type TriangleMesh } from '../../src/index';
import { bvhStatistics } from '../../src/statistics';
import { widenBlas, widenTlas, type WideNodes } from '../../src/wide/index';
import * as binary from '../../src/wgsl/index';
import * as wide from '../../src/wgsl/wide/index';
import { affine, randomNumbers, strewn } from '../shapes';

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** Triangles around the z axis, each a half larger than the last: trees over them are as deep as trees get. */
const nested: TriangleMesh = {
  positions: Float32Array.from(
    Array.from({ length: 120 }, (_, i) =>
      [-1, -1, i / 500, 3, -1, i / 500, -1, 3, i / 500].map((x, k) => (k % 3 === 2 ? x : x * 1.5 ** (i - 60))),
    ).flat(),
  ),
};

/** Wide nodes on the longest way down, by recursion. */
function wideDepth({ nodes }: WideNodes, node = 0): number {
  const children = Array.from({ length: 8 }, (_, i) => i).filter(
    (i) => ((nodes[20 * node + 3]! >>> (24 + i)) & 1) === 1,
  );
  return 1 + Math.max(0, ...children.map((_, i) => wideDepth({ nodes } as WideNodes, nodes[20 * node + 4]! + i)));
}

describe('the stack of a hierarchy', () => {
  it.each([1, 2, 3, 4])('holds one entry for each node of the longest way, and the marks (seed %i)', (seed) => {
    const random = randomNumbers(seed);
    const parts = [strewn(20 + Math.floor(900 * random()), 0.1, random), strewn(3, 0.1, random), nested]
      .slice(0, 1 + (seed % 3))
      .map((mesh) => ({ mesh, blas: buildBlas(mesh) }));
    const tlas = buildTlas(parts.map(({ blas }) => ({ bounds: blas.bounds, transform: affine(random, 3) })));
    const deepest = Math.max(...parts.map(({ blas }) => bvhStatistics(blas).depth));
    expect(binary.packHierarchy(tlas, parts).stackSize).toBe(bvhStatistics(tlas).depth + deepest + 2);
    const widened = parts.map(({ mesh, blas }) => ({ mesh, blas: widenBlas(blas) }));
    const upper = widenTlas(tlas);
    expect(binary.packHierarchy(upper, widened).stackSize).toBe(
      wideDepth(upper) + Math.max(...widened.map(({ blas }) => wideDepth(blas))),
    );
  });

  it.each([2, 65, 3.5, NaN])('is refused if it is %d', (size) => {
    expect(() => binary.bvhTraversal('any', size)).toThrow(expect.objectContaining({ code: 'bvh/options' }) as Error);
    expect(() => wide.bvhTraversal('closest', size)).toThrow(expect.objectContaining({ code: 'bvh/options' }) as Error);
  });

  it('is just enough for rays that enter everything: they find what they find with the largest', async () => {
    const device = await testDevice();
    const blas = buildBlas(nested);
    const parts = [0, 1, 2].map((i) => ({ mesh: nested, blas, transform: identity.map((x, k) => (k === 14 ? i : x)) }));
    const tlas = buildTlas(parts.map(({ transform }) => ({ bounds: blas.bounds, transform })));
    const rays = Float32Array.from(
      Array.from({ length: 64 }, (_, i) => [
        0.01 * 1.4 ** (i - 40),
        0.02 * 1.3 ** (i - 40),
        i % 2 ? 9 : -9,
        0,
        0,
        0,
        i % 2 ? -1 : 1,
        0,
      ]).flat(),
    );
    const shared = widenBlas(blas);
    for (const [modules, { nodes, triangles, instances, stackSize }] of [
      [binary, binary.packHierarchy(tlas, parts)],
      [
        wide,
        binary.packHierarchy(
          widenTlas(tlas),
          parts.map(({ mesh }) => ({ mesh, blas: shared })),
        ),
      ],
    ] as const) {
      const trace = async (traversal: WgslModule) => {
        const shader = wgslModule(
          'test/nested',
          /* wgsl */ `
@group(0) @binding(3) var<storage, read> rays: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> distances: array<f32>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  let hit = bvh_closest_hit(rays[2u * id.x].xyz, rays[2u * id.x + 1u].xyz, 0.0, 1e30);
  distances[id.x] = select(-1.0, hit.t, hit.instance != BVH_MISS);
}`,
          [traversal, modules.bvhBuffers()],
        );
        return [
          ...new Float32Array(
            await runCompute(device, compose([shader], { flags: { BVH_FILTER: false } }).code, {
              inputs: [nodes, triangles, instances, rays],
              outputBytes: 256,
              workgroups: 1,
            }),
          ),
        ];
      };
      const expected = await trace(modules.bvhClosestHit);
      expect(stackSize).toBeLessThan(modules.BVH_STACK_SIZE);
      expect(expected.filter((t) => t > 0).length).toBeGreaterThan(40);
      expect(await trace(modules.bvhTraversal('closest', stackSize))).toEqual(expected);
      // With far too few entries hits are lost, but the rays end.
      expect(await trace(modules.bvhTraversal('closest', 3))).not.toEqual(expected);
    }
    await expectNoGpuErrors();
  });
});
