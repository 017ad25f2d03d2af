import type { Blas } from '@glanz/bvh';
import { createScene, validateScene, type Environment, type Instance, type Light, type Material, type Mesh, type Scene } from '@glanz/scene';
import { RenderError } from './errors';
import type { GpuScene } from './gpu/gpu-scene';
import { attributeWords, layOutGeometry, missingMeshes, packGeometry, packMesh, packTlas, placeInstances, prepareHierarchies, type Geometry, type MeshRegion } from './scene/geometry';
import type { HierarchyBuilder } from './scene/hierarchies';
import { findMaterial } from './scene/materials';

type Mutable<T> = { -readonly [K in keyof T]: T[K] };

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

/** Names listed in an error message, at most. */
const LISTED_NAMES = 50;

const names = (list: readonly { readonly name: string }[]) => {
  const listed = list.slice(0, LISTED_NAMES).map(({ name }) => name).join(', ') || 'none';
  return list.length > LISTED_NAMES ? `${listed} and ${list.length - LISTED_NAMES} more` : listed;
};

/**
 * Edits of a scene that is on the GPU. Each changes the scene and writes what depends on it, no more, and tells whether
 * buffers were replaced, so that kernels bind anew. What takes time (hierarchies) is prepared first, then all is changed at
 * once: between two edits the scene is always whole.
 */
export class SceneEditor {
  readonly scene: Scene;
  readonly #gpu: GpuScene;
  readonly #hierarchies: HierarchyBuilder | undefined;
  /** Materials that instances wear without a variant. */
  readonly #plain: number[];
  /** Hierarchies of meshes that are or were in the scene, so that a part that comes back costs nothing to build. */
  readonly #trees = new WeakMap<Mesh, Blas>();
  /** Instances by name, which no edit changes; made at the first look-up by name. */
  #named: Map<string, number[]> | undefined;
  #geometry: Geometry;
  #version = 0;

  constructor(scene: Scene, geometry: Geometry, gpu: GpuScene, hierarchies: HierarchyBuilder | undefined) {
    this.scene = scene;
    this.#geometry = geometry;
    this.#gpu = gpu;
    this.#hierarchies = hierarchies;
    this.#plain = scene.instances.map(({ material }) => material);
    this.#remember(scene, geometry.blas);
  }

  get geometry(): Geometry {
    return this.#geometry;
  }

  setMaterial(nameOrIndex: string | number, parameters: Material['parameters']): boolean {
    const index = this.#material(nameOrIndex);
    const material = this.scene.materials[index] as Material;
    const before = material.parameters;
    material.parameters = { ...before, ...parameters };
    const emission = Object.entries(parameters).some(([name, value]) => name.startsWith('emission_') && JSON.stringify(before[name as keyof typeof before]) !== JSON.stringify(value));
    return this.#gpu.updateMaterial(index, emission);
  }

  setLight(nameOrIndex: string | number, change: Partial<Light>): boolean {
    const { lights } = this.scene;
    const index = typeof nameOrIndex === 'number' ? nameOrIndex : lights.findIndex(({ name }) => name === nameOrIndex);
    const light = lights[index];
    if (!light) throw new RenderError('renderer/light', `The scene has no light ${JSON.stringify(nameOrIndex)}; it has: ${names(lights)}.`);
    const next = { ...light, ...change, type: light.type } as Light;
    validateScene({ ...createScene(), lights: [next] });
    lights[index] = next;
    return this.#gpu.updateLights();
  }

  setEnvironment(environment: Environment | undefined): boolean {
    if (environment) validateScene({ ...createScene(), environment });
    if (environment) this.scene.environment = environment;
    else delete this.scene.environment;
    return this.#gpu.updateEnvironment(environment);
  }

  adjustEnvironment(change: { readonly rotation?: number; readonly intensity?: number; readonly visible?: boolean }): boolean {
    const { environment } = this.scene;
    if (!environment) throw new RenderError('renderer/environment', 'The scene has no environment to change; set one with setEnvironment().');
    for (const [name, value] of Object.entries(change)) {
      if (typeof value === 'number' && !Number.isFinite(value)) throw new RenderError('renderer/environment', `The environment's ${name} must be finite, not ${value}.`);
    }
    if (environment.type === 'constant' && change.intensity !== undefined) throw new RenderError('renderer/environment', 'A constant environment has no intensity; set another radiance with setEnvironment().');
    const { visible = environment.visible ?? true } = change;
    const next: Environment = environment.type === 'latlong' ? { ...environment, ...change, visible } : { ...environment, visible };
    // The picture was validated when it was set.
    this.scene.environment = next;
    return this.#gpu.updateEnvironment(next);
  }

  setTransform(nameOrIndex: string | number, transform: ArrayLike<number>): boolean | Promise<boolean> {
    if (transform.length !== 16 || !Array.from(transform).every(Number.isFinite)) throw new RenderError('renderer/transform', 'A transform must be 16 finite numbers, column-major.');
    return this.#place(this.#changed(nameOrIndex, { transform: Array.from(transform) }));
  }

  setMaterialOf(nameOrIndex: string | number, material: string | number): boolean | Promise<boolean> {
    const index = this.#material(material);
    const instances = this.#changed(nameOrIndex, { material: index });
    this.#instances(nameOrIndex).forEach((i) => (this.#plain[i] = index));
    return this.#place(instances);
  }

