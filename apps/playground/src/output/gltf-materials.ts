import { toGltfMaterial, writeGlb } from '@glanz/cad';
import type { Material, Scene } from '@glanz/scene';
import type { Opened } from '../input/opening';
import type { State } from '../state/state';
import { composeScene } from '../viewer/compose';

type Json = Record<string, unknown>;

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

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;

/** A binary glTF with another JSON chunk. */
export function replaceJson(glb: Uint8Array<ArrayBuffer>, change: (json: Json) => Json): Uint8Array<ArrayBuffer> {
  const view = new DataView(glb.buffer, glb.byteOffset, glb.byteLength);
  const length = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + length))) as Json;
  const text = new TextEncoder().encode(JSON.stringify(change(json)));
  const padded = Math.ceil(text.length / 4) * 4;
  const rest = glb.subarray(20 + length);
  const out = new Uint8Array(20 + padded + rest.length);
  const header = new DataView(out.buffer);
  header.setUint32(0, MAGIC, true);
  header.setUint32(4, 2, true);
  header.setUint32(8, out.length, true);
  header.setUint32(12, padded, true);
  header.setUint32(16, JSON_CHUNK, true);
  out.fill(0x20, 20, 20 + padded);
  out.set(text, 20);
  out.set(rest, 20 + padded);
  return out;
}

/** The materials that differ from the file's, as they are now. */
function editedMaterials(scene: Scene, state: State): Map<number, Material> {
  const composed = composeScene(scene, { ...state, slots: {}, floor: false }, undefined);
  return new Map(
    Object.keys(state.materials).map((index) => [Number(index), composed.materials[Number(index)] as Material]),
  );
}

/**
 * The model as glTF with the materials as edited: the user's own file with other values, or, where it was none
 * (built-in, OBJ, STL), a GLB of what is visible. Images put on parameters here are not written.
 */
export async function modelAsGltf(
  { scene, request }: Opened,
  state: State,
): Promise<{ readonly bytes: Uint8Array<ArrayBuffer>; readonly extension: 'glb' | 'gltf' }> {
  const file =
    request.kind === 'files' && /\.(glb|gltf)$/i.test(request.entry) ? request.files.get(request.entry) : undefined;
  if (!file) return { bytes: writeGlb(composeScene(scene, { ...state, floor: false }, undefined)), extension: 'glb' };
  const bytes = new Uint8Array(await file.arrayBuffer());
  const patch = (json: Json) => patchMaterials(json, editedMaterials(scene, state));
  if (new DataView(bytes.buffer).getUint32(0, true) === MAGIC)
    return { bytes: replaceJson(bytes, patch), extension: 'glb' };
  const json = JSON.parse(new TextDecoder().decode(bytes)) as Json;
  return { bytes: new TextEncoder().encode(JSON.stringify(patch(json), null, 2)), extension: 'gltf' };
}
