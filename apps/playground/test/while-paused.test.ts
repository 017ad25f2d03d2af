import { describe, expect, it } from 'vitest';
import { whilePaused } from '../src/output/while-paused';

/** A session, and work that the test ends. */
function begin(paused = false) {
  const session = { paused, setPaused: (next: boolean) => void (session.paused = next) };
  const work = () => {
    let [end, fail] = [(_: string) => {}, (_: Error) => {}];
    const ended = new Promise<string>((resolve, reject) => ([end, fail] = [resolve, reject]));
    return { done: whilePaused(session, () => ended), end, fail };
  };
  return { session, work };
}

describe('whilePaused', () => {
  it('pauses the image until the work is done, or has failed', async () => {
    const { session, work } = begin();
    const first = work();
    expect(session.paused).toBe(true);
    first.end('an image');
    expect(await first.done).toBe('an image');
    expect(session.paused).toBe(false);
    const second = work();
    second.fail(new Error('aborted'));
    await expect(second.done).rejects.toThrow('aborted');
    expect(session.paused).toBe(false);
  });

  it('lets the image continue after the last of several that overlap, in whatever order they end', async () => {
    for (const order of [
      [0, 1],
      [1, 0],
    ] as const) {
      const { session, work } = begin();
      const works = [work(), work()] as const;
      works[order[0]].end('');
      await works[order[0]].done;
      expect(session.paused).toBe(true);
      works[order[1]].end('');
      await works[order[1]].done;
      expect(session.paused).toBe(false);
    }
  });

  it('leaves an image paused that was', async () => {
    const { session, work } = begin(true);
    const first = work();
    first.end('');
    await first.done;
    expect(session.paused).toBe(true);
  });
});
