// Files are untrusted: an index out of range would be a TypeError, a count of 2^32 an allocation that ends the process,
// a cycle of nodes an endless loop. So the whole JSON is checked before any of it is used. Errors in what the structure
// depends on (containers, types, indices, ranges, the node tree) are thrown; other parts (an attribute, a factor, a
// light, a camera, an animation) are repaired or left out, with a warning.
import type { SceneWarning } from '@glanz/scene';
import type { GltfJson } from '../json';
import { repairAnimations } from './animations';
import { CheckContext } from './context';
import { isObject, own, quote, type Raw } from '../json-value';
import { checkAccessors, checkBuffers, checkSparseIndices } from './data';
import { extensionsUsed } from './extensions';
import { repairImageLights } from './image-lights';
import { checkMeshes, neededAccessors } from './meshes';
import { checkNodes, checkSkins } from './nodes';
import { checkImages } from './images';
import { repairCameras, repairLights, repairMaterials } from './surfaces';
import { repairVariants, withSoundVariants } from './variants';

/** A document that has been checked. */
export interface CheckedDocument {
  /** Valid in every part that is read. */
  readonly json: GltfJson;
  /** Buffers that shown parts read: these must exist. */
  readonly neededBuffers: ReadonlySet<number>;
  /** Checks the bytes, once they are loaded. */
  readonly checkBytes: (viewBytes: (index: number) => Uint8Array | undefined) => void;
}

/**
 * Checks a parsed document.
 * @param file Name of the document in messages.
 * @param warnings Receives what was repaired or left out.
 * @throws {GltfError} `gltf/malformed`, saying where.
 */
export function checkDocument(json: Raw, file: string, warnings: SceneWarning[]): CheckedDocument {
  const context = new CheckContext(json, file, warnings);
  const used = extensionsUsed(context);
  const views = checkBuffers(context);
  const needed = neededAccessors(context);
  const facts = checkAccessors(context, views, needed);
  const variants = repairVariants(context);
  const materials = context.list('materials').length;
  const meshes = checkMeshes(context, facts, views).map((mesh, index) => ({
    ...named(context, mesh, `/meshes/${index}`),
    primitives: (mesh['primitives'] as readonly Raw[]).map((primitive, at) =>
      withSoundVariants(context, primitive, `/meshes/${index}/primitives/${at}`, variants?.length ?? 0, materials),
    ),
  }));
  const nodes = checkNodes(context, facts, meshes);
  checkSkins(context, facts);
  checkImages(context);
  checkNames(context);
  const lights = repairLights(context);
  const imageLights = repairImageLights(context);
  const accessors = context.list('accessors');
  const checked = {
    ...json,
    ...(used ? { extensionsUsed: used } : {}),
    accessors,
    animations: repairAnimations(context, facts),
    meshes,
    nodes: nodes.map((node, index) =>
      named(context, withoutLostLight(context, node, index, lights?.length ?? 0), `/nodes/${index}`),
    ),
    scenes:
      own(json, 'scenes') === undefined
        ? undefined
        : context
            .list('scenes')
            .map((scene, index) =>
              withValidEnvironment(
                context,
                named(context, scene, `/scenes/${index}`),
                `/scenes/${index}`,
                imageLights?.length ?? 0,
              ),
            ),
    materials: repairMaterials(context),
    cameras: repairCameras(context),
    extensions: {
      ...(lights ? { KHR_lights_punctual: { lights } } : {}),
      ...(variants ? { KHR_materials_variants: { variants } } : {}),
      ...(imageLights ? { EXT_lights_image_based: { lights: imageLights } } : {}),
      ...xmpOf(context),
    },
  };
  if (own(json, 'scenes') === undefined) delete (checked as { scene?: unknown }).scene;
  return {
    json: checked as unknown as GltfJson,
    neededBuffers: buffersOf(
      accessors.filter((_, index) => needed.has(index)),
      meshes,
      views,
    ),
    checkBytes: (viewBytes) => checkSparseIndices(context, facts, viewBytes),
  };
}

/** The packets of KHR_xmp_json_ld, unchecked. */
function xmpOf(context: CheckContext): Raw {
  const extensions = own(context.json, 'extensions');
  const xmp = isObject(extensions) ? own(extensions, 'KHR_xmp_json_ld') : undefined;
  const packets = isObject(xmp) ? own(xmp, 'packets') : undefined;
  return Array.isArray(packets) ? { KHR_xmp_json_ld: { packets } } : {};
}

/** An object whose name, if any, is a string. */
function named(context: CheckContext, object: Raw, path: string): Raw {
  if (own(object, 'name') === undefined || typeof object['name'] === 'string') return object;
  context.warn('gltf/name', `${path}/name`, `is ${quote(object['name'])}, but must be a text; it is left out`);
  const { name: _, ...rest } = object;
  return rest;
}

/** Checks the names of parts that are not checked elsewhere. */
function checkNames(context: CheckContext): void {
  for (const key of [
    'accessors',
    'bufferViews',
    'buffers',
    'materials',
    'animations',
    'cameras',
    'skins',
    'images',
    'textures',
    'samplers',
  ])
    context.list(key).forEach((part, index) => named(context, part, `/${key}/${index}`));
  const asset = own(context.json, 'asset') as Raw;
  for (const key of ['generator', 'copyright']) {
    const value = own(asset, key);
    if (value !== undefined && typeof value !== 'string')
      context.warn('gltf/name', `/asset/${key}`, `is ${quote(value)}, but must be a text`);
  }
}

function withoutLostLight(context: CheckContext, node: Raw, index: number, lights: number): Raw {
  const extensions = own(node, 'extensions');
  const reference = isObject(extensions) ? own(extensions, 'KHR_lights_punctual') : undefined;
  if (reference === undefined) return node;
  const light = isObject(reference) ? own(reference, 'light') : undefined;
  if (typeof light === 'number' && Number.isInteger(light) && light >= 0 && light < lights) return node;
  context.warn(
    'gltf/light',
    `/nodes/${index}/extensions/KHR_lights_punctual`,
    `is ${quote(reference)}, which names no light; it is left out`,
  );
  const { KHR_lights_punctual: _, ...rest } = extensions as Raw;
  return { ...node, extensions: rest };
}

/** A scene without a reference to an environment that does not exist. */
function withValidEnvironment(context: CheckContext, scene: Raw, path: string, lights: number): Raw {
  const extensions = own(scene, 'extensions');
  const reference = isObject(extensions) ? own(extensions, 'EXT_lights_image_based') : undefined;
  const light = isObject(reference) ? own(reference, 'light') : undefined;
  const good = typeof light === 'number' && Number.isInteger(light) && light >= 0 && light < lights;
  if (reference !== undefined && !good)
    context.warn(
      'gltf/environment',
      `${path}/extensions/EXT_lights_image_based`,
      `is ${quote(reference)}, which names no light; it is left out`,
    );
  return { ...scene, extensions: good ? { EXT_lights_image_based: { light } } : {} };
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
    // The buffer of a compressed view is only a fallback and need not exist.
    const extensions = own(view, 'extensions');
    const packed = isObject(extensions)
      ? ((own(extensions, 'EXT_meshopt_compression') ?? own(extensions, 'KHR_meshopt_compression')) as Raw | undefined)
      : undefined;
    buffers.add((packed ?? view)['buffer'] as number);
  });
  return buffers;
}
