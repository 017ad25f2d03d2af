import type { TlasInstance } from '@glanz/bvh';
import { DynamicTlas, type TlasInstances } from '@glanz/bvh/dynamic-tlas';
import type { Instance, Material, Mesh, Scene } from '@glanz/scene';
import { RenderError } from '../errors';
import type { Hierarchy } from './hierarchy';
import { NONE } from '../storage/layout';
import { emittedRadiance } from '../materials/materials';
import { parametersOf } from '../materials/parameters';

/** Words of a node, of which two refer to its children. */
const NODE_WORDS = 16;
const LEFT_CHILD = 3;
const RIGHT_CHILD = 7;
const LEAF = 0x80000000;
/** Nodes up to so far apart are written at once, with those in between: each write costs more than their bytes. */
const JOINED_NODES = 16;

/** Whether an instance can be seen, as far as the scene itself says. */
export const isShown = (scene: Scene, instance: Instance) =>
  instance.visible !== false && (scene.meshes[instance.mesh] as Mesh).indices.length >= 3;

/** Nodes for the GPU. */
export interface NodeRange {
  /** In the node buffer. */
  readonly first: number;
  readonly nodes: Float32Array<ArrayBuffer>;
}

/**
 * Where the instances of a scene are: the upper levels of the hierarchy. Changes in place, at a cost that depends on
 * how many instances change. The GPU record of an instance has the instance's index in the scene.
 */
export class Placement {
  readonly tlas: DynamicTlas;
  /** Scene instance → GPU record, which is the same number; NONE for one that cannot be hit. */
  readonly instanceSlots: Uint32Array<ArrayBuffer>;
  /** By instance: 1 for a catcher that can be hit. */
  readonly #isCatcher: Uint8Array;
  #catchers = 0;
  #bare: DynamicTlas | undefined;
  #isBareNew = false;

  /**
   * @param tlas Over {@link tlasInstances}.
   * @throws {RenderError} `renderer/no-triangles` if nothing can be seen.
   */
  constructor(
    scene: Scene,
    blas: readonly (Hierarchy | undefined)[],
    tlas = new DynamicTlas(tlasInstances(scene, blas)),
  ) {
    const { length } = scene.instances;
    this.tlas = tlas;
    this.instanceSlots = new Uint32Array(length).fill(NONE);
    this.#isCatcher = new Uint8Array(length);
    for (let i = 0; i < length; i++) this.#note(scene, i);
    this.#placeBare(scene, blas);
    this.#check(scene);
  }

  /**
   * A second hierarchy of the catchers and of what glows, which belongs to the environment as they do: what a catcher
   * would look like without the rest. Only where a catcher can be hit.
   */
  get bare(): DynamicTlas | undefined {
    return this.#bare;
  }

  /** Where the nodes of {@link bare} begin in the node buffer. */
  get bareRoot(): number {
    return Math.max(this.instanceSlots.length, 1);
  }

