import type { Mesh, Scene } from '@glanz/scene';

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
 * How a scene's instances use its materials, counted in one pass over the instances. What decides the kernels' text and the
 * material records is then known per material, without another pass.
 */
export class MaterialUse {
  readonly #visible: Uint32Array;
  readonly #translucent: Uint32Array;

  constructor({ materials, meshes, instances }: Scene) {
    this.#visible = new Uint32Array(materials.length);
    this.#translucent = new Uint32Array(materials.length);
    const alpha = meshes.map(hasAlpha);
    for (const { material, mesh, visible } of instances) {
      if (visible !== false) (this.#visible[material] as number)++;
      if (alpha[mesh]) (this.#translucent[material] as number)++;
    }
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
