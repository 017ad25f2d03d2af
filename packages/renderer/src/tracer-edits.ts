import type { Environment, Light, Material, Mesh } from '@glanz/scene';
import type { SceneChange } from './scene/scene-change';
import type { SceneEditor } from './scene/scene-editor';

/**
 * The edits of a `PathTracer`. Each changes the tracer's own scene and restarts the film; its cost depends on what it
 * changes.
 *
 * An edit is made as a whole or not at all. Where the GPU refuses it (`renderer/out-of-memory`, `renderer/gpu-error`, a
 * shader that does not compile), the promise rejects, and scene, film and samples are what they were before; where that
 * turns out only when kernels are there, edits made meanwhile are taken back with it, and the film begins again.
 */
export abstract class TracerEdits {
  /** @internal Makes an edit, and brings the kernels that it needs. */
  protected abstract edit(prepare: (editor: SceneEditor) => SceneChange | Promise<SceneChange>): Promise<void>;

  /**
   * Changes parameters of a material and restarts the film. Where the change needs kernels that are not compiled yet (a
   * new lobe), the old ones are used until the new ones are ready.
   *
   * @returns When the image shows the change in full.
   * @param parameters Names and values as `OPENPBR_PARAMETERS` of `@glanz/openpbr` has them.
   * @throws {RenderError} `renderer/material` if there is no such material, for unknown names, numbers that are not
   * finite, and values out of range. Nothing is changed then.
   */
  setMaterial(nameOrIndex: string | number, parameters: Material['parameters']): Promise<void> {
    return this.edit((editor) => editor.setMaterial(nameOrIndex, parameters));
  }

  /**
   * Changes a light without size: its intensity, colour, place, … Restarts the film.
   *
   * @throws {RenderError} `renderer/light` if there is no such light, {SceneError} for values that a light cannot have.
   */
  setLight(nameOrIndex: string | number, change: Partial<Light>): Promise<void> {
    return this.edit((editor) => editor.setLight(nameOrIndex, change));
  }

  /**
   * Replaces the environment and restarts the film. The `data` array of the present environment with another rotation,
   * intensity or visibility is neither validated nor read again, and costs what {@link adjustEnvironment} costs. So do
   * not change its texels in place; pass another array. Another image is validated and prepared a few milliseconds at a
   * time; later edits of the environment wait for it, all others do not.
   *
   * @throws {SceneError} for values that an environment cannot have.
   */
  setEnvironment(environment: Environment | undefined): Promise<void> {
    return this.edit((editor) => editor.setEnvironment(environment));
  }

  /**
   * Rotates the environment, changes its intensity, or hides it from the camera, at the cost of a uniform. Restarts the
   * film.
   *
   * @throws {RenderError} `renderer/environment` without an environment, for numbers that are not finite, a negative
   * intensity, and the intensity of a constant.
   */
  adjustEnvironment(change: {
    readonly rotation?: number;
    readonly intensity?: number;
    readonly visible?: boolean;
  }): Promise<void> {
    return this.edit((editor) => editor.adjustEnvironment(change));
  }

  /**
   * Moves the instances of a name, or the one of an index: object to world, 16 numbers, column-major. The cost depends
   * on the instances that move, not on the number of others; emissive instances also update the light tables. Restarts
   * the film.
   *
   * @throws {RenderError} `renderer/instance`, `renderer/transform`, `renderer/no-triangles` if nothing would be left
   * to see.
   */
  setInstanceTransform(nameOrIndex: string | number, transform: ArrayLike<number>): Promise<void> {
    return this.setInstanceTransforms([[nameOrIndex, transform]]);
  }

  /**
   * Moves several parts as one edit: what {@link setInstanceTransform} does for each, but the film restarts once, and the
   * GPU checks once. Of a part that is listed more than once, the last transform counts. An empty list does nothing: the
   * film continues.
   *
   * @param list Names or indices with transforms.
   * @throws {RenderError} As {@link setInstanceTransform}; nothing has moved then.
   * @example
   * await tracer.setInstanceTransforms([['lid', lidAt(time)], ['wheel', wheelAt(time)]]);
   */
  async setInstanceTransforms(
    list: readonly (readonly [nameOrIndex: string | number, transform: ArrayLike<number>])[],
  ): Promise<void> {
    if (list.length) return this.edit((editor) => editor.setTransforms(list));
  }

  /**
   * Shows or hides the instances of a name, or the one of an index, or several of them at once. The cost depends on the
   * instances that change; meshes that are shown for the first time also need their hierarchies. Restarts the film.
   *
   * @throws {RenderError} `renderer/instance`, `renderer/no-triangles` if nothing would be left to see.
   */
  setVisibility(nameOrIndex: string | number | readonly (string | number)[], visible: boolean): Promise<void> {
    return this.edit((editor) => editor.setVisibility(nameOrIndex, visible));
  }

  /**
   * Makes the instances of a name, or the one of an index, catchers of shadows and reflections, or plain surfaces
   * again; see `Instance.catcher`. The first catcher needs other kernels. Restarts the film.
   *
   * @throws {RenderError} `renderer/instance`
   */
  setCatcher(nameOrIndex: string | number, catcher: boolean): Promise<void> {
    return this.edit((editor) => editor.setCatcher(nameOrIndex, catcher));
  }

  /**
   * Puts another material on the instances of a name, or on the one of an index. Restarts the film.
   * @throws {RenderError} `renderer/instance`, `renderer/material`
   */
  setInstanceMaterial(nameOrIndex: string | number, material: string | number): Promise<void> {
    return this.edit((editor) => editor.setMaterialOf(nameOrIndex, material));
  }

  /**
   * Puts the scene into one of its variants, or into its own look. Restarts the film.
   * @throws {RenderError} `renderer/variant` if there is no such variant.
   */
  setVariant(variant: string | number | undefined): Promise<void> {
    return this.edit((editor) => editor.setVariant(variant));
  }

  /**
   * Swaps a mesh for another under all its instances: costs the hierarchy of that mesh, and none if it was in the scene
   * before. Restarts the film.
   *
   * A mesh of `poseMesh` of `@glanz/scene/pose` that follows another pose of the same rig is posed on the GPU: no vertex
   * is computed or uploaded by the CPU, and the hierarchy is refitted, and built again where it got worse by half. Its
   * vertices are those of the CPU but for rounding. A normal that morph targets or joints cancel out is that of the bind
   * pose; the CPU computes it from the triangles. Where hierarchies are built on the CPU (`bvhBuilder`, software
   * adapters), or the GPU cannot bind the rig, the vertices are computed on the CPU.
   *
   * @throws {RenderError} `renderer/mesh` if there is no such mesh, {SceneError} if the new one is broken.
   */
  replaceMesh(nameOrIndex: string | number, mesh: Mesh): Promise<void> {
    return this.edit((editor) => editor.replaceMesh(nameOrIndex, mesh));
  }
}
