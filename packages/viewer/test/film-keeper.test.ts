import type { FilmState, PathTracer } from '@glanz/renderer';
import { describe, expect, it } from 'vitest';
import { FilmKeeper } from '../src/film-keeper';

/** A tracer whose copies come when they are let go. */
function fakeTracer(width = 100, height = 100) {
  const waiting: { go: () => void; fail: (error: Error) => void }[] = [];
  const tracer = {
    samples: 0,
    width,
    height,
    lightGroups: [{ name: 'rest' }],
    saves: 0,
    saveFilm(this: { samples: number; saves: number }): Promise<FilmState> {
      this.saves++;
      const { samples } = this;
      return new Promise((resolve, reject) =>
        waiting.push({ go: () => resolve({ samples } as FilmState), fail: reject }),
      );
    },
  };
  const settle = async (error?: Error) => {
    for (const { go, fail } of waiting.splice(0)) {
      if (error) fail(error);
      else go();
    }
    await new Promise((resolve) => setTimeout(resolve));
  };
  return { tracer, as: tracer as unknown as PathTracer, settle };
}

describe('FilmKeeper', () => {
  it('copies at doubling numbers of samples, three seconds apart, one at a time, and at the end', async () => {
    let now = 0;
    const keeper = new FilmKeeper(() => now);
    const { tracer, as, settle } = fakeTracer();
    const saved: number[] = [];
    // A sample every 100 ms; a copy comes with the next one.
    for (let samples = 1; samples <= 400; samples++) {
      now += 100;
      tracer.samples = samples;
      const before = tracer.saves;
      keeper.offer(as, false);
      if (tracer.saves > before) saved.push(samples);
      await settle();
    }
    expect(saved).toEqual([30, 60, 120, 240]);
    expect(keeper.kept?.samples).toBe(240);
    keeper.offer(as, true);
    await settle();
    expect(keeper.kept?.samples).toBe(400);
    // Nothing new, nothing to copy.
    keeper.offer(as, true);
    expect(tracer.saves).toBe(5);
  });

  it('copies what got done while a copy was made', async () => {
    const keeper = new FilmKeeper(() => 0);
    const { tracer, as, settle } = fakeTracer();
    tracer.samples = 8;
    keeper.offer(as, true);
    tracer.samples = 9;
    keeper.offer(as, true);
    expect(tracer.saves).toBe(1);
    await settle();
    await settle();
    expect(keeper.kept?.samples).toBe(9);
  });

  it('drops a copy that comes when there is another image, and asks no more where one was refused', async () => {
    const keeper = new FilmKeeper(() => 0);
    const { tracer, as, settle } = fakeTracer();
    tracer.samples = 8;
    keeper.offer(as, true);
    keeper.clear();
    await settle();
    expect(keeper.kept).toBeUndefined();
    keeper.offer(as, true);
    await settle(new Error('no memory'));
    keeper.offer(as, true);
    expect(tracer.saves).toBe(2);
    keeper.clear();
    keeper.offer(as, true);
    await settle();
    expect(keeper.kept?.samples).toBe(8);
  });

  it('leaves out films whose copying would hold up a frame', () => {
    const keeper = new FilmKeeper(() => 0);
    const { tracer, as } = fakeTracer(2048, 2048);
    tracer.samples = 8;
    keeper.offer(as, true);
    expect(tracer.saves).toBe(0);
  });
});
