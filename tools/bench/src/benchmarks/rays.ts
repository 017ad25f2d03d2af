import { buildBlas, type BlasOptions } from '@glanz/bvh';
import { best } from '@glanz/bvh/best';
import { fast } from '@glanz/bvh/fast';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { createPushButton } from '@glanz/models';
import { BenchError } from '../error';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { GpuRays, type Layout, type LoadedRays } from '../bvh/gpu-rays';
import { assembly, merged, noisySphere, PUSH_BUTTONS, type BenchMesh } from '../bvh/meshes';
import { AFAR, diffuseRays, inRoom, pointShadowRays, primaryRays, shadowRays } from '../bvh/ray-sets';

/**
 * What a prototype with a tree over triangles alone reached on an H200 with rays of its own. Only its diffuse rays are
 * known well enough to hold ours against: where its camera and its light stood decides what the others cost (from near
 * and from afar ours differ by a factor).
 */
const PROTOTYPE: Readonly<Record<string, Readonly<Record<'BVH2' | 'wide', number>>>> = {
  'noisy sphere 1.07M': { BVH2: 1925, wide: 1391 },
  'assembly 1.07M': { BVH2: 1062, wide: 746 },
  'assembly 110k': { BVH2: 1925, wide: 1369 },
};

const KINDS = [
  ['primary', 'closest'],
  ['shadow of a square', 'any'],
  ['shadow of a point', 'any'],
  ['diffuse', 'closest'],
  ['diffuse 2', 'closest'],
  ['primary from afar', 'closest'],
  ['shadow from afar', 'any'],
] as const;

const BALANCED = 'BVH2 balanced';
const PLAIN = 'plain loop, same tree';
const WIDE = 'wide balanced';

const VARIANTS: readonly (readonly [name: string, layout: Layout, options: BlasOptions])[] = [
  [BALANCED, 'BVH2', {}],
  [PLAIN, 'plain', {}],
  ['BVH2 best', 'BVH2', { builder: best }],
  ['BVH2 fast', 'BVH2', { builder: fast }],
  [WIDE, 'wide', {}],
  ['wide best', 'wide', { builder: best }],
];

function meshes(quick: boolean): BenchMesh[] {
  if (quick) return [noisySphere('noisy sphere 3k', 28), assembly('assembly 2k', 20, 24)];
  return [
    noisySphere('noisy sphere 1.07M', 518),
    assembly('assembly 1.07M', 5600, 48),
    assembly('assembly 110k', 1150, 24),
    ...PUSH_BUTTONS.map(([level, name]) => merged(name, createPushButton({ level }))),
  ];
}

