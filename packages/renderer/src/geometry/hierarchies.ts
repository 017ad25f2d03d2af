import { buildBlas, type Blas } from '@glanz/bvh';
import { yieldToEventLoop, type Mesh } from '@glanz/scene';

/**
 * Builds the hierarchies of meshes in the renderer's place. A pool of workers is one: `BvhWorkers` of
 * `@glanz/bvh/workers`.
 */
export interface HierarchyBuilder {
  /**
   * Asked for every mesh in use at once, the largest first.
   *
   * @param mesh Stays as it is until the promise settles; not to be changed or transferred.
   * @param options `signal` aborts when the scene is no longer wanted or another build has failed; `onProgress` takes
   * the share of this mesh that is done, 0..1.
   * @returns What `buildBlas` of `@glanz/bvh` gives.
   */
  buildBlas(
    mesh: { readonly positions: Float32Array; readonly indices: Uint32Array },
    options: { readonly signal: AbortSignal; readonly onProgress: (done: number) => void },
  ): Promise<Blas>;
}

export interface HierarchyOptions {
  readonly hierarchies?: HierarchyBuilder | undefined;
  readonly signal?: AbortSignal | undefined;
  /** 0..1, by triangles. */
  readonly onProgress?: ((done: number) => void) | undefined;
}

/** Milliseconds after which long work yields. */
const SLICE_MS = 12;

/**
 * Makes a function to await between two steps of long work: it yields to the event loop when a slice is over.
 *
 * @param sliceMs Length of a slice, milliseconds.
 */
export function createYielder(sliceMs: number = SLICE_MS): () => Promise<void> {
  let last = performance.now();
  return async () => {
    if (performance.now() - last < sliceMs) return;
    await yieldToEventLoop();
    last = performance.now();
  };
}

/**
 * The hierarchies of the meshes, in their order. Without a builder they are built here, yielding to the event loop in
 * between.
 */
export async function buildHierarchies(
  meshes: readonly Mesh[],
  { hierarchies, signal, onProgress }: HierarchyOptions,
): Promise<Blas[]> {
  const total = meshes.reduce((sum, mesh) => sum + mesh.indices.length, 0);
  if (!hierarchies) {
    const built: Blas[] = [];
    const yieldIfDue = createYielder();
    let done = 0;
    for (const mesh of meshes) {
      built.push(buildBlas({ positions: mesh.positions, indices: mesh.indices }));
      onProgress?.((done += mesh.indices.length) / total);
      await yieldIfDue();
      signal?.throwIfAborted();
    }
    return built;
  }
  const shares = new Float64Array(meshes.length);
  let finished = 0;
  const control = new AbortController();
  const abort = () => control.abort(signal?.reason);
  signal?.throwIfAborted();
  signal?.addEventListener('abort', abort);
  const built: Blas[] = [];
  // Long builds first: several workers end at about the same time.
  const order = [...meshes.keys()].sort(
    (a, b) => (meshes[b] as Mesh).indices.length - (meshes[a] as Mesh).indices.length || a - b,
  );
  const build = async (i: number) => {
    const { positions, indices } = meshes[i] as Mesh;
    const progress = (done: number) => {
      if (control.signal.aborted || !(done > (shares[i] as number))) return;
      const share = Math.min(1, done);
      finished += (share - (shares[i] as number)) * (meshes[i] as Mesh).indices.length;
      shares[i] = share;
      onProgress?.(Math.min(1, finished / total));
    };
    built[i] = await hierarchies.buildBlas({ positions, indices }, { signal: control.signal, onProgress: progress });
    progress(1);
  };
  try {
    await Promise.all(order.map(build));
    signal?.throwIfAborted();
  } catch (error) {
    // The others are of no use.
    control.abort(error);
    throw error;
  } finally {
    signal?.removeEventListener('abort', abort);
  }
  return built;
}
