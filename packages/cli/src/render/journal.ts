import { createHash } from 'node:crypto';
import { appendFile, constants, readFile, stat } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import { CliError } from '../errors';
import type { WrittenFile } from '../output/write';
import { version } from '../version';
import type { Shot } from './shots';

/** Lies beside the first file of an image. A line of JSON for each image that is done. */
export const JOURNAL = '.glanz-journal.jsonl';

// Not through a link in its place.
const APPEND = constants.O_WRONLY | constants.O_CREAT | constants.O_APPEND | (constants.O_NOFOLLOW ?? 0);

const fileOf = (shot: Shot, cwd: string) =>
  join(dirname(resolve(cwd, (shot.outputs[0] as Shot['outputs'][number]).path)), JOURNAL);

/** What a file is, for telling whether it has changed. */
async function stamp(path: string | undefined, cwd: string): Promise<string> {
  if (path === undefined) return '';
  const found = await stat(resolve(cwd, path)).catch(() => undefined);
  return found ? `${found.size} ${found.mtimeMs}` : '';
}

/** An image's identity: everything that decides its pixels, and the state of the files that it is made of. */
export async function keyOf({ options, variant, view, outputs, motion }: Shot, cwd: string): Promise<string> {
  const { variants: _, views: __, outputs: ___, ...rest } = options;
  const camera = view.kind === 'camera' && view.camera?.endsWith('.json') ? await stamp(view.camera, cwd) : '';
  const text = JSON.stringify([
    version(),
    rest,
    variant,
    view,
    outputs,
    await stamp(options.model, cwd),
    await stamp(options.env, cwd),
    camera,
    ...(motion ? [motion] : []),
  ]);
  return createHash('sha256').update(text).digest('hex').slice(0, 32);
}

/** Images that are done, by their journals. */
export class Journal {
  readonly #cwd: string;
  readonly #read = new Map<string, Promise<Map<string, readonly WrittenFile[]>>>();

  constructor(cwd: string) {
    this.#cwd = cwd;
  }

  /** Whether an image was finished by an earlier run, with nothing changed since. */
  async isDone(shot: Shot): Promise<boolean> {
    const file = fileOf(shot, this.#cwd);
    let entries = this.#read.get(file);
    if (!entries) this.#read.set(file, (entries = readJournal(file)));
    const files = (await entries).get(await keyOf(shot, this.#cwd));
    if (!files) return false;
    const sizes = await Promise.all(
      files.map(({ path }) =>
        stat(resolve(this.#cwd, path)).then(
          ({ size }) => size,
          () => -1,
        ),
      ),
    );
    return files.every(({ bytes }, i) => sizes[i] === bytes);
  }

  /** Notes that an image is done; its files are there already. */
  async done(shot: Shot, files: readonly WrittenFile[]): Promise<void> {
    const file = fileOf(shot, this.#cwd);
    await appendFile(file, `${JSON.stringify({ key: await keyOf(shot, this.#cwd), files })}\n`, { flag: APPEND }).catch(
      (cause: unknown) => {
        throw new CliError('cli/output', `Cannot write "${file}": ${(cause as Error).message}.`, {
          cause,
          location: { file },
        });
      },
    );
  }
}

async function readJournal(file: string): Promise<Map<string, readonly WrittenFile[]>> {
  const text = await readFile(file, 'utf8').catch(() => '');
  const entries = new Map<string, readonly WrittenFile[]>();
  for (const line of text.split('\n')) {
    // The last line of a run that was killed may be cut off.
    try {
      const { key, files } = JSON.parse(line) as { key: string; files: readonly WrittenFile[] };
      if (typeof key === 'string' && Array.isArray(files)) entries.set(key, files);
    } catch {
      continue;
    }
  }
  return entries;
}