  /** Nodes that both hierarchies need at most, whatever is shown. */
  get nodeCapacity(): number {
    return this.bareRoot * (this.#bare ? 2 : 1);
  }

  get center(): readonly [number, number, number] {
    const { min, max } = this.tlas.bounds;
    return [0, 1, 2].map((k) => ((min[k] as number) + (max[k] as number)) / 2) as [number, number, number];
  }

  get radius(): number {
    const { min, max } = this.tlas.bounds;
    return 0.5 * Math.hypot(...[0, 1, 2].map((k) => (max[k] as number) - (min[k] as number)));
  }

  /**
   * Follows changes of some of the scene's instances.
   *
   * @param moved Whether transforms or visibility changed; otherwise only materials and catchers did.
   * @throws {RenderError} `renderer/no-triangles` if nothing can be seen any more. The change has been followed all the
   * same.
   */
  update(scene: Scene, blas: readonly (Hierarchy | undefined)[], changed: readonly number[], moved: boolean): void {
    const changes = () => changed.map((i) => [i, placing(scene, blas, scene.instances[i] as Instance)] as const);
    if (moved) this.tlas.update(changes());
    for (const i of changed) this.#note(scene, i);
    if (this.#bare && this.#catchers > 0) {
      const isGlowing = glowing(scene);
      this.#bare.update(changes().map(([i, place]) => [i, this.#isBare(scene, i, isGlowing) ? place : undefined]));
    } else this.#placeBare(scene, blas);
    this.#check(scene);
  }

  /** The nodes of both hierarchies that have changed since they were last taken; at first all of them. */
  takeChangedNodes(): NodeRange[] {
    const changed = (tlas: DynamicTlas, root: number) =>
      [...joinedRanges(tlas.takeChangedNodes(), JOINED_NODES)].map((range) => rangeOf(tlas, root, range));
    const ranges = changed(this.tlas, 0);
    if (!this.#bare) return ranges;
    const others = changed(this.#bare, this.bareRoot);
    const isNew = this.#isBareNew;
    this.#isBareNew = false;
    return [...ranges, ...(isNew ? [rangeOf(this.#bare, this.bareRoot)] : others)];
  }

  /** All nodes of both hierarchies. */
  allNodes(): NodeRange[] {
    return [rangeOf(this.tlas, 0), ...(this.#bare ? [rangeOf(this.#bare, this.bareRoot)] : [])];
  }

  #note(scene: Scene, index: number): void {
    const isPlaced = this.tlas.has(index);
    this.instanceSlots[index] = isPlaced ? index : NONE;
    const isCatcher = isPlaced && scene.instances[index]?.catcher ? 1 : 0;
    this.#catchers += isCatcher - (this.#isCatcher[index] as number);
    this.#isCatcher[index] = isCatcher;
  }

  #isBare(scene: Scene, index: number, isGlowing: (material: number) => boolean): boolean {
    return (
      this.tlas.has(index) && (this.#isCatcher[index] === 1 || isGlowing((scene.instances[index] as Instance).material))
    );
  }

  /** Makes the second hierarchy, where there are catchers. */
  #placeBare(scene: Scene, blas: readonly (Hierarchy | undefined)[]): void {
    const isGlowing = glowing(scene);
    this.#bare =
      this.#catchers > 0
        ? new DynamicTlas(
            scene.instances.map((instance, i) =>
              this.#isBare(scene, i, isGlowing) ? placing(scene, blas, instance) : undefined,
            ),
          )
        : undefined;
    this.#isBareNew = true;
  }

  #check(scene: Scene): void {
    if (this.tlas.count > 0) return;
    if (scene.instances.some((instance) => isShown(scene, instance)))
      throw new RenderError('renderer/no-triangles', 'Every instance has a transform that flattens it.');
    throw new RenderError('renderer/no-triangles', 'The scene has no visible triangles.');
  }
}

/** What the upper levels are over: the scene's instances. */
export const tlasInstances = (scene: Scene, blas: readonly (Hierarchy | undefined)[]): TlasInstances => ({
  length: scene.instances.length,
  at: (i) => placing(scene, blas, scene.instances[i] as Instance),
});

function placing(scene: Scene, blas: readonly (Hierarchy | undefined)[], instance: Instance): TlasInstance | undefined {
  const tree = blas[instance.mesh];
  return tree && tree.triangleIndices.length > 0 && isShown(scene, instance)
    ? { bounds: tree.bounds, transform: instance.transform }
    : undefined;
}

/** Says of a material whether it emits, and finds out once. */
function glowing(scene: Scene): (material: number) => boolean {
  const known = new Map<number, boolean>();
  return (index) => {
    let found = known.get(index);
    if (found === undefined)
      known.set(index, (found = emittedRadiance(parametersOf(scene.materials[index] as Material)).some((c) => c > 0)));
    return found;
  };
}

/** Nodes of a hierarchy that lies in the node buffer from `root` on: by default all. */
function rangeOf(
  { nodes, nodeCount }: DynamicTlas,
  root: number,
  [first, end]: readonly [number, number] = [0, nodeCount],
): NodeRange {
  const range = nodes.subarray(first * NODE_WORDS, end * NODE_WORDS);
  return { first: root + first, nodes: root === 0 ? range : moved(range, root) };
}

/** Ranges, from the first up to the second number, of numbers that rise; those up to `gap` apart are joined. */
export function* joinedRanges(numbers: Uint32Array, gap: number): Generator<readonly [from: number, to: number]> {
  for (let i = 0; i < numbers.length;) {
    const first = numbers[i++] as number;
    let end = first + 1;
    while (i < numbers.length && (numbers[i] as number) <= end + gap) end = (numbers[i++] as number) + 1;
    yield [first, end];
  }
}

/** Nodes with references to inner nodes that count from another place. Leaves name records, which are the same ones. */
function moved(nodes: Float32Array<ArrayBuffer>, root: number): Float32Array<ArrayBuffer> {
  const copy = nodes.slice();
  const words = new Uint32Array(copy.buffer);
  for (let node = 0; node < words.length; node += NODE_WORDS) {
    for (const child of [node + LEFT_CHILD, node + RIGHT_CHILD])
      if ((words[child] as number) < LEAF) (words[child] as number) += root;
  }
  return copy;
}
