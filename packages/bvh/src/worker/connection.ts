import { BvhError } from '../error';
import { builtin } from './port';

/** The part of a web worker's interface that is used here. */
export interface WebWorkerLike {
  postMessage(message: unknown, transfer: Transferable[]): void;
  addEventListener(type: string, listener: (event: Event) => void): void;
  terminate(): void;
}

/** The part of the interface of Node's `worker_threads` `Worker` that is used here. */
export interface NodeWorkerLike {
  // Node has its own type of transferables: any will do.
  postMessage(message: unknown, transfer: readonly never[]): void;
  on(type: string, listener: (value: unknown) => void): unknown;
  terminate(): unknown;
  ref(): void;
  unref(): void;
}

/** The pool's side of a worker: the same for both kinds. */
export interface WorkerConnection {
  post(message: unknown, transfer: readonly ArrayBuffer[]): void;
  /** In Node: whether the worker keeps the process alive. */
  hold(on: boolean): void;
  terminate(): void;
}

/** Hardware threads of this machine. */
export function hardwareThreads(): number {
  const { navigator } = globalThis as { navigator?: { readonly hardwareConcurrency?: number } };
  return (
    navigator?.hardwareConcurrency ??
    builtin<{ availableParallelism(): number }>('node:os')?.availableParallelism() ??
    1
  );
}

let elsewhere: string | undefined;

/**
 * Starts the package's own worker file. From the page's origin this needs only `worker-src 'self'`. From another
 * origin, such as a content delivery network, browsers refuse; there a worker from a Blob imports the file, unless the
 * content security policy forbids that.
 */
export function startWorker(): WebWorkerLike | NodeWorkerLike {
  if (typeof Worker === 'function') {
    try {
      // In this form bundlers find the file.
      return new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'glanz-bvh' });
    } catch (error) {
      if ((error as Error).name !== 'SecurityError') throw error;
      const { url } = import.meta;
      elsewhere ??= URL.createObjectURL(
        new Blob([`import ${JSON.stringify(new URL('./worker.js', url).href)};`], { type: 'text/javascript' }),
      );
      return new Worker(elsewhere, { type: 'module', name: 'glanz-bvh' });
    }
  }
  const threads = builtin<{ readonly Worker: new (url: URL) => NodeWorkerLike }>('node:worker_threads');
  if (!threads)
    throw new BvhError('bvh/worker', 'Workers need Worker or process.getBuiltinModule (Node 20.16 or later).');
  // Not in that form, or they would add the file a second time.
  const { url } = import.meta;
  return new threads.Worker(new URL('./worker.js', url));
}

/** @param failed Called once, if the worker cannot be loaded, throws or exits. */
export function connect(
  worker: WebWorkerLike | NodeWorkerLike,
  received: (message: unknown) => void,
  failed: (why: string) => void,
): WorkerConnection {
  let over = false;
  const fail = (why: string) => {
    if (over) return;
    over = true;
    void worker.terminate();
    failed(why);
  };
  const terminate = () => {
    over = true;
    void worker.terminate();
  };
  const hear = (message: unknown) => {
    if (!over) received(message);
  };
  if ('on' in worker) {
    worker.on('message', hear);
    worker.on('error', (error) => fail((error as Error).message));
    worker.on('exit', () => fail('it has ended'));
    return {
      post: (message, transfer) => worker.postMessage(message, transfer as readonly never[]),
      hold: (on) => (on ? worker.ref() : worker.unref()),
      terminate,
    };
  }
  worker.addEventListener('message', (event) => hear((event as MessageEvent).data));
  worker.addEventListener('messageerror', () => fail('its answer could not be read'));
  worker.addEventListener('error', (event) => {
    event.preventDefault();
    fail(
      (event as ErrorEvent).message ||
        'its script could not be loaded (a wrong address, or a content security policy without worker-src)',
    );
  });
  return { post: (message, transfer) => worker.postMessage(message, [...transfer]), hold: () => undefined, terminate };
}
