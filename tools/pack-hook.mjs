// Runs around the packing and publishing of one package, from its folder: as "prepack", "postpack" and "prepublishOnly"
// of its manifest, so that npm, pnpm and changesets all come through here.
//
// prepack     links of the README become absolute, because a registry's page has nothing beside it
// postpack    the README is again that of the repository
// prepublish  refuses while the repository has no address: a version without it cannot be corrected afterwards
import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { basename, join, resolve } from 'node:path';
import { absoluteLinks, webAddress } from './pipeline/manifest.mjs';
import { TaskError, main } from './pipeline/process.mjs';

const dir = process.cwd();
const base = resolve(dir, '../..');
const readme = join(dir, 'README.md');
const kept = join(base, '.cache', 'readme', `${basename(dir)}.md`);

function restore() {
  if (existsSync(kept)) renameSync(kept, readme);
}

await main(async () => {
  const web = webAddress(JSON.parse(readFileSync(join(base, 'package.json'), 'utf8')));
  const step = process.argv[2];
  if (step === 'postpack') return restore();
  if (step === 'prepublish') {
    if (web) return undefined;
    throw new TaskError(
      'The package.json of the root has no "repository.url", so nothing is published: set it, then run "node tools/check-manifests.mjs --write" and commit.',
    );
  }
  if (step !== 'prepack')
    throw new TaskError(`pack-hook: there is no step "${step}"; steps: prepack, postpack, prepublish.`);
  // An earlier run may have been ended between the two steps.
  restore();
  if (!web) return undefined;
  const text = readFileSync(readme, 'utf8');
  mkdirSync(join(base, '.cache', 'readme'), { recursive: true });
  writeFileSync(kept, text);
  writeFileSync(readme, absoluteLinks(text, web, `packages/${basename(dir)}`));
  return undefined;
});
