import { createPushButton, type PushButtonLevel } from '@glanz/models';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import type { Scene } from '@glanz/scene';
import { estimated, timed, wallTimes, type Benchmark, type Figure } from '../benchmark';
import { GpuClock } from '../gpu-clock';
import { KernelClock, type KernelTime } from '../kernel-clock';

const LEVELS: readonly PushButtonLevel[] = ['low', 'medium', 'high'];

/**
 * GPU milliseconds per sample that strahl 0.1.0 took on an H200 with these settings, on the paper's own model of this
 * size.
 */
const STRAHL: Readonly<Record<PushButtonLevel, number>> = { low: 8.1, medium: 7.7, high: 8.5 };

/** Samples per pixel in a timed run. */
const SAMPLES = 100;

/** Milliseconds for {@link SAMPLES} samples that are asked for. */
const ASKED = 60;

/** The model as the paper shows it, under a constant environment and a sun. */
function sunlit(level: PushButtonLevel): Scene {
  const scene = createPushButton({ level });
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  scene.lights.push({
    type: 'directional',
    name: 'sun',
    color: [1, 1, 1],
    intensity: 3,
    direction: [-0.48, -0.8, -0.36],
  });
  return scene;
}

/** Shares of the kernels, and the rays a second of the two that trace. */
function kernelFigures(level: string, times: readonly KernelTime[]): Figure[] {
  const all = times.reduce((sum, { milliseconds }) => sum + milliseconds, 0);
  return times.flatMap(({ kernel, milliseconds, workgroups }) => {
    const name = kernel.replace('glanz ', '');
    const share = timed(`${level}: share of ${name}`, '%', [(100 * milliseconds) / all]);
    // Known where launches are indirect.
    return workgroups > 0 && (name === 'intersect' || name === 'connect')
      ? [share, timed(`${level}: rays of ${name}`, 'Mrays/s', [(64 * workgroups) / milliseconds / 1e3])]
      : [share];
  });
}

/**
 * The setting of the push-button benchmark of strahl's paper (2025): 512 × 512, 100 samples, depth 5, metal, plastic
 * and a glowing lens, a constant environment and a sun, three resolutions of a push-button; then 1920 × 1080 at depth
 * 8.
 */
