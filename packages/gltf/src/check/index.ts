// Files come from strangers. glTF-Transform trusts a document's numbers: an index out of range is a TypeError there, a
// count of 2^32 an allocation that ends the process, a circle of nodes an endless loop. So the JSON is checked in full
// before it gets there. The line follows the specification: what the structure hangs on (containers, types, indices,
// ranges, the node tree) is refused; a part that can do without (an attribute, a factor, a light, a camera) is repaired or
// left out, with a warning.
import type { SceneWarning } from '@glanz/scene';
import type { GltfJson } from '../json';
import { CheckContext, isObject, own, quote, type Raw } from './context';
import { checkAccessors, checkBuffers, checkSparseIndices } from './data';
import { checkMeshes, neededAccessors } from './meshes';
import { checkNodes, checkSkins } from './nodes';
import { repairCameras, repairLights, repairMaterials } from './surfaces';

/** A document that has been checked. */
export interface CheckedDocument {
  /** Sound in every part that is read. */
  readonly json: GltfJson;
  /** Buffers that something shown reads: those that have to be there. */
  readonly neededBuffers: ReadonlySet<number>;
  /** Checks what only the bytes show, once they are there. */
  readonly checkBytes: (viewBytes: (index: number) => Uint8Array) => void;
}

/** Stands for an accessor that nothing shown reads, as those of animations. */
const UNUSED = { componentType: 5121, type: 'SCALAR', count: 1 };

/**
 * Checks a parsed document.
 * @param file What messages call it.
 * @param warnings Takes what was repaired or left out.
 * @throws {GltfError} `gltf/malformed`, saying where.
 */
export function checkDocument(json: Raw, file: string, warnings: SceneWarning[]): CheckedDocument {
  const context = new CheckContext(json, file, warnings);
  for (const key of ['extensionsUsed', 'extensionsRequired']) {
    const names = own(json, key);
    if (names !== undefined && !(Array.isArray(names) && names.every((name) => typeof name === 'string'))) context.fail(`/${key}`, `is ${quote(names)}, but must be an array of names`);
  }
  const views = checkBuffers(context);
  const needed = neededAccessors(context);
  const facts = checkAccessors(context, views, needed);
  const meshes = checkMeshes(context, facts, views);
  const nodes = checkNodes(context, facts);
  checkSkins(context, facts);
  checkPictures(context);
  const lights = repairLights(context);
  const accessors = context.list('accessors').map((accessor, index) => (needed.has(index) ? accessor : UNUSED));
  const checked = {
    ...json,
    asset: { version: '2.0' },
    accessors,
    meshes,
    nodes: nodes.map((node, index) => withoutLostLight(context, node, index, lights?.length ?? 0)),
    materials: repairMaterials(context),
    cameras: repairCameras(context),
    extensions: lights ? { KHR_lights_punctual: { lights } } : {},
  };
  if (own(json, 'scenes') === undefined) delete (checked as { scene?: unknown }).scene;
  return {
    json: checked as unknown as GltfJson,
    neededBuffers: buffersOf(accessors, meshes, views),
    checkBytes: (viewBytes) => checkSparseIndices(new CheckContext({ accessors }, file, warnings), viewBytes),
  };
}

/** Textures, pictures and samplers are read when a material asks for them; here it counts that they are objects. */
function checkPictures(context: CheckContext): void {
  const samplers = context.list('samplers');
  for (const kind of ['images', 'textures', 'skins', 'animations'] as const) context.list(kind);
  context.list('textures').forEach((texture, index) => {
    const sampler = own(texture, 'sampler');
    if (sampler !== undefined && !(typeof sampler === 'number' && samplers[sampler])) context.warn('gltf/texture', `/textures/${index}/sampler`, `is ${quote(sampler)}, which names no sampler; repetition is taken`);
  });
}

function withoutLostLight(context: CheckContext, node: Raw, index: number, lights: number): Raw {
  const extensions = own(node, 'extensions');
  const reference = isObject(extensions) ? own(extensions, 'KHR_lights_punctual') : undefined;
  if (reference === undefined) return node;
  const light = isObject(reference) ? own(reference, 'light') : undefined;
  if (typeof light === 'number' && Number.isInteger(light) && light >= 0 && light < lights) return node;
  context.warn('gltf/light', `/nodes/${index}/extensions/KHR_lights_punctual`, `is ${quote(reference)}, which names no light; it is left out`);
  const { KHR_lights_punctual: _, ...rest } = extensions as Raw;
  return { ...node, extensions: rest };
}

function buffersOf(accessors: readonly Raw[], meshes: readonly Raw[], views: readonly Raw[]): Set<number> {
  const used = new Set<unknown>();
  for (const accessor of accessors) {
    used.add(own(accessor, 'bufferView'));
    const sparse = own(accessor, 'sparse');
    if (isObject(sparse)) for (const key of ['indices', 'values']) used.add((sparse[key] as Raw)['bufferView']);
  }
  for (const mesh of meshes) {
    for (const primitive of mesh['primitives'] as readonly Raw[]) {
      const extensions = own(primitive, 'extensions');
      const draco = isObject(extensions) ? extensions['KHR_draco_mesh_compression'] : undefined;
      if (isObject(draco)) used.add(draco['bufferView']);
    }
  }
  const buffers = new Set<number>();
  views.forEach((view, index) => {
    if (!used.has(index)) return;
    // The buffer of a compressed view is only a place to unpack to, and need not be there.
    const extensions = own(view, 'extensions');
    const packed = isObject(extensions) ? (own(extensions, 'EXT_meshopt_compression') as Raw | undefined) : undefined;
    buffers.add((packed ?? view)['buffer'] as number);
  });
  return buffers;
}
