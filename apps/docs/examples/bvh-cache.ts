import { BlasCache } from '@glanz/bvh/cache';
import { openIndexedDbStore } from '@glanz/bvh/indexed-db';
import { BvhWorkers } from '@glanz/bvh/workers';
import { PathTracer, requestDevice } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';

/**
 * A path tracer that builds hierarchies on worker threads, unless this browser
 * has stored them on an earlier visit.
 */
export async function createTracer(scene: Scene): Promise<PathTracer> {
  const workers = await BvhWorkers.create();
  const hierarchies = new BlasCache(await openIndexedDbStore(), workers, {
    onError: console.warn,
  });
  try {
    return await PathTracer.create(await requestDevice(), scene, {
      width: 1024,
      height: 1024,
      hierarchies,
    });
  } finally {
    workers.destroy();
  }
}
