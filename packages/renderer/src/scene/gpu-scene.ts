import type { Environment, Instance, Scene } from '@glanz/scene';
import type { KernelFeatures } from '../integrator/pipelines';
import { instanceStruct, NONE } from '../storage/layout';
import type { ResourceName } from '../storage/resources';
import {
  prepareEnvironment,
  roughEnvironment,
  turnEnvironment,
  type EnvironmentData,
} from '../environment/environment';
import { sceneFeatures, texturePlan, type SceneChoices } from './features';
import {
  instanceRanges,
  joinSlices,
  packInstances,
  shapeBytes,
  shapeSlices,
  type Geometry,
} from '../geometry/geometry';
import type { LightGroupTable } from '../lights/light-groups';
import type { LightIds } from '../lights/light-ids';
import type { GatheredLights } from '../lights/lights';
import type { MeshRegion } from '../geometry/hierarchy';
import type { NodeRange } from '../geometry/placement';
import type { TexturePlan } from '../materials/textures';
import type { GpuMemory, PagedArray } from '../storage/buffers';
import { choosePages } from '../storage/choose-pages';
import type { Pages } from '../storage/paged/pages';
import type { ShapeArray, ShapeSlice } from '../storage/shape-arrays';
import { uploadEnergyTextures, type EnergyTextures } from '../materials/energy-textures';
import { fillEnvironmentTextures, makeEnvironmentTextures } from '../environment/environment-textures';
import { inErrorScopes, withErrorScopes } from '../device/error-scopes';
import { SceneResources, type ResourceLog } from '../storage/scene-resources';
import { uploadPace } from '../storage/upload-pace';
import { uploadTextures } from '../materials/texture-upload';
import { GpuLights } from './gpu-lights';
import { GpuMaterials } from './gpu-materials';

/** Milliseconds of gathering lights between two yields to the event loop. */
const GATHER_MS = 4;
/** Lights are written so many bytes at a time. */
const FILL_BYTES = 1 << 20;
/** Instance records are written so many at a time. */
const FILL_RECORDS = 1 << 13;

/** An instance before and after an edit. */
export interface InstanceChange {
  readonly index: number;
  readonly before: Instance;
  readonly after: Instance;
}

/**
 * A scene on the GPU. A cache: everything here can be made again from the `Scene`. It comes in three steps, since a
 * first image needs no lights: the constructor makes what is the size of the scene, `fill()` writes the shapes into
 * it, and `light()` adds lights, environment and energy tables.
 */
export class GpuScene {
  readonly #device: GPUDevice;
  readonly #scene: Scene;
  #geometry: Geometry;
  readonly #choices: SceneChoices;
  readonly #plan: TexturePlan;
  readonly #sceneTextures: readonly GPUTexture[];
  readonly #samplers: readonly GPUSampler[];
  readonly #resources: SceneResources;
  readonly #energySampler: GPUSampler;
  readonly #materials: GpuMaterials;
  readonly #lights: GpuLights;
  /** Derived when they are first asked for after an edit that they depend on, and kept until the next. */
  #features: KernelFeatures | undefined;
  #environment: EnvironmentData;
  /** How often instances, meshes or materials have changed. */
  changes = 0;

