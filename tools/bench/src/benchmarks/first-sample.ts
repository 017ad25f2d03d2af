import { availableParallelism } from 'node:os';
import { PathTracer, requestDevice, warmUp, type RenderStatistics } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { createScene, type Scene } from '@glanz/scene';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { noisySphere } from '../bvh/meshes';
import { benchWorkers, servesBenchmark } from '../bvh/threads';
import { BenchError } from '../error';

/** Triangles, and rings of a noisy sphere that has about as many. */
const SIZES: readonly (readonly [triangles: number, name: string, rings: number])[] = [
  [10_000, '10 k', 50],
  [107_000, '107 k', 164],
  [1_070_000, '1.07 M', 518],
  [10_000_000, '10 M', 1581],
  [31_000_000, '31 M', 2784],
];

/** Milliseconds from the scene in memory to the first sample, where they are asked for. */
const TARGETS: Readonly<Record<string, number>> = { '107 k': 100, '1.07 M': 200, '10 M': 1200, '31 M': 4000 };

const BUILDERS = ['cpu', 'gpu'] as const;

/** Steps of a preparation, in milliseconds. */
const STEPS: readonly (readonly [string, (statistics: RenderStatistics) => number])[] = [
  ['checks', ({ checkMs }) => checkMs],
  ['hierarchies', ({ bvhMs }) => bvhMs],
  ['written to the GPU', ({ uploadMs }) => uploadMs],
  ['of that, lights, environment and tables', ({ lightMs }) => lightMs],
  ['pipelines', ({ compileMs }) => compileMs],
];

/** A smooth noisy sphere in a constant environment. */
function sphereScene(rings: number): Scene {
  const { positions, indices } = noisySphere('sphere', rings);
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < normals.length; i += 3) {
    const [x, y, z] = [positions[i]!, positions[i + 1]!, positions[i + 2]!];
    const length = Math.sqrt(x * x + y * y + z * z);
    normals[i] = x / length;
    normals[i + 1] = y / length;
    normals[i + 2] = z / length;
  }
  const transform = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  return {
    ...createScene('sphere'),
    meshes: [{ name: 'sphere', positions, normals, indices }],
    materials: [{ name: 'clay', parameters: { base_color: [0.6, 0.5, 0.4] } }],
    instances: [{ name: 'sphere', mesh: 0, material: 0, transform }],
    environment: { type: 'constant', radiance: [1, 1, 1] },
  };
}

/** From a scene in memory to its first sample, by size, with hierarchies of the CPU and of the GPU in turns. */
export const benchmark: Benchmark = {
  description: 'from a scene in memory to its first sample: 10 thousand to 10 million triangles, by builder',
  options: {
    max: { type: 'string', help: 'triangles at most; default 11000000; of 32000000 31 million are measured too' },
    repeats: { type: 'string', help: 'tracers of each kind and size; default 5, from 10 million on 2' },
    workers: { type: 'string', help: 'threads that build on the CPU; default: one a core, at most 8' },
  },
  async run({ log, quick, gpu, values }) {
    // A worker of the process below.
    if (servesBenchmark()) return { settings: {}, figures: [] };
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const device = await requestDevice({ gpu: api });
    const small = quick || software;
    const max = values['max'] === undefined ? (small ? 120_000 : 11e6) : Number(values['max']);
    const threads = Number(values['workers'] ?? Math.min(8, availableParallelism()));
    if (!(max > 0) || !(threads >= 1))
      throw new BenchError('bench/option', '--max and --workers must be numbers above 0.');
    const hierarchies = await benchWorkers(threads, true);
    const size = small ? 64 : 512;
    const options = { width: size, height: size, maxDepth: 5, hierarchies };
    await warmUp(device, options);
    const figures: Figure[] = [];
    for (const [count, name, rings] of SIZES.filter(([triangles]) => triangles <= max)) {
      const scene = sphereScene(rings);
      const repeats = Number(values['repeats'] ?? (small ? 1 : count < 5e6 ? 5 : 2));
      const total: Record<string, number[]> = { cpu: [], gpu: [] };
      const steps: Record<string, RenderStatistics[]> = { cpu: [], gpu: [] };
      const images: Record<string, Float32Array> = {};
      for (let i = -1; i < repeats; i++) {
        // Where a build takes many seconds, the first counts.
        if (i === -1 && count > 2e6) continue;
        for (const bvhBuilder of i % 2 === 0 ? BUILDERS : BUILDERS.toReversed()) {
          const begin = performance.now();
          const tracer = await PathTracer.create(device, scene, { ...options, bvhBuilder });
          for await (const progress of tracer.render({ samples: 1 })) void progress;
          const end = performance.now();
          images[bvhBuilder] = await tracer.read('beauty');
          if (i >= 0) {
            total[bvhBuilder]!.push(end - begin);
            steps[bvhBuilder]!.push(tracer.statistics);
          }
          tracer.destroy();
        }
      }
      figures.push(timed(`${name}: triangles`, '1', [scene.meshes[0]!.indices.length / 3]));
      for (const builder of BUILDERS) {
        const goal = small || builder === 'cpu' ? undefined : TARGETS[name];
        const label = `${name}, ${builder}`;
        figures.push(
          timed(
            `${label}: scene in memory to first sample`,
            'ms',
            total[builder]!,
            goal === undefined ? undefined : { value: goal, relation: '<=', source: 'asked for' },
          ),
        );
        for (const [step, value] of STEPS) figures.push(timed(`${label}: ${step}`, 'ms', steps[builder]!.map(value)));
        const { builds, gpuBytes, memory } = steps[builder]!.at(-1)!;
        const temporary = Math.max(...builds.map(({ temporaryBytes }) => temporaryBytes));
        figures.push(
          timed(`${label}: bytes a triangle`, 'B', [memory.perTriangle]),
          timed(`${label}: temporary memory of the build`, 'MB', [temporary / 1e6]),
          timed(`${label}: GPU memory`, 'MB', [gpuBytes / 1e6]),
        );
        const sorted = [...total[builder]!].sort((a, b) => a - b);
        log(`${label}: ${sorted[sorted.length >> 1]!.toFixed(0)} ms to the first sample`);
      }
      const [ours, theirs] = [images['gpu']!, images['cpu']!];
      let differing = 0;
      for (let i = 0; i < ours.length; i += 4) if ([0, 1, 2, 3].some((k) => ours[i + k] !== theirs[i + k])) differing++;
      figures.push(timed(`${name}: pixels of the sample that differ between the builders`, '1', [differing]));
      log(`${name}: ${differing} of ${size * size} pixels differ`);
    }
    hierarchies.destroy();
    device.destroy();
    return {
      settings: { width: size, height: size, maxDepth: 5, workers: threads, environment: 'constant', max },
      gpu: { name: adapterName, software },
      figures,
      notes: ['after `warmUp()`: shaders are in the cache of the driver'],
    };
  },
};
