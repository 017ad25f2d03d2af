import { relative } from 'node:path';
import { parseArgs } from 'node:util';
import { createProject, type CreatedProject, type CreateProjectOptions } from './create-project';
import { CreateError } from './errors';
import { TEMPLATES, templateOf, type TemplateName } from './templates';

/** What the command reads and writes, so that tests can supply it. */
export interface CommandIo {
  readonly cwd: string;
  /** `npm_config_user_agent`, which package managers set: `pnpm/9.1.0 npm/? node/v20`. */
  readonly userAgent: string | undefined;
  readonly print: (line: string) => void;
  readonly printError: (line: string) => void;
  /** Asks the user, with an answer for an empty line; absent where there is no terminal. */
  readonly ask?: (question: string, initial: string) => Promise<string>;
}

const FOLDER = 'glanz-app';

const help = () => `npm create glanz [folder] -- [--template NAME]

Writes a project that shows a path-traced model.

  folder           where it goes; "${FOLDER}" without one
  --template NAME  ${TEMPLATES.map(({ name, title }) => `${name.padEnd(13)} ${title}`).join('\n                   ')}
  --help           this text`;

/** The package manager that runs the command. */
export const managerOf = (userAgent: string | undefined): string =>
  /^(npm|pnpm|yarn|bun)\//.exec(userAgent ?? '')?.[1] ?? 'npm';

/** The template that is asked for, by an option, by an answer, or by default. */
async function chooseTemplate(option: string | undefined, { ask, print }: CommandIo): Promise<TemplateName> {
  if (option !== undefined || !ask) return templateOf(option ?? TEMPLATES[0]!.name).name;
  TEMPLATES.forEach(({ name, title }, i) => print(`  ${i + 1}  ${name.padEnd(13)} ${title}`));
  const answer = (await ask('Template', TEMPLATES[0]!.name)).trim();
  return TEMPLATES[Number(answer) - 1]?.name ?? templateOf(answer).name;
}

function parse(argv: readonly string[]) {
  try {
    const { values, positionals } = parseArgs({
      args: [...argv],
      allowPositionals: true,
      options: { template: { type: 'string', short: 't' }, help: { type: 'boolean', short: 'h' } },
    });
    if (positionals.length > 1) throw new Error(`one folder is expected, not ${positionals.join(', ')}`);
    return { ...values, folder: positionals[0] };
  } catch (cause) {
    throw new CreateError('create-glanz/usage', `${(cause as Error).message}. --help lists the options.`, { cause });
  }
}

/** Runs the command. @returns Its exit code: 0, or 1 after a line that says what is wrong. */
export async function runCommand(
  argv: readonly string[],
  io: CommandIo,
  create: (options: CreateProjectOptions) => Promise<CreatedProject> = createProject,
): Promise<number> {
  try {
    const options = parse(argv);
    if (options.help) {
      io.print(help());
      return 0;
    }
    // A name that is wrong is refused before anything is asked.
    if (options.template !== undefined) templateOf(options.template);
    const folder = options.folder ?? (io.ask ? (await io.ask('Folder', FOLDER)).trim() : FOLDER);
    const template = await chooseTemplate(options.template, io);
    const created = await create({ folder, template, cwd: io.cwd });
    const manager = managerOf(io.userAgent);
    const path = relative(io.cwd, created.folder);
    io.print(`\n${created.name}: ${created.files.length} files in ${path || 'this folder'}. Next:\n`);
    if (path !== '') io.print(`  cd ${/\s/.test(path) ? JSON.stringify(path) : path}`);
    io.print(`  ${manager} install`);
    io.print(`  ${manager} run dev`);
    return 0;
  } catch (error) {
    if (!(error instanceof CreateError)) throw error;
    io.printError(error.message);
    return 1;
  }
}
