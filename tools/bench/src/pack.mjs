// npm run bench:pack — one bundled file per benchmark under .gpu-bench/, for machines that have nothing but a GPU.
// Each file carries its code and makes its models where it runs. With `tools/gpu/pack.sh` beside it:
//   . .gpu/setup.sh && $GPU_NODE .gpu-bench/paper-gpu.mjs --json out.json
import { execFileSync } from 'node:child_process';
import { mkdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { benchmarkNames, bundleBenchmark } from './bundle.mjs';

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
