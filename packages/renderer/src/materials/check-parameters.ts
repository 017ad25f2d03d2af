import { OPENPBR_PARAMETER_NAMES, OPENPBR_PARAMETER_SPECS, validateParameters } from '@glanz/openpbr/parameters';
import type { Material } from '@glanz/scene';
import { RenderError } from '../errors';

/** The name among `names` that differs from `name` by the fewest letters, if they are few. */
function nearest(name: string, names: readonly string[]): string | undefined {
  const distance = (other: string): number => {
    let row = Array.from({ length: other.length + 1 }, (_, i) => i);
    for (let i = 1; i <= name.length; i++) {
      const next = [i];
      for (let j = 1; j <= other.length; j++) {
        next.push(
          Math.min(
            (row[j] as number) + 1,
            (next[j - 1] as number) + 1,
            (row[j - 1] as number) + (name[i - 1] === other[j - 1] ? 0 : 1),
          ),
        );
      }
      row = next;
    }
    return row[other.length] as number;
  };
  const [best] = names.map((other) => ({ other, letters: distance(other) })).sort((a, b) => a.letters - b.letters);
  return best && best.letters <= Math.max(2, name.length / 3) ? best.other : undefined;
}

/**
 * Checks parameters that a material is about to get. Unlike a file's, which are repaired with a warning, an edit's are
 * refused.
 *
 * @param material Its name, for the error.
 * @throws {RenderError} `renderer/material` for names that OpenPBR does not have, and values that it does not allow.
 */
export function checkParameters(material: string, parameters: Material['parameters']): void {
  const refuse = (why: string, cause?: unknown) =>
    new RenderError('renderer/material', `Material "${material}" was not changed: ${why}`, { cause });
  let warnings: ReturnType<typeof validateParameters>['warnings'];
  try {
    ({ warnings } = validateParameters(parameters));
  } catch (cause) {
    throw refuse((cause as Error).message, cause);
  }
  const [first] = warnings;
  if (!first) return;
  const { code, parameter } = first;
  if (code === 'openpbr/unknown-parameter') {
    const meant = nearest(parameter, OPENPBR_PARAMETER_NAMES);
    throw refuse(`OpenPBR has no parameter "${parameter}"${meant ? `; did you mean "${meant}"?` : '.'}`);
  }
  const [min = '-∞', max = '∞'] =
    OPENPBR_PARAMETER_SPECS[parameter as keyof typeof OPENPBR_PARAMETER_SPECS].range ?? [];
  const value = String(parameters[parameter as keyof typeof parameters]);
  throw refuse(
    `${parameter} is ${value}; it must be ${code === 'openpbr/no-direction' ? 'a vector with a length' : `finite and from ${min} to ${max}`}.`,
  );
}
