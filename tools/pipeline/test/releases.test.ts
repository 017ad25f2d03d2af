import { mkdirSync, mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { accidentalMajors, releasePlan } from '../releases.mjs';

const root = fileURLToPath(new URL('../../..', import.meta.url));

/** A workspace of two packages, of which the second one has the first as an optional peer. */
function workspace(range: string, changeset?: string): string {
  const base = mkdtempSync(join(tmpdir(), 'glanz-releases-'));
  const put = (file: string, text: string) => {
    mkdirSync(join(base, file, '..'), { recursive: true });
    writeFileSync(join(base, file), text);
  };
  put('package.json', JSON.stringify({ name: 'base', private: true, version: '0.0.0' }));
  put('pnpm-workspace.yaml', 'packages:\n  - packages/*\n');
  put('pnpm-lock.yaml', '');
  put('packages/cad/package.json', JSON.stringify({ name: '@x/cad', version: '0.1.0' }));
  put(
    'packages/cli/package.json',
    JSON.stringify({ name: '@x/cli', version: '0.1.0', peerDependencies: { '@x/cad': `workspace:${range}` } }),
  );
  const config = JSON.parse(readFileSync(join(root, '.changeset/config.json'), 'utf8')) as object;
  put('.changeset/config.json', JSON.stringify({ ...config, fixed: [] }));
  if (changeset !== undefined) put('.changeset/one.md', changeset);
  return base;
}

const MINOR = "---\n'@x/cad': minor\n---\n\nA part has a name.\n";

describe('the releases that changesets add up to', () => {
  it('are none where no changeset waits', async () => {
    expect(await releasePlan(workspace('^'))).toMatchObject({ changesets: [], releases: [] });
  });

  it('leave a package alone whose peer stays in an open range', async () => {
    const plan = await releasePlan(workspace('>=0.1.0', MINOR));
    expect(plan.releases.map(({ name, newVersion }) => `${name}@${newVersion}`)).toEqual(['@x/cad@0.2.0']);
    expect(accidentalMajors(plan)).toEqual([]);
  });

  it('name a package that would become 1.0.0 because a peer leaves its range', async () => {
    const plan = await releasePlan(workspace('^', MINOR));
    expect(accidentalMajors(plan)).toEqual(['@x/cli']);
  });

  it('take a major version that a changeset asks for', async () => {
    expect(accidentalMajors(await releasePlan(workspace('^', MINOR.replace('minor', 'major'))))).toEqual(['@x/cli']);
    const both = MINOR.replace('---\n\n', "'@x/cli': major\n---\n\n");
    expect(accidentalMajors(await releasePlan(workspace('^', both)))).toEqual([]);
  });
});
