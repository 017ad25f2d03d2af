// The playground is part of the built site: /playground/.
import { execFile } from 'node:child_process';
import { dirname, join } from 'node:path';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

const playground = fileURLToPath(new URL('../../playground', import.meta.url));

/** Builds the playground into a folder of the site, by the playground's own version of Vite. */
export async function buildPlayground(outDir: string): Promise<void> {
  const vite = dirname(createRequire(join(playground, 'package.json')).resolve('vite/package.json'));
  await promisify(execFile)(
    process.execPath,
    [join(vite, 'bin/vite.js'), 'build', playground, '--outDir', outDir, '--emptyOutDir', '--logLevel', 'error'],
    { cwd: playground, maxBuffer: 1 << 24 },
  );
}
