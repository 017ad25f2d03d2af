// The playground is part of the built site: /playground/.
import { execFile } from 'node:child_process';
import { cp } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

const playground = fileURLToPath(new URL('../../playground', import.meta.url));

/**
 * Builds the playground into a folder of the site, by the playground's own version of Vite; or copies it there from the
 * folder that GLANZ_PLAYGROUND names, where tests have built it.
 */
export async function buildPlayground(outDir: string): Promise<void> {
  const built = process.env['GLANZ_PLAYGROUND'];
  if (built) return cp(built, outDir, { recursive: true });
  const vite = dirname(createRequire(join(playground, 'package.json')).resolve('vite/package.json'));
  await promisify(execFile)(
    process.execPath,
    [join(vite, 'bin/vite.js'), 'build', playground, '--outDir', outDir, '--emptyOutDir', '--logLevel', 'error'],
    { cwd: playground, maxBuffer: 1 << 24 },
  );
}
