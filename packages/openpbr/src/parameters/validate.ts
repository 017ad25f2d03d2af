import { GlanzError } from '@glanz/wgsl/error';
import { OPENPBR_PARAMETER_NAMES, OPENPBR_PARAMETER_SPECS } from './specs';
import type { OpenPbrParameterName, OpenPbrParameters } from './types';

/**
 * Thrown where parameters cannot be repaired. Code: `openpbr/parameter-type` (the message says which type the
 * parameter takes).
 */
export class OpenPbrError extends GlanzError {}

/** Something {@link validateParameters} repaired or ignored. */
export interface OpenPbrWarning {
  /**
   * `openpbr/clamped`: a number outside its range; `openpbr/not-finite`: NaN or an infinity; `openpbr/no-direction`: a
   * vector without length; `openpbr/unknown-parameter`: no such name.
   */
  readonly code: 'openpbr/clamped' | 'openpbr/no-direction' | 'openpbr/not-finite' | 'openpbr/unknown-parameter';
  /** The name as it was given. */
  readonly parameter: string;
  /** One line: what was wrong, and what is used instead. */
  readonly message: string;
}

/** What {@link validateParameters} answers. */
export interface ValidatedParameters {
  /** The given parameters, clamped to their hard ranges, vectors of unit length; unknown names are left out. */
  readonly parameters: Partial<OpenPbrParameters>;
  readonly warnings: readonly OpenPbrWarning[];
}

const isTriple = (value: unknown): value is ArrayLike<number> =>
  (Array.isArray(value) || ArrayBuffer.isView(value)) &&
  (value as unknown as ArrayLike<unknown>).length === 3 &&
  Array.from(value as unknown as ArrayLike<unknown>).every((c) => typeof c === 'number');

/** A vector of length 1, or none where it has no direction. Already unit to single precision, it stays as it is. */
function unit(name: string, vector: readonly number[], warnings: OpenPbrWarning[]): readonly number[] | null {
  const length = Math.hypot(...vector);
  if (length > 1e-12) return Math.abs(length - 1) < 1e-7 ? vector : vector.map((component) => component / length);
  warnings.push({
    code: 'openpbr/no-direction',
    parameter: name,
    message: `OpenPBR parameter "${name}" has no length; the unperturbed vector is used.`,
  });
  return null;
}

/**
 * Clamps parameters to the specification's hard ranges, and reports what it changed. A number that is not finite
 * becomes the default, a vector gets length 1. Values of the wrong type are errors.
 *
 * @param given Any parameters; missing ones stay missing.
 * @throws {OpenPbrError} `openpbr/parameter-type` if a value is not a number, a triple of numbers, or a boolean as its
 * type asks.
 * @example
 * const { parameters, warnings } = validateParameters({ specular_roughness: 1.7 });   // 1, and one warning
 */
export function validateParameters(given: Partial<OpenPbrParameters>): ValidatedParameters {
  const warnings: OpenPbrWarning[] = [];
  const result: Record<string, unknown> = {};
  for (const [name, value] of Object.entries(given) as [OpenPbrParameterName, unknown][]) {
    if (value === undefined) continue;
    const info = Object.hasOwn(OPENPBR_PARAMETER_SPECS, name) ? OPENPBR_PARAMETER_SPECS[name] : undefined;
    if (!info) {
      warnings.push({
        code: 'openpbr/unknown-parameter',
        parameter: name,
        message: `OpenPBR has no parameter "${name}"; it is ignored.`,
      });
      continue;
    }
    const wrong = (allowed: string) =>
      new OpenPbrError(
        'openpbr/parameter-type',
        `OpenPBR parameter "${name}" takes ${allowed}, got ${JSON.stringify(value) ?? String(value)}.`,
      );
    const repair = (number: number, initial: number): number => {
      if (!Number.isFinite(number)) {
        warnings.push({
          code: 'openpbr/not-finite',
          parameter: name,
          message: `OpenPBR parameter "${name}" is ${number}; its default ${initial} is used.`,
        });
        return initial;
      }
      const [min, max] = info.range ?? [-Infinity, Infinity];
      const clamped = Math.min(Math.max(number, min), max);
      if (clamped !== number)
        warnings.push({
          code: 'openpbr/clamped',
          parameter: name,
          message: `OpenPBR parameter "${name}" is ${number}, outside ${min}..${max}; ${clamped} is used.`,
        });
      return clamped;
    };
    if (info.type === 'float') {
      if (typeof value !== 'number') throw wrong('a number');
      result[name] = repair(value, info.default as number);
    } else if (info.type === 'boolean') {
      if (typeof value !== 'boolean') throw wrong('true or false');
      result[name] = value;
    } else if (value === null && info.type === 'vector3') {
      result[name] = null;
    } else {
      if (!isTriple(value))
        throw wrong(
          typeof value === 'string'
            ? 'three numbers; cssColor() of @glanz/tonemap/css-color makes them of CSS colours'
            : 'three numbers',
        );
      const initial = info.default as readonly number[] | null;
      const numbers = Array.from(value, (component, i) => repair(component, initial?.[i] ?? 0));
      result[name] = info.type === 'vector3' ? unit(name, numbers, warnings) : numbers;
    }
  }
  return { parameters: result as Partial<OpenPbrParameters>, warnings };
}

/** The specification's default of every parameter. */
export function defaultParameters(): OpenPbrParameters {
  return Object.fromEntries(
    OPENPBR_PARAMETER_NAMES.map((name) => [name, OPENPBR_PARAMETER_SPECS[name].default]),
  ) as unknown as OpenPbrParameters;
}

/**
 * Fills missing parameters with the specification's defaults and clamps the rest to their hard ranges, silently. Use
 * {@link validateParameters}, for messages to a person.
 *
 * @throws {OpenPbrError} `openpbr/parameter-type`
 */
export function resolveParameters(given: Partial<OpenPbrParameters> = {}): OpenPbrParameters {
  return { ...defaultParameters(), ...validateParameters(given).parameters };
}
