import { statusServer, type FarmQueue } from '@glanz/farm';
import type { CliIo } from '../../io';
import { serveUntilInterrupt } from '../serve';
import { openStore } from './open-store';
import type { FarmCommand } from './parse';

/** `glanz farm serve`: a read-only page about the farm, until Ctrl-C. Gives the exit code. */
export async function serveFarm(command: FarmCommand, queue: FarmQueue, io: CliIo): Promise<number> {
  return serveUntilInterrupt(statusServer(queue, await openStore(command, io), thumbnailOf), command, io);
}

/** Twice the width that the page shows, for dense screens. */
const WIDTH = 400;

/** A small PNG of an image file, which is not held in memory as a whole. */
async function thumbnailOf(file: string): Promise<Uint8Array> {
  const { default: sharp } = await import('sharp');
  return sharp(file, { sequentialRead: true })
    .resize({ width: WIDTH, withoutEnlargement: true })
    .toColourspace('srgb')
    .png()
    .toBuffer();
}
