import { toGltfMaterial } from '@glanz/cad';
import type { Material } from '@glanz/scene';

/** A JSON object. */
export type Json = Record<string, unknown>;

const isObject = (value: unknown): value is Json =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

/** What a file says of a material and OpenPBR does not: it stays. */
const KEPT = ['name', 'extras', 'doubleSided', 'alphaMode', 'alphaCutoff'];

/** Brings the textures of a former material into what was written, which knows none: they multiply its new values. */
function withTextures(former: Json, written: Json): Json {
  const result: Json = { ...written };
  for (const [key, value] of Object.entries(former)) {
    if (key.endsWith('Texture')) result[key] = value;
    else if (isObject(value)) {
      const inner = withTextures(value, isObject(written[key]) ? written[key] : {});
      // An extension without a texture that the new values do not need is gone.
      if (isObject(written[key]) || Object.keys(inner).length > 0) result[key] = inner;
    }
  }
  return result;
}

/**
 * A glTF document with other values in some materials. Geometry, textures, animations and everything else stay as they
 * are.
 *
 * @param json The document.
 * @param edited By index of the material.
 */
export function patchMaterials(json: Json, edited: ReadonlyMap<number, Material>): Json {
  const materials = [...((json['materials'] as Json[] | undefined) ?? [])];
  const used = new Set((json['extensionsUsed'] as string[] | undefined) ?? []);
  for (const [index, material] of edited) {
    const former = materials[index];
    if (!former) continue;
    const { json: written, extensions } = toGltfMaterial(material);
    const patched = withTextures(former, written);
    for (const key of KEPT) if (former[key] !== undefined) patched[key] = former[key];
    if (former['alphaMode'] === undefined && written['alphaMode'] !== undefined)
      patched['alphaMode'] = written['alphaMode'];
    materials[index] = patched;
    for (const name of [...extensions, ...Object.keys((patched['extensions'] as Json | undefined) ?? {})])
      used.add(name);
  }
  return { ...json, materials, ...(used.size > 0 ? { extensionsUsed: [...used] } : {}) };
}
