import { pointerPath } from '../animation-pointer';
import type { CheckContext } from './context';
import { isObject, own, quote, type Raw } from '../json-value';
import type { AccessorFacts } from './data';

/** The properties that a channel may animate, and the type of their values. */
const PATHS: Readonly<Record<string, string>> = {
  translation: 'VEC3',
  rotation: 'VEC4',
  scale: 'VEC3',
  weights: 'SCALAR',
};
const INTERPOLATIONS = ['LINEAR', 'STEP', 'CUBICSPLINE'];

/**
 * Animations with their valid channels; the others are left out, with a warning. All animations are kept, so that their
 * indices do not change.
 */
export function repairAnimations(context: CheckContext, facts: readonly (AccessorFacts | undefined)[]): readonly Raw[] {
  return context.list('animations').map((animation, index) => {
    const path = `/animations/${index}`;
    const objects = (key: string): readonly unknown[] => {
      const value = own(animation, key);
      if (Array.isArray(value) && value.length > 0) return value as unknown[];
      context.warn(
        'gltf/animation',
        `${path}/${key}`,
        `is ${quote(value)}, but must be an array that is not empty; nothing is animated`,
      );
      return [];
    };
    const samplers = objects('samplers').map((sampler, at) =>
      repairSampler(context, sampler, `${path}/samplers/${at}`, facts),
    );
    const pointers: { sampler: number; path: readonly string[] }[] = [];
    const moved = new Set<string>();
    const kept = objects('channels').filter((channel, at) => {
      const pointer = pointerOf(context, channel, `${path}/channels/${at}`, samplers, facts);
      if (pointer) pointers.push(pointer);
      return (
        pointer === undefined && isSoundChannel(context, channel, `${path}/channels/${at}`, samplers, facts, moved)
      );
    });
    const name = own(animation, 'name');
    return {
      ...(typeof name === 'string' ? { name } : {}),
      samplers: samplers.map((sampler) => sampler ?? { input: 0, output: 0, interpolation: 'STEP' }),
      channels: kept,
      pointers,
    };
  });
}

function repairSampler(
  context: CheckContext,
  sampler: unknown,
  path: string,
  facts: readonly (AccessorFacts | undefined)[],
): Raw | undefined {
  const lost = (what: string) => {
    context.warn('gltf/animation', path, `${what}; what it moves stays`);
    return undefined;
  };
  if (!isObject(sampler)) return lost(`is ${quote(sampler)}, but must be an object`);
  const interpolation = own(sampler, 'interpolation') ?? 'LINEAR';
  if (!INTERPOLATIONS.includes(interpolation as string))
    return lost(`has the interpolation ${quote(interpolation)}, which is none`);
  const [input, output] = (['input', 'output'] as const).map((key) => own(sampler, key)) as [unknown, unknown];
  for (const [key, accessor] of [
    ['input', input],
    ['output', output],
  ] as const) {
    if (typeof accessor !== 'number' || !facts[accessor])
      return lost(`has ${quote(accessor)} as ${key}, which names no accessor`);
  }
  const times = facts[input as number] as AccessorFacts;
  if (times.type !== 'SCALAR' || times.componentType !== 5126)
    return lost(`has times of ${times.type} of ${times.componentType}, but they must be SCALAR of 5126`);
  if (interpolation === 'CUBICSPLINE' && times.count < 2) return lost('has less than two keys for its CUBICSPLINE');
  return { input, output, interpolation };
}

