import { readFileSync } from 'node:fs';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import type { Benchmark, Figure } from '../benchmark';
import { BenchError } from '../error';
import { assetCases } from '../hashes/assets';
import { differences, unusedFlags, type Difference, type HashEntry, type Hashes } from '../hashes/compare';
import { channelMeans, digest, programDigest } from '../hashes/digest';
import { observePrograms } from '../hashes/observed-wgsl';
import { HASH_CASES, type HashCase } from '../hashes/scenes';

const SIZE = 64;

/** Samples per pixel: of the project's own scenes, and of assets. */
const SAMPLES = 4;
const ASSET_SAMPLES = 2;

/** Sample assets that are rendered by default: textures of several kinds, alpha, vertex colours, mirrored instances. */
const FILM_ASSETS: ReadonlySet<string> = new Set(
  [
    'AlphaBlendModeTest',
    'AttenuationTest',
    'BoxTextured',
    'Duck',
    'MultiUVTest',
    'NegativeScaleTest',
    'TextureSettingsTest',
    'VertexColorTest',
  ].map((name) => `asset ${name}`),
);

const LAYER_CHANNELS = {
  beauty: 4,
  variance: 1,
  albedo: 3,
  normal: 3,
  position: 3,
  depth: 1,
  objectId: 1,
  coverage: 1,
  motion: 2,
  virtualDepth: 1,
  materialId: 1,
  roughness: 1,
} as const;

/** Renders one case and gives the hashes of its layers. */
async function filmHashes(
  device: GPUDevice,
  { name, scene, options, layers = [], noise, relight }: HashCase,
  samples: number,
): Promise<HashEntry[]> {
  const tracer = await PathTracer.create(device, await scene(), {
    seed: 1,
    maxDepth: 6,
    maxVolumeDepth: 32,
    ...options,
    width: SIZE,
    height: SIZE,
  });
  try {
    for await (const progress of tracer.render({
      ...(noise === undefined ? { samples } : { noise, samples: 128 }),
      maxSubmitMs: 500,
    }))
      void progress;
    const films: HashEntry[] = [];
    const add = (part: string, data: Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>, channels: number) =>
      films.push({ scene: name, part, hash: digest(data), means: channelMeans(data, channels) });
    for (const layer of ['beauty', ...layers] as const) add(layer, await tracer.read(layer), LAYER_CHANNELS[layer]);
    if (relight !== undefined) {
      for (const group of tracer.lightGroups) await tracer.setLightGroup(group.name, { intensity: relight });
      add('beauty, relit', await tracer.read('beauty'), 4);
    }
    return films;
  } finally {
    tracer.destroy();
  }
}

/** Composes the programs of one case and compiles none: pipelines are refused. */
async function composeOnly(device: GPUDevice, { scene, options }: HashCase): Promise<void> {
  const tracer = await PathTracer.create(device, await scene(), { ...options, width: SIZE, height: SIZE }).catch(
    (error: unknown) => {
      if (!String((error as Error).message).includes(REFUSED)) throw error;
    },
  );
  tracer?.destroy();
}

const REFUSED = 'hashes: pipelines are not compiled';

function readReport(file: string): Hashes {
  try {
    const { details } = JSON.parse(readFileSync(file, 'utf8')) as { details: Hashes };
    if (!Array.isArray(details.films) || !Array.isArray(details.programs)) throw new Error('it holds no hashes');
    return details;
  } catch (cause) {
    throw new BenchError(
      'bench/missing-data',
      `--against ${file} cannot be read: ${(cause as Error).message}. It must be a file that "hashes --json FILE" wrote.`,
      { cause },
    );
  }
}

function table(kind: string, found: readonly Difference[]): string[] {
  return found.map(({ scene, part, before, after, change }) => {
    const mean = change === undefined ? '' : `, mean changes by ${change === 0 ? '0' : change.toExponential(1)}`;
    return `${kind} differs: ${scene}, ${part}: ${before} → ${after}${mean}`;
  });
}

