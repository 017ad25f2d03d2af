import { expect, test } from 'vitest';
import { fuzz } from './fuzz/run';

// GLANZ_FUZZ=1000000 asks for more than the mutants of every day, GLANZ_FUZZ_SEED for others, GLANZ_FUZZ_FIRST for one
// again.
const count = Number(process.env['GLANZ_FUZZ'] ?? 2000);
const seed = Number(process.env['GLANZ_FUZZ_SEED'] ?? 20261121);
const first = Number(process.env['GLANZ_FUZZ_FIRST'] ?? 0);

test(
  `${count} spoiled documents (seed ${seed}, from ${first}): each is a sound scene or a typed error`,
  { timeout: 120_000 + count * 20 },
  async () => {
    const { findings, done } = await fuzz({
      count,
      seed,
      first,
      onProgress: (now) => process.stderr.write(`${now} of ${count}\n`),
    });
    expect(findings.map(({ mutant, what }) => `mutant ${mutant}: ${what}`)).toEqual([]);
    expect(done).toBe(count);
  },
);
