import { loadPart } from '@glanz/wgsl';
import {
  createScene,
  checkScene,
  type Environment,
  type Instance,
  type Light,
  type Material,
  type Mesh,
  type Scene,
} from '@glanz/scene';
import { notFound, RenderError } from '../errors';
import { EnvironmentEditor, type EnvironmentAdjustment } from './environment-editor';
import type { GpuScene } from './gpu-scene';
import type { SceneChange } from './scene-change';
import { checkParameters } from '../materials/check-parameters';
import { attributeWords, layOutGeometry, meshSlices, packGeometry, type Geometry } from '../geometry/geometry';
import { prepareHierarchies } from '../geometry/prepare-geometry';
import { loadGpuTrees, type HierarchyOptions } from '../geometry/hierarchies';
import type { Hierarchy } from '../geometry/hierarchy';
import { emittedRadiance, findMaterial } from '../materials/materials';
import { parametersOf } from '../materials/parameters';
import { isShown } from '../geometry/placement';

/** A copy that the tracer may edit: big arrays are shared, for edits replace them and never write into them. */
export function ownScene(scene: Scene): Scene {
  return {
    ...scene,
    meshes: [...scene.meshes],
    materials: scene.materials.map((material) => ({ ...material, parameters: { ...material.parameters } })),
    instances: scene.instances.map((instance) => ({ ...instance })),
    lights: scene.lights.map((light) => ({ ...light })),
  };
}

/**
 * Edits of a scene that is on the GPU. Each method checks what it is given and prepares what takes time (hierarchies),
 * and gives the change, which is then made at once: between two changes the scene is always whole.
 */
export class SceneEditor {
  readonly scene: Scene;
  readonly gpu: GpuScene;
  readonly builders: HierarchyOptions;
  /** Materials that instances wear without a variant. */
  readonly #plain: number[];
  /** Hierarchies of meshes that are or were in the scene, so that a part that comes back costs nothing to build. */
  readonly trees = new WeakMap<Mesh, Hierarchy>();
  /** Instances by name, which no edit changes; made at the first look-up by name. */
  #named: Map<string, number[]> | undefined;
  #geometry: Geometry;
  #version = 0;
  readonly #environment: EnvironmentEditor;

  /** @param builders Build what edits bring. */
  constructor(scene: Scene, geometry: Geometry, gpu: GpuScene, builders: HierarchyOptions) {
    this.scene = scene;
    this.#geometry = geometry;
    this.gpu = gpu;
    this.builders = builders;
    this.#environment = new EnvironmentEditor(scene, gpu);
    this.#plain = scene.instances.map(({ material }) => material);
    this.#remember(scene, geometry.blas);
  }

  get geometry(): Geometry {
    return this.#geometry;
  }

  setMaterial(nameOrIndex: string | number, parameters: Material['parameters']): SceneChange {
    const index = this.#material(nameOrIndex);
    const material = this.scene.materials[index] as Material;
    checkParameters(material.name, parameters);
    const before = material.parameters;
    const glows = () => emittedRadiance(parametersOf(material)).some((c) => c > 0);
    const set = (next: Material['parameters']) => {
      const glowed = glows();
      material.parameters = next;
      const { placement, blas } = this.#geometry;
      // Emitters are visible beside catchers: the set of visible objects changes when one is switched.
      if (placement.bare && glows() !== glowed)
        placement.update(
          this.scene,
          blas,
          this.scene.instances.flatMap((instance, i) => (instance.material === index ? [i] : [])),
          false,
        );
    };
    return {
      isStale: () => material.parameters !== before,
      apply: () => {
        set({ ...before, ...parameters });
        const emission = Object.entries(parameters).some(
          ([name, value]) =>
            name.startsWith('emission_') &&
            JSON.stringify(before[name as keyof typeof before]) !== JSON.stringify(value),
        );
        return this.gpu.updateMaterial(index, emission);
      },
      undo: () => set(before),
    };
  }

  setLight(nameOrIndex: string | number, change: Partial<Light>): SceneChange {
    const { lights } = this.scene;
    const index = typeof nameOrIndex === 'number' ? nameOrIndex : lights.findIndex(({ name }) => name === nameOrIndex);
    const light = lights[index];
    if (!light) throw notFound('renderer/light', nameOrIndex, lights);
    const next = { ...light, ...change, type: light.type } as Light;
    checkScene({ ...createScene(), lights: [next] });
    return {
      isStale: () => lights[index] !== light,
      apply: () => {
        lights[index] = next;
        return this.gpu.updateLights();
      },
      undo: () => (lights[index] = light),
    };
  }

