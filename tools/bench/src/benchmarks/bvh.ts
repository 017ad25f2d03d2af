import { buildBlas, type BlasOptions } from '@glanz/bvh';
import { best, bestSplit } from '@glanz/bvh/best';
import { fast } from '@glanz/bvh/fast';
import { sahCost } from '@glanz/bvh/statistics';
import { timed, wallTimes, type Benchmark, type Figure } from '../benchmark';
import { benchMeshes, partsOf, type BenchMesh } from '../bvh/meshes';
import { overTinybvh, spreadOf, writeBvhPage, type BvhDetails, type MeshRow } from '../bvh/page';
import { TINYBVH } from '../bvh/tinybvh';
import { geometricMean } from '../geometric-mean';
import { machine } from '../machine';
import { diffuseRays, primaryRays, shadowRays } from '../bvh/ray-sets';
import { coldTimes, servesBenchmark, slicedTimes, workerTimes } from '../bvh/threads';
import { buildThree, threeCost } from '../bvh/three-mesh-bvh';
import { plainBlas, plainThree, traversalCost, type PlainTree } from '../bvh/traversal-cost';

const min = (values: readonly number[]) => Math.min(...values);

/** Meshes of parts, as CAD programs write them. */
const CAD_LIKE = /push-button|CAD/;

const OURS: readonly (readonly [name: string, options: BlasOptions])[] = [
  ['balanced', {}],
  ['fast', { builder: fast }],
  ['best', { builder: best }],
  ['best-split', { builder: bestSplit }],
];

interface Tree {
  readonly name: string;
  readonly build: () => unknown;
  readonly sah: () => number;
  readonly plain: () => PlainTree;
}

function treesOf(mesh: BenchMesh): Tree[] {
  const three = (name: string, strategy: 'SAH' | 'CENTER', leafSize?: number): Tree => {
    const build = () => buildThree(mesh, strategy, leafSize);
    return { name, build, sah: () => threeCost(build()), plain: () => plainThree(build()) };
  };
  return [
    ...OURS.map(([name, options]): Tree => {
      const build = () => buildBlas(mesh, options);
      return { name, build, sah: () => sahCost(build()), plain: () => plainBlas(build(), mesh) };
    }),
    three('three-mesh-bvh SAH', 'SAH', 4),
    three('three-mesh-bvh CENTER', 'CENTER'),
    // Its default, which links this run to others.
    ...(TINYBVH.some(({ here }) => here === mesh.name) ? [three('three-mesh-bvh SAH, leaves of 10', 'SAH')] : []),
  ];
}

