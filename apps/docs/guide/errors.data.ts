// The error classes and codes out of the packages' own doc comments.
import { readFileSync } from 'node:fs';
import { sep } from 'node:path';
import { defineLoader } from 'vitepress';
import { packageFacts } from '../.vitepress/package-facts';
import { errorClasses, type ErrorClass } from '../src/error-classes';

declare const data: ErrorClass[];
export { data };

const ORDER = [
  'renderer',
  'gltf',
  'scene',
  'image',
  'tonemap',
  'denoise',
  'openpbr',
  'bvh',
  'wgsl',
  'farm',
  'cli',
  'create-glanz',
];

export default defineLoader({
  watch: ['../../../packages/*/src/**/*.ts'],
  load: (files: string[]): ErrorClass[] =>
    files
      .flatMap((file) =>
        errorClasses(file.split(sep).at(file.split(sep).lastIndexOf('src') - 1)!, readFileSync(file, 'utf8')),
      )
      .sort((a, b) => ORDER.indexOf(a.package) - ORDER.indexOf(b.package) || a.name.localeCompare(b.name))
      .map((one) => ({ ...one, package: packageFacts(one.package).name })),
});
