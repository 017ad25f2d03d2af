#!/usr/bin/env node
import { EXIT } from './errors';
import { runCli } from './run';

// A reader that has seen enough (`| head -1`) is no failure; a result that a full disk has cut off is one.
process.stdout.on('error', ({ code }: NodeJS.ErrnoException) => {
  if (code !== 'EPIPE') process.exitCode ||= EXIT.output;
});
// Not process.exit(): what has been written to the streams must get out.
process.exitCode = (await runCli(process.argv.slice(2))) || (process.exitCode ?? 0);
