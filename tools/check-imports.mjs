// node tools/check-imports.mjs — checks the table of ARCHITECTURE.md: who may import whom, through which entries, and
// which files may touch Node.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { checkPackage, findArrowCycle, readArrows } from './pipeline/imports.mjs';
import { root } from './pipeline/process.mjs';
import { Verdicts, runAlone } from './pipeline/report.mjs';
import { listPackages, packageName } from './pipeline/workspace.mjs';

export async function checkImports(base = root) {
  const verdicts = new Verdicts();
  const arrows = readArrows(readFileSync(join(base, 'ARCHITECTURE.md'), 'utf8'));
  const packages = ['packages', 'apps', 'tools'].flatMap((group) => listPackages(group, base));
  const all = new Map(packages.map((p) => [p.name, p]));
  const rootManifest = JSON.parse(readFileSync(join(base, 'package.json'), 'utf8'));

  const cycle = findArrowCycle(arrows);
  verdicts.expect(!cycle, `ARCHITECTURE.md: the packages import each other in a circle: ${cycle?.join(' → ')}`);
  for (const p of packages) {
    if (p.group === 'packages')
      verdicts.expect(arrows.has(p.short), `ARCHITECTURE.md: packages/${p.short} has no row in the table of packages.`);
    const { problems } = checkPackage(p, { arrows, all, rootManifest, base });
    verdicts.expect(problems.length === 0, problems.join('\n'));
  }
  for (const name of arrows.keys())
    verdicts.expect(
      all.get(packageName(name))?.group === 'packages',
      `ARCHITECTURE.md: the table of packages names packages/${name}, which does not exist.`,
    );
  return verdicts;
}

await runAlone(import.meta, checkImports);
