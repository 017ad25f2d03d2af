import { resolve } from 'node:path';
import { FolderStore, statusServer, type FarmQueue } from '@glanz/farm';
import { EXIT } from '../../errors';
import type { CliIo } from '../../io';
import { jsonLine, visible } from '../../visible';
import { listen } from '../serve';
import type { FarmCommand } from './parse';

/** `glanz farm serve`: a read-only page about the farm, until Ctrl-C. Gives the exit code. */
export async function serveFarm(
  { host, port, json, quiet, store }: FarmCommand,
  queue: FarmQueue,
  io: CliIo,
): Promise<number> {
  const server = statusServer(queue, new FolderStore(resolve(io.cwd, store)));
  await listen(server, port, host);
  const { port: actual } = server.address() as { readonly port: number };
  const url = `http://${host.includes(':') ? `[${host}]` : host}:${actual}/`;
  if (json) io.stdout(jsonLine({ ok: true, url }));
  else if (!quiet) io.stderr(`${visible(url)} — Ctrl-C ends\n`);
  await new Promise<void>((done) => {
    const stop = io.onInterrupt(() => {
      stop();
      done();
    });
  });
  server.closeAllConnections();
  await new Promise<void>((done) => server.close(() => done()));
  return EXIT.ok;
}
