import { buildBlas, packTriangles } from '@glanz/bvh';
import { createPushButton } from '@glanz/models';
import { estimated, timed, wallTimes, type Benchmark, type Figure } from '../benchmark';
import { merged, PUSH_BUTTONS } from '../bvh/meshes';
import { writeBvhPage } from '../bvh/page';
import { buildThree } from '../bvh/three-mesh-bvh';
import { machine } from '../machine';

/**
 * The first table of strahl's paper (2025): setting up the hierarchy of a push-button of three resolutions. Theirs is
 * three-mesh-bvh's CENTER split; ours includes all up to buffers that can be uploaded.
 */
export const benchmark: Benchmark = {
  description: 'building hierarchies of the same models',
  options: { pages: { type: 'string', help: 'folder to write the page of the docs and its data into' } },
  async run({ log, quick, values }) {
    const runs = quick ? 3 : 30;
    const figures: Figure[] = [];
    for (const [level, name] of PUSH_BUTTONS) {
      if (quick && level === 'high') continue;
      const mesh = merged(name, createPushButton({ level }));
      const ours: number[] = [],
        center: number[] = [];
      for (let i = -2; i < runs; i++) {
        const [a] = await wallTimes(1, 0, () => packTriangles(buildBlas(mesh), mesh));
        const [b] = await wallTimes(1, 0, () => buildThree(mesh, 'CENTER'));
        if (i < 0) continue;
        ours.push(a!);
        center.push(b!);
      }
      figures.push(
        timed(`${name}: triangles`, '1', [mesh.indices.length / 3]),
        estimated(`${name}: balanced, to buffers for the GPU`, 'ms', ours),
        estimated(`${name}: three-mesh-bvh CENTER`, 'ms', center),
        estimated(
          `${name}: CENTER over balanced`,
          '1',
          center.map((t, i) => t / ours[i]!),
        ),
      );
      log(`${name}: ${Math.min(...ours).toFixed(1)} ms, CENTER ${Math.min(...center).toFixed(1)} ms`);
    }
    if (values['pages'] !== undefined)
      for (const file of writeBvhPage(
        'paper-cpu',
        { benchmark: 'paper-cpu', machine: machine(), quick, figures },
        values['pages'],
      ))
        log(`wrote ${file}`);
    return { settings: { runs, model: 'push-button, all parts in one mesh' }, figures };
  },
};
