import { GlanzError, type Scene } from '@glanz/scene';
import type { GltfDecoders } from '../document';
import { unpackDraco, type DracoPrimitive } from '../draco';
import { loadGltf, type LoadGltfOptions } from '../load';
import { DracoWorkers, type DracoReply, type DracoRequest } from '../draco-workers';
import { buffersOf, sendable, type LoadReply, type LoadRequest } from './protocol';

/** Options that cannot be sent to a worker, for {@link serveGltf}. */
export type WorkerLoadOptions = Pick<LoadGltfOptions, 'decoders' | 'decodeImage' | 'fetch'>;

/**
 * Answers the load requests of `loadGltfInWorker` and `GltfWorker`. The module `@glanz/gltf/worker` does so when it is
 * loaded as a worker; call this function in a worker file of your own to pass decoders.
 *
 * With a Draco decoder and three threads or more, a load starts up to four further workers of the same file, which
 * decode meshes in parallel.
 *
 * @param options Decoders of compressed meshes and images.
 * @example
 * // my-gltf-worker.ts
 * serveGltf({ decoders: { meshopt: async () => (await import('meshoptimizer/decoder')).MeshoptDecoder } });
 */
export function serveGltf(options: WorkerLoadOptions = {}): void {
  const scope = globalThis as unknown as {
    postMessage(message: LoadReply | DracoReply, transfer?: readonly Transferable[]): void;
    addEventListener(type: 'message', listener: (event: MessageEvent<LoadRequest | DracoRequest>) => void): void;
  };
  const decoders = withDracoWorkers(options.decoders);
  scope.addEventListener('message', ({ data }) => {
    if ('kind' in data) {
      void unpacked(data, decoders?.draco).then((primitive) =>
        scope.postMessage(
          { kind: 'unpacked', id: data.id, ...(primitive ? { primitive } : {}) },
          primitive
            ? [
                primitive.indices.buffer,
                ...[...primitive.attributes.values()].map(({ numbers }) => numbers.buffer as ArrayBuffer),
              ]
            : [],
        ),
      );
      return;
    }
    const { input, options: sent } = data;
    const answer = (loaded: Scene) => {
      const scene = sendable(loaded);
      scope.postMessage({ kind: 'scene', scene }, buffersOf(scene));
    };
    const fail = (error: unknown) => {
      const { code, location } = error instanceof GlanzError ? error : ({} as Partial<GlanzError>);
      const path = location?.path;
      scope.postMessage({
        kind: 'error',
        message: error instanceof Error ? error.message : String(error),
        ...(code === undefined ? {} : { code }),
        ...(path === undefined ? {} : { path }),
      });
    };
    loadGltf(input, {
      ...sent,
      ...options,
      ...(decoders ? { decoders } : {}),
      onProgress: (progress) => scope.postMessage({ kind: 'progress', progress }),
    })
      .then(answer)
      .catch(fail);
  });
  scope.postMessage({ kind: 'ready' });
}

/** On machines with fewer threads, further workers do not pay off. */
const MIN_THREADS = 3;

/**
 * Adds workers of the same file, which decode Draco-compressed meshes in parallel, if the machine has enough threads.
 */
function withDracoWorkers(decoders: GltfDecoders | undefined): GltfDecoders | undefined {
  const { location, navigator } = globalThis as {
    location?: { readonly href: string };
    navigator?: { readonly hardwareConcurrency?: number };
  };
  if (
    !decoders?.draco ||
    decoders.dracoWorkers ||
    !location ||
    typeof Worker !== 'function' ||
    (navigator?.hardwareConcurrency ?? 1) < MIN_THREADS
  )
    return decoders;
  return {
    ...decoders,
    dracoWorkers: new DracoWorkers({
      createWorker: () =>
        new Worker(location.href, { type: 'module', name: (globalThis as { name?: string }).name ?? '' }),
    }),
  };
}

/** Decodes a mesh for another worker. */
async function unpacked(
  { bytes, attributes, maxBytes }: DracoRequest,
  given: unknown,
): Promise<DracoPrimitive | undefined> {
  try {
    const module = typeof given === 'function' ? ((await (given as () => unknown)()) as unknown) : given;
    let left = maxBytes;
    return unpackDraco(module, bytes, attributes, (size) => {
      left -= size;
      if (left < 0) throw new Error('it is too large');
    });
  } catch {
    // The caller decodes the mesh again and reports the error.
    return undefined;
  }
}
