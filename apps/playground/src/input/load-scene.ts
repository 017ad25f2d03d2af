import { receivedScene } from '@glanz/gltf/workers';
import type { CompressedFormat } from '@glanz/scene';
import { PlaygroundError } from '../errors';
import type { GroupedScene, LoadReply, LoadRequest } from './load-messages';

interface Asked {
  readonly resolve: (scene: GroupedScene) => void;
  readonly reject: (error: unknown) => void;
  readonly onProgress: ((stage: string, done: number) => void) | undefined;
}

/** A worker that loads models, one after the other. */
export class LoadWorker {
  readonly #worker = new Worker(new URL('./load-worker.ts', import.meta.url), { type: 'module' });
  #asked: Asked | undefined;

  constructor() {
    this.#worker.onmessage = ({ data }: MessageEvent<LoadReply>) => {
      if (data.kind === 'progress') return this.#asked?.onProgress?.(data.stage, data.done);
      const asked = this.#asked;
      this.#asked = undefined;
      if (data.kind === 'scene') asked?.resolve(receivedScene(data.scene));
      else asked?.reject(new PlaygroundError(data.code ?? 'playground/load', data.message));
    };
    this.#worker.onerror = (event) =>
      this.#asked?.reject(
        new PlaygroundError(
          'playground/worker',
          `The model loader failed: ${event.message || 'its script could not be started'}; reload the page.`,
        ),
      );
  }

  /**
   * Asks for a model; not before the one before has come.
   *
   * @throws {PlaygroundError} with the code and the message of the loader's error.
   */
  ask(request: LoadRequest, onProgress?: (stage: string, done: number) => void): Promise<GroupedScene> {
    return new Promise((resolve, reject) => {
      this.#asked = { resolve, reject, onProgress };
      this.#worker.postMessage(request);
    });
  }

  destroy(): void {
    this.#worker.terminate();
  }
}

/**
 * Loads a model in a worker of its own. Aborting ends the worker at once.
 *
 * @throws {PlaygroundError} with the code and the message of the loader's error.
 */
export async function loadScene(
  request: LoadRequest,
  options: {
    readonly signal: AbortSignal;
    readonly onProgress?: (stage: string, done: number) => void;
    readonly compressedFormats?: readonly CompressedFormat[];
  },
): Promise<GroupedScene> {
  const { signal, onProgress, compressedFormats } = options;
  signal.throwIfAborted();
  const worker = new LoadWorker();
  const listening = new AbortController();
  try {
    return await Promise.race([
      worker.ask(
        request.kind === 'files' && compressedFormats ? { ...request, compressedFormats } : request,
        onProgress,
      ),
      new Promise<never>((_, reject) =>
        signal.addEventListener('abort', () => reject(signal.reason as Error), { signal: listening.signal }),
      ),
    ]);
  } finally {
    listening.abort();
    worker.destroy();
  }
}
