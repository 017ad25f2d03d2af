import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { equalTimeMarkdown, writePages, type EqualTimeReport } from '../../src/equal-time/report';
import { DETAILS } from './details';

const REPORT: EqualTimeReport = {
  machine: {
    cpu: 'a processor',
    cores: 2,
    memoryGiB: 4,
    os: 'linux',
    node: 'v20',
    date: '2026-01-02T03:04:05Z',
    commit: 'abc',
  },
  gpu: { name: 'test', software: true },
  quick: false,
  details: DETAILS,
};

describe('the report', () => {
  it('says in its first paragraph that a software GPU measured, and does not say so of a real one', () => {
    expect(equalTimeMarkdown(REPORT).split('\n')[0]).toMatch(/software GPU: these figures do not predict/);
    expect(equalTimeMarkdown({ ...REPORT, gpu: { name: 'nvidia', software: false } })).not.toMatch(/software/);
    expect(equalTimeMarkdown({ ...REPORT, quick: true })).toMatch(/quick run, not a measurement/);
  });

  it('holds the measured values, side by side, with their ratio', () => {
    const text = equalTimeMarkdown(REPORT);
    expect(text).toContain('| 1.0·10<sup>-4</sup> : 0.01 (**100×**) |');
    expect(text).toContain('16384 | 1.00010 ± 0.00020 | 1 of 256');
    expect(text).not.toMatch(/NaN|undefined|Infinity/);
  });

  it('has tables of even width', () => {
    let columns = 0;
    for (const line of equalTimeMarkdown(REPORT).split('\n')) {
      const count = line.startsWith('|') ? line.split('|').length : 0;
      if (count > 0 && columns > 0) expect(count, line).toBe(columns);
      columns = count;
    }
  });
});

describe('the pages', () => {
  it('are the page, its plots and its data, and the page shows each plot', () => {
    const folder = mkdtempSync(join(tmpdir(), 'glanz-pages-'));
    try {
      const files = writePages(REPORT, folder)
        .map((file) => basename(file))
        .sort();
      expect(files).toEqual(['equal-time-flip.svg', 'equal-time-relmse.svg', 'equal-time.json', 'equal-time.md']);
      const page = readFileSync(join(folder, 'equal-time.md'), 'utf8');
      for (const file of files.filter((name) => name.endsWith('.svg'))) expect(page).toContain(`(./${file})`);
      expect(page.match(/^# /gm)).toHaveLength(1);
      expect((JSON.parse(readFileSync(join(folder, 'equal-time.json'), 'utf8')) as EqualTimeReport).details).toEqual(
        DETAILS,
      );
      // One panel to a scene.
      expect(readFileSync(join(folder, 'equal-time-relmse.svg'), 'utf8')).toMatch(/box[\s\S]*product \(noise alone\)/);
    } finally {
      rmSync(folder, { recursive: true });
    }
  });
});
