import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { createScene, type Mesh, type Scene } from '@glanz/scene';
import { timed, type Benchmark, type Figure } from '../benchmark';

const COUNTS = [1_000, 10_000, 100_000];
/** Every so many instances one glows. */
const GLOW_EVERY = 2_500;

/** A surface of revolution around y: `profile` holds radius and height alternately. */
function lathe(name: string, profile: readonly (readonly [radius: number, height: number])[], segments: number): Mesh {
  const positions = new Float32Array(profile.length * (segments + 1) * 3);
  const indices: number[] = [];
  profile.forEach(([radius, height], row) => {
    for (let column = 0; column <= segments; column++) {
      const angle = (2 * Math.PI * column) / segments;
      positions.set([radius * Math.cos(angle), height, radius * Math.sin(angle)], 3 * (row * (segments + 1) + column));
      if (row === 0 || column === segments) continue;
      const a = (row - 1) * (segments + 1) + column,
        b = a + segments + 1;
      indices.push(a, b, a + 1, a + 1, b, b + 1);
    }
  });
  return { name, positions, indices: Uint32Array.from(indices) };
}

const half = (steps: number, radius: (angle: number) => number) =>
  Array.from(
    { length: steps + 1 },
    (_, i) =>
      [radius((Math.PI * i) / steps) * Math.sin((Math.PI * i) / steps), -Math.cos((Math.PI * i) / steps)] as const,
  );

/** Four meshes of 12 to 3,072 triangles, turned at random on the places of a cubic grid. */
function manyInstances(count: number, seed: number): Scene {
  let state = seed >>> 0;
  const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  const scene = createScene('instances');
  scene.meshes.push(
    lathe(
      'block',
      [
        [0, -0.6],
        [0.8, -0.6],
        [0.8, 0.6],
        [0, 0.6],
      ],
      4,
    ),
    lathe(
      'ball',
      half(24, () => 0.9),
      48,
    ),
    lathe(
      'bolt',
      [
        [0, -1],
        [0.3, -1],
        [0.3, 0.4],
        [0.6, 0.4],
        [0.6, 0.8],
        [0, 0.8],
      ],
      24,
    ),
    lathe(
      'vase',
      half(32, (angle) => 0.5 + 0.3 * Math.sin(3 * angle)),
      48,
    ),
  );
  for (let i = 0; i < 16; i++)
    scene.materials.push({
      name: `paint ${i}`,
      parameters: { base_color: [random(), random(), random()], specular_roughness: 0.2 + 0.6 * random() },
    });
  scene.materials.push({ name: 'glow', parameters: { emission_luminance: 20 } });
  const side = Math.ceil(Math.cbrt(count));
  for (let i = 0; i < count; i++) {
    const angle = 2 * Math.PI * random();
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    scene.instances.push({
      name: `part ${i}`,
      mesh: i % 4,
      material: i % GLOW_EVERY === 0 ? 16 : i % 16,
      transform: [
        c,
        0,
        -s,
        0,
        0,
        1,
        0,
        0,
        s,
        0,
        c,
        0,
        2.5 * (i % side),
        2.5 * (Math.floor(i / side) % side),
        2.5 * Math.floor(i / side ** 2),
        1,
      ],
    });
  }
  scene.environment = { type: 'constant', radiance: [0.5, 0.5, 0.5] };
  return scene;
}

type Edit = (tracer: PathTracer, turn: number, part: number) => Promise<void>;