/** Hashes of films and programs, to show that a change of the renderer leaves both as they were. */
export const benchmark: Benchmark = {
  description:
    'nothing: it stores a hash of the film and of each program of a fixed set of scenes, and compares them with an earlier run (--against FILE)',
  options: {
    against: { type: 'string', help: 'file of an earlier run; exit status 1 if a hash differs' },
    only: { type: 'string', help: 'part of the names of scenes, e.g. "material" or "asset Duck"' },
    assets: {
      type: 'string',
      help: 'some (default): programs of all sample assets and films of eight; all: films of all; no: none',
    },
    films: { type: 'string', help: 'no: compares programs alone, compiles and renders nothing' },
  },
  async run({ log, quick, gpu: gpuName, values }) {
    const before = values['against'] === undefined ? undefined : readReport(values['against']);
    const which = values['assets'] ?? (quick ? 'no' : 'some');
    if (!['all', 'some', 'no'].includes(which))
      throw new BenchError('bench/option', `--assets ${which}: it must be all, some or no.`);
    const assets = which === 'no' ? [] : assetCases();
    const notes =
      assets === undefined
        ? ['The sample assets are not present: their scenes were skipped.']
        : which === 'no'
          ? ['The sample assets were left out.']
          : [];
    if (which === 'some' && assets)
      notes.push(
        `Of the sample assets, films of ${FILM_ASSETS.size} were rendered and programs of all composed; --assets all renders all.`,
      );
    const requested = values['only'] ?? '';
    const cases = [...HASH_CASES, ...(assets ?? [])].filter(({ name }) => name.includes(requested));
    if (cases.length === 0) throw new BenchError('bench/option', `--only ${requested}: no scene has this in its name.`);
    const render = values['films'] !== 'no';
    const { gpu, adapterName, software } = await createGpu(
      gpuName === undefined ? { software: 'only' } : { gpu: gpuName },
    );
    const films: HashEntry[] = [];
    const programs = new Map<string, HashEntry>();
    const flagSets = new Map<string, Readonly<Record<string, boolean>>>();
    const skipped: string[] = [];
    try {
      for (const [index, one] of cases.entries()) {
        const start = performance.now();
        const compiled = render && (!one.name.startsWith('asset ') || which === 'all' || FILM_ASSETS.has(one.name));
        // Of its own: a device remembers what it has compiled, and programs would not be composed again.
        const device = await requestDevice({ gpu });
        if (!compiled) device.createComputePipelineAsync = () => Promise.reject(new Error(REFUSED));
        observePrograms(({ kernel, code, flags }) => {
          const hash = programDigest(code);
          programs.set(`${one.name} ${kernel} ${hash}`, { scene: one.name, part: kernel, hash });
          flagSets.set(JSON.stringify(flags), flags);
        });
        try {
          if (compiled)
            films.push(...(await filmHashes(device, one, one.name.startsWith('asset ') ? ASSET_SAMPLES : SAMPLES)));
          else await composeOnly(device, one);
        } catch (error) {
          const reason = (error as Error).message.split('\n', 1)[0]!;
          // Every scene of the project can be rendered; an asset may need a decoder that is not installed.
          if (!one.name.startsWith('asset '))
            throw new BenchError('bench/failed', `${one.name}: ${reason}`, { cause: error });
          skipped.push(`${one.name}: ${reason}`);
        } finally {
          device.destroy();
        }
        log(`${index + 1}/${cases.length} ${one.name}: ${((performance.now() - start) / 1000).toFixed(1)} s`);
      }
    } finally {
      observePrograms(undefined);
    }
    const { neverOn, neverOff } = unusedFlags([...flagSets.values()]);
    const details: Hashes = { films, programs: numbered([...programs.values()]), skipped };
    notes.push(...skipped.map((line) => `skipped: ${line}`));
    const figures: Figure[] = [
      { name: 'scenes', unit: '1', runs: 1, median: cases.length - skipped.length },
      { name: 'films', unit: '1', runs: 1, median: films.length },
      { name: 'programs', unit: '1', runs: 1, median: details.programs.length },
    ];
    if (requested === '') {
      figures.push({
        name: 'flags that no scene uses',
        unit: '1',
        runs: 1,
        median: neverOn.length,
        target: { value: 0, relation: '<=', source: 'each flag is on somewhere' },
      });
      if (neverOn.length > 0) {
        notes.push(`No scene uses ${neverOn.join(', ')}: add one to src/hashes/scenes.ts.`);
        process.exitCode = 1;
      }
      if (neverOff.length > 0) notes.push(`In all scenes on: ${neverOff.join(', ')}.`);
    }
    if (before) {
      const partial = requested !== '' || (assets ?? []).length === 0;
      const changed = [
        ...table('film', render ? differences(before.films, films, partial || which !== 'all') : []),
        ...table('program', differences(before.programs, details.programs, partial || !render)),
      ];
      figures.push({
        name: 'hashes that differ',
        unit: '1',
        runs: 1,
        median: changed.length,
        target: { value: 0, relation: '<=', source: String(values['against']) },
      });
      notes.push(...changed);
      if (changed.length > 0) process.exitCode = 1;
    }
    return {
      settings: {
        assets: which,
        size: SIZE,
        samples: SAMPLES,
        assetSamples: ASSET_SAMPLES,
        seed: 1,
        only: requested,
        films: render,
      },
      gpu: { name: adapterName, software },
      figures,
      notes,
      details,
    };
  },
};

/** Gives each entry a name of its own, where a scene has several programs of one kernel. */
function numbered(entries: readonly HashEntry[]): HashEntry[] {
  const counts = new Map<string, number>();
  return [...entries]
    .sort((a, b) => (a.scene + a.part + a.hash < b.scene + b.part + b.hash ? -1 : 1))
    .map((entry) => {
      const name = `${entry.scene}\n${entry.part}`;
      const count = (counts.get(name) ?? 0) + 1;
      counts.set(name, count);
      return count === 1 ? entry : { ...entry, part: `${entry.part} ${count}` };
    });
}
