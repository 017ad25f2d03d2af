import { openPbrStruct, packOpenPbr, type OpenPbrParameters } from '@glanz/openpbr';
import type { Material, Scene, TextureBinding } from '@glanz/scene';
import {
  bindingStruct,
  GROUP_SHIFT,
  MATERIAL_CULLED,
  MATERIAL_DISPERSIVE,
  MATERIAL_EMISSIVE,
  MATERIAL_INDEX_MATCHED,
  MATERIAL_INTERIOR,
  MATERIAL_MASK,
  MATERIAL_OPAQUE,
  MATERIAL_PRIORITY_SHIFT,
  MATERIAL_DELTA_TRANSMISSION,
  MATERIAL_TWO_SIDED_EMISSION,
  materialStruct,
} from '../storage/layout';
import { hasInterior, isDispersive, isIndexMatched, transmitsByDelta } from './interiors';
import { parametersOf } from './parameters';
import type { TexturePlan } from './textures';

/** A parameter that some material textures, with its number in the GPU records. */
export interface TexturedParameterInfo {
  readonly name: string;
  readonly id: number;
  /** `direction`: no product. `any`: a colour that some texture drives by one channel. */
  readonly type: 'vec3f' | 'f32' | 'any' | 'direction';
}

/** Directions that textures may drive. */
const DIRECTIONS: readonly string[] = ['geometry_normal', 'geometry_tangent', 'geometry_coat_normal'];
const NOT_TEXTURED: readonly string[] = ['geometry_thin_walled', 'geometry_coat_tangent'];

/** Numbers of the parameters in texture binding records: the struct's order. -1 for one that textures do not drive. */
export function parameterId(name: string): number {
  return NOT_TEXTURED.includes(name) ? -1 : openPbrStruct.fields.findIndex((field) => field.name === name);
}

export const OPACITY_ID = parameterId('geometry_opacity');

/** Textures of a material that the surface model reads, in a fixed order. */
function bindingsOf(material: Material): [name: string, id: number, binding: TextureBinding][] {
  return Object.entries(material.textures ?? {})
    .map(([name, binding]) => [name, parameterId(name), binding] as [string, number, TextureBinding])
    .filter(([, id, binding]) => id >= 0 && binding !== undefined)
    .sort((a, b) => a[1] - b[1]);
}

/** The scene textures that materials use. */
export function usedTextures(materials: readonly Material[]): Set<number> {
  return new Set(materials.flatMap((material) => bindingsOf(material).map(([, , binding]) => binding.texture)));
}

/** The parameters that at least one material textures. */
export function texturedParameters(materials: readonly Material[]): TexturedParameterInfo[] {
  const found = new Map<number, TexturedParameterInfo>();
  for (const material of materials) {
    for (const [name, id, { channels }] of bindingsOf(material)) {
      const type = DIRECTIONS.includes(name)
        ? 'direction'
        : openPbrStruct.fields[id]?.type === 'f32'
          ? 'f32'
          : channels === 'rgb' && found.get(id)?.type !== 'any'
            ? 'vec3f'
            : 'any';
      found.set(id, { name, id, type });
    }
  }
  return [...found.values()].sort((a, b) => a.id - b.id);
}

/** Whether some texture's codes stand for another range than 0 to 1. */
export function hasRanges(materials: readonly Material[]): boolean {
  return materials.some((material) =>
    bindingsOf(material).some(([name, , { range }]) => range !== undefined && !DIRECTIONS.includes(name)),
  );
}

/** Whether some material turns the tangent that an anisotropic highlight runs along. */
export function turnsTangent(materials: readonly Material[]): boolean {
  return materials.some(
    ({ parameters, textures }) =>
      textures?.geometry_tangent !== undefined || (parameters.geometry_tangent ?? null) !== null,
  );
}

/** Whether some coat lies otherwise than its base, by a map of its own or because the base has one. */
export function hasCoatFrames(materials: readonly Material[]): boolean {
  return materials.some(
    ({ parameters, textures }) =>
      (parameters.coat_weight ?? 0) > 0 &&
      (textures?.geometry_normal !== undefined ||
        textures?.geometry_coat_normal !== undefined ||
        (parameters.geometry_coat_normal ?? null) !== null ||
        (parameters.geometry_coat_tangent ?? null) !== null),
  );
}

