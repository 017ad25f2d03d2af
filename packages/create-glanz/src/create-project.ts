import { cp, mkdir, readdir, readFile, rename, writeFile } from 'node:fs/promises';
import { basename, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { CreateError } from './errors';
import { templateOf, type TemplateName } from './templates';

/** What {@link createProject} is to make. */
export interface CreateProjectOptions {
  /** The project's folder, relative to `cwd`; it may exist where it is empty (a `.git` in it does not count). */
  readonly folder: string;
  /** @defaultValue 'vanilla' */
  readonly template?: TemplateName;
  /** @defaultValue the folder of the process */
  readonly cwd?: string;
}

/** A project that was created. */
export interface CreatedProject {
  /** Absolute path. */
  readonly folder: string;
  /** Name in its package.json: the last part of the folder, as npm accepts it. */
  readonly name: string;
  /** Files that were written, relative to the folder, with `/`, sorted. */
  readonly files: readonly string[];
}

/** The package's own folder: one above `src`, and above `dist`. */
const home = fileURLToPath(new URL('..', import.meta.url));

/** A name for a package out of a folder's: lower case, only letters, digits, and `.`, `_`, `-` within. */
function packageName(folder: string): string {
  const name = basename(folder)
    .toLowerCase()
    .replace(/[^a-z0-9._-]+/g, '-')
    .replace(/^[._-]+|-+$/g, '');
  if (name === '' || name.length > 214 || name === 'node_modules')
    throw new CreateError(
      'create-glanz/name',
      `"${basename(folder)}" gives no name for a package: choose a folder with letters or digits in its name.`,
    );
  return name;
}

async function refuseFilled(folder: string): Promise<void> {
  let entries: string[];
  try {
    entries = await readdir(folder);
  } catch (cause) {
    if ((cause as NodeJS.ErrnoException).code === 'ENOENT') return;
    throw new CreateError('create-glanz/folder', `${folder} is not a folder that can be read.`, { cause });
  }
  const [first] = entries.filter((entry) => entry !== '.git');
  if (first !== undefined)
    throw new CreateError('create-glanz/folder', `${folder} is not empty: it has ${first} in it. Choose another one.`);
}

/** Paths of all files below a folder, relative to it, with `/`. */
async function filesBelow(folder: string): Promise<string[]> {
  const entries = await readdir(folder, { withFileTypes: true, recursive: true });
  return entries
    .filter((entry) => entry.isFile())
    .map((entry) =>
      join(entry.parentPath, entry.name)
        .slice(folder.length + 1)
        .replaceAll('\\', '/'),
    )
    .filter((path) => !path.startsWith('.git/'))
    .sort();
}

/**
 * Writes a project that shows a path-traced model: the files of a template, a sample model, and a package.json with the
 * versions of Glanz that this package was published with. Nothing is installed or downloaded.
 *
 * @throws {CreateError} `create-glanz/template`, `create-glanz/name`, `create-glanz/folder`, `create-glanz/write`; where
 * one of the first three is thrown, nothing was written.
 *
 * @example
 * const { folder } = await createProject({ folder: 'shop', template: 'configurator' });
 */
export const createProject = (options: CreateProjectOptions): Promise<CreatedProject> =>
  writeProject(options, join(home, 'dist', 'push-button.glb'));

/** What {@link createProject} does, with the sample model's file. */
export async function writeProject(options: CreateProjectOptions, model: string): Promise<CreatedProject> {
  const template = templateOf(options.template ?? 'vanilla');
  const folder = resolve(options.cwd ?? process.cwd(), options.folder);
  const name = packageName(folder);
  await refuseFilled(folder);
  const { version } = JSON.parse(await readFile(join(home, 'package.json'), 'utf8')) as { version: string };
  try {
    await mkdir(folder, { recursive: true });
    await cp(join(home, 'templates', template.name), folder, { recursive: true });
    // npm leaves a .gitignore out of what it packs.
    await rename(join(folder, '_gitignore'), join(folder, '.gitignore'));
    const manifest = join(folder, 'package.json');
    const text = await readFile(manifest, 'utf8');
    await writeFile(manifest, text.replaceAll('GLANZ_VERSION', version).replaceAll('GLANZ_NAME', name));
    await mkdir(join(folder, 'public'), { recursive: true });
    await cp(model, join(folder, 'public', 'push-button.glb'));
  } catch (cause) {
    throw new CreateError('create-glanz/write', `${folder} cannot be written: ${(cause as Error).message}`, { cause });
  }
  return { folder, name, files: await filesBelow(folder) };
}
