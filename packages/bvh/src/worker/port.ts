/** The far end: what code inside a worker hears and says. */
export interface WorkerPort {
  post(message: unknown, transfer?: readonly ArrayBuffer[]): void;
  listen(heard: (message: unknown) => void): void;
}

interface Threads {
  readonly parentPort: {
    postMessage(message: unknown, transfer: readonly ArrayBuffer[]): void;
    on(type: 'message', heard: (message: unknown) => void): void;
  } | null;
}

/** One of Node's own modules, without an import that bundlers for the web would stumble over. */
export function builtin<T>(name: string): T | undefined {
  const { process } = globalThis as { process?: { getBuiltinModule?: (name: string) => unknown } };
  return process?.getBuiltinModule?.(name) as T | undefined;
}

/** The port of the worker that this code runs in; undefined outside of workers. */
export function ownPort(): WorkerPort | undefined {
  const scope = globalThis as unknown as {
    WorkerGlobalScope?: new () => object;
    postMessage(message: unknown, transfer: readonly ArrayBuffer[]): void;
    addEventListener(type: 'message', heard: (event: MessageEvent) => void): void;
  };
  if (scope.WorkerGlobalScope && globalThis instanceof scope.WorkerGlobalScope) {
    return {
      post: (message, transfer = []) => scope.postMessage(message, transfer),
      listen: (heard) => scope.addEventListener('message', (event) => heard(event.data)),
    };
  }
  const port = builtin<Threads>('node:worker_threads')?.parentPort;
  return port
    ? {
        post: (message, transfer = []) => port.postMessage(message, transfer),
        listen: (heard) => port.on('message', heard),
      }
    : undefined;
}
