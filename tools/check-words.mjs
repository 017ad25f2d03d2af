// node tools/check-words.mjs — finds words that CONTRIBUTING.md replaces by the field's terms.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './pipeline/process.mjs';
import { Verdicts, runAlone } from './pipeline/report.mjs';
import { findWords, readWords } from './pipeline/words.mjs';

const SOURCES = /\.(ts|tsx|mts|mjs|wesl|vue|md|css|html)$/;
/** Texts about versions that are published are not rewritten; this check and its test name the words. */
const EXCEPT = /(^|\/)CHANGELOG\.md$|^\.changeset\/|^CONTRIBUTING\.md$|^tools\/pipeline\/test\/words\.test\.ts$/;

export async function checkWords(base = root) {
  const verdicts = new Verdicts();
  const words = readWords(readFileSync(join(base, 'CONTRIBUTING.md'), 'utf8'));
  verdicts.expect(words.length > 0, 'CONTRIBUTING.md: the table of words is missing.');
  const files = execFileSync('git', ['ls-files'], { cwd: base, encoding: 'utf8', maxBuffer: 1 << 26 }).split('\n');
  for (const file of files.filter((name) => SOURCES.test(name) && !EXCEPT.test(name))) {
    let text;
    try {
      text = readFileSync(join(base, file), 'utf8');
    } catch {
      // Deleted, and not committed yet.
      continue;
    }
    const found = findWords(text, words);
    verdicts.expect(
      found.length === 0,
      found.map(({ line, word, say }) => `${file}:${line}: "${word}": say ${say}`).join('\n'),
    );
  }
  return verdicts;
}

await runAlone(import.meta, checkWords);
