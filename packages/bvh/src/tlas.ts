import { buildOverBoxes } from './builders/over-boxes';
import { BvhError } from './error';
import { rootBounds, TLAS_MAX_DEPTH, type Aabb } from './layout';
import { checkTransform, placeInstance, type TlasInstance } from './place-instance';

/** Top-level hierarchy: instances. */
export interface Tlas {
  /** Nodes, as in a BLAS; each leaf holds one instance. */
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly nodeCount: number;
  /**
   * Leaf order → instance given. Instances that no ray can hit are left out: those with an empty BLAS, or with a
   * transform that is not finite or is singular.
   */
  readonly instanceOrder: Uint32Array<ArrayBuffer>;
  /**
   * 12 numbers an instance given: the rows of the 3×4 matrix from world to object space. Those of instances that are
   * left out mean nothing.
   */
  readonly toObject: Float64Array<ArrayBuffer>;
  /** Box of everything, in the world. */
  readonly bounds: Aabb;
}

/**
 * Builds the hierarchy over instances: a millisecond for a thousand. Rebuild it when instances move; their BLAS stay.
 * Where few of many instances move, appear or vanish, `DynamicTlas` of `@glanz/bvh/dynamic-tlas` costs less. No path
 * from the root has more than {@link TLAS_MAX_DEPTH} inner nodes.
 *
 * @throws {BvhError} `bvh/transform` for a transform without 16 numbers, `bvh/too-many` beyond 4 million instances.
 */
export function buildTlas(instances: readonly TlasInstance[]): Tlas {
  const { length } = instances;
  if (length > 2 ** TLAS_MAX_DEPTH)
    throw new BvhError('bvh/too-many', `${length} instances: one hierarchy holds ${2 ** TLAS_MAX_DEPTH}.`);
  const boxes = new Float32Array(length * 6);
  const toObject = new Float64Array(length * 12);
  const kept = new Uint32Array(length);
  let count = 0;
  for (let i = 0; i < length; i++) {
    const instance = instances[i] as TlasInstance;
    checkTransform(instance, i);
    if (placeInstance(instance, boxes, 6 * count, toObject, 12 * i)) kept[count++] = i;
  }
  const { nodes, nodeCount } = buildOverBoxes(boxes, count, TLAS_MAX_DEPTH).finish();
  return { nodes, nodeCount, instanceOrder: kept.slice(0, count), toObject, bounds: rootBounds(nodes) };
}
