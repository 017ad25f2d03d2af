import { checkTransform, placeInstance, type TlasInstance } from './place-instance';

/** What can be hit, such as an array; each is asked for once. `undefined`: not in the hierarchy for now. */
export type TlasInstances = Pick<readonly (TlasInstance | undefined)[], 'length' | 'at'>;

/** A tree over boxes, one box a leaf, in the layout of `Tlas.nodes`: parents before their children. */
export interface BoxTree {
  readonly nodes: Float32Array;
  readonly nodeCount: number;
  /** Leaf order → box given. */
  readonly order: Uint32Array;
}

/**
 * Builds a tree over all of some boxes. Where it gives none, the caller builds it.
 *
 * @param boxes Six numbers each: min xyz, max xyz; finite. Not to be changed.
 * @param count How many, also 0.
 */
export type BuildBoxes = (boxes: Float32Array<ArrayBuffer>, count: number) => Promise<BoxTree | undefined>;

/** Boxes of the instances that can be hit, one after the other. */
export interface InstanceBoxes {
  /** With room for more. */
  readonly boxes: Float32Array<ArrayBuffer>;
  /** The instance of each box. */
  readonly instances: Uint32Array<ArrayBuffer>;
}

/**
 * The boxes of instances in world space.
 *
 * @param toObject 12 numbers an instance: set to the inverse transforms.
 * @throws {BvhError} `bvh/transform` for a transform without 16 numbers.
 */
export function instanceBoxes(instances: TlasInstances, toObject: Float64Array): InstanceBoxes {
  const { length } = instances;
  const boxes = new Float32Array(6 * length);
  const kept = new Uint32Array(length);
  let count = 0;
  for (let i = 0; i < length; i++) {
    const instance = instances.at(i);
    if (!instance) continue;
    checkTransform(instance, i);
    if (placeInstance(instance, boxes, 6 * count, toObject, 12 * i)) kept[count++] = i;
  }
  return { boxes, instances: kept.subarray(0, count) };
}
