import { describe, expect, it } from 'vitest';
import { farmMetrics, pauseAfter, verdictOn } from '../src/index';

describe('what becomes of a job that failed', () => {
  it('a lost GPU: elsewhere, up to five times', () => {
    expect([1, 4].map((gpu) => verdictOn('gpu', { gpu }).type)).toEqual(['elsewhere', 'elsewhere']);
    expect(verdictOn('gpu', { gpu: 5 })).toEqual({ type: 'dead', why: 'it lost its GPU 5 times' });
  });
  it('wrong input: never again', () => {
    expect(verdictOn('input', { input: 1 })).toEqual({ type: 'dead', why: 'its input is wrong' });
  });
  it('a crash: the third is the last', () => {
    expect([1, 2, 3].map((crash) => verdictOn('crash', { crash }).type)).toEqual(['elsewhere', 'elsewhere', 'dead']);
  });
  it('a full disk: later, and later', () => {
    const delays = [1, 2, 3, 7].map((output) => verdictOn('output', { output }));
    expect(delays).toEqual([1000, 2000, 4000, 64_000].map((delayMs) => ({ type: 'later', delayMs })));
  });
  it('the worker pauses, a minute at most', () => {
    expect([1, 2, 7, 30].map(pauseAfter)).toEqual([1000, 2000, 60_000, 60_000]);
  });
});

it('metrics are Prometheus text: each line is a comment or a sample', () => {
  const text = farmMetrics(
    {
      waiting: 3,
      active: 1,
      delayed: 0,
      failed: 2,
      done: 7,
      submitted: 13,
      retries: { gpu: 4 },
      secondsPerJob: 1.5,
      workers: [{ id: 'w"1\\', host: 'h', pid: 1, gpu: 'A\nB', done: 7, beat: 1000, beatMs: 5000 }],
    },
    3000,
  );
  // The grammar of https://prometheus.io/docs/instrumenting/exposition_formats/.
  const sample = /^[a-z_]+(\{([a-z]+="([^"\\\n]|\\[\\"n])*")(,[a-z]+="([^"\\\n]|\\[\\"n])*")*\})? -?\d+(\.\d+)?$/;
  for (const line of text.trimEnd().split('\n'))
    expect(line).toMatch(line.startsWith('#') ? /^# (HELP|TYPE) [a-z_]+ \S/ : sample);
  expect(text).toContain('glanz_farm_jobs{state="waiting"} 3\n');
  expect(text).toContain('glanz_farm_retries_total{kind="gpu"} 4\n');
  expect(text).toContain('glanz_farm_worker_heartbeat_age_seconds{worker="w\\"1\\\\",gpu="A\\nB"} 2\n');
});
