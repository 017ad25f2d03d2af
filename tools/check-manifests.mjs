// node tools/check-manifests.mjs — each package's manifest has what it shares with the others from the root's manifest,
// a label of stability, and its LICENSE and CHANGELOG beside it, so that npm packs them as pnpm does. With --write:
// makes it so.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { STABILITY, completeManifest } from './pipeline/manifest.mjs';
import { root } from './pipeline/process.mjs';
import { Verdicts, runAlone } from './pipeline/report.mjs';
import { publishedPackages } from './pipeline/workspace.mjs';

const textOf = (manifest) => `${JSON.stringify(manifest, undefined, 2)}\n`;
const HOW = 'run "node tools/check-manifests.mjs --write"';

export async function checkManifests({ base = root, write = process.argv.includes('--write') } = {}) {
  const verdicts = new Verdicts();
  const rootManifest = JSON.parse(readFileSync(join(base, 'package.json'), 'utf8'));
  const license = readFileSync(join(base, 'LICENSE'), 'utf8');
  for (const { name, short, dir, manifest } of publishedPackages(base)) {
    const where = `packages/${short}`;
    const own = (manifest.keywords ?? []).filter((word) => !(rootManifest.keywords ?? []).includes(word));
    verdicts.expect(own.length >= 2, `${where}: "keywords" has fewer than two of its own.`);
    verdicts.expect(
      STABILITY.includes(manifest.glanz?.stability),
      `${where}: "glanz.stability" must be one of ${STABILITY.join(', ')}.`,
    );
    const files = [
      [
        'package.json',
        textOf(completeManifest(manifest, rootManifest, where)),
        "differs from what the root's package.json says",
      ],
      ['LICENSE', license, 'is not the LICENSE of the root'],
    ];
    for (const [file, text, fault] of files) {
      const path = join(dir, file);
      const there = existsSync(path) ? readFileSync(path, 'utf8') : undefined;
      if (write && there !== text) writeFileSync(path, text);
      else verdicts.expect(there === text, `${where}/${file} ${fault}: ${HOW}.`);
    }
    const changelog = join(dir, 'CHANGELOG.md');
    // Changesets adds its entries below the first line.
    if (write && !existsSync(changelog))
      writeFileSync(changelog, `# ${name}\n\nNo version before 0.1.0 was published.\n`);
    else verdicts.expect(existsSync(changelog), `${where} has no CHANGELOG.md: ${HOW}.`);
  }
  verdicts.table.push(
    `${publishedPackages(base).length} packages${rootManifest.repository?.url ? '' : '; the root\'s "repository.url" is empty, so nothing can be published'}`,
  );
  return verdicts;
}

await runAlone(import.meta, checkManifests);
