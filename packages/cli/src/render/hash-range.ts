import { createHash } from 'node:crypto';
import { createReadStream } from 'node:fs';
import { pipeline } from 'node:stream/promises';
import { Worker } from 'node:worker_threads';

/** From here on a thread pays, which takes some 30 ms to start. */
const THREAD_BYTES = 2 ** 26;

/** As text: the package has no file for it, and bundles need none. */
const SCRIPT = `
const { createHash } = require('node:crypto');
const { openSync, readSync } = require('node:fs');
const { parentPort, workerData: { file, start, bytes } } = require('node:worker_threads');
const hash = createHash('sha256');
const descriptor = openSync(file, 'r');
const buffer = new Uint8Array(2 ** 22);
for (let at = 0; at < bytes; ) {
  const count = readSync(descriptor, buffer, 0, Math.min(buffer.length, bytes - at), start + at);
  if (count === 0) break;
  hash.update(buffer.subarray(0, count));
  at += count;
}
parentPort.postMessage(hash.digest('hex'));
`;

/**
 * The SHA-256 of a part of a file, hexadecimal; of large ones on a thread of its own, so that several films are hashed
 * while they are added up.
 *
 * @param start In bytes.
 */
export async function hashRange(file: string, start: number, bytes: number): Promise<string> {
  if (bytes < THREAD_BYTES) {
    const hash = createHash('sha256');
    if (bytes > 0) await pipeline(createReadStream(file, { start, end: start + bytes - 1 }), hash);
    return hash.digest('hex');
  }
  const worker = new Worker(SCRIPT, { eval: true, workerData: { file, start, bytes } });
  try {
    return await new Promise<string>((done, fail) => {
      worker.once('message', done);
      worker.once('error', fail);
    });
  } finally {
    await worker.terminate();
  }
}
