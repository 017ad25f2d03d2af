import type { Backend } from '../backend';
import { EXIT } from '../errors';
import { numbered } from '../gpus/choose-gpus';
import type { CliIo } from '../io';
import type { ReportOptions } from '../options';
import { jsonLine, visible } from '../visible';

/** `glanz --list-gpus`: what could render here. Gives the exit code: an empty list is no success. */
export async function listGpusCommand(report: ReportOptions, io: CliIo, backend: Backend): Promise<number> {
  const gpus = await backend.listGpus();
  if (report.json) io.stdout(jsonLine({ ok: gpus.length > 0, gpus }));
  else if (gpus.length === 0)
    io.stderr(
      'glanz: There is no GPU, nor a software one: install a Vulkan driver, Mesa 25 or newer, or the npm package @sparticuz/chromium (Linux x64). [renderer/no-adapter]\n',
    );
  else {
    const labels = numbered(gpus.map(({ name }) => name));
    for (const [i, { backend: api, driver, software }] of gpus.entries())
      io.stdout(
        `${visible(`${labels[i]} · ${api}${driver ? ` · ${driver}` : ''}${software ? ' · on the CPU' : ''}`)}\n`,
      );
  }
  return gpus.length > 0 ? EXIT.ok : EXIT.gpu;
}
