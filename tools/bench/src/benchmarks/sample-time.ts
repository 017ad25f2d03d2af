import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { taskScene } from '../equal-time/glanz';
import { SCENES } from '../equal-time/scenes';
import { GpuClock } from '../gpu-clock';
import { KernelClock } from '../kernel-clock';
import { listOption, numberOption } from '../options';

/** What a sample of the scenes of `equal-time` costs on the GPU, by depth, and how kernels share it. */
export const benchmark: Benchmark = {
  description: 'GPU time of a sample in the scenes of equal-time, by the depth of paths, and the share of each kernel',
  options: {
    scenes: { type: 'string', help: 'names, separated by commas' },
    size: { type: 'string', help: 'pixels across and down (512)' },
    samples: { type: 'string', help: 'samples a pixel of a run (256)' },
    runs: { type: 'string', help: 'timed runs (5)' },
    depths: { type: 'string', help: "edges of a path at most, separated by commas; default that of each scene's task" },
    'light-paths': { type: 'string', help: 'light paths for each pixel and sample (0)' },
    guiding: { type: 'string', help: 'millions of paths that a guide learns from (0)' },
  },
  async run({ log, quick, gpu, values }) {
    const names = listOption(
      values['scenes'],
      SCENES.map(({ name }) => name),
      'scene',
    );
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const small = quick || software;
    const size = numberOption(values, 'size', small ? 64 : 512);
    const samples = numberOption(values, 'samples', small ? 4 : 256);
    const runs = numberOption(values, 'runs', small ? 2 : 5);
    const lightPaths = Number(values['light-paths'] ?? 0);
    const guiding = Number(values['guiding'] ?? 0);
    const depths = values['depths']?.split(',').map((text) => numberOption({ depths: text }, 'depths', 1));
    const device = await requestDevice({ gpu: api });
    // Before the tracers: it watches their buffers, too.
    const kernels = KernelClock.create(device);
    const clock = GpuClock.create(device);
    const figures: Figure[] = [];
    const details: Record<string, Record<string, readonly number[]>> = {};
    for (const { name, load } of SCENES.filter((scene) => names.includes(scene.name))) {
      const { task } = await load(size);
      const scene = await taskScene(task);
      for (const maxDepth of depths ?? [task.maxDepth]) {
        const { camera, multipleScattering } = task;
        const options = { width: size, height: size, maxDepth, camera, multipleScattering, lightPaths, guiding };
        const tracer = await PathTracer.create(device, scene, options);
        const render = async (count: number) => {
          tracer.reset();
          for await (const progress of tracer.render({ samples: count })) void progress;
          await device.queue.onSubmittedWorkDone();
        };
        const title = `${name}, depth ${maxDepth}`;
        // Memory for many paths at once comes with the first samples.
        await render(samples);
        const before = await tracer.readRayCount();
        await render(samples);
        const rays = ((await tracer.readRayCount()) - before) / (samples * size * size);
        figures.push(timed(`${title}: rays of a path`, '1', [rays]));
        const times: number[] = [];
        for (let i = 0; clock && i < runs; i++) times.push((await clock.measure(() => render(samples))).busy / samples);
        if (times.length > 0) figures.push(timed(`${title}: GPU time of a sample`, 'ms', times));
        const few = Math.min(samples, 8);
        const shares = kernels ? await kernels.measure(() => render(few)) : [];
        const all = shares.reduce((sum, { milliseconds }) => sum + milliseconds, 0);
        details[title] = Object.fromEntries(shares.map(({ kernel, each }) => [kernel, each]));
        for (const { kernel, milliseconds } of shares.sort((a, b) => b.milliseconds - a.milliseconds)) {
          if (milliseconds < 0.01 * all) continue;
          figures.push(timed(`${title}: ${kernel} by itself`, 'ms', [milliseconds / few]));
        }
        log(`${title}: ${times[0]?.toFixed(3) ?? 'no time'} ms a sample, ${rays.toFixed(2)} rays of a path`);
        tracer.destroy();
      }
    }
    clock?.destroy();
    kernels?.destroy();
    device.destroy();
    const notes = clock
      ? [
          'The times of kernels by themselves contain gaps between them: their shares are what they are for. `details` has each dispatch.',
        ]
      : ['The device has no timestamps: rays are counted, not timed.'];
    return {
      settings: { size, samples, depths, lightPaths, guiding },
      gpu: { name: adapterName, software },
      figures,
      notes,
      details,
    };
  },
};