  setEnvironment(environment: Environment | undefined): SceneChange | Promise<SceneChange> {
    return this.#environment.set(environment);
  }

  adjustEnvironment(change: EnvironmentAdjustment): SceneChange | Promise<SceneChange> {
    return this.#environment.adjust(change);
  }

  setTransforms(
    list: readonly (readonly [nameOrIndex: string | number, transform: ArrayLike<number>])[],
  ): SceneChange | Promise<SceneChange> {
    const places = new Map<number, number[]>();
    for (const [nameOrIndex, transform] of list) {
      const place = Array.from(transform);
      if (place.length !== 16 || !place.every(Number.isFinite))
        throw new RenderError('renderer/transform', 'A transform must be 16 finite numbers.');
      for (const index of this.#instances(nameOrIndex)) places.set(index, place);
    }
    return this.#change(
      [...places.keys()],
      (instance, index) => ({ ...instance, transform: places.get(index) as number[] }),
      true,
      'reprojects',
    );
  }

  setMaterialOf(nameOrIndex: string | number, material: string | number): SceneChange | Promise<SceneChange> {
    const index = this.#material(material);
    const which = this.#instances(nameOrIndex);
    const before = which.map((i) => this.#plain[i] as number);
    const withPlain = (change: SceneChange): SceneChange => ({
      ...change,
      apply: () => {
        which.forEach((i) => (this.#plain[i] = index));
        return change.apply();
      },
      undo: () => {
        which.forEach((i, k) => (this.#plain[i] = before[k] as number));
        change.undo();
      },
    });
    const placed = this.#change(which, (instance) => ({ ...instance, material: index }), false);
    return placed instanceof Promise ? placed.then(withPlain) : withPlain(placed);
  }

  setVariant(variant: string | number | undefined): SceneChange | Promise<SceneChange> {
    const all = this.scene.variants ?? [];
    const index = typeof variant === 'string' ? all.indexOf(variant) : variant;
    if (index !== undefined && all[index] === undefined)
      throw notFound(
        'renderer/variant',
        variant,
        all.map((name) => ({ name })),
      );
    const materialOf = (instance: Instance, i: number) =>
      (index === undefined ? undefined : instance.variants?.[index]) ?? (this.#plain[i] as number);
    const which = [...this.scene.instances.keys()].filter(
      (i) => materialOf(this.scene.instances[i] as Instance, i) !== this.scene.instances[i]?.material,
    );
    return this.#change(which, (instance, i) => ({ ...instance, material: materialOf(instance, i) }), false);
  }

  setCatcher(nameOrIndex: string | number, catcher: boolean): SceneChange | Promise<SceneChange> {
    return this.#change(this.#instances(nameOrIndex), (instance) => ({ ...instance, catcher }), false);
  }

  setVisibility(
    nameOrIndex: string | number | readonly (string | number)[],
    visible: boolean,
  ): SceneChange | Promise<SceneChange> {
    const which = [...new Set([nameOrIndex].flat().flatMap((one) => this.#instances(one)))];
    return this.#change(which, (instance) => ({ ...instance, visible }), true);
  }

  async replaceMesh(nameOrIndex: string | number, mesh: Mesh): Promise<SceneChange> {
    // A chunk of its own, for most scenes keep their meshes.
    const { replaceMesh } = await loadPart('replace-mesh', import('./replace-mesh'));
    const tools = [
      attributeWords,
      createScene,
      layOutGeometry,
      loadGpuTrees,
      meshSlices,
      notFound,
      checkScene,
    ] as const;
    return replaceMesh(this, tools, nameOrIndex, mesh);
  }

  /** @internal Hierarchies that are known. */
  blas(scene: Scene): (Hierarchy | undefined)[] {
    return scene.meshes.map((mesh) => this.trees.get(mesh));
  }

  /**
   * Brings the hierarchies of a scene.
   * @param read Meshes whose nodes the CPU needs: also those of the scene as it is, which an edit may have to write
   * again.
   * @internal
   */
  async build(scene: Scene, read: readonly Mesh[]): Promise<void> {
    this.#remember(
      scene,
      await prepareHierarchies(scene, { ...this.builders, compact: this.#geometry.compact }, this.blas(scene)),
    );
    const load = async (mesh: Mesh) => {
      const tree = this.trees.get(mesh);
      if (tree?.gpu) this.trees.set(mesh, await tree.gpu.read());
    };
    await Promise.all([...new Set(read)].map(load));
  }

  #remember(scene: Scene, blas: readonly (Hierarchy | undefined)[]): void {
    scene.meshes.forEach((mesh, i) => {
      const tree = blas[i];
      if (tree) this.trees.set(mesh, tree);
    });
  }

  /** @internal The change to other instances, meshes and where they lie. */
  commit({ instances, meshes }: Scene, geometry: Geometry, upload: () => boolean): SceneChange {
    const version = this.#version;
    const before = { instances: this.scene.instances, meshes: this.scene.meshes, geometry: this.#geometry };
    const set = (state: typeof before) => {
      this.#version++;
      this.scene.instances = state.instances;
      this.scene.meshes = state.meshes;
      this.#geometry = state.geometry;
    };
    return {
      isStale: () => version !== this.#version,
      apply: () => {
        set({ instances, meshes, geometry });
        return upload();
      },
      undo: () => set(before),
    };
  }

  #material(nameOrIndex: string | number): number {
    const index = findMaterial(this.scene, nameOrIndex);
    if (index < 0) throw notFound('renderer/material', nameOrIndex, this.scene.materials);
    return index;
  }

  get #byName(): ReadonlyMap<string, readonly number[]> {
    if (!this.#named) {
      this.#named = new Map();
      for (const [i, { name }] of this.scene.instances.entries()) {
        const same = this.#named.get(name);
        if (same) same.push(i);
        else this.#named.set(name, [i]);
      }
    }
    return this.#named;
  }

  /** Indices of the instances of a name, or the one of an index. */
  #instances(nameOrIndex: string | number): readonly number[] {
    const found =
      typeof nameOrIndex === 'string'
        ? this.#byName.get(nameOrIndex)
        : this.scene.instances[nameOrIndex] && [nameOrIndex];
    if (!found) throw notFound('renderer/instance', nameOrIndex, this.scene.instances);
    return found;
  }

  /**
   * Changes some instances, at a cost that depends on how many.
   * @param moves Whether the change is one of transforms or visibility.
   * @param effect Of a change of transforms alone: the surfaces are elsewhere in the image.
   */
  #change(
    which: readonly number[],
    changed: (instance: Instance, index: number) => Instance,
    moves: boolean,
    effect?: 'reprojects',
  ): SceneChange | Promise<SceneChange> {
    const version = this.#version;
    const geometry = this.#geometry;
    const { placement, blas } = geometry;
    const { instances } = this.scene;
    const changes = which.map((index) => ({
      index,
      before: instances[index] as Instance,
      after: changed(instances[index] as Instance, index),
    }));
    // Meshes that are shown for the first time bring hierarchies, and the first catcher an upper level that has no room
    // yet.
    const isMissing = moves && changes.some(({ after }) => !blas[after.mesh] && isShown(this.scene, after));
    const lacksRoom =
      geometry.tlasNodes < 2 * placement.bareRoot &&
      changes.some(({ after }) => after.catcher && after.visible !== false);
    if (isMissing || lacksRoom) {
      const reshaped = () => {
        const next = [...this.scene.instances];
        for (const index of which) next[index] = changed(next[index] as Instance, index);
        return { ...this.scene, instances: next };
      };
      return this.reshape(reshaped);
    }
    const set = (state: 'before' | 'after') => {
      this.#version++;
      for (const change of changes) this.scene.instances[change.index] = change[state];
      placement.update(this.scene, blas, which, moves);
    };
    return {
      isStale: () => version !== this.#version,
      apply: () => {
        set('after');
        return this.gpu.updateInstances(geometry, changes);
      },
      undo: () => set('before'),
      ...(effect && {
        effect,
        moves: changes.map(({ index, before, after }) => ({
          index,
          before: before.transform,
          after: after.transform,
        })),
      }),
    };
  }

  /** @internal Everything is laid out again, and once more if another change came in between. */
  async reshape(changed: () => Scene): Promise<SceneChange> {
    for (;;) {
      const version = this.#version;
      const next = changed();
      await this.build(next, [...this.scene.meshes, ...next.meshes]);
      const geometry = layOutGeometry(next, this.blas(next), this.#geometry.compact);
      const packed = await packGeometry(next, geometry);
      const pages = await this.gpu.pagesOf(next, geometry);
      if (version !== this.#version) continue;
      return this.commit(next, geometry, () => {
        this.gpu.updateShapes(geometry, packed, pages);
        return true;
      });
    }
  }
}
