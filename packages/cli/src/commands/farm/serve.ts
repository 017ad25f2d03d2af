import { resolve } from 'node:path';
import { FolderStore, statusServer, type FarmQueue } from '@glanz/farm';
import type { CliIo } from '../../io';
import { serveUntilInterrupt } from '../serve';
import type { FarmCommand } from './parse';

/** `glanz farm serve`: a read-only page about the farm, until Ctrl-C. Gives the exit code. */
export function serveFarm(command: FarmCommand, queue: FarmQueue, io: CliIo): Promise<number> {
  return serveUntilInterrupt(statusServer(queue, new FolderStore(resolve(io.cwd, command.store))), command, io);
}
