// npm run gallery:pack — what renders the gallery, as .gallery-bench/ for a machine that has nothing but a GPU. With
// `tools/gpu/pack.sh` beside it:
//   . .gpu/setup.sh && $GPU_NODE .gallery-bench/lib/gallery.mjs --out gallery
import { rmSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { bundleGallery } from './bundle.mjs';

const LIMIT_MIB = 40;
const out = join(dirname(fileURLToPath(import.meta.url)), '../../../.gallery-bench');
rmSync(out, { recursive: true, force: true });
const mib = (await bundleGallery(out)) / 2 ** 20;
process.stdout.write(`.gallery-bench: ${mib.toFixed(1)} MiB of ${LIMIT_MIB}\n`);
if (mib > LIMIT_MIB) {
  process.stderr.write('gallery:pack: too large to carry\n');
  process.exitCode = 1;
}
