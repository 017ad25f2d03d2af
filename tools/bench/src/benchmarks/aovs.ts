import { createCornellBox, createPushButton } from '@glanz/models';
import { PathTracer, requestDevice, type AovName } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { RENDER_OPTIONS } from '@glanz/renderer/options';
import { createScene, type Material, type Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { GpuClock } from '../gpu-clock';
import { place, sphere, square, translation } from '../hashes/shapes';

/** All of a film's first samples, which are those that record. */
const SAMPLES = 64;

/** Percent of a sample's time that AOVs may take. */
const ALLOWED = 3;

const REQUESTS = {
  none: [],
  guides: ['albedo', 'normal'],
  all: RENDER_OPTIONS.aovs.values,
} as const satisfies Readonly<Record<string, readonly AovName[]>>;

type Request = keyof typeof REQUESTS;
const names = Object.keys(REQUESTS) as readonly Request[];

function pushButton(): Scene {
  const scene = createPushButton({ level: 'medium' });
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

/** A sphere of clear glass and a mirror on a plane: chains of several vertices. */
function glassAndMirror(): Scene {
  const scene = createScene();
  const glass: Material = { name: 'glass', parameters: { transmission_weight: 1, specular_roughness: 0 } };
  const mirror: Material = { name: 'mirror', parameters: { base_metalness: 1, specular_roughness: 0 } };
  const ground: Material = { name: 'ground', parameters: { base_color: [0.5, 0.45, 0.4] } };
  place(scene, sphere(), glass, translation(-0.9, 1, 0));
  place(scene, sphere(), mirror, translation(1.2, 1, -0.6));
  place(scene, square(), ground, [4, 0, 0, 0, 0, 0, -4, 0, 0, 4, 0, 0, 0, 0, 0, 1]);
  scene.environment = studioEnvironment();
  scene.cameras.push({ type: 'perspective', name: 'camera', transform: translation(0, 1.2, 4), yfov: 0.7 });
  return scene;
}

const SCENES: Readonly<Record<string, () => Scene>> = {
  'push-button': pushButton,
  'Cornell box': () => createCornellBox(),
  'glass and mirror': glassAndMirror,
};

const median = (values: readonly number[]) =>
  [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)] as number;

/** What first-hit AOVs cost: the time per sample with and without them, taken in turns. */
export const benchmark: Benchmark = {
  description: `time per sample with first-hit AOVs over that without, at most ${ALLOWED} %: 512 × 512, depth 5, the film's first ${SAMPLES} samples`,
  async run({ log, quick, gpu }) {
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const device = await requestDevice({ gpu: api });
    const size = quick || software ? 64 : 512;
    const samples = quick ? 4 : SAMPLES;
    const runs = quick ? 2 : software ? 5 : 40;
    const clock = GpuClock.create(device);
    const figures: Figure[] = [];
    for (const [scene, make] of Object.entries(SCENES)) {
      const tracers = {} as Record<Request, PathTracer>;
      for (const name of names)
        tracers[name] = await PathTracer.create(device, make(), {
          width: size,
          height: size,
          maxDepth: 5,
          camera: 0,
          aovs: REQUESTS[name],
        });
      const render = async (tracer: PathTracer) => {
        tracer.reset();
        for await (const progress of tracer.render({ samples, maxSubmitMs: 1000 })) void progress;
        await device.queue.onSubmittedWorkDone();
      };
      const time = async (tracer: PathTracer) => {
        if (clock) return (await clock.measure(() => render(tracer))).busy / samples;
        const start = performance.now();
        await render(tracer);
        return (performance.now() - start) / samples;
      };
      // The scheduler learns how large its batches may be.
      for (const name of names) for (let i = 0; i < 3; i++) await render(tracers[name]);
      const times = { none: [], guides: [], all: [], again: [] } as Record<Request | 'again', number[]>;
      for (let i = 0; i < runs; i++) {
        for (const name of names) times[name].push(await time(tracers[name]));
        // Its difference to the first is the measurement's own error.
        times.again.push(await time(tracers.none));
      }
      const base = median(times.none);
      figures.push(timed(`${scene}: without AOVs`, 'ms', times.none));
      for (const name of ['again', 'guides', 'all'] as const) {
        const label = { again: 'without AOVs, again', guides: 'albedo and normal', all: 'all AOVs' }[name];
        // Each run against its neighbours in time: clocks drift.
        const more = times[name].map((ms, i) => 100 * (ms / (times.none[i] as number) - 1));
        const target = { value: ALLOWED, relation: '<=', source: 'asked for' } as const;
        figures.push(
          timed(`${scene}: ${label}, more time`, '%', more, software || quick || name === 'again' ? undefined : target),
        );
        log(`${scene}: ${label}: ${((100 * median(times[name])) / base - 100).toFixed(2)} % more`);
      }
      for (const name of names) tracers[name].destroy();
    }
    clock?.destroy();
    device.destroy();
    return {
      settings: { width: size, height: size, maxDepth: 5, samples, runs, clock: clock ? 'GPU timestamps' : 'wall' },
      gpu: { name: adapterName, software },
      figures,
      notes: ['Later samples than the first 64 record nothing.'],
    };
  },
};
