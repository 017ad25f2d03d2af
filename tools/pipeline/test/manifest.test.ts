import { execFile } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { afterAll, describe, expect, it } from 'vitest';
import { checkManifests } from '../../check-manifests.mjs';
import { absoluteLinks, completeManifest, errorsPage, webAddress } from '../manifest.mjs';

const run = promisify(execFile);
const hook = fileURLToPath(new URL('../../pack-hook.mjs', import.meta.url));
const WEB = 'https://git.example/someone/glanz';
const README =
  '# @glanz/bvh\n\nSee [the scene](../scene), [`rays`](src/rays.ts), [rules](../../CONTRIBUTING.md#rules), [MDN](https://developer.mozilla.org), [below](#below).\n\n![image](../../media/a.webp)\n\n```md\n[kept](../scene)\n```\n';

describe('fields that all manifests share', () => {
  const root = {
    author: 'Glanz contributors',
    license: 'MIT',
    keywords: ['webgpu'],
    repository: { type: 'git', url: `git+${WEB}.git` },
  };

  it('come from the root, with the folder of the package', () => {
    expect(completeManifest({ name: '@glanz/bvh', keywords: ['bvh'] }, root, 'packages/bvh')).toMatchObject({
      keywords: ['bvh', 'webgpu'],
      author: 'Glanz contributors',
      license: 'MIT',
      homepage: `${WEB}/tree/HEAD/packages/bvh#readme`,
      bugs: { url: `${WEB}/issues` },
      repository: { type: 'git', url: `git+${WEB}.git`, directory: 'packages/bvh' },
      publishConfig: { access: 'public', provenance: true },
    });
  });

  it('keep the licence of a package that holds files of others', () => {
    const license = 'MIT AND Apache-2.0';
    expect(completeManifest({ name: '@glanz/bvh', license, glanz: { license } }, root, 'packages/bvh').license).toBe(
      license,
    );
    expect(completeManifest({ name: '@glanz/bvh', license }, root, 'packages/bvh').license).toBe('MIT');
  });

  it('name no address while the root has none, and completing twice changes nothing', () => {
    const unset = { ...root, repository: { type: 'git', url: '' } };
    expect(webAddress(unset)).toBeUndefined();
    const once = completeManifest(
      { name: '@glanz/bvh', keywords: ['bvh'], homepage: 'https://old.example' },
      unset,
      'packages/bvh',
    );
    expect(Object.keys(once)).not.toEqual(expect.arrayContaining(['homepage']));
    expect(once).not.toHaveProperty('repository');
    expect(completeManifest(once, unset, 'packages/bvh')).toEqual(once);
  });
});

it('relative links become absolute outside of code', () => {
  const text = absoluteLinks(README, WEB, 'packages/bvh');
  expect(text).toContain(`[the scene](${WEB}/tree/HEAD/packages/scene)`);
  expect(text).toContain(`[\`rays\`](${WEB}/blob/HEAD/packages/bvh/src/rays.ts)`);
  expect(text).toContain(`[rules](${WEB}/blob/HEAD/CONTRIBUTING.md#rules)`);
  expect(text).toContain(`![image](${WEB}/raw/HEAD/media/a.webp)`);
  for (const same of ['(https://developer.mozilla.org)', '(#below)', '[kept](../scene)']) expect(text).toContain(same);
});

it('the page on errors is part of the documentation, else of the repository', () => {
  const repository = { type: 'git', url: `git+${WEB}.git` };
  expect(errorsPage({ repository, homepage: 'https://glanz.example/' })).toBe('https://glanz.example/guide/errors');
  expect(errorsPage({ repository })).toBe(`${WEB}/blob/HEAD/apps/docs/guide/errors.md`);
  expect(errorsPage({ repository: { type: 'git', url: '' } })).toBeUndefined();
});

describe('npm pack', () => {
  const base = mkdtempSync(join(tmpdir(), 'glanz-pack-'));
  const dir = join(base, 'packages', 'bvh');
  afterAll(() => rmSync(base, { recursive: true, force: true }));
  const put = (path: string, text: string) => writeFileSync(join(base, path), text);
  const rootManifest = (url: string) =>
    put(
      'package.json',
      JSON.stringify({
        name: 'root',
        author: 'Glanz contributors',
        license: 'MIT',
        keywords: ['webgpu'],
        repository: { type: 'git', url },
      }),
    );
  mkdirSync(join(dir, 'dist'), { recursive: true });
  put('LICENSE', 'MIT License\n');
  put('packages/bvh/README.md', README);
  put('packages/bvh/dist/index.js', 'export {};\n');
  const scripts = Object.fromEntries(
    Object.entries({ prepack: 'prepack', postpack: 'postpack', prepublishOnly: 'prepublish' }).map(([name, step]) => [
      name,
      `node ${JSON.stringify(hook)} ${step}`,
    ]),
  );
  const manifest = {
    name: '@glanz/bvh',
    version: '0.0.0',
    keywords: ['bvh', 'rays'],
    glanz: { stability: 'beta' },
    files: ['dist', 'CHANGELOG.md'],
  };
  put('packages/bvh/package.json', JSON.stringify(manifest));

  /** Packs the package, with the hooks of this checkout, and unpacks what came of it. */
  async function packed(): Promise<(file: string) => string> {
    put(
      'packages/bvh/package.json',
      JSON.stringify({ ...(JSON.parse(readFileSync(join(dir, 'package.json'), 'utf8')) as object), scripts }),
    );
    await run('npm', ['pack', '--pack-destination', base, '--loglevel', 'error'], { cwd: dir });
    await run('tar', ['-xzf', join(base, 'glanz-bvh-0.0.0.tgz'), '-C', base]);
    return (file) => readFileSync(join(base, 'package', file), 'utf8');
  }

  it('finds what the check has written: LICENSE, CHANGELOG, manifest; the README has absolute links, and the source keeps its own', async () => {
    rootManifest(`git+${WEB}.git`);
    expect((await checkManifests({ base, write: false })).failed).toBe(3);
    await checkManifests({ base, write: true });
    expect((await checkManifests({ base, write: false })).lines).toEqual([]);
    const read = await packed();
    expect(read('LICENSE')).toBe('MIT License\n');
    expect(read('CHANGELOG.md')).toMatch(/^# @glanz\/bvh\n/);
    expect(read('README.md')).toContain(`${WEB}/tree/HEAD/packages/scene`);
    expect(JSON.parse(read('package.json'))).toMatchObject({ repository: { directory: 'packages/bvh' } });
    expect(readFileSync(join(dir, 'README.md'), 'utf8')).toBe(README);
  });

  it('leaves the README alone while there is no address, and publishing is refused', async () => {
    rootManifest('');
    expect((await packed())('README.md')).toBe(README);
    const refused = await run(process.execPath, [hook, 'prepublish'], { cwd: dir }).catch(
      (error: { code: number; stderr: string }) => error,
    );
    expect(refused).toMatchObject({ code: 1, stderr: expect.stringContaining('repository.url') });
    rootManifest(WEB);
    await expect(run(process.execPath, [hook, 'prepublish'], { cwd: dir })).resolves.toBeDefined();
  });

  it('a README that an earlier run left changed comes back', async () => {
    rootManifest(WEB);
    await run(process.execPath, [hook, 'prepack'], { cwd: dir });
    expect(readFileSync(join(dir, 'README.md'), 'utf8')).not.toBe(README);
    await run(process.execPath, [hook, 'prepack'], { cwd: dir });
    await run(process.execPath, [hook, 'postpack'], { cwd: dir });
    expect(readFileSync(join(dir, 'README.md'), 'utf8')).toBe(README);
  });
});
