/** The worker's side: how code inside a worker receives and posts messages. */
export interface WorkerPort {
  post(message: unknown, transfer?: readonly ArrayBuffer[]): void;
  listen(received: (message: unknown) => void): void;
}

interface Threads {
  readonly parentPort: {
    postMessage(message: unknown, transfer: readonly ArrayBuffer[]): void;
    on(type: 'message', received: (message: unknown) => void): void;
  } | null;
}

/** One of Node's built-in modules, without an import that web bundlers would try to resolve. */
export function builtin<T>(name: string): T | undefined {
  const { process } = globalThis as { process?: { getBuiltinModule?: (name: string) => unknown } };
  return process?.getBuiltinModule?.(name) as T | undefined;
}

/** The port of the worker that this code runs in; undefined outside of workers. */
export function ownPort(): WorkerPort | undefined {
  const scope = globalThis as unknown as {
    WorkerGlobalScope?: new () => object;
    postMessage(message: unknown, transfer: readonly ArrayBuffer[]): void;
    addEventListener(type: 'message', received: (event: MessageEvent) => void): void;
  };
  if (scope.WorkerGlobalScope && globalThis instanceof scope.WorkerGlobalScope) {
    return {
      post: (message, transfer = []) => scope.postMessage(message, transfer),
      listen: (received) => scope.addEventListener('message', (event) => received(event.data)),
    };
  }
  const port = builtin<Threads>('node:worker_threads')?.parentPort;
  return port
    ? {
        post: (message, transfer = []) => port.postMessage(message, transfer),
        listen: (received) => port.on('message', received),
      }
    : undefined;
}
