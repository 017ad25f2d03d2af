import { buildBlas, closestHit, type Blas } from '@glanz/bvh';
import { GpuBuilder, readGpuBlas, type GpuBuildTimes } from '@glanz/bvh/gpu';
import { sahCost } from '@glanz/bvh/statistics';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { GpuRays } from '../bvh/gpu-rays';
import { assembly, benchMeshes, inMemory, noisySphere, type BenchMesh } from '../bvh/meshes';
import { diffuseRays, inRoom, primaryRays } from '../bvh/ray-sets';
import { BenchError } from '../error';

/** Triangles up to which the tree of the CPU is built, too. */
const COMPARED = 2_000_000;

const PHASES = ['primitives', 'sort', 'cluster', 'layout', 'total'] as const;

/** Meshes by size alone, made when asked for. */
const SIZED: readonly (readonly [count: number, make: () => BenchMesh])[] = [
  [10_000, () => noisySphere('noisy sphere 10k', 50)],
  [1_070_000, () => noisySphere('noisy sphere 1.07M', 518)],
  [1_075_000, () => assembly('assembly 1.07M', 5600, 48)],
  [10_000_000, () => noisySphere('noisy sphere 10M', 1581)],
  [10_200_000, () => assembly('assembly 10M', 53_000, 48)],
  [31_000_000, () => noisySphere('noisy sphere 31M', 2784)],
];

/** Milliseconds at most for sizes that have a target. */
const target = (count: number): Figure['target'] => {
  const value = count > 20e6 ? 130 : count > 5e6 ? 40 : count > 9e5 ? 6 : undefined;
  return value === undefined ? undefined : { value, relation: '<=', source: 'a data centre GPU' };
};

