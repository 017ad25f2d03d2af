import { readFileSync } from 'node:fs';
import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import { compose, wgslModule } from '@glanz/wgsl';
import { expect, test } from 'vitest';
import { buildBlas, buildTlas, closestHitInstances } from '../src/index';
import { bvhBuffers, bvhClosestHit, packHierarchy } from '../src/wgsl/index';
import { sphere } from './shapes';

test('the shader of the README finds what the CPU finds', async () => {
  const readme = readFileSync(new URL('../README.md', import.meta.url), 'utf8');
  const text = /wgslModule\('app\/trace', `([^`]*)`/.exec(readme)![1]!;
  const mesh = sphere(20),
    blas = buildBlas(mesh);
  const placed = [0, 1].map((x) => ({ mesh, blas, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1] }));
  const tlas = buildTlas(placed.map(({ transform }) => ({ bounds: blas.bounds, transform })));
  const { nodes, triangles, instances } = packHierarchy(tlas, placed);
  const { code } = compose([wgslModule('app/trace', text, [bvhClosestHit, bvhBuffers()])], {
    flags: { BVH_FILTER: false },
  });
  const distances = new Float32Array(
    await runCompute(await testDevice(), code, {
      inputs: [nodes, triangles, instances],
      outputBytes: 256,
      workgroups: 1,
    }),
  );
  await expectNoGpuErrors();
  const expected = Array.from(
    distances,
    (_, i) => closestHitInstances(tlas, placed, { origin: [0, 0, 3], direction: [0.01 * (i - 32), 0, -1] })?.t ?? -1,
  );
  expected.forEach((t, i) => expect(distances[i]).toBeCloseTo(t, 4));
  expect(expected.filter((t) => t > 0).length).toBeGreaterThan(30);
});
