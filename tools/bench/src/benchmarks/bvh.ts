import { buildBlas } from '@glanz/bvh';
import { sahCost } from '@glanz/bvh/statistics';
import { timed, wallTimes, type Benchmark, type Figure } from '../benchmark';
import { benchMeshes } from '../bvh/meshes';
import { buildThree, threeCost } from '../bvh/three-mesh-bvh';

const geometricMean = (values: readonly number[]) => Math.exp(values.reduce((sum, value) => sum + Math.log(value), 0) / values.length);

/** Our builder beside three-mesh-bvh's, on the same meshes in the same process, with one formula for the cost of both. */
export const benchmark: Benchmark = {
  description: 'build and traversal against other libraries',
  async run({ log, quick }) {
    const notes: string[] = [];
    const meshes = await benchMeshes(quick, (line) => notes.push(line));
    const runs = quick ? 2 : 5;
    const figures: Figure[] = [];
    const ratios = { sah: [] as number[], center: [] as number[], cost: [] as number[] };
    for (const mesh of meshes) {
      const { name } = mesh;
      // The first call comes before the machine code is warm: an application feels it.
      const cold = await wallTimes(1, 0, () => buildBlas(mesh));
      // Taken in turns, so that a disturbance of the machine meets all alike.
      const times = { ours: [] as number[], sah: [] as number[], center: [] as number[] };
      for (let i = -1; i < runs; i++) {
        const [ours] = await wallTimes(1, 0, () => buildBlas(mesh));
        const [sah] = await wallTimes(1, 0, () => buildThree(mesh, 'SAH', 4));
        const [center] = await wallTimes(1, 0, () => buildThree(mesh, 'CENTER'));
        if (i < 0) continue;
        times.ours.push(ours!);
        times.sah.push(sah!);
        times.center.push(center!);
      }
      const cost = sahCost(buildBlas(mesh)), sahTreeCost = threeCost(buildThree(mesh, 'SAH', 4)), centerCost = threeCost(buildThree(mesh, 'CENTER'));
      const [ours, sah, center] = [times.ours, times.sah, times.center].map((list) => Math.min(...list)) as [number, number, number];
      ratios.sah.push(sah / ours);
      ratios.center.push(center / ours);
      ratios.cost.push(cost / sahTreeCost);
      const value = (what: string, x: number) => timed(`${name}: ${what}`, '1', [x]);
      figures.push(
        value('triangles', mesh.indices.length / 3),
        timed(`${name}: balanced, first call`, 'ms', cold),
        timed(`${name}: balanced`, 'ms', times.ours),
        timed(`${name}: three-mesh-bvh SAH, leaves of 4`, 'ms', times.sah),
        timed(`${name}: three-mesh-bvh CENTER`, 'ms', times.center),
        timed(`${name}: three-mesh-bvh SAH over balanced`, '1', times.sah.map((t, i) => t / times.ours[i]!)),
        timed(`${name}: three-mesh-bvh CENTER over balanced`, '1', times.center.map((t, i) => t / times.ours[i]!)),
        value('SAH cost, balanced', cost),
        value('SAH cost, three-mesh-bvh SAH', sahTreeCost),
        value('SAH cost, three-mesh-bvh CENTER', centerCost),
      );
      log(`${name}: ${ours.toFixed(1)} ms, SAH ${(sah / ours).toFixed(2)}×, CENTER ${(center / ours).toFixed(2)}×, cost ${(cost / sahTreeCost).toFixed(3)} of SAH's`);
    }
    const target = (value: number, relation: '<=' | '>=', source: string) => (quick ? undefined : { value, relation, source });
    figures.push(
      timed('all: three-mesh-bvh SAH over balanced, geometric mean of minima', '1', [geometricMean(ratios.sah)], target(4, '>=', 'four times as fast')),
      timed('all: three-mesh-bvh SAH over balanced, least', '1', [Math.min(...ratios.sah)], target(3, '>=', 'three times as fast on any mesh')),
      timed('all: three-mesh-bvh CENTER over balanced, geometric mean of minima', '1', [geometricMean(ratios.center)], target(1, '>=', 'no slower than CENTER')),
      timed("all: SAH cost over three-mesh-bvh SAH's, geometric mean", '1', [geometricMean(ratios.cost)], target(1, '<=', 'trees as good')),
    );
    return { settings: { runs, meshes: meshes.map(({ name }) => name), leaves: 'at most 4 triangles' }, figures, notes };
  },
};
