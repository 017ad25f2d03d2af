import { writeGlb } from '@glanz/cad';
import type { Material, Scene } from '@glanz/scene';
import type { Opened } from '../input/opening';
import type { State } from '../state/state';
import { composeScene } from '../viewer/compose';
import { patchMaterials, type Json } from './gltf-materials';
import { patchMoves, type MovedDocument } from './gltf-moves';

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

/** Names that a message lists at most. */
const MAX_NAMES = 3;

/** What a saved document says otherwise than the page shows it; empty if nothing. */
function noteOn({ unsaved, animated }: Omit<MovedDocument, 'json'>, { instances }: Scene): string {
  const named = (parts: readonly number[]) => {
    const names = parts.slice(0, MAX_NAMES).map((part) => instances[part]?.name || `part ${part + 1}`);
    return [...names, ...(parts.length > MAX_NAMES ? [`${parts.length - MAX_NAMES} more`] : [])].join(', ');
  };
  return [
    unsaved.length > 0
      ? `The file keeps these parts where its skeleton or animation puts them: ${named(unsaved)}.`
      : '',
    animated.length > 0 ? `In the file, the moves of animated parts turn with the animation: ${named(animated)}.` : '',
  ]
    .filter(Boolean)
    .join(' ');
}

/** A model as a file. */
export interface SavedModel {
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly extension: 'glb' | 'gltf';
  /** What the user must know of it; empty if nothing. */
  readonly note: string;
}

/**
 * The model as glTF with the materials as edited and the parts as moved: the user's own file with other values and
 * places, or, where it was none (built-in, OBJ, STL, USD), a GLB of what is visible. Images put on parameters here are
 * not written.
 */
export async function modelAsGltf({ scene, request }: Opened, state: State): Promise<SavedModel> {
  const file =
    request.kind === 'files' && /\.(glb|gltf)$/i.test(request.entry) ? request.files.get(request.entry) : undefined;
  if (!file)
    return { bytes: writeGlb(composeScene(scene, { ...state, floor: false }, undefined)), extension: 'glb', note: '' };
  const bytes = new Uint8Array(await file.arrayBuffer());
  let note = '';
  const patch = (json: Json) => {
    const edited = patchMaterials(json, editedMaterials(scene, state));
    if (Object.keys(state.moves).length === 0) return edited;
    const moved = patchMoves(edited, scene, state.moves);
    note = noteOn(moved, scene);
    return moved.json;
  };
  if (new DataView(bytes.buffer).getUint32(0, true) === MAGIC)
    return { bytes: replaceJson(bytes, patch), extension: 'glb', note };
  const json = JSON.parse(new TextDecoder().decode(bytes)) as Json;
  return { bytes: new TextEncoder().encode(JSON.stringify(patch(json), null, 2)), extension: 'gltf', note };
}
