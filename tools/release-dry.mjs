// npm run release:dry — what a release would publish, without publishing: the packed tarballs in out/packages, publint
// and attw on them, and the versions that the waiting changesets ask for.
import { statSync } from 'node:fs';
import { join, relative } from 'node:path';
import { checkPublished } from './check-published.mjs';
import { main, root } from './pipeline/process.mjs';
import { packAll } from './pipeline/packed.mjs';
import { accidentalMajors, releasePlan } from './pipeline/releases.mjs';
import { columns } from './pipeline/report.mjs';
import { publishedPackages } from './pipeline/workspace.mjs';

await main(async () => {
  const packages = await packAll(join(root, 'out', 'packages'));
  const plan = await releasePlan();
  const releases = new Map(plan.releases.map((release) => [release.name, release]));
  const rows = packages.map((p) => {
    const release = releases.get(p.name);
    return [
      p.name,
      release ? `${release.oldVersion} → ${release.newVersion}` : `${p.manifest.version}, unchanged`,
      release ? String(release.changesets.length) : '0',
      (statSync(p.tarball).size / 1000).toFixed(1),
      relative(root, p.tarball),
    ];
  });
  process.stdout.write(
    `${columns([['package', 'version', 'changesets', 'kB', 'tarball'], ...rows], [2, 3]).join('\n')}\n`,
  );
  const verdicts = await checkPublished();
  const without = publishedPackages().filter(
    ({ name, manifest }) => manifest.version === '0.0.0' && !releases.has(name),
  );
  verdicts.expect(
    without.length === 0,
    `no changeset releases ${without.map(({ name }) => name).join(', ')}, which was never released.`,
  );
  const majors = accidentalMajors(plan);
  verdicts.expect(
    majors.length === 0,
    `no changeset asks for the major version of ${majors.join(', ')}: a peer dependency leaves its range. Open the range (">=").`,
  );
  for (const line of [...verdicts.table, ...verdicts.lines]) process.stdout.write(`${line}\n`);
  process.stdout.write(`${verdicts.passed} passed, ${verdicts.failed} failed\n`);
  return verdicts.failed > 0 ? 1 : 0;
});
