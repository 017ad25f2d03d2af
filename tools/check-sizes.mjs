// node tools/check-sizes.mjs — what a page pays for everything that a package exports, minified by esbuild and gzipped,
// by itself and with all its dependencies, against a budget. Budgets hold for what is there when the entry is imported;
// what it loads later by import() stands beside it. READMEs and the documentation state the same sizes; --write puts
// them there.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { PEERS, bundle } from './pipeline/bundle.mjs';
import { installPacked } from './pipeline/packed.mjs';
import { Verdicts, columns, runAlone } from './pipeline/report.mjs';
import { root } from './pipeline/process.mjs';
import { compareSizeTexts } from './pipeline/size-texts.mjs';
import { NODE_PACKAGES, entriesOf } from './pipeline/workspace.mjs';

/**
 * Budgets in kB (1000 bytes), min+gz: of the package's own code, or with all its dependencies (`withDependencies`). The
 * energy tables are an entry of their own, which the host loads when it likes.
 */
const BUDGETS = [
  { specifier: '@glanz/bvh', limit: 10 },
  // 13 before leaf orders became hierarchies for queries on the CPU.
  { specifier: '@glanz/bvh/gpu', limit: 13.5 },
  { specifier: '@glanz/openpbr', limit: 30, without: '@glanz/openpbr/tables' },
  { specifier: '@glanz/tonemap', limit: 5 },
  // Weights are not in it.
  { specifier: '@glanz/denoise', limit: 20 },
  // 92 before edits could be taken back, films saved and resumed, and hierarchies over instances changed in place; 107
  // before paths wrote AOVs and motion, edits were classified, and lights had ids; 113 before it chose where hierarchies
  // are built, placed those of the GPU, and read them back for edits; 115 before guides, which are loaded later.
  // 115.1 before soft shadows on catchers, whose shader is loaded later: what asks for it is here. 115.3 before every mix
  // of wraps and filters fitted into the samplers that a shader binds.
  // 115.4 before textures were fitted into a budget and the device's memory: what does it is loaded where they exceed
  // them; whether they do, the report, and another attempt where the GPU has no memory are here. 116.2 before haze and
  // retroreflection: their lobes are loaded where materials have them; their parameters, and where they act, are here.
  { specifier: '@glanz/renderer', limit: 116.9, withDependencies: true },
  { specifier: '@glanz/gltf', limit: 40, withDependencies: true },
  // 14 before it kept samples through the loss of a GPU and checked all that it is given; 19 before models were placed
  // on a ground and played; the code for both is loaded later.
  { specifier: '@glanz/viewer', limit: 20.8 },
  // 10 before it had properties, methods and events of animations.
  { specifier: '@glanz/element', limit: 10.5 },
  { specifier: '@glanz/react', limit: 1.6 },
  // The renderer is loaded when the first scene is prepared.
  { specifier: '@glanz/three', limit: 16 },
  { specifier: '@glanz/three/compat', limit: 22 },
  { specifier: '@glanz/three/fiber', limit: 17 },
];

/** Files that pages take as they are: kB, gzipped. */
// 228 before the renderer chose where hierarchies are built; what builds them on the GPU lies beside the file.
// 229 before animations, a ground and an interaction prompt, whose code lies beside it too; 231 before guides, likewise; 231.5
// before volumes of glTF scatter; 232.7 before budgets for textures and images, whose code lies beside it; 233.4 before
// haze and retroreflection, whose lobes lie beside it; 234 before what filters moving frames lay beside it.
const FILES = [{ specifier: '@glanz/element', file: 'dist/glanz-viewer.min.js', limit: 227 }];

const kB = (bytes) => (bytes / 1000).toFixed(2);

export async function checkSizes({ write = process.argv.includes('--write') } = {}) {
  const verdicts = new Verdicts();
  const consumer = await installPacked();
  const rows = [];
  const measured = new Map();
  for (const p of consumer.packages.filter(({ short }) => !NODE_PACKAGES.includes(short))) {
    const foreign = Object.keys(p.manifest.dependencies ?? {}).flatMap((name) => [name, `${name}/*`]);
    for (const { path, specifier } of entriesOf(p)) {
      if (path === './node') continue;
      await verdicts.attempt(specifier, async () => {
        const code = `export * from '${specifier}';`;
        const own = await bundle(consumer, code, { external: [...PEERS, ...foreign] });
        const all = await bundle(consumer, code, { external: PEERS });
        const { limit, withDependencies, without } = BUDGETS.find((budget) => budget.specifier === specifier) ?? {};
        measured.set(specifier.replace('@glanz/', ''), { own: own.gzip, all: all.gzip, lazy: all.lazy });
        rows.push([
          specifier,
          kB(own.gzip),
          kB(all.gzip),
          all.lazy > 0 ? kB(all.lazy) : '',
          limit === undefined ? '' : `${limit} ${withDependencies ? 'with all' : 'own'}`,
        ]);
        if (limit === undefined) return;
        const size = (withDependencies ? all : own).gzip;
        verdicts.expect(size <= limit * 1000, `${specifier}: ${kB(size)} kB min+gz, over its budget of ${limit} kB.`);
        if (!without) return;
        const [heaviest] = Object.entries((await bundle(consumer, `export * from '${without}';`)).inputs).sort(
          (a, b) => b[1] - a[1],
        )[0];
        const carried = all.inputs[heaviest] ?? 0;
        verdicts.expect(
          carried < 4000,
          `${specifier} carries the data of ${without} (${carried} bytes of ${heaviest}).`,
        );
      });
    }
  }
  for (const { specifier, file, limit } of FILES) {
    const size = gzipSync(readFileSync(join(consumer.folder, 'node_modules', specifier, file)), {
      level: 9,
    }).byteLength;
    rows.push([`${specifier}/${file}`, kB(size), kB(size), '', `${limit} own`]);
    verdicts.expect(
      size <= limit * 1000,
      `${specifier}: ${file} takes ${kB(size)} kB gzipped, over its budget of ${limit} kB.`,
    );
  }
  for (const { specifier } of BUDGETS)
    verdicts.expect(
      rows.some(([name]) => name === specifier),
      `${specifier} has a budget but was not measured.`,
    );
  const texts = compareSizeTexts(
    measured,
    consumer.packages.map(({ short }) => short).filter((short) => !NODE_PACKAGES.includes(short)),
    { base: root, write },
  );
  verdicts.expect(texts.length === 0, texts.join('\n'));
  verdicts.table.push(
    ...columns([['entry', 'own kB', 'with dependencies', 'loaded later', 'budget'], ...rows], [1, 2, 3]),
  );
  return verdicts;
}

await runAlone(import.meta, checkSizes);