/** @param moved Properties of nodes that previous channels animate. */
function isSoundChannel(
  context: CheckContext,
  channel: unknown,
  path: string,
  samplers: readonly (Raw | undefined)[],
  facts: readonly (AccessorFacts | undefined)[],
  moved: Set<string>,
): boolean {
  const lost = (what: string) => {
    context.warn('gltf/animation', path, `${what}; it is left out`);
    return false;
  };
  const target = isObject(channel) ? own(channel, 'target') : undefined;
  if (!isObject(channel) || !isObject(target)) return lost(`is ${quote(channel)}, but must be an object with a target`);
  const at = own(channel, 'sampler');
  if (typeof at !== 'number' || !(at in samplers)) return lost(`has ${quote(at)} as sampler, which is none`);
  const sampler = samplers[at];
  const node = own(target, 'node'),
    part = own(target, 'path');
  // By the specification, channels without a node are ignored.
  if (!sampler || node === undefined) return false;
  const nodes = context.list('nodes');
  if (typeof node !== 'number' || !nodes[node]) return lost(`moves node ${quote(node)}, which is none`);
  const type = typeof part === 'string' && Object.hasOwn(PATHS, part) ? PATHS[part] : undefined;
  if (type === undefined) return lost(`moves ${quote(part)}, which is not a part of a node`);
  const keys =
    (facts[sampler['input'] as number] as AccessorFacts).count * (sampler['interpolation'] === 'CUBICSPLINE' ? 3 : 1);
  const values = facts[sampler['output'] as number] as AccessorFacts;
  if (values.type !== type) return lost(`has values of ${values.type} for ${part as string}, but they must be ${type}`);
  const exact = part === 'translation' || part === 'scale';
  if (values.componentType !== 5126 && (exact || !values.normalized))
    context.warn(
      'gltf/animation',
      path,
      `has values of ${values.componentType}, but the ${part as string} must be floats${exact ? '' : ' or normalized'}; they are read as they are`,
    );
  const size = part === 'weights' ? targetCount(context, nodes[node] as Raw) : 1;
  if (size === 0) return lost('animates morph targets that do not exist');
  if (values.count !== keys * size) return lost(`has ${values.count} values, but its times ask for ${keys * size}`);
  if (moved.has(`${node} ${part as string}`))
    context.warn(
      'gltf/animation',
      path,
      `moves the ${part as string} of node ${node}, as another channel does; the last one counts`,
    );
  moved.add(`${node} ${part as string}`);
  if (part !== 'weights' && own(nodes[node] as Raw, 'matrix') !== undefined)
    context.warn(
      'gltf/animation',
      path,
      `moves the ${part as string} of node ${node}, which has a matrix; the animation replaces it`,
    );
  return true;
}

/** A channel of KHR_animation_pointer; null if it is invalid, undefined if it is another kind of channel. */
function pointerOf(
  context: CheckContext,
  channel: unknown,
  path: string,
  samplers: readonly (Raw | undefined)[],
  facts: readonly (AccessorFacts | undefined)[],
): { sampler: number; path: readonly string[] } | null | undefined {
  const target = isObject(channel) ? own(channel, 'target') : undefined;
  if (!isObject(channel) || !isObject(target) || own(target, 'path') !== 'pointer') return undefined;
  const lost = (what: string) => {
    context.warn('gltf/animation', path, `${what}; it is left out`);
    return null;
  };
  const extensions = own(target, 'extensions');
  const extension = isObject(extensions) ? own(extensions, 'KHR_animation_pointer') : undefined;
  const pointer = isObject(extension) ? own(extension, 'pointer') : undefined;
  const parts = pointerPath(pointer);
  if (!parts) return lost(`moves ${quote(pointer)}, which cannot be animated`);
  const at = own(channel, 'sampler');
  const sampler = typeof at === 'number' ? samplers[at] : undefined;
  if (typeof at !== 'number' || !(at in samplers)) return lost(`has ${quote(at)} as sampler, which is none`);
  if (!sampler) return null;
  const keys =
    (facts[sampler['input'] as number] as AccessorFacts).count * (sampler['interpolation'] === 'CUBICSPLINE' ? 3 : 1);
  const values = facts[sampler['output'] as number] as AccessorFacts;
  if (values.count % keys !== 0 || (values.type !== 'SCALAR' && values.count !== keys))
    return lost(`has ${values.count} values of ${values.type} for ${keys} keys`);
  return { sampler: at, path: parts };
}

/** Morph targets of a node's mesh. Meshes have been checked. */
function targetCount(context: CheckContext, node: Raw): number {
  const mesh = own(node, 'mesh');
  const [primitive] =
    (typeof mesh === 'number'
      ? (context.list('meshes')[mesh]?.['primitives'] as readonly Raw[] | undefined)
      : undefined) ?? [];
  const targets = primitive && own(primitive, 'targets');
  return Array.isArray(targets) ? targets.length : 0;
}
