import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { geometricMean } from '../geometric-mean';
import { CONTESTANTS, type Contestant } from './models';
import { WORK, type Shares, type Work } from './profile';

/** The environments in which loads are measured. */
export const PLACES = {
  address: 'Chromium, from a URL on the same machine',
  bytes: 'Chromium, from the bytes of the file in memory',
  node: 'Node, from the bytes of the file in memory',
} as const;

export type Place = keyof typeof PLACES;

/** Minimum, median and maximum of repeated times, milliseconds. */
export interface Spread {
  readonly min: number;
  readonly median: number;
  readonly max: number;
}

/** The times of a model in one environment. */
export interface LoadingRow {
  readonly model: string;
  readonly place: Place;
  readonly times: Readonly<Partial<Record<Contestant, Spread>>>;
  /** Longest task of the main thread, milliseconds of its CPU time; measured for loads from a URL only. */
  readonly blocks?: Readonly<Partial<Record<Contestant, Spread>>>;
}

/** The data of the documentation page. */
export interface LoadingDetails {
  readonly three: string;
  readonly browser: string;
  readonly runs: number;
  readonly rows: readonly LoadingRow[];
  /** Where the time of the calling thread goes when a model is loaded from memory in Chromium. */
  readonly profiled?: { readonly commit?: string | undefined; readonly date: string };
  readonly profiles?: readonly { readonly model: string; readonly glanz: Shares; readonly three: Shares }[];
}

/** A report of the benchmark. */
export interface LoadingReport {
  readonly machine: {
    readonly cpu: string;
    readonly cores: number;
    readonly node: string;
    readonly commit?: string | undefined;
    readonly date: string;
  };
  readonly details: LoadingDetails;
}

/** Ratio of three.js's median time to the contestant's, geometric mean over the models. */
export function speedUp(
  rows: readonly LoadingRow[],
  place: Place,
  contestant: Exclude<Contestant, 'three'>,
): number | undefined {
  const ratios = rows.flatMap(({ place: where, times }) =>
    where === place && times[contestant] && times.three ? [times.three.median / times[contestant].median] : [],
  );
  return ratios.length === 0 ? undefined : geometricMean(ratios);
}

const digits = (ms: number) => (ms < 10 ? ms.toFixed(1) : ms.toFixed(0));
const spread = (s: Spread | undefined) => (s ? `${digits(s.median)} (${digits(s.min)} – ${digits(s.max)})` : '–');

/** The share of a load's time that any loader with the same decoders and browser needs. */
const fixedShare = (shares: Shares) => shares.waiting + shares.decoder + shares.browser;

/** Where the time goes, and how fast the loader would be if its own code took no time. */
function profileSection({ rows, profiles, profiled }: LoadingDetails): string[] {
  if (!profiles) return [];
  const kinds = Object.keys(WORK) as Work[];
  const percent = (share: number) => (share < 0.005 ? '' : `${(100 * share).toFixed(0)} %`);
  const bounds = profiles.flatMap(({ model, glanz }) => {
    const times = rows.find((row) => row.model === model && row.place === 'bytes')?.times;
    return times?.glanz && times.three
      ? [
          {
            model,
            now: times.three.median / times.glanz.median,
            bound: times.three.median / times.glanz.median / fixedShare(glanz),
          },
        ]
      : [];
  });
  const large = bounds.filter(({ model }) =>
    rows.some((row) => row.model === model && row.place === 'bytes' && (row.times.three?.median ?? 0) > 20),
  );
  return [
    '## Where the time goes',
    '',
    `Shares of the main thread's time while a model is loaded repeatedly from memory in Chromium, sampled every 0.1 ms. The first column is time in which the thread waits, for images that the browser decodes or for Draco in three.js's workers. The column of the browser is work that the browser does on this thread; with the image options of three.js this includes a pass over all pixels.${profiled ? ` Commit ${profiled.commit ?? 'unknown'}, ${profiled.date.slice(0, 10)}.` : ''}`,
    '',
    `| model | | ${kinds.map((kind) => WORK[kind]).join(' | ')} |`,
    `| --- | --- | ${kinds.map(() => '--:').join(' | ')} |`,
    ...profiles.flatMap(({ model, glanz, three }) => [
      `| ${model} | loadGltf | ${kinds.map((kind) => percent(glanz[kind])).join(' | ')} |`,
      `| | three.js | ${kinds.map((kind) => percent(three[kind])).join(' | ')} |`,
    ]),
    '',
    `Where a load waits for images or other threads, most of the time that Glanz needs is spent in decoders and the browser. If the loader's own work (checks, tangents and the rest) took no time, three.js ÷ loadGltf from memory would be ${bounds.map(({ model, now, bound }) => `${bound.toFixed(2)}× instead of ${now.toFixed(2)}× (${model})`).join(', ')}; for the models that take three.js more than 20 ms, the geometric mean would be **${geometricMean(large.map(({ bound }) => bound)).toFixed(2)}×**.`,
    '',
  ];
}

