import { resolveParameters, type OpenPbrParameters } from '@glanz/openpbr';
import type { Material } from '@glanz/scene';

const known = new WeakMap<Material['parameters'], OpenPbrParameters>();

/**
 * All parameters of a material of the tracer's own scene, resolved once: a scene that is prepared asks dozens of times.
 * Only for materials whose parameters are replaced when they change, as those of {@link ownScene} are.
 */
export function parametersOf({ parameters }: Pick<Material, 'parameters'>): OpenPbrParameters {
  let resolved = known.get(parameters);
  if (!resolved) known.set(parameters, (resolved = resolveParameters(parameters)));
  return resolved;
}