/** Each changes one thing; `part` is an instance that does not glow. */
const EDITS: Readonly<Record<string, Edit>> = {
  'setCamera()': (tracer, turn) => tracer.setCamera({ ...tracer.camera, name: `view ${turn}` }),
  'setVisibility() of one': (tracer, turn, part) => tracer.setVisibility(part, turn % 2 === 1),
  'setVisibility() of one by name': (tracer, turn, part) => tracer.setVisibility(`part ${part}`, turn % 2 === 1),
  'setInstanceTransform() of one, a small move': (tracer, turn, part) =>
    tracer.setInstanceTransform(
      part,
      Array.from(tracer.scene.instances[part]!.transform, (value, k) =>
        k === 13 ? value + (turn % 2 === 0 ? 0.1 : -0.1) : value,
      ),
    ),
  'setInstanceTransform() of one, across the scene': (tracer, turn, part) =>
    tracer.setInstanceTransform(
      part,
      Array.from(tracer.scene.instances[part]!.transform, (value, k) =>
        k === 12 ? value + (turn % 2 === 0 ? 20 : -20) : value,
      ),
    ),
  'setInstanceMaterial() of one': (tracer, turn, part) => tracer.setInstanceMaterial(part, turn % 2 === 0 ? 3 : 4),
  'setMaterial()': (tracer, turn) => tracer.setMaterial('paint 5', { specular_roughness: turn % 2 === 0 ? 0.3 : 0.5 }),
  'setInstanceTransform() of one that glows': (tracer, turn) =>
    tracer.setInstanceTransform(
      0,
      Array.from(tracer.scene.instances[0]!.transform, (value, k) =>
        k === 13 ? value + (turn % 2 === 0 ? 0.1 : -0.1) : value,
      ),
    ),
};

/** What many instances cost the processor: preparing them, and each change of one. */
export const benchmark: Benchmark = {
  description:
    'scenes of 1,000, 10,000 and 100,000 instances of four meshes: milliseconds of create(), of a camera move, and of edits of one instance',
  options: {
    counts: { type: 'string', help: 'numbers of instances, separated by commas; 1000,10000,100000 by default' },
  },
  async run({ log, quick, gpu: requested, seed = 1, values }) {
    const { gpu, adapterName, software } = await createGpu(requested ? { gpu: requested } : {});
    const counts = values['counts']?.split(',').map(Number) ?? (quick ? COUNTS.slice(0, 2) : COUNTS);
    const runs = quick ? 3 : 25;
    const device = await requestDevice({ gpu });
    const figures: Figure[] = [];
    const idle = () => device.queue.onSubmittedWorkDone();
    try {
      for (const count of counts) {
        const scene = manyInstances(count, seed);
        const of = `${count.toLocaleString('en')} instances`;
        const target = (value: number) =>
          count === 100_000 ? ({ value, relation: '<=', source: 'an edit costs what it touches' } as const) : undefined;
        const opening =
          count === 100_000
            ? ({ value: 3000, relation: '<=', source: 'a scene of 100,000 instances opens in seconds' } as const)
            : undefined;
        const times: number[] = [];
        const busy: number[] = [];
        let tracer: PathTracer | undefined;
        // The first one compiles the kernels, which the device keeps.
        for (let run = -1; run < (quick ? 1 : 3); run++) {
          tracer?.destroy();
          const from = performance.now(),
            used = process.cpuUsage();
          tracer = await PathTracer.create(device, scene, { width: 64, height: 64 });
          if (run < 0) continue;
          times.push(performance.now() - from);
          const { user, system } = process.cpuUsage(used);
          busy.push((user + system) / 1000);
        }
        if (!tracer) break;
        figures.push(timed(`${of}: create()`, 'ms', times, opening));
        // Of all threads, those of a software GPU among them.
        figures.push(timed(`${of}: processor time of create()`, 'ms', busy, opening));
        const { checkMs, bvhMs, uploadMs, lightMs } = tracer.statistics;
        log(
          `${of}: create() ${times.map((ms) => ms.toFixed(0)).join(', ')} ms; the last: check ${checkMs.toFixed(0)}, hierarchies ${bvhMs.toFixed(0)}, upload ${uploadMs.toFixed(0)}, of which lights ${lightMs.toFixed(0)}`,
        );
        const part = Math.floor(count / 2) + 1;
        for (const [name, edit] of Object.entries(EDITS)) {
          const edits: number[] = [];
          for (let turn = -4; turn < runs; turn++) {
            await idle();
            const from = performance.now();
            await edit(tracer, turn + 4, part);
            if (turn >= 0) edits.push(performance.now() - from);
          }
          figures.push(timed(`${of}: ${name}`, 'ms', edits, name.endsWith('glows') ? undefined : target(1)));
          log(`${of}: ${name} ${figures.at(-1)?.median?.toFixed(3)} ms`);
        }
        tracer.destroy();
        await idle();
      }
    } finally {
      device.destroy();
    }
    return {
      settings: { counts, runs, seed, meshes: 4, materials: 17, width: 64, height: 64 },
      figures,
      gpu: { name: adapterName, software },
    };
  },
};