  setVariant(variant: string | number | undefined): boolean | Promise<boolean> {
    const all = this.scene.variants ?? [];
    const index = typeof variant === 'string' ? all.indexOf(variant) : variant;
    if (index !== undefined && all[index] === undefined) throw new RenderError('renderer/variant', `The scene has no variant ${JSON.stringify(variant)}; it has: ${all.join(', ') || 'none'}.`);
    return this.#place(this.scene.instances.map((instance, i) => ({ ...instance, material: (index === undefined ? undefined : instance.variants?.[index]) ?? (this.#plain[i] as number) })));
  }

  setCatcher(nameOrIndex: string | number, catcher: boolean): boolean | Promise<boolean> {
    return this.#place(this.#changed(nameOrIndex, { catcher }));
  }

  async setVisibility(nameOrIndex: string | number | readonly (string | number)[], visible: boolean): Promise<boolean> {
    const changed = () => ({ ...this.scene, instances: this.#changed(nameOrIndex, { visible }) });
    if (missingMeshes(changed(), this.#geometry.blas).length === 0) return this.#place(changed().instances);
    // Shown for the first time: their hierarchies come first.
    return this.#reshape(changed);
  }

  async replaceMesh(nameOrIndex: string | number, mesh: Mesh): Promise<boolean> {
    const index = typeof nameOrIndex === 'number' ? nameOrIndex : this.scene.meshes.findIndex(({ name }) => name === nameOrIndex);
    if (!this.scene.meshes[index]) throw new RenderError('renderer/mesh', `The scene has no mesh ${JSON.stringify(nameOrIndex)}; it has: ${names(this.scene.meshes)}.`);
    validateScene({ ...createScene(), meshes: [mesh] });
    const changed = () => ({ ...this.scene, meshes: this.scene.meshes.map((old, i) => (i === index ? mesh : old)) });
    await this.#build(changed());
    const region = this.#geometry.regions[index] as MeshRegion;
    const tree = this.#trees.get(mesh);
    const fits = tree && tree.nodeCount <= region.nodes && tree.triangleIndices.length <= region.triangles && attributeWords(mesh) <= region.words;
    if (!fits) return this.#reshape(changed);
    const next = changed();
    const blas = this.#blas(next);
    const { triangleCount, hasVertexColors } = layOutGeometry(next, blas);
    const geometry: Geometry = { ...this.#geometry, ...placeInstances(next, blas), blas, hasVertexColors, triangleCount };
    this.#commit(next, geometry);
    return this.#gpu.updateMesh(geometry, index, packMesh(mesh, tree, region));
  }

  #blas(scene: Scene): (Blas | undefined)[] {
    return scene.meshes.map((mesh) => this.#trees.get(mesh));
  }

  async #build(scene: Scene): Promise<void> {
    this.#remember(scene, await prepareHierarchies(scene, { hierarchies: this.#hierarchies }, this.#blas(scene)));
  }

  #remember(scene: Scene, blas: readonly (Blas | undefined)[]): void {
    scene.meshes.forEach((mesh, i) => {
      const tree = blas[i];
      if (tree) this.#trees.set(mesh, tree);
    });
  }

  #commit(scene: Scene, geometry: Geometry): void {
    this.#version++;
    this.scene.instances = scene.instances;
    this.scene.meshes = scene.meshes;
    this.#geometry = geometry;
  }

  #material(nameOrIndex: string | number): number {
    const index = findMaterial(this.scene, nameOrIndex);
    if (index < 0) throw new RenderError('renderer/material', `The scene has no material ${JSON.stringify(nameOrIndex)}; it has: ${names(this.scene.materials)}.`);
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
    const found = typeof nameOrIndex === 'string' ? this.#byName.get(nameOrIndex) : this.scene.instances[nameOrIndex] && [nameOrIndex];
    if (!found) throw new RenderError('renderer/instance', `The scene has no instance ${JSON.stringify(nameOrIndex)}; it has: ${names(this.scene.instances)}.`);
    return found;
  }

  #changed(nameOrIndex: string | number | readonly (string | number)[], change: Partial<Mutable<Instance>>): Instance[] {
    const which = new Set([nameOrIndex].flat().flatMap((one) => this.#instances(one)));
    return this.scene.instances.map((instance, i) => (which.has(i) ? { ...instance, ...change } : instance));
  }

  /** Other instances of the same shapes. The old ones stay if the new ones show nothing. */
  #place(instances: Instance[]): boolean | Promise<boolean> {
    const geometry = { ...this.#geometry, ...placeInstances({ ...this.scene, instances }, this.#geometry.blas) };
    // The first catcher brings a second hierarchy.
    if (packTlas(geometry).length > 16 * geometry.tlasNodes) return this.#reshape(() => ({ ...this.scene, instances }));
    this.#commit({ ...this.scene, instances }, geometry);
    return this.#gpu.updatePlacement(geometry);
  }

  /** Everything is laid out anew, and once more if another edit came in between. */
  async #reshape(changed: () => Scene): Promise<boolean> {
    for (;;) {
      const version = this.#version;
      const next = changed();
      await this.#build(next);
      const geometry = layOutGeometry(next, this.#blas(next));
      const packed = await packGeometry(next, geometry);
      if (version !== this.#version) continue;
      this.#commit(next, geometry);
      this.#gpu.updateShapes(geometry, packed);
      return true;
    }
  }
}
