// Where READMEs and the documentation state sizes, and which of the measured ones each of them is.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

/**
 * Measured bytes of one entry, min+gz: `own` code, with `all` dependencies, and what it loads `lazy`.
 * @typedef {{ own: number, all: number, lazy: number }} Size
 */

const kB = (bytes) => String(Math.max(1, Math.round(bytes / 1000)));

/** The row of a package in a table whose third column is "own, all". */
const row = (file, short) => ({
  file,
  pattern: new RegExp(`^\\| \\[\`@glanz/${short}\`\\][^|]*\\|[^|]*\\| ([\\d.]+), ([\\d.]+) \\|`, 'dm'),
  sizes: [
    [short, 'own'],
    [short, 'all'],
  ],
});

const SENTENCES = [
  {
    file: 'packages/openpbr/README.md',
    pattern: /Sizes, min\+gz: ([\d.]+) kB for `\.`, tables ([\d.]+) kB apart/d,
    sizes: [
      ['openpbr', 'own'],
      ['openpbr/tables', 'own'],
    ],
  },
  {
    file: 'packages/renderer/README.md',
    pattern:
      /^- ([\d.]+) kB \(min\+gz, dependencies included\) load with the import; the ([\d.]+) kB of energy tables/dm,
    sizes: [
      ['renderer', 'all'],
      ['renderer', 'lazy'],
    ],
  },
  { file: 'packages/wgsl/README.md', pattern: /`\.\/error`\. ([\d.]+) kB min\+gz in all/d, sizes: [['wgsl', 'all']] },
  {
    file: 'apps/docs/guide/performance.md',
    pattern: /The renderer is about ([\d.]+) kB with everything/d,
    sizes: [['renderer', 'all']],
  },
  {
    file: 'apps/docs/guide/viewers.md',
    pattern: /^\| script, min\+gz \| ([\d.]+) kB, then at most ([\d.]+) kB more/dm,
    sizes: [
      ['element', 'all'],
      ['element', 'lazy'],
    ],
  },
];

/**
 * Compares what the texts say with what was measured, or writes it.
 *
 * @param {ReadonlyMap<string, Size>} measured By entry without `@glanz/`: `bvh`, `bvh/wide`.
 * @param {readonly string[]} packages Short names of those that have a row in the tables.
 * @returns {string[]} One line for each text that is wrong and was not written.
 */
export function compareSizeTexts(measured, packages, { base, write = false }) {
  const tables = ['README.md', 'apps/docs/packages/index.md'];
  const problems = [];
  for (const { file, pattern, sizes } of [
    ...tables.flatMap((file) => packages.map((short) => row(file, short))),
    ...SENTENCES,
  ]) {
    const path = join(base, file);
    const text = readFileSync(path, 'utf8');
    const match = pattern.exec(text);
    if (!match) {
      problems.push(
        `${file} has no text like ${pattern.source}, where the size of ${sizes.map(([entry]) => `@glanz/${entry}`).join(', ')} is stated.`,
      );
      continue;
    }
    let next = text;
    // From the back, so that places before stay where they are.
    for (const [i, [entry, kind]] of [...sizes.entries()].reverse()) {
      const [from, to] = match.indices[i + 1];
      const value = kB(measured.get(entry)[kind]);
      if (match[i + 1] === value) continue;
      if (write) next = next.slice(0, from) + value + next.slice(to);
      else
        problems.push(
          `${file} says ${match[i + 1]} kB for @glanz/${entry} (${kind}), which has ${value}: run "node tools/check-sizes.mjs --write".`,
        );
    }
    if (next !== text) writeFileSync(path, next);
  }
  return problems;
}
