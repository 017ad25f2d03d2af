import { basename, dirname, resolve } from 'node:path';
import type { Backend } from '../../backend';
import { EXIT } from '../../errors';
import { openJdTemplate } from '../../farm/openjd';
import type { PlannedImage } from '../../farm/plan';
import type { CliIo } from '../../io';
import { writeWhole } from '../../output/write';
import type { ProgressReporter } from '../../progress';
import { jsonLine, visible } from '../../visible';
import { openPlan } from './open-plan';
import { openStore } from './open-store';
import type { FarmCommand } from './parse';

/**
 * `glanz farm submit BATCH --openjd FILE`: writes a job template of Open Job Description, whose tasks are
 * `glanz farm task`. Gives the exit code.
 */
export async function writeTemplate(
  command: FarmCommand,
  io: CliIo,
  backend: Backend,
  progress: ProgressReporter,
): Promise<number> {
  const plan = await openPlan(command, io, backend, progress);
  await plan.check();
  const store = await openStore(command, io);
  const images: Pick<PlannedImage, 'shot' | 'requests'>[] = [];
  for await (const { shot, requests } of plan.images(store)) images.push({ shot, requests });
  const batch = resolve(io.cwd, command.args[0] as string);
  const file = command.openjd as string;
  const template = openJdTemplate(basename(batch), images, {
    folder: dirname(resolve(io.cwd, file)),
    batch,
    store: store.address,
    outputRoot: plan.outputRoot,
    cwd: io.cwd,
    split: command.split,
    gpu: command.gpus[0],
    values: command.values,
  });
  await writeWhole(file, io.cwd, [new TextEncoder().encode(`${JSON.stringify(template, undefined, 2)}\n`)]);
  progress.clear();
  if (command.json) io.stdout(jsonLine({ ok: true, images: images.length, openjd: file }));
  else if (!command.quiet) io.stderr(`${visible(`${file}: ${images.length} images`)}\n`);
  return EXIT.ok;
}
