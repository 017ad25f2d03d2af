import type { Session } from '../viewer/session';

/** Sessions that are paused for work, how often, and whether they were paused before. */
const holds = new WeakMap<object, { count: number; readonly paused: boolean }>();

/**
 * Does work while the image on the screen is paused. Work that was aborted may end after other work has begun: the image
 * continues with the last one.
 */
export async function whilePaused<T>(
  session: Pick<Session, 'paused' | 'setPaused'>,
  work: () => Promise<T>,
): Promise<T> {
  const hold = holds.get(session) ?? { count: 0, paused: session.paused };
  holds.set(session, hold);
  hold.count++;
  session.setPaused(true);
  try {
    return await work();
  } finally {
    if (--hold.count === 0) {
      holds.delete(session);
      session.setPaused(hold.paused);
    }
  }
}
