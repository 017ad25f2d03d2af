import type { Instance, Material, Scene } from '@glanz/scene';
import { isOneSided } from '../geometry/culling';
import type { LightGroupTable } from '../lights/light-groups';
import { MaterialUse } from '../materials/material-use';
import {
  emittedRadiance,
  isOpaque,
  packBindings,
  packMaterial,
  texturedParameters,
  type TexturedParameterInfo,
} from '../materials/materials';
import { parametersOf } from '../materials/parameters';
import type { TexturePlan } from '../materials/textures';
import { materialStruct } from '../storage/layout';
import type { SceneResources } from '../storage/scene-resources';
import type { SceneChoices } from './features';

/** The materials of a scene on the GPU: their records, and those of the textures that they bind. */
export class GpuMaterials {
  readonly textured: readonly TexturedParameterInfo[];
  readonly #scene: Scene;
  readonly #choices: SceneChoices;
  readonly #resources: SceneResources;
  readonly #groups: () => LightGroupTable;
  readonly #bindings: ReturnType<typeof packBindings>;
  #firstBinding: number[] = [];
  /** Derived when it is first asked for after instances or meshes have changed. */
  #use: MaterialUse | undefined;

  constructor(
    scene: Scene,
    choices: SceneChoices,
    plan: TexturePlan,
    resources: SceneResources,
    groups: () => LightGroupTable,
  ) {
    this.#scene = scene;
    this.#choices = choices;
    this.#resources = resources;
    this.#groups = groups;
    this.textured = texturedParameters(scene.materials);
    this.#bindings = packBindings(scene.materials, plan);
  }

  /** Remembers where bindings are. @returns Puts that back; records are to be written again. */
  remember(): () => void {
    const firstBinding = this.#firstBinding;
    return () => {
      this.#firstBinding = firstBinding;
      this.forgetUse();
    };
  }

  /** Makes the records, and writes the texture bindings into the attribute heap from a word on. */
  make(firstWord: number): void {
    const { records, first, count } = this.#bindings;
    const bindings = count.reduce((a, b) => a + b, 0);
    const words = records.byteLength / 4 / Math.max(1, bindings);
    this.#firstBinding = first.map((index) => firstWord + index * words);
    this.#resources.write('attributes', records, 4 * firstWord);
    this.#resources.upload('materials', this.#packAll());
  }

  write(index: number): void {
    const record = materialStruct.allocate();
    this.#pack(record, 0, index);
    this.#resources.write('materials', record, index * materialStruct.size);
  }

  writeAll(): void {
    this.#resources.write('materials', this.#packAll());
  }

  emits({ material }: Instance): boolean {
    return emittedRadiance(parametersOf(this.#scene.materials[material] as Material)).some((c) => c > 0);
  }

  /** Whether the camera looks through a material's back faces. */
  culls(material: number): boolean {
    return (
      this.#choices.backFaceCulling !== 'off' &&
      isOneSided(this.#scene.materials[material] as Material, this.isOpaque(material))
    );
  }

  isOpaque(material: number): boolean {
    return isOpaque(this.#scene.materials[material] as Material, this.#used.hasVertexAlpha(material));
  }

  isVisible(material: number): boolean {
    return this.#used.isVisible(material);
  }

  /** Instances or meshes have changed in more than {@link replaceUse} can follow. */
  forgetUse(): void {
    this.#use = undefined;
  }

  /** An instance has changed. @returns Whether all that is known of the materials' use has stayed as it was. */
  replaceUse(before: Instance, after: Instance): boolean {
    return this.#use?.replace(before, after) ?? false;
  }

  get #used(): MaterialUse {
    return (this.#use ??= new MaterialUse(this.#scene));
  }

  #pack(buffer: ArrayBuffer, at: number, index: number): void {
    const material = this.#scene.materials[index] as Material;
    packMaterial(
      buffer,
      at,
      material,
      this.#firstBinding[index] as number,
      this.#bindings.count[index] as number,
      this.isOpaque(index),
      this.culls(index),
      this.#groups().material(material),
    );
  }

  #packAll(): ArrayBuffer {
    const buffer = materialStruct.allocate(this.#scene.materials.length);
    this.#scene.materials.forEach((_, index) => this.#pack(buffer, index, index));
    return buffer;
  }
}
