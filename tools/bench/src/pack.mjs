// npm run bench:pack — one bundled file per benchmark under .gpu-bench/, for machines that have nothing but a GPU.
// `--browser` packs Chromium and its pages as well (browser/pack.mjs), `--products` the models of denoise-time; both are
// besides the limit of what is packed.
// Each file carries its code and makes its models where it runs; scenes and references of equal-time and groundtruth
// lie beside it. With `tools/gpu/pack.sh` beside it:
//   . .gpu/setup.sh && $GPU_NODE .gpu-bench/paper-gpu.mjs --json out.json
import { execFileSync } from 'node:child_process';
import { mkdirSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { benchmarkNames, bundle, bundleBenchmark } from './bundle.mjs';

const root = fileURLToPath(new URL('../../..', import.meta.url));
const out = join(root, '.gpu-bench');
rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
let total = 0;
for (const name of benchmarkNames()) {
  const file = join(out, `${name}.mjs`);
  await bundleBenchmark(name, file);
  const { size } = statSync(file);
  total += size;
  process.stdout.write(`.gpu-bench/${name}.mjs ${(size / 1024).toFixed(0)} KiB\n`);
}
// The fuzzer of glTF wants many cores rather than a GPU; those machines have both.
execFileSync(process.execPath, [join(root, 'packages/gltf/test/fuzz/pack.mjs'), join(out, 'fuzz-gltf.mjs')], {
  stdio: ['ignore', 'ignore', 'inherit'],
});
total += statSync(join(out, 'fuzz-gltf.mjs')).size;
process.stdout.write(`.gpu-bench/fuzz-gltf.mjs ${(statSync(join(out, 'fuzz-gltf.mjs')).size / 1024).toFixed(0)} KiB\n`);
// What equal-time and groundtruth read: scenes, references and decoded textures.
const packer = join(root, 'tools/bench/.cache/pack-data.mjs');
await bundle("export { packData } from './equal-time/pack-data';", packer);
const { packData } = await import(pathToFileURL(packer).href);
const data = join(out, 'equal-time-data');
const missing = await packData(data);
const dataBytes = readdirSync(data, { recursive: true }).reduce(
  (sum, file) => sum + statSync(join(data, file)).size,
  0,
);
total += dataBytes;
process.stdout.write(
  `.gpu-bench/equal-time-data ${(dataBytes / 1024).toFixed(0)} KiB${missing.length === 0 ? '' : `, without ${missing.join(', ')}, which are not here`}\n`,
);
if (process.argv.includes('--products')) {
  const products = join(root, 'tools/bench/.cache/pack-products.mjs');
  await bundle("export { packProducts } from './denoise/pack-products';", products);
  const { packProducts } = await import(pathToFileURL(products).href);
  const left = await packProducts(join(out, 'product-data'), join(root, 'packages/denoise-weights/weights'));
  process.stdout.write(
    `.gpu-bench/product-data${left.length === 0 ? '' : `, without ${left.join(', ')}, which are not here`}\n`,
  );
}
if (process.argv.includes('--browser')) await (await import('./browser/pack.mjs')).packBrowser();
let commit = 'unknown';
try {
  commit = execFileSync('git', ['rev-parse', '--short', 'HEAD'], { cwd: root, encoding: 'utf8' }).trim();
} catch {
  // A source archive has no git; the report then says so.
}
writeFileSync(join(out, 'commit.sh'), `export GLANZ_COMMIT=${commit}\n`);
process.stdout.write(`total ${(total / 2 ** 20).toFixed(1)} MiB\n`);
if (total > 60 * 2 ** 20) {
  process.stderr.write('bench:pack: over 60 MiB\n');
  process.exitCode = 1;
}
