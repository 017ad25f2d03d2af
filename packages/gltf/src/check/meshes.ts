import type { CheckContext } from './context';
import { isObject, own, quote, type Raw } from '../json-value';
import type { AccessorFacts } from './data';

/** Attributes that are read, with the types they may have. Others may hold anything. */
const ATTRIBUTES: ReadonlyMap<string, readonly string[]> = new Map([
  ['NORMAL', ['VEC3']],
  ['TANGENT', ['VEC4']],
  ['TEXCOORD_0', ['VEC2']],
  ['COLOR_0', ['VEC3', 'VEC4']],
  ['JOINTS_0', ['VEC4']],
  ['WEIGHTS_0', ['VEC4']],
]);

const [BYTE, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, FLOAT] = [5120, 5121, 5122, 5123, 5126] as const;
const FLOATS = [`${FLOAT}`],
  CODES = [`${UNSIGNED_BYTE} normalized`, `${UNSIGNED_SHORT} normalized`];

/** Components that attributes may have (glTF 2.0, 3.7.2.1). */
const COMPONENTS: ReadonlyMap<string, readonly string[]> = new Map([
  ['POSITION', FLOATS],
  ['NORMAL', FLOATS],
  ['TANGENT', FLOATS],
  ['TEXCOORD_0', [...FLOATS, ...CODES]],
  ['COLOR_0', [...FLOATS, ...CODES]],
  ['JOINTS_0', [`${UNSIGNED_BYTE}`, `${UNSIGNED_SHORT}`]],
  ['WEIGHTS_0', [...FLOATS, ...CODES]],
]);
const SMALL = [BYTE, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT].flatMap((component) => [
  `${component}`,
  `${component} normalized`,
]);
const SIGNED = [`${BYTE} normalized`, `${SHORT} normalized`];

/** What KHR_mesh_quantization adds. */
const QUANTIZED: ReadonlyMap<string, readonly string[]> = new Map([
  ['POSITION', SMALL],
  ['NORMAL', SIGNED],
  ['TANGENT', SIGNED],
  ['TEXCOORD_0', SMALL],
]);

/** Draco's ids have 32 bits. */
const MAX_ID = 2 ** 32 - 1;

/** Accessors that are read: those of meshes, skins' matrices and instances. Animations are not. */
export function neededAccessors(context: CheckContext): Set<number> {
  const needed = new Set<number>();
  const add = (value: unknown) => {
    if (typeof value === 'number') needed.add(value);
  };
  const addAll = (value: unknown) => {
    if (isObject(value)) Object.values(value).forEach(add);
  };
  context.list('meshes').forEach((mesh, index) => {
    const primitives = own(mesh, 'primitives');
    if (primitives === undefined) context.fail(`/meshes/${index}`, 'has no primitives');
    for (const primitive of context.objects(primitives, `/meshes/${index}/primitives`)) {
      addAll(own(primitive, 'attributes'));
      add(own(primitive, 'indices'));
      const targets = own(primitive, 'targets');
      if (Array.isArray(targets)) targets.forEach(addAll);
    }
  });
  for (const skin of context.list('skins')) add(own(skin, 'inverseBindMatrices'));
  context.list('nodes').forEach((node, index) => {
    addAll(context.extension(node, 'EXT_mesh_gpu_instancing', `/nodes/${index}`)?.['attributes']);
  });
  return needed;
}

/** Checks what meshes refer to. Returns them without attributes of a wrong type, with a warning. */
export function checkMeshes(
  context: CheckContext,
  facts: readonly (AccessorFacts | undefined)[],
  views: readonly Raw[],
): readonly Raw[] {
  const materials = context.list('materials');
  return context.list('meshes').map((mesh, index) => {
    const path = `/meshes/${index}`;
    const weights = own(mesh, 'weights');
    if (weights !== undefined && !(Array.isArray(weights) && weights.every((w) => typeof w === 'number')))
      context.fail(`${path}/weights`, 'must be an array of numbers');
    const primitives = context.objects(own(mesh, 'primitives'), `${path}/primitives`);
    if (primitives.length === 0) context.fail(`${path}/primitives`, 'is empty');
    const targets = new Set(
      primitives.map((primitive) => {
        const list = own(primitive, 'targets');
        return Array.isArray(list) ? list.length : 0;
      }),
    );
    if (targets.size > 1)
      context.warn(
        'gltf/primitive',
        `${path}/primitives`,
        `have ${[...targets].join(', ')} morph targets, but must all have as many`,
      );
    const [number = 0] = targets;
    if (Array.isArray(weights) && weights.length !== number)
      context.warn('gltf/primitive', `${path}/weights`, `are ${weights.length}, but there are ${number} morph targets`);
    return {
      ...mesh,
      primitives: primitives.map((primitive, at) =>
        checkPrimitive(context, `${path}/primitives/${at}`, primitive, facts, materials, views),
      ),
    };
  });
}

