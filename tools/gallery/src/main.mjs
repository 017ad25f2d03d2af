// npm run gallery — bundles the tool from the sources of the workspace, then runs it in this process.
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { bundleGallery } from './bundle.mjs';

const out = join(dirname(fileURLToPath(import.meta.url)), '../.cache');
// Models need no weights, which a checkout has only after a build.
await bundleGallery(out, { weights: !process.argv.includes('--models') });
await import(pathToFileURL(join(out, 'lib/gallery.mjs')).href);
