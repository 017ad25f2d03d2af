import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, describe, expect, it } from 'vitest';
import { managerOf, runCommand } from '../src/command';
import { writeProject, type CreateProjectOptions } from '../src/create-project';
import { CreateError, TEMPLATES } from '../src/index';

const home = fileURLToPath(new URL('..', import.meta.url));
const { version } = JSON.parse(readFileSync(join(home, 'package.json'), 'utf8')) as { version: string };

const base = mkdtempSync(join(tmpdir(), 'create-glanz-'));
afterAll(() => rmSync(base, { recursive: true, force: true }));
let count = 0;
const empty = () => {
  const folder = join(base, String(count++));
  mkdirSync(folder);
  return folder;
};

// Stands for the sample that a build writes.
const model = join(base, 'model.glb');
writeFileSync(model, 'glTF');
const create = (options: CreateProjectOptions) => writeProject(options, model);

/** Runs the command. @returns Its exit code, what it printed, and what it asked. */
async function run(argv: readonly string[], answers?: readonly string[], userAgent?: string) {
  const cwd = empty();
  const printed: string[] = [];
  const errors: string[] = [];
  const asked: string[] = [];
  const left = [...(answers ?? [])];
  const code = await runCommand(
    argv,
    {
      cwd,
      userAgent,
      print: (line) => void printed.push(line),
      printError: (line) => void errors.push(line),
      ...(answers
        ? {
            ask: async (question: string, initial: string) => {
              asked.push(question);
              return left.shift() || initial;
            },
          }
        : {}),
    },
    create,
  );
  return { code, cwd, printed: printed.join('\n'), errors: errors.join('\n'), asked };
}

/** The packages that changesets keeps at the version of this one. */
const together = (
  JSON.parse(readFileSync(join(home, '../../.changeset/config.json'), 'utf8')) as { fixed: string[][] }
).fixed.find((group) => group.includes('create-glanz'));

interface Manifest {
  readonly name: string;
  readonly scripts: Readonly<Record<string, string>>;
  readonly dependencies: Readonly<Record<string, string>>;
  readonly devDependencies: Readonly<Record<string, string>>;
}

