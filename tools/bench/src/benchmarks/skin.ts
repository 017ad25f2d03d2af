import { buildBlas, type Blas } from '@glanz/bvh';
import { refitBlas } from '@glanz/bvh/refit';
import { PathTracer, requestDevice, type HierarchyBuilder } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { frameCamera, type Mesh } from '@glanz/scene';
import { poseMesh } from '@glanz/scene/pose';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { GpuClock } from '../gpu-clock';
import { numberOption } from '../options';
import { JOINTS, makeCharacter, type Character } from '../skin/character';

/** Poses that do not count: they build the hierarchy, compile kernels and make what poses on the GPU. */
const WARM_UP = 4;
const TARGET = { value: 8, relation: '<=', source: 'a skinned character of 100,000 triangles' } as const;

/** Milliseconds of one pose. */
interface PoseTimes {
  /** Vertices on this thread. */
  readonly skin: number;
  /** Of the edit, within a builder on this thread. */
  readonly refit: number;
  /** From the mesh until the edit is made; without `refit`. */
  readonly edit: number;
  /** From then until a sample is in the film. */
  readonly sample: number;
}

/** Fits the last hierarchy to the mesh, and counts the time. */
class RefittingBuilder implements HierarchyBuilder {
  ms = 0;
  #last: Blas | undefined;

  buildBlas(mesh: Pick<Mesh, 'positions' | 'indices'>): Promise<Blas> {
    const from = performance.now();
    // The floor is small and never replaced.
    const last = mesh.indices.length > 6 ? this.#last : undefined;
    const blas = last ? { ...last, nodes: last.nodes.slice(), bounds: structuredClone(last.bounds) } : buildBlas(mesh);
    if (last) refitBlas(blas, mesh);
    if (mesh.indices.length > 6) this.#last = blas;
    this.ms += performance.now() - from;
    return Promise.resolve(blas);
  }
}

/** What one pose of a skinned character costs until it is in the image. */
export const benchmark: Benchmark = {
  description:
    'a skinned character, posed on the CPU and on the GPU: milliseconds from the pose to the next sample, by vertices, refit, upload and sample',
  options: {
    triangles: { type: 'string', help: 'triangles of the character; default 100000, with --quick 10000' },
    targets: { type: 'string', help: 'morph targets of the second character; default 8' },
    size: { type: 'string', help: 'pixels of a side of the film; default 512, with --quick 64' },
    poses: { type: 'string', help: 'poses that are timed; default 30, with --quick 5' },
  },
  async run({ log, quick, gpu: requested, values }) {
    const triangles = numberOption(values, 'triangles', quick ? 10_000 : 100_000);
    const targets = numberOption(values, 'targets', 8);
    const size = numberOption(values, 'size', quick ? 64 : 512);
    const poses = numberOption(values, 'poses', quick ? 5 : 30);
    const { gpu, adapterName, software } = await createGpu(requested ? { gpu: requested } : {});
    const figures: Figure[] = [];
    const notes: string[] = [];
    for (const [what, character] of [
      ['skin', makeCharacter(triangles, 0)],
      [`skin and ${targets} morph targets`, makeCharacter(triangles, targets)],
    ] as const)
      for (const place of ['CPU', 'GPU'] as const) {
        const device = await requestDevice({ gpu });
        try {
          const { times, busy } = await timePoses(device, character, place, { size, poses });
          const name = `${what}, on the ${place}`;
          const target = place === 'GPU' && !quick && !software && triangles === 100_000 ? TARGET : undefined;
          const list = (of: (one: PoseTimes) => number) => times.map(of);
          figures.push(
            timed(
              `${name}: pose to sample`,
              'ms',
              list((t) => t.skin + t.refit + t.edit + t.sample),
              target,
            ),
            timed(
              `${name}: vertices on this thread`,
              'ms',
              list(({ skin }) => skin),
            ),
            timed(
              `${name}: refit on this thread`,
              'ms',
              list(({ refit }) => refit),
            ),
            timed(
              `${name}: the rest of the edit`,
              'ms',
              list(({ edit }) => edit),
            ),
            timed(
              `${name}: sample`,
              'ms',
              list(({ sample }) => sample),
            ),
          );
          if (busy.length > 0) figures.push(timed(`${name}: time of the GPU`, 'ms', busy));
          log(
            `${name}: ${figures.findLast((figure) => figure.name === `${name}: pose to sample`)?.median?.toFixed(2)} ms`,
          );
        } finally {
          device.destroy();
        }
      }
    if (software) notes.push('The GPU is software: its work takes this processor.');
    return {
      settings: { triangles, joints: JOINTS, influences: 4, targets, width: size, height: size, poses, maxDepth: 8 },
      figures,
      gpu: { name: adapterName, software },
      notes,
    };
  },
};

async function timePoses(
  device: GPUDevice,
  { rig, scene, pose }: Character,
  place: 'CPU' | 'GPU',
  { size, poses }: { readonly size: number; readonly poses: number },
): Promise<{ readonly times: PoseTimes[]; readonly busy: number[] }> {
  const builder = new RefittingBuilder();
  const tracer = await PathTracer.create(device, scene, {
    width: size,
    height: size,
    maxDepth: 8,
    camera: frameCamera(scene, { aspect: 1 }),
    ...(place === 'CPU' ? { hierarchies: builder, bvhBuilder: 'cpu' } : { bvhBuilder: 'gpu' }),
  });
  const clock = GpuClock.create(device);
  const times: PoseTimes[] = [];
  const busy: number[] = [];
  const one = async (frame: number): Promise<PoseTimes> => {
    builder.ms = 0;
    const begin = performance.now();
    const posed = poseMesh(rig, pose(frame));
    // A copy has the vertices that the CPU computes.
    const mesh = place === 'CPU' ? { ...posed } : posed;
    const made = performance.now();
    await tracer.replaceMesh('character', mesh);
    const edited = performance.now();
    for await (const _ of tracer.render({ samples: 1 }));
    await device.queue.onSubmittedWorkDone();
    const { ms: refit } = builder;
    return { skin: made - begin, refit, edit: edited - made - refit, sample: performance.now() - edited };
  };
  for (let frame = 0; frame < WARM_UP + poses; frame++) {
    await device.queue.onSubmittedWorkDone();
    const time = await one(frame);
    if (frame >= WARM_UP) times.push(time);
  }
  // Apart from the wall times, since the clock adds work to every submission.
  for (let frame = 0; clock && frame < Math.min(5, poses); frame++)
    busy.push((await clock.measure(async () => void (await one(WARM_UP + poses + frame)))).busy);
  clock?.destroy();
  tracer.destroy();
  await device.queue.onSubmittedWorkDone();
  return { times, busy };
}
