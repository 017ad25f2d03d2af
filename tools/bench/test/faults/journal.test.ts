import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, it } from 'vitest';
import { untilDone } from '../../src/faults/isolate';
import { Journal, type TrialName } from '../../src/faults/journal';

const folder = mkdtempSync(join(tmpdir(), 'glanz-journal-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const trial = (point: string): TrialName => ({ subject: 'tracer', point, fault: 'lost-unknown' });

describe('a journal', () => {
  it('read again knows what was made, what was not reached, and what was running', () => {
    const file = join(folder, 'a.jsonl');
    const journal = new Journal(file);
    journal.begin(trial('one'));
    journal.end({ ...trial('one'), ending: 'error', detail: 'renderer/device-lost' });
    journal.begin(trial('two'));
    journal.miss(trial('two'));
    journal.begin(trial('three'));
    // The process died while it wrote.
    writeFileSync(file, `${readFileSync(file, 'utf8')}{"ended":{"subj`);
    const again = new Journal(file);
    expect(again.outcomes).toEqual([{ ...trial('one'), ending: 'error', detail: 'renderer/device-lost' }]);
    expect(again.missed).toEqual([trial('two')]);
    expect(again.running).toEqual(trial('three'));
    expect(['one', 'two', 'three'].map((point) => again.has(trial(point)))).toEqual([true, true, false]);
    expect(again.has({ ...trial('one'), fault: 'late' })).toBe(false);
  });
});

describe('a campaign in a process of its own', () => {
  /** Makes five trials; dies in the second and the fourth, as long as the journal does not have them. */
  const program = (file: string) => `
    const { readFileSync, appendFileSync, existsSync } = require('node:fs');
    const text = () => (existsSync(${JSON.stringify(file)}) ? readFileSync(${JSON.stringify(file)}, 'utf8') : '');
    const note = (line) => appendFileSync(${JSON.stringify(file)}, JSON.stringify(line) + '\\n');
    for (const point of ['a', 'b', 'c', 'd', 'e']) {
      const trial = { subject: 'tracer', point, fault: 'late' };
      if (text().includes(JSON.stringify({ ended: trial }).slice(0, -2))) continue;
      note({ begun: trial });
      if ('bd'.includes(point)) process.kill(process.pid, 'SIGSEGV');
      else note({ ended: { ...trial, ending: 'image' } });
    }`;

  it('that dies in a trial counts it as a crash, and continues with the next', async () => {
    const file = join(folder, 'b.jsonl');
    await untilDone([process.execPath, '-e', program(file)], file, process.env);
    expect(new Journal(file).outcomes.map(({ point, ending }) => `${point} ${ending}`)).toEqual([
      'a image',
      'b crash',
      'c image',
      'd crash',
      'e image',
    ]);
  });

  it('that fails, or dies before its first trial, is an error and no endless loop', async () => {
    const file = join(folder, 'c.jsonl');
    await expect(untilDone([process.execPath, '-e', 'process.exit(3)'], file, process.env)).rejects.toMatchObject({
      code: 'bench/failed',
    });
    await expect(
      untilDone([process.execPath, '-e', 'process.kill(process.pid, "SIGSEGV")'], file, process.env),
    ).rejects.toMatchObject({ code: 'bench/failed' });
  });
});
