import { createWriteStream } from 'node:fs';
import { rename, rm } from 'node:fs/promises';
import { resolve } from 'node:path';
import { Readable } from 'node:stream';
import { pipeline } from 'node:stream/promises';
import { CliError, EXIT } from '../../errors';
import type { FarmPlan } from '../../farm/plan';
import type { CliIo } from '../../io';
import type { ProgressReporter } from '../../progress';
import { namesOf } from '../../render/results';
import { version } from '../../version';
import { jsonLine, visible } from '../../visible';
import { openStore } from './open-store';
import type { FarmCommand } from './parse';

/**
 * `glanz farm manifest`: writes the images of a batch that are finished, in the order of the batch, as JSON. Gives the
 * exit code: 1 while images are missing.
 */
export async function writeManifest(
  command: FarmCommand,
  plan: FarmPlan,
  io: CliIo,
  progress: ProgressReporter,
): Promise<number> {
  const { manifest, json, quiet } = command;
  await plan.check();
  const store = await openStore(command, io);
  const file = resolve(io.cwd, manifest as string);
  const partial = `${file}.${process.pid}.partial`;
  let images = 0;
  let missing = 0;
  async function* text() {
    yield `{"version":${JSON.stringify(version())},"images":[`;
    for await (const { id, shot, paths } of plan.images(store)) {
      const result = await store.result(id);
      if (!result) {
        missing++;
        continue;
      }
      await store.deliver(result, { root: plan.outputRoot, paths });
      const { options } = shot;
      yield `${images++ > 0 ? ',' : ''}\n${JSON.stringify({
        id,
        model: options.model,
        ...namesOf(shot),
        width: options.width,
        height: options.height,
        files: result.files.map(({ bytes, sha256 }, i) => ({ path: paths[i], bytes, sha256 })),
      })}`;
    }
    yield `\n],"missing":${missing}}\n`;
  }
  try {
    await pipeline(Readable.from(text()), createWriteStream(partial, { flags: 'wx' }));
    await rename(partial, file);
  } catch (cause) {
    await rm(partial, { force: true });
    if ((cause as NodeJS.ErrnoException).syscall === undefined) throw cause;
    throw new CliError('cli/output', `Cannot write "${manifest}": ${(cause as Error).message}.`, { cause });
  }
  progress.clear();
  if (json) io.stdout(jsonLine({ ok: missing === 0, images, missing, manifest }));
  else if (!quiet)
    io.stderr(`${visible(`${manifest}: ${images} images${missing > 0 ? `, ${missing} are missing` : ''}`)}\n`);
  return missing === 0 ? EXIT.ok : EXIT.failure;
}
