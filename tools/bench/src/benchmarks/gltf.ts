import { timed, type Benchmark, type Figure } from '../benchmark';
import { BenchError } from '../error';
import { packedBrowser } from '../browser/chromium';
import { geometricMean } from '../geometric-mean';
import { openPage } from '../loading/chromium';
import { CONTESTANTS, loadModels, type Contestant, type Load, type LoadModel } from '../loading/models';
import { profileLoads } from '../loading/profile';
import {
  PLACES,
  speedUp,
  writeLoadingPage,
  type LoadingDetails,
  type LoadingRow,
  type Place,
  type Spread,
} from '../loading/report';
import { machine } from '../machine';

/** The version of three.js in the workspace's catalog. */
const THREE = '0.185.0';

function spread(values: readonly number[]): Spread {
  const { min, median, max } = timed('', 'ms', values);
  return { min: min!, median: median!, max: max! };
}

/** Loads a model by all, in turns, so that a disturbance of the machine meets all alike. */
async function inTurns(
  model: LoadModel,
  contestants: readonly Contestant[],
  runs: number,
  load: (contestant: Contestant, file: string) => Promise<Load>,
): Promise<Partial<Record<Contestant, number[]>>> {
  const times: Partial<Record<Contestant, number[]>> = {};
  for (let i = -1; i < runs; i++) {
    const counts = new Set<number>();
    for (const contestant of contestants) {
      const { ms, triangles } = await load(contestant, model.file);
      counts.add(triangles);
      if (i >= 0) (times[contestant] ??= []).push(ms);
    }
    if (counts.size !== 1)
      throw new BenchError(
        'bench/different',
        `${model.name}: the loaders find different numbers of triangles: ${[...counts].join(', ')}.`,
      );
  }
  return times;
}

/** Our loaders beside three.js's GLTFLoader with its decoders, in Chromium and in Node. */
export const benchmark: Benchmark = {
  description: "glTF loading against three.js's GLTFLoader, in Chromium and Node",
  options: { pages: { type: 'string', help: 'folder to write the page of the docs and its data into' } },
  async run({ log, quick, values }) {
    const models = loadModels();
    const runs = quick ? 2 : 9;
    const figures: Figure[] = [],
      rows: LoadingRow[] = [];
    const note = (
      model: LoadModel,
      place: Place,
      times: Partial<Record<Contestant, number[]>>,
      blocks?: Partial<Record<Contestant, number[]>>,
    ) => {
      const spreads = (of: Partial<Record<Contestant, number[]>>) =>
        Object.fromEntries(Object.entries(of).map(([name, list]) => [name, spread(list)]));
      rows.push({ model: model.name, place, times: spreads(times), ...(blocks ? { blocks: spreads(blocks) } : {}) });
      for (const [name, list] of Object.entries(times))
        figures.push(timed(`${model.name}, ${PLACES[place]}: ${CONTESTANTS[name as Contestant]}`, 'ms', list));
      for (const [name, list] of Object.entries(blocks ?? {}))
        figures.push(
          timed(
            `${model.name}: longest task of the page while ${CONTESTANTS[name as Contestant]} loads`,
            'ms',
            list,
            name === 'worker' && !quick ? { value: 16, relation: '<=', source: 'one frame' } : undefined,
          ),
        );
      log(
        `${model.name}, ${place}: ${Object.entries(times)
          .map(([name, list]) => `${CONTESTANTS[name as Contestant]} ${spread(list).median.toFixed(1)} ms`)
          .join(', ')}`,
      );
    };
    const page = await openPage();
    const all = Object.keys(CONTESTANTS) as Contestant[];
    try {
      for (const model of models) {
        const blocks: Partial<Record<Contestant, number[]>> = {};
        const times = await inTurns(model, all, runs, (contestant, file) => page.load(contestant, file, 'address'));
        for (const contestant of all)
          for (let i = 0; i < (quick ? 1 : 3); i++)
            (blocks[contestant] ??= []).push(await page.longestTask(contestant, model.file));
        note(model, 'address', times, blocks);
        note(
          model,
          'bytes',
          await inTurns(model, all, runs, (contestant, file) => page.load(contestant, file, 'bytes')),
        );
      }
    } finally {
      await page.close();
    }
    const profiles: NonNullable<LoadingDetails['profiles']>[number][] = [];
    const legible = await openPage(true);
    try {
      for (const { name, file } of models) {
        const address = `/assets/${file.split('/').map(encodeURIComponent).join('/')}`,
          ms = quick ? 100 : 2000;
        profiles.push({
          model: name,
          glanz: await profileLoads(legible.page, 'glanz', address, ms),
          three: await profileLoads(legible.page, 'three', address, ms),
        });
      }
    } finally {
      await legible.close();
    }
    // A bare machine has no decoders of images for Node.
    const node = packedBrowser() === undefined ? (await import('../loading/node')).openNode() : undefined;
    if (node)
      for (const model of models)
        note(
          model,
          'node',
          await inTurns(model, ['glanz', 'three'], runs, (contestant, file) =>
            node.load(contestant as 'glanz' | 'three', file),
          ),
        );
    const target = quick ? undefined : ({ value: 1.5, relation: '>=', source: 'half as fast again' } as const);
    for (const place of Object.keys(PLACES) as Place[]) {
      for (const name of ['glanz', 'worker'] as const) {
        const ratio = speedUp(rows, place, name);
        if (ratio !== undefined)
          figures.push(
            timed(
              `${PLACES[place]}: three.js over ${CONTESTANTS[name]}, geometric mean of ratios of medians`,
              '1',
              [ratio],
              target,
            ),
          );
      }
    }
    const best = geometricMean(
      (Object.keys(PLACES) as Place[])
        .map((place) => speedUp(rows, place, 'glanz'))
        .filter((ratio) => ratio !== undefined),
    );
    figures.push(timed('everywhere: three.js over loadGltf, geometric mean', '1', [best], target));
    const details: LoadingDetails = { three: THREE, browser: page.version, runs, rows, profiled: machine(), profiles };
    if (values['pages'] !== undefined)
      for (const file of writeLoadingPage({ machine: machine(), details }, values['pages'])) log(`wrote ${file}`);
    return {
      settings: {
        runs,
        models: models.map(({ name }) => name),
        three: THREE,
        browser: `Chromium ${page.version}, headless`,
      },
      figures,
      details,
    };
  },
};
