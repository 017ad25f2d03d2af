import { isMainThread, parentPort, Worker, workerData } from 'node:worker_threads';
import { buildBlas } from '@glanz/bvh';
import { serveBuilds } from '@glanz/bvh/worker';
import { BvhWorkers } from '@glanz/bvh/workers';
import { buildBlasAsync } from '@glanz/bvh/async';
import type { BenchMesh } from './meshes';

interface Role {
  readonly role: 'serve' | 'cold';
  readonly mesh?: BenchMesh;
}

/** The bundle itself, once more, in a thread of its own: nothing in it has run yet. */
const again = (data: Role) => new Worker(new URL(import.meta.url), { workerData: data, stdout: true });

/** True in a thread that was started from here; the benchmark has nothing to do there. */
export function servesBenchmark(): boolean {
  const data = workerData as Role | null;
  // In a worker the module answers build requests by itself, if only it is there: bundlers leave out what is not named.
  if (isMainThread || !data?.role || typeof serveBuilds !== 'function') return false;
  if (data.role === 'cold' && data.mesh) {
    const times: number[] = [];
    for (let i = 0; i < 7; i++) {
      const start = performance.now();
      buildBlas(data.mesh);
      times.push(performance.now() - start);
    }
    parentPort?.postMessage({ kind: 'cold', times });
  }
  return true;
}

/** Milliseconds of seven builds one after the other in a fresh thread: the first runs code that was never compiled. */
export function coldTimes(mesh: BenchMesh): Promise<number[]> {
  return new Promise((resolve, reject) => {
    const worker = again({ role: 'cold', mesh });
    worker.on('error', reject);
    worker.on('message', (message: { kind: string; times: number[] }) => {
      if (message.kind !== 'cold') return;
      resolve(message.times);
      void worker.terminate();
    });
  });
}

/** So many workers of this benchmark. `warmUp` lets them run what they will run before they are asked to. */
export async function benchWorkers(count: number, warmUp = false): Promise<BvhWorkers> {
  const workers = await BvhWorkers.create({
    count,
    together: true,
    warmUp,
    createWorker: () => again({ role: 'serve' }),
  });
  if (workers.fallback) throw new Error(workers.fallback);
  return workers;
}

/**
 * Milliseconds for building `meshes` on one worker and on two, after a round of each that does not count; taken in
 * turns, so that a disturbance of the machine meets both alike.
 */
export async function workerTimes(
  meshes: readonly BenchMesh[],
  runs: number,
): Promise<readonly [one: number[], two: number[]]> {
  const pools = [await benchWorkers(1), await benchWorkers(2)] as const;
  const times: readonly [number[], number[]] = [[], []];
  for (let i = -1; i < runs; i++) {
    for (const [k, workers] of pools.entries()) {
      const start = performance.now();
      await Promise.all(meshes.map((mesh) => workers.buildBlas(mesh)));
      if (i >= 0) times[k]!.push(performance.now() - start);
    }
  }
  for (const workers of pools) workers.destroy();
  return times;
}

/** Builds in slices on this thread: milliseconds in all, and the longest time that the thread was not free. */
export async function slicedTimes(
  mesh: BenchMesh,
  runs: number,
): Promise<{ readonly all: number[]; readonly longest: number[] }> {
  const all: number[] = [],
    longest: number[] = [];
  for (let i = -1; i < runs; i++) {
    let last = performance.now(),
      max = 0,
      done = false;
    const tick = () => {
      const now = performance.now();
      max = Math.max(max, now - last);
      last = now;
      if (!done) setImmediate(tick);
    };
    setImmediate(tick);
    const start = performance.now();
    await buildBlasAsync(mesh);
    const end = performance.now();
    done = true;
    max = Math.max(max, end - last);
    if (i < 0) continue;
    all.push(end - start);
    longest.push(max);
  }
  return { all, longest };
}
