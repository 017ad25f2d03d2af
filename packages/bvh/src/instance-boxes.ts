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
 * Builds a tree over boxes. Where it gives none, or one without all of them, the caller builds it.
 *
 * @param boxes Six numbers each: min xyz, max xyz; finite. Not to be changed.
 * @param count How many, also 0.
 */
export type BuildBoxes = (boxes: Float32Array<ArrayBuffer>, count: number) => Promise<BoxTree | undefined>;

/** Boxes of the instances that can be hit, without gaps. */
export interface InstanceBoxes {
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
  const boxes = new Float32Array(6 * instances.length);
  const present = new Uint8Array(instances.length);
  for (let i = 0; i < present.length; i++) {
    const instance = instances.at(i);
    if (!instance) continue;
    checkTransform(instance, i);
    present[i] = placeInstance(instance, boxes, 6 * i, toObject, 12 * i) ? 1 : 0;
  }
  return withoutGaps(boxes, present);
}

/**
 * Moves the boxes of those that are present together, to the beginning.
 *
 * @param present By instance: 1, or 0.
 */
export function withoutGaps(boxes: Float32Array<ArrayBuffer>, present: Uint8Array): InstanceBoxes {
  const kept = new Uint32Array(present.length);
  let count = 0;
  for (let i = 0; i < present.length; i++) {
    if (!present[i]) continue;
    if (count < i) boxes.copyWithin(6 * count, 6 * i, 6 * i + 6);
    kept[count++] = i;
  }
  return { boxes: boxes.subarray(0, 6 * count), instances: kept.subarray(0, count) };
}
