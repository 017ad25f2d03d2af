/** Signals that end a render early. */
export type Interrupt = 'SIGINT' | 'SIGTERM' | 'SIGHUP';

/** Input, output and time of a command; tests replace them. */
export interface CliIo {
  /** Machine-readable output and help. */
  readonly stdout: (text: string) => void;
  /** Progress, summaries, warnings, errors. */
  readonly stderr: (text: string) => void;
  /** Whether stderr is a terminal: one line is rewritten there, while logs get a line now and then. */
  readonly interactive: boolean;
  /** Width of the terminal, columns. */
  readonly columns: () => number;
  /** Whether stderr may be coloured. */
  readonly color: boolean;
  readonly cwd: string;
  readonly debug: boolean;
  /** Milliseconds, monotonic. */
  readonly now: () => number;
  /** Resolves after `milliseconds`, or when `signal` aborts. */
  readonly wait: (milliseconds: number, signal: AbortSignal) => Promise<void>;
  /** Calls `handler` at the first interrupt; a second one ends the process at once. Returns how to stop listening. */
  readonly onInterrupt: (handler: (signal: Interrupt) => void) => () => void;
}

const broken = new WeakSet<NodeJS.WriteStream>();
const watched = new WeakSet<NodeJS.WriteStream>();

/**
 * Writes until the stream breaks: after a reader has closed its end of the pipe, or a terminal is gone, text is
 * dropped. Without a listener the stream's error would end the process, and with it the render.
 */
function writerOf(stream: NodeJS.WriteStream): (text: string) => void {
  if (!watched.has(stream)) {
    watched.add(stream);
    stream.on('error', () => broken.add(stream));
  }
  return (text) => {
    if (!broken.has(stream)) stream.write(text);
  };
}

/**
 * The environment of this process. After stdout or stderr is closed, output to it is discarded; the process does not
 * end.
 */
export function nodeIo(): CliIo {
  const { env, stderr, stdout } = process;
  const interactive = stderr.isTTY === true && env.TERM !== 'dumb';
  return {
    stdout: writerOf(stdout),
    stderr: writerOf(stderr),
    interactive,
    columns: () => stderr.columns ?? 80,
    color: env.NO_COLOR ? false : env.FORCE_COLOR ? env.FORCE_COLOR !== '0' : interactive,
    cwd: process.cwd(),
    debug: Boolean(env.GLANZ_DEBUG),
    now: () => performance.now(),
    wait: (milliseconds, signal) =>
      new Promise((done) => {
        if (signal.aborted) return done();
        const end = () => {
          clearTimeout(timer);
          signal.removeEventListener('abort', end);
          done();
        };
        const timer = setTimeout(end, milliseconds);
        signal.addEventListener('abort', end);
      }),
    onInterrupt(handler) {
      const signals: Interrupt[] = ['SIGINT', 'SIGTERM', 'SIGHUP'];
      const listeners = signals.map((signal) => {
        // `once`: the second signal meets the system's default and ends the process.
        const listener = () => handler(signal);
        process.once(signal, listener);
        return [signal, listener] as const;
      });
      return () => {
        for (const [signal, listener] of listeners) process.removeListener(signal, listener);
      };
    },
  };
}
