// node tools/check-wesl.mjs — shader sources: functions of at most 120 lines with at most five conditions, lines of at
// most 120 columns, and no gates in TypeScript.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './pipeline/process.mjs';
import { Verdicts, runAlone } from './pipeline/report.mjs';
import { brokenRules, hasGates } from './pipeline/wesl-rules.mjs';

/** What writes gates and what reads them, with their tests. */
const COMPOSER = /^(packages\/wgsl|tools\/pipeline)\//;
const read = (base, file) => readFileSync(join(base, file), 'utf8');

export async function checkWesl(base = root) {
  const verdicts = new Verdicts();
  const files = execFileSync(
    'git',
    ['ls-files', '--cached', '--others', '--exclude-standard', 'packages', 'apps', 'tools'],
    {
      cwd: base,
      encoding: 'utf8',
      maxBuffer: 1 << 26,
    },
  )
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

  for (const file of files.filter((name) => name.endsWith('.ts') && !COMPOSER.test(name)))
    verdicts.expect(
      !hasGates(read(base, file)),
      `${file}: gates ("//#if") are the composer's: text with conditions goes into a .wesl file.`,
    );
  return verdicts;
}

await runAlone(import.meta, () => checkWesl());