/** Rays a second on the GPU: one ray a thread, workgroups of 64, through both levels, written to memory. */
export const benchmark: Benchmark = {
  description: 'rays a second on the GPU: primary, shadow and diffuse, by layout, builder and mesh',
  options: {
    size: {
      type: 'string',
      help: 'edge of the square image whose pixels send rays, a multiple of 8; default 1024. More rays hide better that a launch ends with its slowest ones',
    },
    brief: {
      type: 'string',
      help: '"yes": only balanced, both layouts, beside the plain loop, on the meshes of the prototype',
    },
  },
  async run({ log, quick, gpu, values }) {
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const device = await requestDevice({ gpu: api });
    const small = quick || software;
    const size = values['size'] === undefined ? (small ? 64 : 1024) : Number(values['size']);
    if (!(Number.isInteger(size) && size >= 8 && size % 8 === 0))
      throw new BenchError('bench/option', `--size ${values['size']}: it must be a multiple of 8.`);
    const brief = values['brief'] === 'yes';
    const runs = small ? 2 : 7;
    const figures: Figure[] = [],
      notes: string[] = [];
    if (!device.features.has('timestamp-query')) notes.push('no timestamp queries: wall times');
    for (const alone of meshes(small).filter(({ name }) => !brief || small || PROTOTYPE[name] !== undefined)) {
      const { mesh, bounds } = inRoom(alone);
      const { name } = mesh;
      log(`${name}: ${mesh.indices.length / 3} triangles`);
      // The rays are those that the first variant's hits give, for all variants.
      let sets: Float32Array<ArrayBuffer>[] | undefined;
      const expected: Uint32Array[] = [];
      const balanced: number[][] = [];
      for (const [variant, layout, options] of VARIANTS.filter(
        ([name]) => !brief || [BALANCED, PLAIN, WIDE].includes(name),
      )) {
        const blas = buildBlas(mesh, options);
        const tracer = await GpuRays.create(device, layout, blas, mesh);
        if (!sets) {
          const trace = (rays: Float32Array<ArrayBuffer>) => tracer.results(tracer.load(rays), 'closest');
          const primary = primaryRays(bounds, size);
          const hits = await trace(primary);
          const diffuse = diffuseRays(bounds, primary, hits, mesh, 3);
          const afar = primaryRays(bounds, size, AFAR);
          sets = [
            primary,
            shadowRays(bounds, primary, hits, mesh),
            pointShadowRays(bounds, primary, hits, mesh),
            diffuse,
            diffuseRays(bounds, diffuse, await trace(diffuse), mesh, 4),
            afar,
            pointShadowRays(bounds, afar, await trace(afar), mesh),
          ];
        }
        figures.push(timed(`${name}, ${variant}: nodes`, 'MB', [tracer.nodeBytes / 1e6]));
        const rates: string[] = [];
        for (const [k, [kind, query]] of KINDS.entries()) {
          const loaded: LoadedRays = tracer.load(sets[k]!);
          const results = await tracer.results(loaded, query);
          expected[k] ??= results;
          let other = 0;
          for (let i = 1; i < results.length; i += 2) if (results[i] !== expected[k]![i]) other++;
          // Neighbours share the rays through their common edge.
          if (layout === 'plain')
            figures.push(
              timed(`${name}, ${variant}: ${kind}, rays that hit something else`, '1', [other / loaded.count]),
            );
          else if (other > 1e-3 * loaded.count + 2)
            throw new Error(
              `${name}, ${variant}, ${kind}: ${other} of ${loaded.count} rays hit something else than with ${VARIANTS[0]![0]}`,
            );
          // As many runs at a time as make 20 ms, so that starting them does not count.
          const once = await tracer.time(loaded, query, 1);
          const times = Math.ceil((small ? 5 : 20) / Math.max(once, 0.1));
          // A GPU that has idled, while a hierarchy was built say, takes a while to come back to its clock.
          let last = Infinity;
          for (let spent = 0; spent < (small ? 0 : 3000);) {
            const milliseconds = await tracer.time(loaded, query, times);
            spent += milliseconds;
            if (spent > 300 && Math.abs(milliseconds - last) < 0.01 * last) break;
            last = milliseconds;
          }
          const rate: number[] = [];
          for (let i = 0; i < runs; i++)
            rate.push((loaded.count * times) / (await tracer.time(loaded, query, times)) / 1e3);
          const known =
            variant === BALANCED ? PROTOTYPE[name]?.BVH2 : variant === WIDE ? PROTOTYPE[name]?.wide : undefined;
          const target =
            !small && kind === 'diffuse' && known !== undefined
              ? { value: known, relation: '>=' as const, source: 'the prototype on an H200' }
              : undefined;
          figures.push(timed(`${name}, ${variant}: ${kind}`, 'Mrays/s', rate, target));
          if (variant === BALANCED) balanced.push(rate);
          if (layout === 'plain')
            figures.push(
              timed(
                `${name}, ${BALANCED} over the plain loop: ${kind}`,
                '1',
                balanced[k]!.map((ours, i) => ours / rate[i]!),
                small ? undefined : { value: 1, relation: '>=', source: 'precision is free' },
              ),
            );
          rates.push(`${kind} ${[...rate].sort((a, b) => a - b)[rate.length >> 1]!.toFixed(small ? 2 : 0)}`);
        }
        log(`  ${variant}, ${(tracer.nodeBytes / 1e6).toFixed(1)} MB: ${rates.join(', ')}`);
        tracer.destroy();
      }
    }
    device.destroy();
    return {
      settings: {
        size,
        runs,
        place: 'in a closed cubic room',
        rays: 'primary: one a pixel, the mesh fills the image; from afar: from a corner of the room with a lens of 60°, shadow rays to a point; shadow: to a square light above; diffuse: cosine, first and second bounce',
        levels: 2,
      },
      gpu: { name: adapterName, software },
      figures,
      notes,
    };
  },
};
