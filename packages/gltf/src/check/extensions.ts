import type { CheckContext } from './context';
import { isObject, own, quote, type Raw } from '../json-value';

/** Lists whose entries may have extensions. Materials are scanned deeper. */
const LISTS = [
  'accessors',
  'animations',
  'buffers',
  'bufferViews',
  'cameras',
  'images',
  'meshes',
  'nodes',
  'samplers',
  'scenes',
  'skins',
  'textures',
];

/** How deep the textures of an extension of a material lie, with the extensions of their own. */
const MATERIAL_DEPTH = 5;

/**
 * The names of all extensions that the document uses, declared or not: decoders are chosen by these names. Undefined if
 * there are none.
 */
export function extensionsUsed(context: CheckContext): readonly string[] | undefined {
  const lists = ['extensionsUsed', 'extensionsRequired'].map((key) => {
    const names = own(context.json, key);
    if (names === undefined) return [];
    if (!(Array.isArray(names) && names.every((name) => typeof name === 'string')))
      context.fail(`/${key}`, `is ${quote(names)}, but must be an array of names`);
    context.notEmpty(names, `/${key}`);
    if (new Set(names).size < names.length) context.warn('gltf/extension', `/${key}`, 'names an extension twice');
    return names as string[];
  });
  const [declared = [], required = []] = lists;
  const used = new Set(declared);
  const undeclared = (name: string, how: string) => {
    if (used.has(name)) return;
    used.add(name);
    context.warn('gltf/extension', '/extensionsUsed', `does not name ${quote(name)}, which the document ${how}`);
  };
  for (const name of required) undeclared(name, 'requires');
  for (const name of namesIn(context)) undeclared(name, 'uses');
  return used.size > 0 ? [...used] : undefined;
}

/** Names of the extensions that parts of the document have. */
function namesIn(context: CheckContext): ReadonlySet<string> {
  const found = new Set<string>();
  const add = (part: unknown) => {
    const extensions = isObject(part) ? own(part, 'extensions') : undefined;
    if (isObject(extensions)) for (const name of Object.keys(extensions)) found.add(name);
  };
  const addAll = (parts: unknown) => {
    if (Array.isArray(parts)) parts.forEach(add);
  };
  const addDeep = (part: unknown, depth: number) => {
    if (!isObject(part) || depth > MATERIAL_DEPTH) return;
    add(part);
    for (const [key, value] of Object.entries(part)) if (key !== 'extras') addDeep(value, depth + 1);
  };
  add(context.json);
  for (const key of LISTS) context.list(key).forEach(add);
  for (const mesh of context.list('meshes')) addAll(own(mesh, 'primitives'));
  for (const animation of context.list('animations')) {
    const channels = own(animation, 'channels');
    if (Array.isArray(channels))
      for (const channel of channels) add(isObject(channel) ? own(channel as Raw, 'target') : undefined);
  }
  for (const material of context.list('materials')) addDeep(material, 0);
  return found;
}
