import { testDevice, expectNoGpuErrors } from '@glanz/gpu';
import { buildBlas, closestHit } from '@glanz/bvh';
import { afterAll, expect, test } from 'vitest';
import { GpuRays, LAYOUTS } from '../src/bvh/gpu-rays';
import { assembly, noisySphere } from '../src/bvh/meshes';
import { diffuseRays, inRoom, primaryRays, shadowRays } from '../src/bvh/ray-sets';

afterAll(() => expectNoGpuErrors());

for (const layout of LAYOUTS) {
  test(`rays of the benchmark hit on the GPU what they hit on the CPU (${layout})`, async () => {
    const device = await testDevice();
    const { mesh, bounds } = inRoom(layout === 'BVH2' ? noisySphere('sphere', 12) : assembly('assembly', 12, 8));
    const blas = buildBlas(mesh);
    const rays = await GpuRays.create(device, layout, blas, mesh);
    const primary = primaryRays(bounds, 16);
    const loaded = rays.load(primary);
    const results = await rays.results(loaded, 'closest');
    const expected = (set: Float32Array, i: number) =>
      closestHit(blas, mesh, {
        origin: set.subarray(8 * i, 8 * i + 3),
        direction: set.subarray(8 * i + 4, 8 * i + 7),
        tMax: set[8 * i + 7]!,
      });
    let other = 0;
    for (let i = 0; i < 256; i++) if (expected(primary, i)?.triangle !== results[2 * i + 1]) other++;
    expect(other).toBeLessThanOrEqual(1);
    // The room is closed: every ray hits.
    expect(results.filter((word, i) => i % 2 === 1 && word === 0xffffffff)).toHaveLength(0);
    const diffuse = diffuseRays(bounds, primary, results, mesh, 3);
    expect(diffuse.length).toBe(primary.length);
    const shadow = shadowRays(bounds, primary, results, mesh);
    const blocked = await rays.results(rays.load(shadow), 'any');
    let lit = 0,
      differ = 0;
    for (let i = 0; i < 256; i++) {
      const is = blocked[2 * i + 1] === 0;
      if (!is) lit++;
      if (is !== (expected(shadow, i) !== undefined)) differ++;
    }
    expect(differ).toBeLessThanOrEqual(1);
    expect(lit).toBeGreaterThan(20);
    expect(lit).toBeLessThan(250);
    expect(await rays.time(loaded, 'closest', 3)).toBeGreaterThanOrEqual(0);
    rays.destroy();
  });
}