function checkPrimitive(
  context: CheckContext,
  path: string,
  primitive: Raw,
  facts: readonly (AccessorFacts | undefined)[],
  materials: readonly Raw[],
  views: readonly Raw[],
): Raw {
  context.integer(primitive, 'mode', path, 0, 6, 4);
  context.index(primitive, 'material', path, materials, 'material');
  const indices = context.index(primitive, 'indices', path, facts, 'accessor');
  if (indices !== undefined) {
    const { type, componentType } = facts[indices] as AccessorFacts;
    const view = own(context.list('accessors')[indices] as Raw, 'bufferView');
    if (typeof view === 'number' && own(views[view] as Raw, 'byteStride') !== undefined)
      context.warn(
        'gltf/data',
        `${path}/indices`,
        'lie in a buffer view with a byteStride, which indices must not have; they are read with it',
      );
    if (type !== 'SCALAR' || ![5121, 5123, 5125].includes(componentType))
      context.fail(`${path}/indices`, `is a ${type} of ${componentType}, but indices are unsigned whole numbers`);
  }
  const draco = context.extension(primitive, 'KHR_draco_mesh_compression', path);
  if (draco) {
    const at = `${path}/extensions/KHR_draco_mesh_compression`;
    context.integer(draco, 'bufferView', at, 0, views.length - 1);
    const attributes = context.object(draco, 'attributes', at) ?? context.fail(at, 'has no attributes');
    for (const semantic of Object.keys(attributes))
      context.integer(attributes, semantic, `${at}/attributes`, 0, MAX_ID);
  }
  const attributes = context.object(primitive, 'attributes', path) ?? context.fail(path, 'has no attributes');
  const kept = checkAttributes(context, `${path}/attributes`, attributes, facts);
  const vertices = facts[kept['POSITION'] as number]?.count;
  const targets = own(primitive, 'targets');
  let sound: Raw[] | undefined;
  if (targets !== undefined) {
    const list = context.objects(targets, `${path}/targets`);
    context.notEmpty(list, `${path}/targets`);
    sound = list.map((target, t) => {
      const moved: Record<string, unknown> = {};
      for (const [semantic, accessor] of Object.entries(target)) {
        const at = `${path}/targets/${t}/${semantic}`;
        context.reference(accessor, at, facts, 'accessor');
        const { count, type } = facts[accessor] as AccessorFacts;
        if (kept[semantic] === undefined)
          context.warn('gltf/primitive', at, 'changes an attribute that does not exist');
        if (vertices !== undefined && count !== vertices) context.fail(at, `moves ${count} vertices of ${vertices}`);
        if (/^(TEXCOORD|COLOR)_\d+$/.test(semantic))
          context.warn('gltf/primitive', at, 'is not read: morph targets move positions, normals and tangents');
        else if (['POSITION', 'NORMAL', 'TANGENT'].includes(semantic) && type !== 'VEC3')
          context.warn('gltf/primitive', at, `is a ${quote(type)}, but must be VEC3; it is left out`);
        else moved[semantic] = accessor;
      }
      return moved;
    });
  }
  return { ...primitive, attributes: kept, ...(sound ? { targets: sound } : {}) };
}

function checkAttributes(
  context: CheckContext,
  path: string,
  attributes: Raw,
  facts: readonly (AccessorFacts | undefined)[],
): Raw {
  const kept: Record<string, unknown> = {};
  for (const [semantic, accessor] of Object.entries(attributes)) {
    const at = `${path}/${semantic}`;
    context.reference(accessor, at, facts, 'accessor');
    const { type, componentType, normalized } = facts[accessor] as AccessorFacts;
    if (semantic === 'POSITION' && type !== 'VEC3') context.fail(at, `is a ${type}, but positions are VEC3`);
    const kind = semantic.replace(/^(TEXCOORD|JOINTS|WEIGHTS)_\d+$/, '$1_0');
    const types = ATTRIBUTES.get(kind);
    if (types && !types.includes(type))
      context.warn('gltf/primitive', at, `is a ${quote(type)}, but must be ${types.join(' or ')}; it is left out`);
    else kept[semantic] = accessor;
    const components = `${componentType}${normalized ? ' normalized' : ''}`;
    const allowed = [
      ...(COMPONENTS.get(kind) ?? [components]),
      ...(context.uses('KHR_mesh_quantization') ? (QUANTIZED.get(kind) ?? []) : []),
    ];
    if (!allowed.includes(components))
      context.warn(
        'gltf/primitive',
        at,
        `has components of ${components}, but must have ${allowed.join(' or ')}; they are taken as they are`,
      );
  }
  for (const semantic of Object.keys(kept)) {
    const [, kind, set] = /^(JOINTS|WEIGHTS)_(\d+)$/.exec(semantic) ?? [];
    const other = kind === 'JOINTS' ? `WEIGHTS_${set}` : `JOINTS_${set}`;
    if (kind !== undefined && kept[other] === undefined)
      context.warn('gltf/skin', path, `has ${semantic} without ${other}; it does not move the mesh`);
  }
  return kept;
}
