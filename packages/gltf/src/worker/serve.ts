import { GlanzError, type Scene } from '@glanz/scene';
import type { GltfDecoders } from '../document';
import { unpackDraco, type DracoPrimitive } from '../draco';
import { loadGltf, type LoadGltfOptions } from '../load';
import { DracoWorkers, type DracoReply, type DracoRequest } from '../draco-workers';
import { buffersOf, sendable, type LoadReply, type LoadRequest } from './protocol';

/** What a worker of your own adds to a load: things that cannot be sent. */
export type WorkerLoadOptions = Pick<LoadGltfOptions, 'decoders' | 'decodeImage' | 'fetch'>;

/**
 * Answers one load request after another, for `loadGltfInWorker`. The module `@glanz/gltf/worker` does so by itself
 * where it is loaded as a worker; call this in a worker file of your own to hand it decoders.
 *
 * With a decoder of Draco and three threads or more, a load starts up to four further workers of the same file, which
 * unpack meshes side by side.
 *
 * @param options Decoders of compressed meshes and pictures.
 * @example
 * // my-gltf-worker.ts
 * serveGltf({ decoders: { meshopt: async () => (await import('meshoptimizer/decoder')).MeshoptDecoder } });
 */
export function serveGltf(options: WorkerLoadOptions = {}): void {
  const scope = globalThis as unknown as {
    postMessage(message: LoadReply | DracoReply, transfer?: readonly Transferable[]): void;
    addEventListener(type: 'message', heard: (event: MessageEvent<LoadRequest | DracoRequest>) => void): void;
  };
  const decoders = withHelpers(options.decoders);
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

/** Machines with fewer threads have none to spare for helpers. */
const SPARE_THREADS = 3;

/**
 * Decoders that unpack Draco-compressed meshes side by side, by workers of the same file, where the machine has the
 * threads.
 */
function withHelpers(decoders: GltfDecoders | undefined): GltfDecoders | undefined {
  const { location, navigator } = globalThis as {
    location?: { readonly href: string };
    navigator?: { readonly hardwareConcurrency?: number };
  };
  if (
    !decoders?.draco ||
    decoders.dracoWorkers ||
    !location ||
    typeof Worker !== 'function' ||
    (navigator?.hardwareConcurrency ?? 1) < SPARE_THREADS
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

/** What a helper does. */
async function unpacked(
  { bytes, attributes, most }: DracoRequest,
  given: unknown,
): Promise<DracoPrimitive | undefined> {
  try {
    const module = typeof given === 'function' ? ((await (given as () => unknown)()) as unknown) : given;
    let left = most;
    return unpackDraco(module, bytes, attributes, (size) => {
      left -= size;
      if (left < 0) throw new Error('it is too large');
    });
  } catch {
    // Whoever asked unpacks it again, and tells.
    return undefined;
  }
}
