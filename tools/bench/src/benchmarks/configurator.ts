import { createPushButtonKit, PUSH_BUTTON_KIT } from '@glanz/models';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { studioEnvironment } from '@glanz/scene/studio';
import { timed, type Benchmark, type Figure } from '../benchmark';

const { lenses, mountings, blocks, materials } = PUSH_BUTTON_KIT;

type Change = (tracer: PathTracer, turn: number) => Promise<void>;

/** Shows one of several groups of parts and hides the one before it. */
async function show(tracer: PathTracer, groups: readonly (readonly string[])[], turn: number): Promise<void> {
  const visible = new Set(tracer.scene.instances.flatMap(({ name, visible: is }) => (is === false ? [] : [name])));
  const requested = groups[turn % groups.length] ?? [];
  const appear = requested.filter((name) => !visible.has(name));
  const vanish = groups.flat().filter((name) => visible.has(name) && !requested.includes(name));
  if (appear.length > 0) await tracer.setVisibility(appear, true);
  if (vanish.length > 0) await tracer.setVisibility(vanish, false);
}

/** What a customer of a configurator does, one click each. */
const CHANGES: Readonly<Record<string, Change>> = {
  'colour of the lens': (tracer, turn) =>
    tracer.setMaterial(materials.lens, { base_color: turn % 2 === 0 ? [0.46, 0.012, 0.012] : [0.012, 0.33, 0.08] }),
  'finish of the panel': (tracer, turn) =>
    tracer.setMaterial(materials.panel, {
      base_metalness: turn % 2,
      base_color: turn % 2 === 0 ? [0.86, 0.51, 0.004] : [0.56, 0.57, 0.59],
    }),
  'colour of the light': (tracer, turn) =>
    tracer.setMaterial(materials.halo, { emission_color: turn % 2 === 0 ? [1, 0.06, 0.04] : [0.12, 1, 0.32] }),
  'light on and off': (tracer, turn) =>
    tracer.setMaterial(materials.halo, { emission_luminance: turn % 2 === 0 ? 0 : 3.2 }),
  'another lens': (tracer, turn) =>
    show(
      tracer,
      Object.keys(lenses).map((name) => [`Lens ${name}`]),
      turn,
    ),
  'another mounting': (tracer, turn) => show(tracer, Object.values(mountings), turn),
  'a contact block': (tracer, turn) => show(tracer, [[], blocks['Contact block NC']], turn),
};

/** From a click to the first sample of the whole image with the change in it: the cost of a change. */
export const benchmark: Benchmark = {
  description:
    'the push-button configurator: milliseconds from a change to the first image that shows it, by kind of change',
  async run({ log, quick, gpu: requested }) {
    const { gpu, adapterName, software } = await createGpu(requested ? { gpu: requested } : {});
    const [width, height] = quick ? [160, 100] : [1280, 800];
    const level = quick ? 'low' : 'medium';
    const runs = quick ? 3 : 24;
    const device = await requestDevice({ gpu });
    const figures: Figure[] = [];
    try {
      const scene = { ...createPushButtonKit({ level }), environment: studioEnvironment() };
      const tracer = await PathTracer.create(device, scene, { width, height, maxDepth: 8, background: 'transparent' });
      const sample = async () => {
        for await (const _ of tracer.render({ samples: 1 }));
      };
      for (const change of Object.values(CHANGES)) await change(tracer, 1);
      // The first sample of all finds the size of batches.
      for (let i = 0; i < 3; i++) {
        tracer.reset();
        await sample();
      }
      for (const [name, change] of Object.entries(CHANGES)) {
        const [edits, images]: [number[], number[]] = [[], []];
        // The first two turns may compile what this kind of change calls for.
        for (let turn = -2; turn < runs; turn++) {
          const from = performance.now();
          await change(tracer, turn + 2);
          const edited = performance.now();
          await sample();
          if (turn < 0) continue;
          edits.push(edited - from);
          images.push(performance.now() - from);
        }
        figures.push(
          timed(`${name}: to the first sample`, 'ms', images),
          timed(`${name}: the edit alone`, 'ms', edits),
        );
        log(
          `${name}: ${figures.at(-2)?.median?.toFixed(1)} ms, of which the edit ${figures.at(-1)?.median?.toFixed(2)} ms`,
        );
      }
      tracer.destroy();
    } finally {
      device.destroy();
    }
    return { settings: { width, height, level, maxDepth: 8, runs }, figures, gpu: { name: adapterName, software } };
  },
};