/** Hierarchies built on the GPU: time by phases, cost and diffuse rays beside the trees of `balanced`. */
export const benchmark: Benchmark = {
  description: 'building hierarchies on the GPU: time by phases, surface area cost and diffuse rays beside balanced',
  options: {
    max: { type: 'string', help: 'triangles at most; default 11000000, of 32000000 the largest mesh is built too' },
    rays: { type: 'string', help: '"no": no rays are traced' },
    'default-limits': { type: 'string', help: '"yes": a device with the limits that every browser has' },
  },
  async run({ log, quick, gpu, values }) {
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const device = await requestDevice({ gpu: api, defaultLimits: values['default-limits'] === 'yes' });
    const small = quick || software;
    const max = values['max'] === undefined ? (small ? 60_000 : 11e6) : Number(values['max']);
    if (!(max > 0)) throw new BenchError('bench/option', `--max ${values['max']}: it must be a number of triangles.`);
    const runs = small ? 2 : 9;
    const timestamps = device.features.has('timestamp-query');
    const figures: Figure[] = [],
      notes: string[] = timestamps ? [] : ['no timestamp queries: wall times alone'];
    const builder = await GpuBuilder.create(device);
    const figure = (name: string, unit: string, list: readonly number[], limit?: Figure['target']) =>
      figures.push(timed(name, unit, list, small ? undefined : limit));

    const measure = async (mesh: BenchMesh): Promise<Blas> => {
      const count = mesh.indices.length / 3;
      const input = inMemory(device, mesh);
      const times: GpuBuildTimes[] = [],
        wall: number[] = [];
      let blas: Blas | undefined,
        cost = 0,
        same = 1;
      try {
        for (let i = -2; i < runs; i++) {
          const start = performance.now();
          const built = await builder.buildBlas(input, { timestamps });
          const end = performance.now();
          cost = built.sahCost;
          if (i >= 0) wall.push(end - start);
          if (i >= 0 && built.times) times.push(built.times);
          if (i === -2) blas = await readGpuBlas(device, built);
          // Two runs give the same bits.
          if (i === -1 && count <= COMPARED) {
            const again = await readGpuBlas(device, built);
            const bits = (tree: Blas) => Buffer.from(tree.nodes.buffer);
            same = bits(again).equals(bits(blas!)) ? 1 : 0;
          }
          built.destroy();
        }
      } finally {
        input.destroy();
      }
      figure(`${mesh.name}: triangles`, '1', [count]);
      for (const phase of times.length > 0 ? PHASES : [])
        figure(
          `${mesh.name}: GPU time, ${phase}`,
          'ms',
          times.map((time) => time[phase]),
          phase === 'total' ? target(count) : undefined,
        );
      figure(`${mesh.name}: from the call to the result`, 'ms', wall);
      if (same !== 1) throw new Error(`${mesh.name}: two builds gave different nodes`);
      const sorted = times.map(({ total }) => total).sort((a, b) => a - b);
      log(
        `${mesh.name}: ${count} triangles, GPU ${sorted[sorted.length >> 1]?.toFixed(2) ?? '?'} ms, wall ${Math.min(...wall).toFixed(2)} ms, cost ${cost.toFixed(2)}`,
      );
      return blas!;
    };

    const compare = async (mesh: BenchMesh, blas: Blas): Promise<void> => {
      const balanced = buildBlas(mesh);
      const ratio = sahCost(blas) / sahCost(balanced);
      const limit = { value: 1.1, relation: '<=', source: 'quality' } as const;
      figures.push(timed(`${mesh.name}: surface area cost over balanced`, '1', [ratio], limit));
      log(`  surface area cost ${ratio.toFixed(3)} of balanced`);
      if (values['rays'] === 'no') return;
      const room = inRoom(mesh);
      const input = inMemory(device, room.mesh);
      const built = await builder.buildBlas(input);
      const own = await GpuRays.create(device, 'BVH2', await readGpuBlas(device, built), room.mesh);
      const reference = buildBlas(room.mesh);
      const other = await GpuRays.create(device, 'BVH2', reference, room.mesh);
      built.destroy();
      input.destroy();
      const primary = primaryRays(room.bounds, small ? 64 : 1024);
      const hits = await other.results(other.load(primary), 'closest');
      const rays = diffuseRays(room.bounds, primary, hits, room.mesh, 3);
      const [ownRays, otherRays] = [own.load(rays), other.load(rays)];
      const [found, expected] = [await own.results(ownRays, 'closest'), await other.results(otherRays, 'closest')];
      // Distances: neighbours share the rays through their common edge.
      const t = [found, expected].map(({ buffer }) => new Float32Array(buffer)) as [Float32Array, Float32Array];
      const isSame = (a: number, b: number) => a === b || Math.abs(a - b) <= 1e-4 * Math.abs(b);
      const distance = (results: Uint32Array, times: Float32Array, i: number) =>
        results[i + 1] === 0xffffffff ? Infinity : times[i]!;
      let [wrong, ours, theirs] = [0, 0, 0];
      for (let i = 0; i < found.length; i += 2) {
        const [a, b] = [distance(found, t[0], i), distance(expected, t[1], i)];
        if (isSame(a, b)) continue;
        // Which of the two is right, in double precision.
        const ray = rays.subarray(4 * i, 4 * i + 8);
        const [origin, direction] = [ray.subarray(0, 3), ray.subarray(4, 7)];
        const hit = closestHit(reference, room.mesh, { origin, direction, tMin: ray[3]!, tMax: ray[7]! });
        const exact = hit?.t ?? Infinity;
        if (isSame(a, exact)) ours++;
        if (isSame(b, exact)) theirs++;
        if (wrong++ < 6)
          log(
            `  ray ${i / 2}: ${a} (triangle ${found[i + 1]}) through the tree of the GPU, ${b} (${expected[i + 1]}) through balanced, ${exact} (${hit?.triangle}; u ${hit?.u}, v ${hit?.v}) in double precision; from ${origin.join(', ')} along ${direction.join(', ')}`,
          );
      }
      const once = await other.time(otherRays, 'closest', 1);
      const times = Math.ceil((small ? 5 : 20) / Math.max(once, 0.1));
      const rates: number[] = [];
      for (let i = -1; i < runs; i++) {
        const theirs = await other.time(otherRays, 'closest', times);
        const ours = await own.time(ownRays, 'closest', times);
        if (i >= 0) rates.push(theirs / ours);
      }
      figure(`${mesh.name}: diffuse rays that hit something else`, '1', [wrong / ownRays.count]);
      figure(`${mesh.name}: of them, as in double precision`, '1', [wrong > 0 ? ours / wrong : 1]);
      figure(`${mesh.name}: of them, balanced as in double precision`, '1', [wrong > 0 ? theirs / wrong : 1]);
      figure(`${mesh.name}: diffuse rays a second over balanced`, '1', rates, {
        value: 0.95,
        relation: '>=',
        source: 'quality',
      });
      log(
        `  diffuse rays ${[...rates].sort((a, b) => a - b)[rates.length >> 1]!.toFixed(3)} of balanced, ${wrong} of ${ownRays.count} hit something else (${ours} as in double precision, of balanced ${theirs})`,
      );
      own.destroy();
      other.destroy();
    };

    const seen = new Set<string>();
    const list = (await benchMeshes(quick, (line) => notes.push(line))).map(
      (mesh) => [mesh.indices.length / 3, () => mesh] as const,
    );
    for (const [count, make] of [...SIZED, ...list].filter(([triangles]) => triangles <= max)) {
      const mesh = make();
      if (seen.has(mesh.name)) continue;
      seen.add(mesh.name);
      const blas = await measure(mesh);
      if (count <= COMPARED) await compare(mesh, blas);
    }
    builder.destroy();
    device.destroy();
    return {
      settings: { runs, max, levels: 2, rays: 'diffuse: cosine, first bounce, in a closed cubic room' },
      gpu: { name: adapterName, software },
      figures,
      notes,
    };
  },
};
