import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { CONTESTANTS, type Contestant } from './models';
import { WORK, type Shares, type Work } from './profile';

/** Where loads were measured. */
export const PLACES = {
  address: 'Chromium, from an address on the same machine',
  bytes: 'Chromium, from the bytes of the file in memory',
  node: 'Node, from the bytes of the file in memory',
} as const;

export type Place = keyof typeof PLACES;

/** Smallest, middle and largest of repeated times, milliseconds. */
export interface Spread {
  readonly min: number;
  readonly median: number;
  readonly max: number;
}

/** What was measured of a model at a place. */
export interface LoadingRow {
  readonly model: string;
  readonly place: Place;
  readonly times: Readonly<Partial<Record<Contestant, Spread>>>;
  /** Longest task of the page's own thread, milliseconds of that thread's time; from an address only. */
  readonly blocks?: Readonly<Partial<Record<Contestant, Spread>>>;
}

/** What the page is made of. */
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

export const geometricMean = (values: readonly number[]): number =>
  Math.exp(values.reduce((sum, value) => sum + Math.log(value), 0) / values.length);

/** How many times longer three.js takes, middle over middle, geometric mean over the models. */
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

/** The shares of a load that no loader that uses the same decoders and the same browser can save. */
const fixedShare = (shares: Shares) => shares.waiting + shares.decoder + shares.browser;

/** Where the time goes, and how fast the loader would be if all that is its own took none. */
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
    `Shares of the calling thread's time, sampled every tenth of a millisecond while a model is loaded from memory in Chromium again and again. What waits for others (images decoded by the browser, Draco in three.js's workers) is waiting; what the browser does on this thread itself is the browser's: with three.js's options for images that is a pass over all pixels.${profiled ? ` Commit ${profiled.commit ?? 'unknown'}, ${profiled.date.slice(0, 10)}.` : ''}`,
    '',
    `| model | | ${kinds.map((kind) => WORK[kind]).join(' | ')} |`,
    `| --- | --- | ${kinds.map(() => '--:').join(' | ')} |`,
    ...profiles.flatMap(({ model, glanz, three }) => [
      `| ${model} | loadGltf | ${kinds.map((kind) => percent(glanz[kind])).join(' | ')} |`,
      `| | three.js | ${kinds.map((kind) => percent(three[kind])).join(' | ')} |`,
    ]),
    '',
    `So of a load by Glanz the decoders and the browser have most in the models where there is something to wait for. Were checks, tangents and all else of the loader's own free, three.js ÷ loadGltf from memory would be ${bounds.map(({ model, now, bound }) => `${bound.toFixed(2)}× instead of ${now.toFixed(2)}× (${model})`).join(', ')}; of the models that take three.js more than 20 ms, **${geometricMean(large.map(({ bound }) => bound)).toFixed(2)}×** in the geometric mean.`,
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
    `How long does it take from a glTF file to a scene that can be rendered? Glanz beside three.js ${three}: \`GLTFLoader\` with its \`DRACOLoader\` and \`MeshoptDecoder\`. Five models: large images (DamagedHelmet), Draco (chess-board), meshopt (pirate, bunny), many parts with images (lamborghini).`,
    '',
    '**What is compared.** Both loaders end with every image decoded and every vertex unpacked, neither has put anything on a graphics card. In a browser both leave decoded images as `ImageBitmap`s, so no pixel passes through JavaScript. What differs:',
    '',
    '- Glanz checks what it reads (every index, every float, every byte range; broken files are a scene with a warning or a typed error), brings vectors to length 1 and makes MikkTSpace tangents where a material needs them and the file has none (DamagedHelmet). three.js does none of it; its shaders make up tangents.',
    '- Glanz decodes the images that a path tracer looks at; three.js also those of baked occlusion.',
    "- `GltfWorker` does everything in one worker, which stays ready between loads. three.js unpacks Draco in up to four workers and all the rest on the page's own thread.",
    '- In Node three.js gets what it expects of a browser: `createImageBitmap` made of the same `sharp` that Glanz uses, and a Draco decoder of the same package without workers.',
    '',
    `Taken in turns, ${runs} loads each after one that does not count; middle (smallest – largest). ${machine.cpu}, ${machine.cores} cores, Node ${machine.node}, Chromium ${browser}${machine.commit ? `, commit ${machine.commit.slice(0, 7)}` : ''}, ${machine.date.slice(0, 10)}. Data: \`loading.json\`; again with \`npm run bench -- gltf --pages apps/docs/results\`.`,
    '',
    '## Time to a scene',
    '',
    ...(Object.keys(PLACES) as Place[]).flatMap(table),
    'The aim, half as fast again in the mean, is not reached. Why:',
    '',
    "- Both use the same decoders (the browser's JPEG, Draco's and meshopt's own WebAssembly), and those take most of the time. What Glanz wins, it wins by decoding images while geometry is unpacked, by asking for them without the pass over the pixels that colour options cost (profiles are taken out of the bytes instead), and by not decoding what is not looked at. The largest image alone bounds DamagedHelmet.",
    '- Draco (chess-board): three.js unpacks its eight meshes side by side in up to four workers. Glanz does so too where there are threads for it (`decoders.dracoWorkers`, and in a worker of its own three threads or more); these times are of two cores and, with `loadGltf`, without such workers.',
    '- Small files and plain geometry (pirate, bunny): from an address they take about as long as the server and the copy of the bytes. From memory Glanz is slower by what its checks cost: about 3 ms for the 144,046 triangles of the bunny.',
    '',
    ...profileSection(details),
    '## How long the page stands still',
    '',
    "Longest task of the page's own thread during a load, in milliseconds of its time on the processor. A frame has 16.",
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
