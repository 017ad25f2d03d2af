import { describe, expect, it } from 'vitest';
import { duration, ProgressReporter, rate } from '../src/progress';
import { fakeIo } from './fakes';

const at = (samples: number, elapsedMs: number, targetSamples = 100) => ({
  samples,
  targetSamples,
  elapsedMs,
  remainingMs: (targetSamples - samples) * 1000,
  samplesPerSecond: 1.2345,
});

it('durations and rates are short', () => {
  expect([0, 900, 61_000, 3_599_000, 3_600_000, 36_061_000, Infinity].map(duration)).toEqual([
    '0:00',
    '0:01',
    '1:01',
    '59:59',
    '1:00:00',
    '10:01:01',
    '–',
  ]);
  expect([0, NaN, 0.01234, 1.2345, 12.345, 123.45, 12345].map(rate)).toEqual([
    '0',
    '0',
    '0.0123',
    '1.23',
    '12.3',
    '123',
    '12345',
  ]);
});

describe('in a log', () => {
  it('writes a line per stage and then fewer and fewer for samples, always the last', () => {
    const io = fakeIo('.');
    const progress = new ProgressReporter(io, false);
    progress.stage('load');
    progress.stage('compile', 0.1);
    progress.stage('compile', 0.9);
    for (let s = 1; s <= 100; s++) progress.samples(at(s, s * 1000));
    expect(io.err.slice(0, 2)).toEqual(['load\n', 'compile\n']);
    const lines = io.err.slice(2);
    expect(lines[0]).toBe('render 1/100 samples · 1.23 samples/s · 1:39 left\n');
    expect(lines.at(-1)).toContain('100/100');
    expect(lines.length).toBeLessThan(12);
    expect(lines.every((line) => line.endsWith('\n') && !line.includes('\r') && !line.includes('\x1b'))).toBe(true);
  });
});

describe('on a terminal', () => {
  it('rewrites one line that fits, redraws at most every 80 ms, and takes it away', () => {
    const io = fakeIo('.', { interactive: true, columns: 70 });
    const progress = new ProgressReporter(io, false);
    progress.stage('load');
    for (let s = 1; s <= 50; s++) {
      io.time += 10;
      progress.samples(at(s, s * 10));
    }
    expect(io.err.length).toBeLessThan(10);
    for (const text of io.err) {
      expect(text.startsWith('\r\x1b[2K')).toBe(true);
      expect(text).not.toContain('\n');
      expect(text.length - 5).toBeLessThan(70);
    }
    io.err.length = 0;
    progress.line('done');
    expect(io.err).toEqual(['\r\x1b[2K', 'done\n']);
  });
  it('drops the bar when there is no room', () => {
    const io = fakeIo('.', { interactive: true, columns: 40 });
    new ProgressReporter(io, false).samples(at(1, 10));
    expect(io.err.join('')).not.toContain('━');
    expect((io.err[0] as string).length - 5).toBeLessThan(40);
  });
});

it('towards a noise target it shows the noise, and time makes the bar', () => {
  const io = fakeIo('.', { interactive: true, columns: 100 });
  const progress = new ProgressReporter(io, false);
  progress.samples({
    samples: 96,
    targetSamples: 65536,
    elapsedMs: 3000,
    remainingMs: 9000,
    samplesPerSecond: 32,
    noise: 0.0321,
  });
  const text = io.err.join('');
  expect(text).toContain('96 samples · noise 3.21 % · 32.0 samples/s · 0:09 left');
  const [filled, rest] = [text.split('━').length - 1, text.split('─').length - 1];
  // A whole number of characters.
  expect(Math.abs(filled - 0.25 * (filled + rest))).toBeLessThanOrEqual(0.5);
});

it('quiet says nothing', () => {
  const io = fakeIo('.');
  const progress = new ProgressReporter(io, true);
  progress.stage('load');
  progress.samples(at(1, 1));
  progress.line('x');
  progress.warning('y');
  expect(io.err).toEqual([]);
});
