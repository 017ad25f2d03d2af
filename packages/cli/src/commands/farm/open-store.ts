import { resolve } from 'node:path';
import { openFarmStore, type FarmStore } from '@glanz/farm';
import type { CliIo } from '../../io';
import type { FarmCommand } from './parse';

/** Opens the store that the command names. @throws {FarmError} */
export function openStore({ store: { url, endpoint, cache } }: FarmCommand, { cwd }: CliIo): Promise<FarmStore> {
  return openFarmStore(
    cache === undefined ? { url: resolve(cwd, url) } : { url, endpoint, cache: resolve(cwd, cache) },
  );
}
