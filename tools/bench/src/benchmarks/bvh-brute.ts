import type { BlasOptions } from '@glanz/bvh';
import { fast } from '@glanz/bvh/fast';
import { best, bestSplit } from '@glanz/bvh/best';
import { GpuBuilder } from '@glanz/bvh/gpu';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { timed, type Benchmark } from '../benchmark';
import { buildOnGpu } from '../bvh-brute/build-on-gpu';
import { GpuTracer } from '../bvh-brute/gpu';
import { tryScenes } from '../bvh-brute/run';
import { writeBvhPage, type BruteDetails } from '../bvh/page';
import { BenchError } from '../error';
import { machine } from '../machine';

/** Ways to build that are tried in turn. */
export const BUILDERS: readonly BlasOptions[] = [
  {},
  { builder: fast },
  { builder: best },
  { builder: bestSplit },
  { bins: 4 },
];

/**
 * No measurement but a trial: rays through random scenes against brute force. Ends with an error if any ray is lost.
 */
export const benchmark: Benchmark = {
  description: 'rays through random scenes against brute force, on the CPU and the GPU (--seed N)',
  options: {
    pages: { type: 'string', help: 'folder to write the page of the docs and its data into' },
    builder: { type: 'string', help: '"gpu": all trees are built on the GPU' },
  },
  async run({ log, quick, gpu, seed = 1, values }) {
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? { software: 'only' } : { gpu });
    const device = await requestDevice({ gpu: api });
    const gpus = await Promise.all((['binary', 'wide'] as const).map((layout) => GpuTracer.create(device, layout)));
    const onGpu = values['builder'] === 'gpu';
    const builder = onGpu ? await GpuBuilder.create(device) : undefined;
    const scenes = quick ? 50 : 1200,
      raysPerScene = quick ? 1000 : 8500,
      gpuEvery = quick ? 2 : 10;
    log(`seed ${seed}: ${scenes} scenes of ${raysPerScene} rays each`);
    const totals = await tryScenes({
      seed,
      scenes,
      raysPerScene,
      gpuEvery,
      gpus,
      builders: BUILDERS,
      log,
      ...(builder ? { build: buildOnGpu(device, builder) } : {}),
    });
    builder?.destroy();
    device.destroy();
    if (totals.wrong + totals.gpuWrong > 0)
      throw new BenchError(
        'bench/wrong-hits',
        `${totals.wrong} rays on the CPU and ${totals.gpuWrong} on the GPU are wrong with seed ${seed}: see the lines above.`,
      );
    const details: BruteDetails = {
      seed,
      scenes,
      rays: totals.rays,
      wrong: totals.wrong,
      gpuRays: totals.gpuRays,
      gpuWrong: totals.gpuWrong,
    };
    if (values['pages'] !== undefined)
      for (const file of writeBvhPage(
        'bvh-brute',
        { benchmark: 'bvh-brute', machine: machine(), quick, details },
        values['pages'],
      ))
        log(`wrote ${file}`);
    const none = { value: 0, relation: '<=' as const, source: 'no ray is lost' };
    return {
      settings: { seed, scenes, raysPerScene, gpuEvery, builder: onGpu ? 'GPU' : 'all of the CPU' },
      gpu: { name: adapterName, software },
      figures: [
        timed('scenes', '1', [scenes]),
        timed('rays on the CPU', '1', [totals.rays]),
        timed('of them through the wide layout as well', '1', [totals.wideRays]),
        timed('of them hits', '1', [totals.hits]),
        timed('wrong on the CPU', '1', [totals.wrong], none),
        timed('past degenerate triangles, bounded loosely', '1', [totals.loose]),
        timed('rays on the GPU', '1', [totals.gpuRays]),
        timed('wrong on the GPU', '1', [totals.gpuWrong], none),
        timed('within rounding of an edge on the GPU, either side right', '1', [totals.gpuMarginal]),
      ],
    };
  },
};
