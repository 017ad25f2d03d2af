import { inSlices, type Mesh, type Scene } from '@glanz/scene';
import type { Geometry } from '../geometry/geometry';
import type { MeshRegion } from '../geometry/hierarchy';
import { lightGroupTable, type LightGroupTable } from '../lights/light-groups';
import { LightIds, lightIndex } from '../lights/light-ids';
import {
  buildLightTable,
  noLights,
  placingSteps,
  type GatheredLights,
  type LightGeometry,
  type LightTable,
} from '../lights/lights';
import type { SceneResources } from '../storage/scene-resources';
import type { SceneChoices } from './features';

/** The lights of a scene on the GPU: their table, their groups, and the records of their ids. */
export class GpuLights {
  /** Names of the lights that hold across edits. */
  readonly ids = new LightIds();
  readonly #scene: Scene;
  readonly #choices: SceneChoices;
  readonly #resources: SceneResources;
  #groups: LightGroupTable;
  #table: LightTable;
  /** Of the scene when the lights were gathered: directional lights are weighed by it. */
  #radius = 0;

  constructor(scene: Scene, choices: SceneChoices, resources: SceneResources) {
    this.#scene = scene;
    this.#choices = choices;
    this.#resources = resources;
    this.#groups = lightGroupTable(scene, choices.lightGroups);
    this.#table = noLights(scene);
  }

  get table(): LightTable {
    return this.#table;
  }

  get groups(): LightGroupTable {
    return this.#groups;
  }

  /** Remembers what is in place. @returns Puts it back; records are to be written again. */
  remember(): () => void {
    const [groups, table, radius] = [this.#groups, this.#table, this.#radius];
    return () => {
      [this.#groups, this.#table, this.#radius] = [groups, table, radius];
    };
  }

  /** Whether some light is weighed by the size of the scene, and that is another one. */
  weighs(radius: number): boolean {
    return radius !== this.#radius && this.#scene.lights.some(({ type }) => type === 'directional');
  }

  /**
   * Finds the lights for the first time, and makes the buffer for their records, still empty.
   * @param gathered As `lightSteps()` has found them, whose memory is used; else they are found here, in one go.
   * @param sliceMs Yields to the event loop after so many milliseconds.
   */
  async gather(geometry: Geometry, gathered: GatheredLights | undefined, sliceMs: number): Promise<void> {
    const { radius } = geometry.placement;
    const placed =
      gathered &&
      (await inSlices(placingSteps(this.#scene, gathered, this.#places(geometry), radius, this.ids), { sliceMs }));
    this.#radius = radius;
    this.#table = placed ?? this.#build(geometry);
  }

  /** Finds the lights again. The instances' first lights may be others then. */
  rebuild(geometry: Geometry): void {
    this.#table = this.#build(geometry);
    this.#radius = geometry.placement.radius;
  }

  /**
   * Writes the records, after {@link rebuild}.
   * @param before The table until then.
   * @returns Whether buffers were replaced.
   */
  write(before: LightTable): boolean {
    const { records } = this.#table;
    const moved = this.#writeIndex();
    if (records.byteLength === before.records.byteLength) {
      this.#resources.write('lights', records);
      return moved;
    }
    this.#resources.upload('lights', records);
    return true;
  }

  /** Writes the records again, after others have been taken back. */
  rewrite(): void {
    this.#resources.write('lights', this.#table.records);
    this.#writeIndex();
  }

  /** Sorts the lights into groups again. @returns Whether that changes anything. */
  updateGroups(): boolean {
    const before = this.#groups.names;
    this.#groups = lightGroupTable(this.#scene, this.#choices.lightGroups);
    const { names } = this.#groups;
    return before.length !== names.length || before.some((name, i) => name !== names[i]);
  }

  /** Makes the records of the lights by their ids, for the first kernel that binds them; kept up to date from then on. */
  makeIndex(): void {
    if (!this.#resources.buffer('light_index')) this.#writeIndex(true);
  }

  /** @returns Whether the buffer was replaced. */
  #writeIndex(asked = false): boolean {
    const present = this.#resources.buffer('light_index');
    if (!present && !asked) return false;
    const needed = 4 * this.ids.end;
    const grows = !present || present.size < needed;
    // Room to grow: each new buffer is another bind group.
    const buffer = grows ? this.#resources.make('light_index', 2 * needed) : present;
    this.#resources.write('light_index', lightIndex(this.#table, buffer.size / 4));
    return grows;
  }

  #build(geometry: Geometry): LightTable {
    const { radius } = geometry.placement;
    const { lightSampling } = this.#choices;
    return buildLightTable(this.#scene, this.#places(geometry), radius, this.#groups, lightSampling, this.ids);
  }

  /** Where shapes are, as lights name them. */
  #places({ placement, regions, blas }: Geometry): LightGeometry {
    const leaves = new Map<number, Uint32Array>();
    const leafTriangles = (mesh: number): Uint32Array => {
      let order = leaves.get(mesh);
      if (!order) {
        order = new Uint32Array((this.#scene.meshes[mesh] as Mesh).indices.length / 3);
        const { firstTriangle } = regions[mesh] as MeshRegion;
        const inputs = blas[mesh]?.triangleIndices ?? new Uint32Array();
        for (let leaf = 0; leaf < inputs.length; leaf++) order[inputs[leaf] as number] = firstTriangle + leaf;
        leaves.set(mesh, order);
      }
      return order;
    };
    return { instanceSlots: placement.instanceSlots, leafTriangles };
  }
}