const CHANNEL = { r: 0, g: 1, b: 2, a: 3, rgb: 4 } as const;

/** Texture binding records of all materials, and where each material's begin. */
export function packBindings(
  materials: readonly Material[],
  plan: TexturePlan,
): { records: ArrayBuffer; first: number[]; count: number[] } {
  const all = materials.map(bindingsOf);
  const records = bindingStruct.allocate(all.reduce((sum, list) => sum + list.length, 0));
  const first: number[] = [];
  const count: number[] = [];
  let index = 0;
  for (const list of all) {
    first.push(index);
    count.push(list.length);
    for (const [name, id, binding] of list) {
      const placement = plan.placements.get(binding.texture);
      if (!placement) continue;
      const [a, b, c, d, x, y] = binding.transform ?? [1, 0, 0, 1, 0, 0];
      const [at0, at1] = DIRECTIONS.includes(name) ? [0, binding.scale ?? 1] : (binding.range ?? [0, 1]);
      const texels = placement.width * placement.height * Math.max(Math.abs(a * d - b * c), 1e-12);
      bindingStruct.write(records, index++, {
        parameter: id,
        channels: CHANNEL[binding.channels] | ((binding.uv ?? 0) > 0 ? 1 << 8 : 0),
        sampling: placement.sampling,
        layer: placement.layer,
        row_u: [a, c, x],
        row_v: [b, d, y],
        scale: at1 - at0,
        offset: at0,
        log_size: 0.5 * Math.log2(texels),
      });
    }
  }
  return { records, first, count };
}

/** Radiance that a material emits where no texture dims it. */
export function emittedRadiance(parameters: OpenPbrParameters): [number, number, number] {
  return parameters.emission_color.map((c) => c * parameters.emission_luminance) as [number, number, number];
}

/** Whether every hit on the material counts, so that traversal need not ask. */
export function isOpaque(material: Material, hasVertexAlpha: boolean): boolean {
  return (material.parameters.geometry_opacity ?? 1) >= 1 && !material.textures?.geometry_opacity && !hasVertexAlpha;
}

/** Writes one material's record. `firstBinding` is a word offset into the attribute heap. */
export function packMaterial(
  buffer: ArrayBuffer,
  index: number,
  material: Material,
  firstBinding: number,
  bindingCount: number,
  opaque: boolean,
  culled: boolean,
  group: number,
): void {
  const parameters = parametersOf(material);
  const packed = openPbrStruct.allocate();
  packOpenPbr(packed, 0, parameters);
  const emissive = emittedRadiance(parameters).some((c) => c > 0);
  const mask = material.opacity_threshold !== undefined;
  materialStruct.write(buffer, index, {
    parameters: packed,
    first_binding: firstBinding,
    binding_count: bindingCount,
    flags:
      (material.double_sided ? MATERIAL_TWO_SIDED_EMISSION : 0) |
      (opaque ? MATERIAL_OPAQUE : 0) |
      (emissive ? MATERIAL_EMISSIVE : 0) |
      (mask ? MATERIAL_MASK : 0) |
      (hasInterior(material) ? MATERIAL_INTERIOR : 0) |
      (isIndexMatched(material) ? MATERIAL_INDEX_MATCHED : 0) |
      (transmitsByDelta(material) ? MATERIAL_DELTA_TRANSMISSION : 0) |
      (isDispersive(material) ? MATERIAL_DISPERSIVE : 0) |
      (culled ? MATERIAL_CULLED : 0) |
      ((material.dielectric_priority ?? 0) << MATERIAL_PRIORITY_SHIFT) |
      (group << GROUP_SHIFT),
    opacity_threshold: material.opacity_threshold ?? 0,
  });
}

/** Index of a material by index or name; -1 if there is none. */
export function findMaterial(scene: Scene, nameOrIndex: string | number): number {
  if (typeof nameOrIndex === 'number') return scene.materials[nameOrIndex] ? nameOrIndex : -1;
  return scene.materials.findIndex((material) => material.name === nameOrIndex);
}