describe.each(TEMPLATES)('$name', ({ name: template }) => {
  it('asks for what its sources import, in the versions of this package', async () => {
    const { folder, files } = await create({ folder: 'My Shop', template, cwd: empty() });
    const manifest = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')) as Manifest;
    expect(manifest.name).toBe('my-shop');
    expect(Object.keys(manifest.scripts)).toEqual(expect.arrayContaining(['dev', 'build']));
    const declared = { ...manifest.dependencies, ...manifest.devDependencies };
    const imported = new Set(
      files
        .filter((file) => /\.(ts|tsx|mjs)$/.test(file))
        .flatMap((file) => [
          ...readFileSync(join(folder, file), 'utf8').matchAll(/(?:from|import) '((?:@[\w-]+\/)?[\w-]+)/g),
        ])
        .map(([, name]) => name!),
    );
    expect(imported.size).toBeGreaterThan(0);
    expect(Object.keys(declared)).toEqual(expect.arrayContaining([...imported]));
    const ours = Object.entries(declared).filter(([name]) => name.startsWith('@glanz/'));
    expect(ours.length).toBeGreaterThan(0);
    for (const [, range] of ours) expect(range).toBe(`^${version}`);
    // The version is that of create-glanz, which has to be that of each package here.
    expect(together).toEqual(expect.arrayContaining(ours.map(([name]) => name)));
  });

  it('leaves no placeholder, and has what npm would drop', async () => {
    const { folder, files } = await create({ folder: 'x', template, cwd: empty() });
    expect(files).toEqual(expect.arrayContaining(['.gitignore', 'package.json', 'public/push-button.glb']));
    expect(readFileSync(join(folder, '.gitignore'), 'utf8')).toContain('node_modules');
    for (const file of files) {
      expect(file).not.toContain('_gitignore');
      expect(readFileSync(join(folder, file), 'utf8'), file).not.toMatch(/GLANZ_[A-Z]/);
    }
  });
});

it('has a template for each folder, and a folder for each template', () => {
  expect(readdirSync(join(home, 'templates')).sort()).toEqual(TEMPLATES.map(({ name }) => name).sort());
});

it.each([
  ['shop', 'shop'],
  ['Éclair & Co', 'clair-co'],
  ['.hidden', 'hidden'],
])('of the folder "%s" the package is called %s', async (folder, name) => {
  expect((await create({ folder, cwd: empty() })).name).toBe(name);
});

describe('what cannot be is refused, and nothing is written', () => {
  it('a folder with files in it; one with a .git alone is taken', async () => {
    const cwd = empty();
    mkdirSync(join(cwd, 'a'));
    writeFileSync(join(cwd, 'a', 'notes.txt'), 'mine');
    await expect(create({ folder: 'a', cwd })).rejects.toMatchObject({ code: 'create-glanz/folder' });
    expect(readdirSync(join(cwd, 'a'))).toEqual(['notes.txt']);
    mkdirSync(join(cwd, 'b', '.git'), { recursive: true });
    const { files } = await create({ folder: 'b', cwd });
    expect(files).toContain('package.json');
  });

  it('a file in place of the folder', async () => {
    const cwd = empty();
    writeFileSync(join(cwd, 'a'), '');
    await expect(create({ folder: 'a', cwd })).rejects.toMatchObject({ code: 'create-glanz/folder' });
  });

  it('a name of no letters, and a template that there is not', async () => {
    const cwd = empty();
    await expect(create({ folder: '---', cwd })).rejects.toMatchObject({ code: 'create-glanz/name' });
    const wrong = create({ folder: 'a', template: 'svelte' as 'react', cwd });
    await expect(wrong).rejects.toBeInstanceOf(CreateError);
    await expect(wrong).rejects.toThrow(/"svelte".*vanilla, react, next, three, configurator/);
    expect(readdirSync(cwd)).toEqual([]);
  });

  it('a model that cannot be read is an error with its cause', async () => {
    const failing = writeProject({ folder: 'a', cwd: empty() }, join(base, 'none.glb'));
    await expect(failing).rejects.toMatchObject({ code: 'create-glanz/write', cause: { code: 'ENOENT' } });
  });
});

describe('the command', () => {
  it('creates what its arguments say, and prints what comes next', async () => {
    const { code, cwd, printed } = await run(['shop', '--template', 'react']);
    expect(code).toBe(0);
    expect(existsSync(join(cwd, 'shop', 'src', 'App.tsx'))).toBe(true);
    expect(printed).toMatch(/ {2}cd shop\n {2}npm install\n {2}npm run dev$/);
  });

  it('asks nothing without a terminal: the first template, in a folder of its own', async () => {
    const { code, cwd } = await run([]);
    expect([code, readdirSync(cwd)]).toEqual([0, ['glanz-app']]);
    expect(existsSync(join(cwd, 'glanz-app', 'src', 'main.ts'))).toBe(true);
  });

  it('asks for what is missing; a template by its number or its name', async () => {
    const byNumber = await run([], ['shop', '2']);
    expect(byNumber.asked).toEqual(['Folder', 'Template']);
    expect(existsSync(join(byNumber.cwd, 'shop', 'src', 'App.tsx'))).toBe(true);
    const byName = await run(['shop'], ['next']);
    expect(byName.asked).toEqual(['Template']);
    expect(existsSync(join(byName.cwd, 'shop', 'app', 'page.tsx'))).toBe(true);
    expect((await run(['shop', '-t', 'vanilla'], [])).asked).toEqual([]);
  });

  it('takes the folder where it is, and its name', async () => {
    const { code, cwd, printed } = await run(['.']);
    expect(code).toBe(0);
    expect(existsSync(join(cwd, 'package.json'))).toBe(true);
    expect(printed).not.toContain('cd ');
  });

  it('names the package manager that started it', async () => {
    expect((await run(['shop'], undefined, 'pnpm/11.0.0 npm/? node/v20.20.0')).printed).toContain('  pnpm install\n');
    expect([managerOf('yarn/4.0.0'), managerOf('bun/1.2'), managerOf('strange'), managerOf(undefined)]).toEqual([
      'yarn',
      'bun',
      'npm',
      'npm',
    ]);
  });

  it.each([
    [['a', 'b'], /one folder/],
    [['--colour'], /--colour/],
    [['a', '--template', 'svelte'], /no template "svelte"/],
  ])('%j fails in one line', async (argv, message) => {
    const { code, cwd, errors } = await run(argv, ['never', 'asked']);
    expect([code, readdirSync(cwd)]).toEqual([1, []]);
    expect(errors).toMatch(message);
    expect(errors).not.toContain('\n');
  });

  it('its help names all templates', async () => {
    const { code, cwd, printed } = await run(['--help']);
    expect([code, readdirSync(cwd)]).toEqual([0, []]);
    for (const { name, title } of TEMPLATES) expect(printed).toContain(`${name.padEnd(13)} ${title}`);
  });
});
