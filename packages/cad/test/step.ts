import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';

/** STEP files of the CAx Implementor Forum's recommended tests, as `occt-import-js` ships them. */
export const stepFile = (path: string): string =>
  join(dirname(createRequire(import.meta.url).resolve('occt-import-js/package.json')), 'test/testfiles', path);
export const stepBytes = (path: string): Uint8Array => new Uint8Array(readFileSync(stepFile(path)));

/** An assembly of 18 parts: a plate, two brackets, bolts, nuts, a rod. */
export const ASSEMBLY = 'cax-if/as1-oc-214/as1-oc-214.stp';
/** A cube with edges of 1 m, of which a file in millimetres and one in inches exist too. */
export const CUBE = 'simple-basic-cube/cube.stp';
