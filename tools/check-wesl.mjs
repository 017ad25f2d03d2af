// node tools/check-wesl.mjs — shader sources: functions of at most 120 lines with at most five conditions, lines of at
// most 120 columns, and no more gates in templates of TypeScript than tools/pipeline/wesl-templates.json lists.
//
// node tools/check-wesl.mjs --write   shortens that list; it never grows
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './pipeline/process.mjs';
import { Verdicts, runAlone } from './pipeline/report.mjs';
import { brokenRules, gateLines } from './pipeline/wesl-rules.mjs';

const LIST = 'tools/pipeline/wesl-templates.json';
/** The composer, which reads gates. */
const COMPOSER = /^packages\/wgsl\//;
const read = (base, file) => readFileSync(join(base, file), 'utf8');

export async function checkWesl(base = root, { write = false } = {}) {
  const verdicts = new Verdicts();
  const files = execFileSync('git', ['ls-files', '--cached', '--others', '--exclude-standard', 'packages', 'apps'], {
    cwd: base,
    encoding: 'utf8',
    maxBuffer: 1 << 26,
  })
    .split('\n')
    // A file may be deleted, and that not committed yet.
    .filter((file) => existsSync(join(base, file)));
  const shaders = files.filter((file) => file.endsWith('.wesl'));
  verdicts.expect(shaders.length > 0, 'there are no .wesl files.');
  for (const file of shaders)
    await verdicts.attempt(file, () => {
      const broken = brokenRules(read(base, file), file);
      verdicts.expect(broken.length === 0, broken.join('\n'));
    });

  const listed = JSON.parse(read(base, LIST));
  const found = {};
  for (const file of files.filter((name) => /\/src\/.*\.ts$/.test(name) && !COMPOSER.test(name))) {
    const count = gateLines(read(base, file));
    if (count > 0) found[file] = count;
    verdicts.expect(
      count <= (listed[file] ?? 0),
      `${file}: ${count} lines of gates in a template, ${listed[file] ?? 0} are listed: new conditions go into a .wesl file.`,
    );
  }
  if (write) {
    const shorter = Object.entries(listed).flatMap(([file, count]) =>
      found[file] ? [[file, Math.min(count, found[file])]] : [],
    );
    writeFileSync(join(base, LIST), `${JSON.stringify(Object.fromEntries(shorter), undefined, 2)}\n`);
  }
  return verdicts;
}

await runAlone(import.meta, () => checkWesl(root, { write: process.argv.includes('--write') }));
