import type { Backend } from '../backend';
import type { CliIo } from '../io';
import type { ReportOptions } from '../options';

/** `glanz --list-gpus`: what could render here. */
export async function listGpusCommand(report: ReportOptions, io: CliIo, backend: Backend): Promise<void> {
  const gpus = await backend.listGpus();
  if (report.json) io.stdout(`${JSON.stringify({ ok: true, gpus })}\n`);
  else for (const { name, software } of gpus) io.stdout(`${name}${software ? '  (software)' : ''}\n`);
}
