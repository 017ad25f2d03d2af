import { nodeBackend, type Backend } from './backend';
import { benchCommand } from './commands/bench';
import { convertCommand } from './commands/convert';
import { infoCommand } from './commands/info';
import { listGpusCommand } from './commands/list-gpus';
import { mergeCommand } from './commands/merge';
import { renderCommand } from './commands/render';
import { serveCommand } from './commands/serve';
import { describeError, errorLine, EXIT, exitCodeOf } from './errors';
import { helpOf } from './help';
import { nodeIo, type CliIo } from './io';
import { parseCommand } from './command';
import { ProgressReporter } from './progress';
import { version } from './version';
import { jsonLine, visible } from './visible';

/**
 * Runs the `glanz` command in this process.
 *
 * @param argv Arguments without `node` and script: `['render', 'model.glb', '-o', 'out.png']`.
 * @param io Where output goes and interrupts come from; default: this process.
 * @param backend Loader and renderer; default: the real ones.
 * @returns The exit code. Never throws, never ends the process.
 */
export async function runCli(
  argv: readonly string[],
  io: CliIo = nodeIo(),
  backend: Backend = nodeBackend(),
): Promise<number> {
  // Even a command line that cannot be read may have asked for JSON.
  let json = argv.includes('--json');
  try {
    const command = parseCommand(argv);
    if (command.kind === 'help') {
      io.stdout(helpOf(command.topic));
      return EXIT.ok;
    }
    if (command.kind === 'version') {
      io.stdout(`${version()}\n`);
      return EXIT.ok;
    }
    json = command.json;
    if (command.kind === 'convert') return await convertCommand(command, io);
    if (command.kind === 'info') return await infoCommand(command, io, backend);
    if (command.kind === 'bench')
      return await benchCommand(command, io, backend, new ProgressReporter(io, command.quiet));
    if (command.kind === 'serve') return await serveCommand(command, io);
    if (command.kind === 'farm') return await (await import('./commands/farm/run')).farmCommand(command, io, backend);
    if (command.kind === 'merge') return await mergeCommand(command, io, backend);
    if (command.kind === 'list-gpus') return await listGpusCommand(command, io, backend);
    if (command.kind === 'video') {
      const { videoCommand } = await import('./commands/video');
      const { result, exitCode } = await videoCommand(command, io, backend, new ProgressReporter(io, command.quiet));
      if (json && result) io.stdout(jsonLine(result));
      return exitCode;
    }
    const { result, exitCode } = await renderCommand(command, io, backend, new ProgressReporter(io, command.quiet));
    if (json)
      io.stdout(
        jsonLine(
          result ?? { ok: false, error: { code: 'cli/interrupted', message: 'Interrupted before the first sample.' } },
        ),
      );
    return exitCode;
  } catch (error) {
    io.stderr(`glanz: ${errorLine(error)}\n`);
    if (io.debug && error instanceof Error)
      io.stderr(
        `${[error.stack ?? '', ...(error.cause instanceof Error ? [`caused by ${error.cause.stack}`] : [])].join('\n').split('\n').map(visible).join('\n')}\n`,
      );
    if (json) io.stdout(jsonLine({ ok: false, error: describeError(error) }));
    return exitCodeOf(error);
  }
}
