import { buildBlas, buildTlas } from '@glanz/bvh';
import { closestHitBatch } from '@glanz/bvh/batch';
import { closestPointBatch } from '@glanz/bvh/distance';
import { BoxRegion, overlapBatch } from '@glanz/bvh/overlap';
import { refitBlas } from '@glanz/bvh/refit';
import { deserializeBlas, serializeBlas } from '@glanz/bvh/serialize';
import { sahCost } from '@glanz/bvh/statistics';
import { timed, wallTimes, type Benchmark, type Figure } from '../benchmark';
import { noisySphere } from '../bvh/meshes';
import { randomDirection, randomNumbers } from '../bvh-brute/random';

/** What is done with trees after they are built: on one thread, warm. */
export const benchmark: Benchmark = {
  description: 'upper levels, refits, CPU queries and reading back, one thread',
  async run({ quick, seed = 1 }) {
    const random = randomNumbers(seed);
    const mesh = noisySphere('sphere', quick ? 40 : 160);
    const triangles = mesh.indices.length / 3,
      count = quick ? 2_000 : 100_000,
      runs = quick ? 2 : 9;
    const blas = buildBlas(mesh);
    const figures: Figure[] = [];
    const measure = async (name: string, work: () => unknown, target?: number) => {
      const times = await wallTimes(runs, 3, work);
      figures.push(
        timed(
          name,
          'ms',
          times,
          target === undefined || quick ? undefined : { value: target, relation: '<=', source: 'issue 3' },
        ),
      );
    };
    const instances = Array.from({ length: 1000 }, () => {
      const axes = [0, 1, 2].map(() => randomDirection(random));
      return {
        bounds: blas.bounds,
        transform: [...axes.flatMap((axis) => [...axis, 0]), ...[0, 1, 2].map(() => 60 * random()), 1],
      };
    });
    // A single call is a matter of a millisecond, and the clock's: fifty at a time.
    const tlas = await wallTimes(runs * 5, 20, () => {
      for (let i = 0; i < 50; i++) buildTlas(instances);
    });
    figures.push(
      timed(
        'TLAS over 1,000 instances',
        'ms',
        tlas.map((ms) => ms / 50),
        quick ? undefined : { value: 1, relation: '<=', source: 'rebuilt each frame' },
      ),
    );
    await measure(`refit, ${triangles} triangles`, () => refitBlas(blas, mesh));
    await measure(`surface area cost, ${triangles} triangles`, () => sahCost(blas));
    const bytes = serializeBlas(blas);
    await measure(`write, ${triangles} triangles`, () => serializeBlas(blas));
    await measure(`read and check, ${triangles} triangles`, () => deserializeBlas(bytes, mesh));
    const rays = new Float32Array(8 * count),
      points = new Float32Array(3 * count),
      boxes = new Float32Array(6 * count);
    for (let i = 0; i < count; i++) {
      const from = randomDirection(random),
        to = randomDirection(random),
        place = randomDirection(random);
      rays.set([...from.map((x) => 2 * x), 0, ...from.map((x, k) => 0.9 * to[k]! - 2 * x), 1e30], 8 * i);
      points.set(
        place.map((x) => x * (0.5 + 1.5 * random())),
        3 * i,
      );
      boxes.set([...place.map((x) => x - 0.02), ...place.map((x) => x + 0.02)], 6 * i);
    }
    const out = { t: new Float32Array(count), triangle: new Int32Array(count) };
    await measure(`closest hits, ${count} rays`, () => closestHitBatch(blas, mesh, rays, out));
    const near = { distance: new Float32Array(count), triangle: new Int32Array(count) };
    await measure(`nearest points, ${count} points`, () => closestPointBatch(blas, mesh, points, near));
    const region = new BoxRegion(),
      starts = new Uint32Array(count + 1);
    const found = {
      starts,
      triangle: new Uint32Array(overlapBatch(blas, mesh, region, boxes, { starts, triangle: new Uint32Array(0) })),
    };
    await measure(`triangles in ${count} boxes (${found.triangle.length} found)`, () =>
      overlapBatch(blas, mesh, region, boxes, found),
    );
    return { settings: { seed, triangles, count, runs, bytesPerTriangle: bytes.byteLength / triangles }, figures };
  },
};
