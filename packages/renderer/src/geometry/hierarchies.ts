import { loadPart } from '@glanz/wgsl';
import { buildBlas, type Blas } from '@glanz/bvh';
import type { BuildBoxes } from '@glanz/bvh/dynamic-tlas';
import { yieldToEventLoop, type Mesh } from '@glanz/scene';
import type { CompactShapes } from './compact-shapes';
import { suitsGpu, type GpuBuilds, type Hierarchy, type HierarchyBuild } from './hierarchy';

/**
 * Builds the hierarchies of meshes in the renderer's place. A pool of workers is one: `BvhWorkers` of
 * `@glanz/bvh/workers`.
 */
export interface HierarchyBuilder {
  /**
   * Called for all meshes in use at once, the largest first.
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
  /** Builds hierarchies of large meshes, and of many instances, on the GPU. Absent: all are built on the CPU. */
  readonly gpu?: GpuBuilds | undefined;
  /** Shapes are compact: triangles are packed later. */
  readonly compact?: CompactShapes | undefined;
  readonly signal?: AbortSignal | undefined;
  /** 0..1, by triangles. */
  readonly onProgress?: ((done: number) => void) | undefined;
  /** Reports where hierarchies were built, when all of them are. */
  readonly onBuilt?: ((build: HierarchyBuild) => void) | undefined;
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

/** What builds and poses on the GPU: a chunk of its own, for most scenes have no use for it. */
export const loadGpuTrees = () => loadPart('gpu-trees', import('./gpu-trees'));

/** What builds the tree over a scene's instances on the GPU, where there are enough of them. */
export const instanceTreesOnGpu = async (
  { gpu, signal }: HierarchyOptions,
  instances: number,
): Promise<BuildBoxes | undefined> =>
  gpu && instances >= gpu.minInstances ? (await loadGpuTrees()).boxTreesOnGpu(gpu, signal) : undefined;

/** Triangles of all meshes. */
export const trianglesOf = (meshes: readonly Mesh[]) =>
  meshes.reduce((sum, { indices }) => sum + indices.length / 3, 0);

/** Runs work that several do together. If it fails, or the caller aborts, the signal is aborted: no part is of use. */
async function together<T>(outer: AbortSignal | undefined, run: (signal: AbortSignal) => Promise<T>): Promise<T> {
  const control = new AbortController();
  const abort = () => control.abort(outer?.reason);
  outer?.throwIfAborted();
  outer?.addEventListener('abort', abort);
  try {
    const result = await run(control.signal);
    outer?.throwIfAborted();
    return result;
  } catch (error) {
    control.abort(error);
    throw error;
  } finally {
    outer?.removeEventListener('abort', abort);
  }
}

/**
 * The hierarchies of the meshes, in their order. Those that suit the GPU are built there, where that is asked for, at
 * the same time as the others are built on the CPU; what the GPU turns out not to have memory for is built there too.
 */
export async function buildHierarchies(meshes: readonly Mesh[], options: HierarchyOptions): Promise<Hierarchy[]> {
  const { gpu, compact, onProgress, onBuilt } = options;
  const built: (Hierarchy | undefined)[] = [];
  const total = trianglesOf(meshes);
  const begin = performance.now();
  let done = 0;
  const report = (where: HierarchyBuild['where'], which: readonly Mesh[], temporaryBytes = 0) => {
    if (which.length > 0)
      onBuilt?.({
        where,
        meshes: which.length,
        triangles: trianglesOf(which),
        ms: performance.now() - begin,
        temporaryBytes,
      });
  };
  /** Adds up the progress of a part of the meshes. */
  const partOf = (which: readonly Mesh[]) => {
    let before = 0;
    return (share: number) => {
      done += (share - before) * trianglesOf(which);
      before = share;
      onProgress?.(Math.min(1, done / total));
    };
  };
  await together(options.signal, async (signal) => {
    const onCpu = async (which: readonly number[]) => {
      const some = which.map((i) => meshes[i] as Mesh);
      const trees = await buildOnCpu(some, options.hierarchies, signal, partOf(some));
      which.forEach((i, n) => (built[i] = trees[n]));
      report('cpu', some);
    };
    const indices = [...meshes.keys()];
    const isChosen = (i: number) => gpu !== undefined && suitsGpu(gpu, meshes[i] as Mesh);
    const chosen = indices.filter(isChosen);
    const onGpu = async () => {
      if (!gpu || chosen.length === 0) return;
      const some = chosen.map((i) => meshes[i] as Mesh);
      const { buildOnGpu } = await loadGpuTrees();
      const { trees, temporaryBytes } = await buildOnGpu(gpu, some, { signal, onProgress: partOf(some), compact });
      chosen.forEach((i, n) => (built[i] = trees[n]));
      report(
        'gpu',
        some.filter((_, n) => trees[n]),
        temporaryBytes,
      );
      const left = chosen.filter((i) => !built[i]);
      if (left.length > 0) await onCpu(left);
    };
    const others = indices.filter((i) => !isChosen(i));
    await Promise.all([onGpu(), others.length > 0 || chosen.length === 0 ? onCpu(others) : undefined]);
  });
  return built as Hierarchy[];
}

/** Without a builder they are built on this thread, yielding to the event loop in between. */
async function buildOnCpu(
  meshes: readonly Mesh[],
  hierarchies: HierarchyBuilder | undefined,
  signal: AbortSignal,
  onProgress: (done: number) => void,
): Promise<Blas[]> {
  const total = trianglesOf(meshes);
  const built: Blas[] = [];
  let finished = 0;
  if (!hierarchies) {
    const yieldIfDue = createYielder();
    for (const { positions, indices } of meshes) {
      built.push(buildBlas({ positions, indices }));
      onProgress((finished += indices.length / 3) / total);
      await yieldIfDue();
      signal.throwIfAborted();
    }
    return built;
  }
  const shares = new Float64Array(meshes.length);
  // Long builds first: several workers end at about the same time.
  const order = [...meshes.keys()].sort(
    (a, b) => (meshes[b] as Mesh).indices.length - (meshes[a] as Mesh).indices.length || a - b,
  );
  const build = async (i: number) => {
    const { positions, indices } = meshes[i] as Mesh;
    const progress = (done: number) => {
      if (signal.aborted || !(done > (shares[i] as number))) return;
      const share = Math.min(1, done);
      finished += ((share - (shares[i] as number)) * indices.length) / 3;
      shares[i] = share;
      onProgress(Math.min(1, finished / total));
    };
    built[i] = await hierarchies.buildBlas({ positions, indices }, { signal, onProgress: progress });
    progress(1);
  };
  await Promise.all(order.map(build));
  return built;
}
