import { statusServer, type FarmQueue } from '@glanz/farm';
import type { CliIo } from '../../io';
import { serveUntilInterrupt } from '../serve';
import { openStore } from './open-store';
import type { FarmCommand } from './parse';

/** `glanz farm serve`: a read-only page about the farm, until Ctrl-C. Gives the exit code. */
export async function serveFarm(command: FarmCommand, queue: FarmQueue, io: CliIo): Promise<number> {
  return serveUntilInterrupt(statusServer(queue, await openStore(command, io)), command, io);
}