  constructor(device: GPUDevice, memory: GpuMemory, scene: Scene, geometry: Geometry, choices: SceneChoices) {
    this.#device = device;
    this.#resources = new SceneResources(memory, choices.pages);
    this.#scene = scene;
    this.#geometry = geometry;
    this.#choices = choices;
    this.#plan = texturePlan(device, scene, choices);
    const { textures, samplers } = uploadTextures(device, memory, scene, this.#plan);
    this.#sceneTextures = textures;
    this.#samplers = samplers;

    this.#lights = new GpuLights(scene, choices, this.#resources);
    this.#materials = new GpuMaterials(scene, choices, this.#plan, this.#resources, () => this.groups);
    this.#makeShapes(geometry);
    this.#environment = roughEnvironment(scene.environment);
    this.#resources.make('instances', scene.instances.length * instanceStruct.size);
    this.#energySampler = device.createSampler({ label: 'glanz energy', minFilter: 'linear', magFilter: 'linear' });
  }

  get environment(): EnvironmentData {
    return this.#environment;
  }

  /** Texels of the images in use, without mip levels. */
  get texels(): number {
    return this.#plan.arrays.reduce((sum, { width, height, layers }) => sum + width * height * layers.length, 0);
  }

  /** Arrays of shapes that lie in textures. */
  get pages(): readonly ShapeArray[] | undefined {
    return this.#resources.pages?.names;
  }

  get groups(): LightGroupTable {
    return this.#lights.groups;
  }

  get lightCount(): number {
    return this.#lights.table.count;
  }

  /** Names of the lights that hold across edits. */
  get lightIds(): LightIds {
    return this.#lights.ids;
  }

  /** The lights with a size of their own among the light records. */
  get areaLights(): { readonly first: number; readonly count: number } {
    const { firstArea, areaCount } = this.#lights.table;
    return { first: firstArea, count: areaCount };
  }

  /** Probability that a light sample goes to the environment rather than to the table of lights. */
  get environmentProbability(): number {
    if (!this.#environment.table) return 0;
    if (this.lightCount === 0) return 1;
    const { radius } = this.#geometry.placement;
    const power = this.#environment.meanLuminance * 4 * Math.PI * Math.PI * radius * radius;
    return Math.min(0.9, Math.max(0.1, power / (power + this.#lights.table.power)));
  }

  /**
   * Makes an edit by the `update…` methods, keeping what it replaces until it is settled.
   * @param restoreScene Takes the `Scene` back to what it was before the edit.
   * @returns To be settled or undone; later edits must have been undone before.
   * @throws What `edit` throws, with the edit taken back.
   */
  record<T>(edit: () => T, restoreScene: () => void): ResourceLog & { readonly result: T } {
    const [geometry, environment] = [this.#geometry, this.#environment];
    const restore = [this.#lights.remember(), this.#materials.remember()];
    return this.#resources.record(edit, () => {
      restoreScene();
      [this.#geometry, this.#environment] = [geometry, environment];
      for (const restoreRecords of restore) restoreRecords();
      this.#changed();
      this.rewrite();
    });
  }

  /** Writes all records of fixed size again. */
  rewrite(): void {
    this.#writeAllNodes();
    this.#materials.writeAll();
    this.#lights.rewrite();
    this.#writeInstances();
  }

  /** What decides the kernels' text. Derived once after an edit; a camera move derives nothing. */
  features(): KernelFeatures {
    return (this.#features ??= this.#deriveFeatures());
  }

  #deriveFeatures(): KernelFeatures {
    const { count, tree, profiles, areaCount } = this.#lights.table;
    const choices = { ...this.#choices, pages: this.#resources.pages };
    return sceneFeatures(this.#scene, choices, {
      textured: this.#materials.textured,
      plan: this.#plan,
      groups: this.groups.names.length,
      lights: count > 0,
      tree,
      profiles,
      areaLights: areaCount > 0,
      environmentMap: this.#environment.pixels !== undefined,
      environmentSampled: this.#environment.table !== undefined,
      vertexColors: this.#geometry.hasVertexColors,
      catchers: this.#geometry.placement.bare !== undefined,
      isOpaque: (material) => this.#materials.isOpaque(material),
      isVisible: (material) => this.#materials.isVisible(material),
    });
  }

  /** Whether the camera looks through a material's back faces. */
  culls(material: number): boolean {
    return this.#materials.culls(material);
  }

  /** Binding of one of the resources this scene owns. */
  resource(name: string): GPUBindingResource | undefined {
    if (name === 'light_index') this.#lights.makeIndex();
    const buffer = this.#resources.buffer(name as ResourceName);
    if (buffer) return 'view' in buffer ? buffer.view : { buffer };
    const texture = this.#resources.texture(name as ResourceName);
    if (texture) return texture.createView();
    if (name === 'energy_sampler') return this.#energySampler;
    const [, kind, index] = /^scene_(texture|sampler)_(\d+)$/.exec(name) ?? [];
    if (kind === 'texture') return this.#sceneTextures[Number(index)]?.createView({ dimension: '2d-array' });
    if (kind === 'sampler') return this.#samplers[Number(index)];
    return undefined;
  }

  /**
   * Re-reads one material of the scene. Returns true if bindings were replaced.
   * @param emission Whether what it emits may have changed: only then the lights are built again.
   */
  updateMaterial(index: number, emission: boolean): boolean {
    this.#changed();
    if (emission) this.#updateGroups();
    this.#materials.write(index);
    this.#writeNodes(this.#geometry.placement.takeChangedNodes());
    return emission && this.updateLights();
  }

  /**
   * Takes the scene's environment. Returns true if bindings were replaced: not for another rotation or intensity of the
   * same image.
   */
  updateEnvironment(environment: Environment | undefined, prepared?: EnvironmentData): boolean {
    const before = this.#environment;
    this.#features = undefined;
    this.#environment = turnEnvironment(before, environment) ?? prepared ?? prepareEnvironment(environment);
    const replaced = this.#environment.pixels !== before.pixels || this.#environment.table !== before.table;
    if (replaced) {
      makeEnvironmentTextures(this.#resources, this.#environment, before);
      for (const _ of fillEnvironmentTextures(this.#device.queue, this.#resources, this.#environment, before));
    }
    return (this.#updateGroups() && this.updateLights()) || replaced;
  }

  /** Instances have moved, appeared, vanished, or wear another material. Returns true if bindings were replaced. */
  updatePlacement(geometry: Geometry): boolean {
    this.#setGeometry(geometry);
    this.#writeAllNodes();
    this.#updateGroups();
    // Meshes may have brought vertex colours that let light pass.
    this.#materials.writeAll();
    const replaced = this.updateLights();
    this.#writeInstances();
    return replaced;
  }

  /**
   * Some instances have moved, appeared, disappeared or got another material; the geometry's placement has followed.
   * Writes what depends on them. Returns true if bindings were replaced.
   */
  updateInstances(geometry: Geometry, changes: readonly InstanceChange[]): boolean {
    const { placement } = geometry;
    this.#geometry = geometry;
    this.changes++;
    this.#writeNodes(placement.takeChangedNodes());
    const isUseSame = changes
      .map(({ before, after }) => this.#materials.replaceUse(before, after))
      .every((same) => same);
    if (!isUseSame || (placement.bare !== undefined) !== this.#features?.flags['CATCHER']) this.#features = undefined;
    const assigned = new Set(
      changes.flatMap(({ before, after }) =>
        before.material === after.material ? [] : [before.material, after.material],
      ),
    );
    for (const index of assigned) this.#materials.write(index);
    const emits = changes.some(({ before, after }) => this.#materials.emits(before) || this.#materials.emits(after));
    if (emits) this.#updateGroups();
    const indices = changes.map(({ index }) => index);
    if (emits || this.#lights.weighs(placement.radius)) return this.updateLights(indices);
    this.#writeRecords(indices);
    return false;
  }

  #writeNodes(ranges: readonly NodeRange[]): void {
    for (const { first, nodes } of ranges) this.#resources.write('nodes', nodes, 64 * first);
  }

  #writeAllNodes(): void {
    const { placement } = this.#geometry;
    placement.takeChangedNodes();
    this.#writeNodes(placement.allNodes());
  }

  /** An array of shapes. */
  shapes(name: ShapeArray): GPUBuffer | PagedArray {
    return this.#resources.buffer(name) as GPUBuffer | PagedArray;
  }

  /** Writes parts of the shapes, also after an edit that had written others there was taken back. */
  writeShapes(slices: Iterable<ShapeSlice>): void {
    for (const { buffer, offset, data } of slices) this.#resources.write(buffer, data, offset);
  }

  /** Where the arrays of shapes will lie. @throws As {@link choosePages}. */
  pagesOf(scene: Scene, geometry: Geometry): Promise<Pages | undefined> {
    return choosePages(this.#device, shapeBytes(scene, geometry), this.#resources.pages);
  }

  /** All shapes are new. Bindings are replaced. @param pages See {@link pagesOf}. */
  updateShapes(geometry: Geometry, slices: Iterable<ShapeSlice>, pages: Pages | undefined): void {
    this.#resources.pages = pages;
    this.#setGeometry(geometry);
    this.#makeShapes(geometry);
    this.writeShapes(joinSlices(slices));
    this.updatePlacement(geometry);
  }

  #setGeometry(geometry: Geometry): void {
    this.#geometry = geometry;
    this.#materials.forgetUse();
    this.#changed();
  }

  #changed(): void {
    this.#features = undefined;
    this.changes++;
  }

  /** Makes the buffers of shapes, still empty but for what belongs to materials. */
  #makeShapes(geometry: Geometry): void {
    for (const [name, bytes] of Object.entries(shapeBytes(this.#scene, geometry)))
      this.#resources.make(name as ShapeArray, bytes);
    this.#materials.make(geometry.attributeWords);
  }

  /** Writes the shapes, yielding to the event loop every few milliseconds. */
  fill(signal?: AbortSignal): Promise<void> {
    return this.#write('the shapes of this scene', this.#shapeParts(), signal);
  }

  *#shapeParts(): Generator<number> {
    this.#geometry.placement.takeChangedNodes();
    for (const [i, tree] of this.#geometry.blas.entries()) {
      if (!tree?.gpu) continue;
      const region = this.#geometry.regions[i] as MeshRegion;
      tree.gpu.place((name) => this.shapes(name), region);
      // The pace lets the GPU free what large meshes were built in before many more are placed.
      yield 64 * region.nodes;
    }
    for (const { buffer, offset, data } of joinSlices(shapeSlices(this.#scene, this.#geometry))) {
      this.#resources.write(buffer, data, offset);
      yield data.byteLength;
    }
    yield* this.#instanceParts();
  }

  /**
   * Writes part by part, yielding to the event loop every few milliseconds.
   * @param parts Writes one part a step and yields its bytes.
   */
  async #write(what: string, parts: Generator<number, void>, signal?: AbortSignal): Promise<void> {
    const pace = uploadPace(this.#device);
    const written: Promise<void>[] = [];
    for (;;) {
      const { result: part, verified } = inErrorScopes(this.#device, what, () => parts.next());
      written.push(verified);
      if (part.done) break;
      await pace(part.value);
      signal?.throwIfAborted();
    }
    await Promise.all(written);
  }

  /**
   * Adds lights and environment, yielding to the event loop every few milliseconds.
   * @param gathered The lights, as `lightSteps()` has found them, whose memory is used; else they are found here, in
   * one go.
   */
  async light(environment: EnvironmentData, energy: EnergyTextures, gathered?: GatheredLights): Promise<void> {
    await withErrorScopes(this.#device, 'the environment', () => {
      this.#environment = environment;
      makeEnvironmentTextures(this.#resources, this.#environment);
      uploadEnergyTextures(this.#device.queue, this.#resources, energy);
    });
    await this.#write(
      'the environment',
      fillEnvironmentTextures(this.#device.queue, this.#resources, this.#environment),
    );
    await this.#lights.gather(this.#geometry, gathered, GATHER_MS);
    this.#features = undefined;
    await this.#write('the lights of this scene', this.#lightParts());
  }

  *#lightParts(): Generator<number> {
    const { records, firstLight } = this.#lights.table;
    this.#resources.make('lights', records.byteLength);
    // All others are as `fill()` wrote them.
    const lit: number[] = [];
    firstLight.forEach((first, index) => first !== NONE && lit.push(index));
    this.#writeRecords(lit);
    for (let at = 0; at < records.byteLength; at += FILL_BYTES) {
      const bytes = Math.min(FILL_BYTES, records.byteLength - at);
      this.#resources.write('lights', new Uint8Array(records, at, bytes), at);
      yield bytes;
    }
  }

  /** Takes the tables of a guide, see guide.wesl: rows of `width` numbers. */
  setGuide(table: Float32Array<ArrayBuffer>, width: number): void {
    const size = [width, table.length / width];
    const texture = this.#resources.makeTexture('guide', { size, format: 'r32float' }, table.byteLength);
    this.#device.queue.writeTexture({ texture }, table, { bytesPerRow: 4 * width }, size);
  }

  /** Sorts the lights into groups again; where that changes anything, materials are written again. */
  #updateGroups(): boolean {
    const changed = this.#lights.updateGroups();
    if (changed) this.#materials.writeAll();
    return changed;
  }

  /**
   * Re-reads the scene's lights and what its instances emit. Returns true if bindings were replaced.
   * @param changed Instances whose records are to be written besides those that name other lights than before.
   */
  updateLights(changed: readonly number[] = []): boolean {
    this.#features = undefined;
    const before = this.#lights.table;
    this.#lights.rebuild(this.#geometry);
    const { firstLight } = this.#lights.table;
    const indices = [...changed];
    for (let i = 0; i < firstLight.length; i++) if (firstLight[i] !== before.firstLight[i]) indices.push(i);
    this.#writeRecords(indices);
    return this.#lights.write(before);
  }

  /** Writes the records of all instances. Each has its own, hidden or not, so that the buffer is never replaced. */
  #writeInstances(): void {
    for (const _ of this.#instanceParts());
  }

  *#instanceParts(): Generator<number> {
    const { length } = this.#scene.instances;
    for (let from = 0; from < length; from += FILL_RECORDS)
      yield this.#writeRange(from, Math.min(from + FILL_RECORDS, length));
  }

  /** Writes the records of some instances. */
  #writeRecords(indices: readonly number[]): void {
    for (const [first, end] of instanceRanges(indices)) this.#writeRange(first, end);
  }

  #writeRange(first: number, end: number): number {
    const records = packInstances(this.#scene, this.#geometry, this.#lights.table.firstLight, first, end);
    this.#resources.write('instances', records, first * instanceStruct.size);
    return records.byteLength;
  }
}