export const benchmark: Benchmark = {
  description:
    'time per sample of the push-button at 512 × 512, depth 5, constant environment and sun, three resolutions, and of 1920 × 1080 at depth 8',
  async run({ log, quick, gpu }) {
    const started = performance.now();
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const device = await requestDevice({ gpu: api });
    const deviceMs = performance.now() - started;
    const size = quick ? 64 : 512;
    const samples = quick ? 2 : software ? 4 : SAMPLES;
    const runs = quick ? 2 : software ? 5 : 30;
    const figures: Figure[] = [timed('device: time to get', 'ms', [deviceMs])];
    const notes: string[] = [];
    const clock = GpuClock.create(device);
    if (!clock) notes.push('no timestamp queries: GPU times are missing');
    for (const level of LEVELS) {
      log(`${level}: building the model`);
      const scene = sunlit(level);
      const options = { width: size, height: size, maxDepth: 5, camera: 0 } as const;
      const render = async (tracer: PathTracer, count: number) => {
        for await (const progress of tracer.render({ samples: count })) void progress;
      };

      const bvh: number[] = [];
      const firstSample: number[] = [];
      const create: number[] = [];
      let tracer: PathTracer | undefined;
      // The first creation is cold: its pipelines come from the driver's compiler, later ones from its cache.
      for (let i = 0; i < (quick ? 2 : 5); i++) {
        tracer?.destroy();
        const t0 = performance.now();
        tracer = await PathTracer.create(device, scene, options);
        const t1 = performance.now();
        await render(tracer, 1);
        await tracer.read('beauty');
        const t2 = performance.now();
        const { bvhMs, uploadMs, compileMs, triangles, lights, gpuBytes } = tracer.statistics;
        bvh.push(bvhMs);
        if (i === 0) {
          figures.push(
            timed(`${level}: pipelines, first creation`, 'ms', [compileMs]),
            timed(`${level}: upload, first`, 'ms', [uploadMs]),
            timed(`${level}: first sample, first creation`, 'ms', [t2 - t1]),
            timed(`${level}: from scene to first sample, first creation`, 'ms', [t2 - t0]),
            timed(`${level}: triangles`, '1', [triangles]),
            timed(`${level}: emissive triangles and lights`, '1', [lights]),
            timed(`${level}: GPU memory`, 'MiB', [gpuBytes / 2 ** 20]),
          );
        } else {
          create.push(compileMs);
          firstSample.push(t2 - t1);
        }
      }
      figures.push(
        timed(`${level}: pipelines, created again`, 'ms', create),
        timed(`${level}: first sample, created again`, 'ms', firstSample),
        timed(`${level}: hierarchies on the CPU`, 'ms', bvh),
      );

      const rendering = tracer as PathTracer;
      await render(rendering, samples);
      const again = async () => {
        rendering.reset();
        await render(rendering, samples);
        await device.queue.onSubmittedWorkDone();
      };
      // Apart, so that the clock's own commands do not burden the wall time.
      const wall = (await wallTimes(runs, 0, again)).map((ms) => ms / samples);
      const asked = software || quick ? undefined : ({ value: ASKED, relation: '<=', source: 'asked for' } as const);
      figures.push(
        estimated(
          `${level}: wall time of ${samples} samples`,
          'ms',
          wall.map((ms) => ms * samples),
          asked,
        ),
        timed(`${level}: wall time per sample`, 'ms', wall),
      );
      if (clock) {
        const measured = [];
        for (let i = 0; i < runs; i++) measured.push(await clock.measure(again));
        const target =
          software || quick
            ? undefined
            : ({
                value: STRAHL[level] / 4,
                relation: '<=',
                source: `a quarter of strahl's ${STRAHL[level]} ms on an H200`,
              } as const);
        figures.push(
          estimated(
            `${level}: GPU time of ${samples} samples`,
            'ms',
            measured.map(({ busy }) => busy),
          ),
          timed(
            `${level}: GPU time per sample`,
            'ms',
            measured.map(({ busy }) => busy / samples),
            target,
          ),
          timed(
            `${level}: GPU time per sample with the gaps between submissions`,
            'ms',
            measured.map(({ span }) => span / samples),
          ),
          timed(
            `${level}: submissions`,
            '1',
            measured.map(({ submissions }) => submissions),
          ),
        );
      }
      log(`${level}: ${(wall[0] as number).toFixed(2)} ms per sample`);
      rendering.destroy();
    }
    for (const level of LEVELS) {
      const tracer = await PathTracer.create(
        device,
        sunlit(level),
        quick
          ? { width: 96, height: 54, maxDepth: 8, camera: 0 }
          : { width: 1920, height: 1080, maxDepth: 8, camera: 0 },
      );
      const again = async () => {
        tracer.reset();
        for await (const progress of tracer.render({ samples: software ? 2 : 16 })) void progress;
        await device.queue.onSubmittedWorkDone();
      };
      const wall = await wallTimes(quick || software ? 2 : 7, 1, again);
      figures.push(
        timed(
          `${level}, 1920 × 1080, depth 8`,
          'samples/s',
          wall.map((ms) => ((software ? 2 : 16) * 1000) / ms),
        ),
      );
      tracer.destroy();
    }
    clock?.destroy();
    const kernels = KernelClock.create(device);
    for (const level of kernels ? LEVELS : []) {
      const tracer = await PathTracer.create(device, sunlit(level), {
        width: size,
        height: size,
        maxDepth: 5,
        camera: 0,
      });
      const again = async () => {
        tracer.reset();
        for await (const progress of tracer.render({ samples, maxSubmitMs: 1000 })) void progress;
        await device.queue.onSubmittedWorkDone();
      };
      await again();
      figures.push(...kernelFigures(level, await (kernels as KernelClock).measure(again)));
      tracer.destroy();
    }
    kernels?.destroy();
    device.destroy();
    return {
      settings: {
        width: size,
        height: size,
        maxDepth: 5,
        samples,
        environment: 'constant, radiance 1',
        sun: 'irradiance 3',
        model: 'push-button',
        levels: LEVELS,
      },
      gpu: { name: adapterName, software },
      figures,
      notes,
    };
  },
};
