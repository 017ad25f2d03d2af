import { glanzPackage } from '../../tsup.base';
import manifest from './package.json' with { type: 'json' };
import { writeWeights } from './scripts/weights.mjs';
import { WEIGHT_ARCHIVES } from './src/archives';

/** Each entry has a file of its name; the archives are many. */
const names = Object.values(manifest.exports).flatMap((entry) =>
  typeof entry === 'string' ? [] : [entry.default.slice('./dist/'.length, -'.js'.length)],
);

export default {
  ...glanzPackage(Object.fromEntries(names.map((name) => [name, `src/${name}.ts`]))),
  onSuccess: async () => writeWeights(WEIGHT_ARCHIVES),
};
