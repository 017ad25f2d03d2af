// npm run bench -- <name> [--json FILE] [--quick] [--gpu NAME] [--seed N]
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { benchmarkNames, bundleBenchmark } from './bundle.mjs';

const [name, ...argv] = process.argv.slice(2);
const names = benchmarkNames();
if (name === undefined || name === '--list' || name === '--help' || !names.includes(name)) {
  const asked =
    name === undefined || name.startsWith('--') ? '' : `bench: bench/unknown-name: there is no benchmark "${name}". `;
  process.stderr.write(
    `${asked}Usage: npm run bench -- <name> [--json FILE] [--quick] [--gpu NAME] [--seed N]; names: ${names.join(', ')}.\n`,
  );
  process.exitCode = name === '--list' || name === '--help' ? 0 : 1;
} else {
  const outfile = join(fileURLToPath(new URL('../.cache/', import.meta.url)), `${name}.mjs`);
  await bundleBenchmark(name, outfile);
  process.argv.splice(2, process.argv.length, ...argv);
  await import(pathToFileURL(outfile).href);
}