/** Our builders beside three-mesh-bvh's, on the same meshes in the same process, with one evaluator for all trees. */
export const benchmark: Benchmark = {
  description: 'building hierarchies, and what rays look at in them, beside three-mesh-bvh',
  options: {
    pages: { type: 'string', help: 'folder to write the page of the docs and its data into' },
    brief: {
      type: 'string',
      help: '"yes": only balanced beside three-mesh-bvh, on all meshes, and the threads; nothing of rays. For a machine that is lent for minutes',
    },
    threads: { type: 'string', help: '"yes": only the threads, with the largest mesh' },
    'two-cores': { type: 'string', help: '"yes": put it on that page as the run on a machine of two cores' },
  },
  async run({ log, quick, values }) {
    const figures: Figure[] = [],
      notes: string[] = [];
    if (servesBenchmark()) return { settings: {}, figures };
    const meshes = await benchMeshes(quick, (line) => notes.push(line));
    const runs = quick ? 2 : 5;
    const brief = values['brief'] === 'yes';
    const rows: MeshRow[] = [];
    const ratios = {
      sah: [] as number[],
      center: [] as number[],
      cost: [] as number[],
      fast: [] as number[],
      best: [] as number[],
    };
    const figure = (name: string, unit: string, values: readonly number[], target?: Figure['target']) =>
      figures.push(timed(name, unit, values, quick ? undefined : target));
    const onlyThreads = values['threads'] === 'yes';
    for (const mesh of onlyThreads ? [] : meshes) {
      const trees = treesOf(mesh).filter(
        ({ name }) => !brief || name === 'balanced' || /^three-mesh-bvh (SAH|CENTER)$/.test(name),
      );
      const times = new Map(trees.map(({ name }) => [name, [] as number[]]));
      // Taken in turns, so that a disturbance of the machine meets all alike; `best` is slow and comes less often.
      for (let i = -1; i < runs; i++) {
        for (const { name, build } of trees) {
          if (name.startsWith('best') && i > 0 && mesh.indices.length > 1e6) continue;
          const [time] = await wallTimes(1, 0, build);
          if (i >= 0) times.get(name)!.push(time!);
        }
      }
      const time = (name: string) => min(times.get(name)!);
      const costs = new Map(trees.map(({ name, sah }) => [name, sah()]));
      figure(`${mesh.name}: triangles`, '1', [mesh.indices.length / 3]);
      for (const { name } of trees) {
        figure(`${mesh.name}: ${name}`, 'ms', times.get(name)!);
        figure(`${mesh.name}: ${name}, SAH cost`, '1', [costs.get(name)!]);
      }
      for (const name of ['three-mesh-bvh SAH', 'three-mesh-bvh CENTER'])
        figure(
          `${mesh.name}: ${name} over balanced`,
          '1',
          times.get(name)!.map((t, i) => t / times.get('balanced')![i]!),
        );
      ratios.sah.push(time('three-mesh-bvh SAH') / time('balanced'));
      ratios.center.push(time('three-mesh-bvh CENTER') / time('balanced'));
      ratios.cost.push(costs.get('balanced')! / costs.get('three-mesh-bvh SAH')!);
      log(
        `${mesh.name}: ${time('balanced').toFixed(1)} ms, SAH ${ratios.sah.at(-1)!.toFixed(2)}×, CENTER ${ratios.center.at(-1)!.toFixed(2)}×, cost ${ratios.cost.at(-1)!.toFixed(3)} of SAH's`,
      );
      const row = {
        name: mesh.name,
        triangles: mesh.indices.length / 3,
        times: Object.fromEntries([...times].map(([name, list]) => [name, spreadOf(list)])),
        costs: Object.fromEntries(costs),
      };
      if (brief) {
        rows.push({ ...row, diffuse: {} });
        continue;
      }
      ratios.fast.push(time('balanced') / time('fast'));

      // What rays look at: counted, not timed, with the same rays for all trees.
      const size = quick ? 32 : 128;
      let sets: (readonly [string, Float32Array, boolean])[] = [];
      const diffuse = new Map<string, number>();
      for (const { name, plain } of trees) {
        const tree = plain();
        if (sets.length === 0) {
          const { bounds } = buildBlas(mesh);
          const primary = primaryRays(bounds, size);
          const { triangleIndices } = buildBlas(mesh);
          const { hits } = traversalCost(tree, mesh, primary, false);
          const results = new Uint32Array(hits.length),
            t = new Float32Array(results.buffer);
          for (let i = 0; i < hits.length; i += 2) {
            t[i] = hits[i]!;
            results[i + 1] = hits[i + 1]! < 0 ? 0xffffffff : triangleIndices[hits[i + 1]!]!;
          }
          sets = [
            ['primary', primary, false],
            ['shadow', shadowRays(bounds, primary, results, mesh), true],
            ['diffuse', diffuseRays(bounds, primary, results, mesh, 3), false],
          ];
        }
        for (const [kind, rays, any] of sets) {
          const { nodes, triangles } = traversalCost(tree, mesh, rays, any);
          figure(`${mesh.name}: ${name}, nodes per ${kind} ray`, '1', [nodes]);
          figure(`${mesh.name}: ${name}, triangles per ${kind} ray`, '1', [triangles]);
          if (kind === 'diffuse') diffuse.set(name, nodes + triangles);
        }
      }
      rows.push({ ...row, diffuse: Object.fromEntries(diffuse) });
      const gain = diffuse.get('best')! / diffuse.get('balanced')!;
      const cad = CAD_LIKE.test(mesh.name);
      if (cad) ratios.best.push(gain);
      figure(
        `${mesh.name}: best over balanced, nodes and triangles per diffuse ray`,
        '1',
        [gain],
        cad ? { value: 0.85, relation: '<=', source: 'a sixth less in models of parts' } : undefined,
      );
      log(
        `${mesh.name}: fast ${time('fast').toFixed(1)} ms, best ${time('best').toFixed(0)} ms; per diffuse ray ${[...diffuse].map(([name, x]) => `${name} ${x.toFixed(1)}`).join(', ')}`,
      );
    }
    if (!onlyThreads) {
      figure('all: three-mesh-bvh SAH over balanced, geometric mean of minima', '1', [geometricMean(ratios.sah)], {
        value: 4,
        relation: '>=',
        source: 'four times as fast',
      });
      figure('all: three-mesh-bvh SAH over balanced, least', '1', [min(ratios.sah)], {
        value: 3,
        relation: '>=',
        source: 'three times as fast on any mesh',
      });
      figure(
        'all: three-mesh-bvh CENTER over balanced, geometric mean of minima',
        '1',
        [geometricMean(ratios.center)],
        { value: 1, relation: '>=', source: 'no slower than CENTER' },
      );
      figure("all: SAH cost over three-mesh-bvh SAH's, geometric mean", '1', [geometricMean(ratios.cost)], {
        value: 1,
        relation: '<=',
        source: 'trees as good',
      });
      if (!brief)
        figure('all: balanced over fast, geometric mean of minima', '1', [geometricMean(ratios.fast)], {
          value: 2,
          relation: '>=',
          source: 'twice as fast',
        });
      if (!brief)
        figure(
          'CAD-like: best over balanced, nodes and triangles per diffuse ray, geometric mean',
          '1',
          [geometricMean(ratios.best)],
          { value: 0.85, relation: '<=', source: 'a sixth less' },
        );
    }

    const large = meshes.reduce((a, b) => (b.indices.length > a.indices.length ? b : a));
    log(`threads, with ${large.name}`);
    const [cold, ...warm] = await coldTimes(large);
    figure(`${large.name}: first build in a fresh thread`, 'ms', [cold!]);
    figure(`${large.name}: further builds in that thread`, 'ms', warm);
    figure(
      `${large.name}: first build over the median of further ones`,
      '1',
      [cold! / [...warm].sort((a, b) => a - b)[warm.length >> 1]!],
      { value: 2, relation: '<=', source: 'cold within twice of warm' },
    );
    const four = [large, large, large, large];
    const [one, two] = await workerTimes(four, runs);
    figure(`four times ${large.name}: one worker`, 'ms', one);
    figure(`four times ${large.name}: two workers`, 'ms', two);
    figure(`four times ${large.name}: one worker over two, minima`, '1', [min(one) / min(two)], {
      value: 1.6,
      relation: '>=',
      source: 'two workers',
    });
    const parts = partsOf(quick ? 'low' : 'high');
    const [oneOfParts, twoOfParts] = await workerTimes(parts.meshes, 3 * runs);
    figure(`${parts.name}: one worker`, 'ms', oneOfParts);
    figure(`${parts.name}: two workers`, 'ms', twoOfParts);
    figure(`${parts.name}: one worker over two, minima`, '1', [min(oneOfParts) / min(twoOfParts)], {
      value: 1.6,
      relation: '>=',
      source: 'two workers',
    });
    const [alone, together] = await workerTimes([large], 3 * runs);
    figure(`${large.name}: on one worker`, 'ms', alone);
    figure(`${large.name}: on two workers together`, 'ms', together);
    figure(`${large.name}: one worker over two together, minima`, '1', [min(alone) / min(together)], {
      value: 1.6,
      relation: '>=',
      source: 'two workers',
    });
    const sliced = await slicedTimes(large, runs);
    figure(`${large.name}: in slices on the main thread`, 'ms', sliced.all);
    figure(`${large.name}: longest slice`, 'ms', sliced.longest, { value: 16, relation: '<=', source: 'one frame' });
    const tiny = brief || onlyThreads ? [] : overTinybvh(rows).flatMap(({ byCenter, bySah }) => [byCenter, bySah]);
    if (tiny.length > 0)
      figure(
        "all: balanced over tinybvh's AVX2 build, linked by three-mesh-bvh, geometric mean",
        '1',
        [geometricMean(tiny)],
        { value: 2, relation: '<=', source: 'twice as long as C++' },
      );
    const details: BvhDetails = {
      runs,
      rows,
      threads: {
        mesh: large.name,
        cold: cold!,
        warm: spreadOf(warm),
        one: spreadOf(one),
        two: spreadOf(two),
        parts: { name: parts.name, one: spreadOf(oneOfParts), two: spreadOf(twoOfParts) },
        alone: spreadOf(alone),
        together: spreadOf(together),
        sliced: spreadOf(sliced.all),
        longest: spreadOf(sliced.longest),
      },
    };
    if (values['pages'] !== undefined)
      for (const file of writeBvhPage(
        onlyThreads ? 'bvh-threads' : brief ? 'bvh-brief' : values['two-cores'] === undefined ? 'bvh' : 'bvh-two-cores',
        { benchmark: 'bvh', machine: machine(), quick, figures, details },
        values['pages'],
      ))
        log(`wrote ${file}`);
    return {
      details,
      settings: { runs, meshes: meshes.map(({ name }) => name), leaves: 'at most 4 triangles' },
      figures,
      notes,
    };
  },
};
