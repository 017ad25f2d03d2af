import { receivedScene } from '@glanz/gltf/workers';
import type { CompressedFormat, Scene } from '@glanz/scene';
import { PlaygroundError } from '../errors';
import type { LoadReply, LoadRequest } from './load-messages';

/**
 * Loads a model in a worker of its own. Aborting ends the worker at once.
 *
 * @throws {PlaygroundError} with the code and the message of the loader's error.
 */
export function loadScene(request: LoadRequest, options: { readonly signal: AbortSignal; readonly onProgress?: (stage: string, done: number) => void; readonly compressedFormats?: readonly CompressedFormat[] }): Promise<Scene> {
  const { signal, onProgress, compressedFormats } = options;
  signal.throwIfAborted();
  return new Promise((resolve, reject) => {
    const worker = new Worker(new URL('./load-worker.ts', import.meta.url), { type: 'module' });
    const abort = () => settle(() => reject(signal.reason as Error));
    const settle = (answer: () => void) => {
      worker.terminate();
      signal.removeEventListener('abort', abort);
      answer();
    };
    signal.addEventListener('abort', abort);
    worker.onmessage = ({ data }: MessageEvent<LoadReply>) => {
      if (data.kind === 'progress') onProgress?.(data.stage, data.done);
      else if (data.kind === 'scene') settle(() => resolve(receivedScene(data.scene)));
      else settle(() => reject(new PlaygroundError(data.code ?? 'playground/load', data.message)));
    };
    worker.onerror = (event) => settle(() => reject(new PlaygroundError('playground/worker', `The model loader failed: ${event.message || 'its script could not be started'}; reload the page.`)));
    worker.postMessage(request.kind === 'files' && compressedFormats ? { ...request, compressedFormats } : request);
  });
}
