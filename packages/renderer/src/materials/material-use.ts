import type { Instance, Mesh, Scene } from '@glanz/scene';

const alphaKnown = new WeakMap<Float32Array, boolean>();

/** Whether a mesh's vertex colours are less than opaque somewhere. Each array of colours is scanned once. */
function hasAlpha({ colors }: Mesh): boolean {
  if (!colors) return false;
  let found = alphaKnown.get(colors);
  if (found === undefined) {
    found = false;
    for (let i = 3; i < colors.length && !found; i += 4) found = (colors[i] as number) < 1;
    alphaKnown.set(colors, found);
  }
  return found;
}

/**
 * How a scene's instances use its materials, counted in one pass over the instances. What decides the kernels' text and
 * the material records is then known per material, without another pass.
 */
export class MaterialUse {
  readonly #visible: Uint32Array;
  readonly #translucent: Uint32Array;
  readonly #alpha: readonly boolean[];

  constructor({ materials, meshes, instances }: Scene) {
    this.#visible = new Uint32Array(materials.length);
    this.#translucent = new Uint32Array(materials.length);
    this.#alpha = meshes.map(hasAlpha);
    for (const instance of instances) this.#count(instance, 1);
  }

  /**
   * Counts an instance as it is now, and no longer as it was. Its mesh must be one of those given to the constructor.
   * @returns Whether all answers are the same as before.
   */
  replace(before: Instance, after: Instance): boolean {
    const answers = () =>
      [before.material, after.material]
        .map((material) => `${this.isVisible(material)} ${this.hasVertexAlpha(material)}`)
        .join();
    const known = answers();
    this.#count(before, -1);
    this.#count(after, 1);
    return answers() === known;
  }

  #count({ material, mesh, visible }: Instance, by: number): void {
    if (visible !== false) (this.#visible[material] as number) += by;
    if (this.#alpha[mesh]) (this.#translucent[material] as number) += by;
  }

  /** Whether a visible instance has the material. */
  isVisible(material: number): boolean {
    return (this.#visible[material] as number) > 0;
  }

  /** Whether an instance, visible or not, has the material on a mesh whose vertex colours let light pass. */
  hasVertexAlpha(material: number): boolean {
    return (this.#translucent[material] as number) > 0;
  }
}