/** The page of the documentation. */
export function loadingMarkdown({ machine, details }: LoadingReport): string {
  const { three, browser, runs, rows } = details;
  const names = Object.keys(CONTESTANTS) as Contestant[];
  const table = (place: Place) => {
    const own = rows.filter((row) => row.place === place);
    const shown = names.filter((name) => own.some(({ times }) => times[name]));
    const ours = shown.filter((name) => name !== 'three') as Exclude<Contestant, 'three'>[];
    const ratio = (row: LoadingRow, name: Contestant) =>
      row.times[name] && row.times.three ? `${(row.times.three.median / row.times[name].median).toFixed(2)}×` : '–';
    return [
      `### ${PLACES[place]}`,
      '',
      `| model | ${shown.map((name) => `${CONTESTANTS[name]}, ms`).join(' | ')} | ${ours.map((name) => `three.js ÷ ${CONTESTANTS[name]}`).join(' | ')} |`,
      `| --- | ${[...shown, ...ours].map(() => '--:').join(' | ')} |`,
      ...own.map(
        (row) =>
          `| ${row.model} | ${shown.map((name) => spread(row.times[name])).join(' | ')} | ${ours.map((name) => ratio(row, name)).join(' | ')} |`,
      ),
      `| geometric mean | ${shown.map(() => '').join(' | ')} | ${ours.map((name) => `**${speedUp(rows, place, name)?.toFixed(2)}×**`).join(' | ')} |`,
      '',
    ];
  };
  const blocked = rows.filter(({ blocks }) => blocks);
  return [
    '# Loading',
    '',
    '<ResultPlot of="loading" />',
    '',
    `The time from a glTF file to a scene that can be rendered, with Glanz and with three.js ${three}: \`GLTFLoader\` with its \`DRACOLoader\` and \`MeshoptDecoder\`. The five models have large images (DamagedHelmet), Draco compression (chess-board), meshopt compression (pirate, bunny), and many parts with images (lamborghini).`,
    '',
    '**What is compared.** Both loaders finish with every image decoded and all vertex data decompressed; neither uploads anything to the GPU. In a browser both return images as `ImageBitmap`s, so no pixels pass through JavaScript. The differences:',
    '',
    '- Glanz validates the file: every index, every float, every byte range. A broken file gives a scene with warnings or a typed error. It also normalises vectors, and generates MikkTSpace tangents where a material needs them and the file has none (DamagedHelmet). three.js does none of this; its shaders derive tangents from screen-space derivatives.',
    '- Glanz decodes only the images that a path tracer uses; three.js also decodes occlusion textures.',
    '- `GltfWorker` loads in one worker, which is kept between loads. three.js decompresses Draco in up to four workers and does everything else on the main thread.',
    '- In Node, three.js gets a `createImageBitmap` that uses `sharp`, as Glanz does, and the same Draco decoder without workers.',
    '',
    `The loaders alternate, with ${runs} loads each after one warm-up load that is not counted. Times are the median (minimum – maximum). ${machine.cpu}, ${machine.cores} cores, Node ${machine.node}, Chromium ${browser}${machine.commit ? `, commit ${machine.commit.slice(0, 7)}` : ''}, ${machine.date.slice(0, 10)}. \`npm run bench -- gltf --pages apps/docs/results\` writes this page; the data is in \`loading.json\`.`,
    '',
    '## Time to a scene',
    '',
    ...(Object.keys(PLACES) as Place[]).flatMap(table),
    'The target, a geometric mean of at least 1.5×, is not reached. The reasons:',
    '',
    "- Both use the same decoders (the browser's JPEG, Draco's and meshopt's own WebAssembly), which take most of the time. Glanz is faster because it decodes images while it decompresses geometry, because it removes colour profiles from the bytes of an image rather than request a colour conversion, which costs a pass over all pixels, and because it does not decode images that are not used. For DamagedHelmet, the time to decode its largest image is a lower bound.",
    '- Draco (chess-board): three.js decompresses the eight meshes in parallel in up to four workers. Glanz does the same with `decoders.dracoWorkers`, and in `GltfWorker` where the machine has at least three threads. Here there are two cores, and `loadGltf` runs without such workers.',
    '- Small files and plain geometry (pirate, bunny): from a URL, most of the time is the transfer of the bytes. From memory Glanz is slower by the cost of its checks: about 3 ms for the 144,046 triangles of the bunny.',
    '',
    ...profileSection(details),
    '## How long the main thread is blocked',
    '',
    'Longest task of the main thread during a load, in milliseconds of CPU time of that thread. A frame at 60 Hz lasts 16.7 ms.',
    '',
    `| model | ${names.map((name) => CONTESTANTS[name]).join(' | ')} |`,
    `| --- | ${names.map(() => '--:').join(' | ')} |`,
    ...blocked.map(({ model, blocks }) => `| ${model} | ${names.map((name) => spread(blocks?.[name])).join(' | ')} |`),
    '',
  ].join('\n');
}

/** Writes the page and its data. Returns the files. */
export function writeLoadingPage(report: LoadingReport, folder: string): string[] {
  mkdirSync(folder, { recursive: true });
  const page = join(folder, 'loading.md'),
    data = join(folder, 'loading.json');
  writeFileSync(page, loadingMarkdown(report));
  writeFileSync(data, `${JSON.stringify(report, null, 1)}\n`);
  return [page, data];
}
