/** Polls of a wait that follow each other without a pause: what takes a fraction of a millisecond ends within them. */
const TURNS = 8;
/** Milliseconds between polls after that. */
const PAUSE_MS = 1;

const PACED = Symbol.for('glanz.paced');

/** Functions of an addon have no name, those that `bind` makes do. */
const isNative = (callback: unknown) =>
  typeof callback === 'function' && callback.name === '' && String(callback).endsWith('{ [native code] }');

/**
 * Lets Dawn poll for events of the GPU once a millisecond while it waits for one. Without this it polls in each turn of
 * the event loop, by `setImmediate`, and takes a core from a software adapter, which renders on the same cores. Replaces
 * the process's `setImmediate`, once; callbacks that are written in JavaScript get Node's.
 */
export function pacePolling(): void {
  const holder = globalThis as { [PACED]?: boolean };
  if (holder[PACED]) return;
  holder[PACED] = true;
  const { setImmediate: immediate, setTimeout: later } = globalThis;
  let turns = 0;
  let polling = false;
  const poll = (callback: () => void) => {
    polling = true;
    try {
      callback();
    } finally {
      polling = false;
    }
  };
  const paced = (callback: (...args: unknown[]) => void, ...args: unknown[]) => {
    if (!isNative(callback)) return immediate(callback, ...args);
    // A poll that asks for another waits for the same event.
    turns = polling ? turns + 1 : 0;
    return turns < TURNS ? immediate(poll, callback as () => void) : later(poll, PAUSE_MS, callback as () => void);
  };
  Object.defineProperties(paced, Object.getOwnPropertyDescriptors(immediate));
  globalThis.setImmediate = paced as unknown as typeof setImmediate;
}
