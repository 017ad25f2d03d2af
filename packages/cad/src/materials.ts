import type { OpenPbrParameters } from '@glanz/openpbr';
import { validateParameters } from '@glanz/openpbr/parameters';
import { OPENPBR_PRESET_NAMES, openPbrPreset, type OpenPbrPresetName } from '@glanz/openpbr/presets';
import type { Material } from '@glanz/scene';
import { CadError } from './error';
import type { CadColor } from './read';

/**
 * What a part looks like: an example of OpenPBR's specification, parameters of it, or both, the second over the first.
 */
export interface CadLook {
  /** Name in `OPENPBR_PRESETS`. */
  readonly preset?: OpenPbrPresetName;
  /** Colours as linear Rec.709. */
  readonly parameters?: Partial<OpenPbrParameters>;
  /** Takes the base colour from the CAD file, where it has one. */
  readonly keepColor?: boolean;
  /** Default: the preset, or the pattern. */
  readonly name?: string;
}

/** One rule of a {@link CadMaterialMap}; what is given must fit. */
export interface CadRule extends CadLook {
  /**
   * Pattern for the part's name, or for its path with "/" between assemblies; `*` for anything. Case does not count.
   */
  readonly part?: string;
  /** Colour in the CAD file as sRGB, `#rrggbb`; two codes off still fit. */
  readonly color?: string;
}

/** Translates names and colours of a CAD file to materials. The first rule that fits counts. */
export interface CadMaterialMap {
  readonly rules: readonly CadRule[];
  /** Where none fits. Default: a satin plastic of the file's colour. */
  readonly fallback?: CadLook;
}

const DEFAULT: CadLook = { keepColor: true, parameters: { specular_roughness: 0.4 } };
const RULE_KEYS = ['part', 'color', 'preset', 'parameters', 'keepColor', 'name'];

/**
 * Checks a material map that has been read from JSON.
 *
 * @throws {CadError} `cad/materials`, saying where.
 */
export function checkMaterialMap(json: unknown): CadMaterialMap {
  const fail = (path: string, what: string): never => {
    throw new CadError('cad/materials', `The material map: ${path} ${what}.`, { location: { path } });
  };
  const object = (value: unknown, path: string): Record<string, unknown> =>
    typeof value === 'object' && value !== null && !Array.isArray(value)
      ? (value as Record<string, unknown>)
      : fail(path, 'must be an object');
  const look = (value: unknown, path: string): void => {
    const given = object(value, path);
    for (const key of Object.keys(given))
      if (!RULE_KEYS.includes(key)) fail(`${path}/${key}`, `is not known; there are ${RULE_KEYS.join(', ')}`);
    for (const key of ['part', 'color', 'name', 'preset'])
      if (given[key] !== undefined && typeof given[key] !== 'string') fail(`${path}/${key}`, 'must be a text');
    if (given['color'] !== undefined && !/^#[0-9a-f]{6}$/i.test(given['color'] as string))
      fail(`${path}/color`, `is "${given['color'] as string}", but must be like #c0c0c0`);
    if (given['preset'] !== undefined && !OPENPBR_PRESET_NAMES.includes(given['preset'] as OpenPbrPresetName))
      fail(
        `${path}/preset`,
        `is "${given['preset'] as string}", which is not a preset; there are ${OPENPBR_PRESET_NAMES.slice(0, 6).join(', ')} and ${OPENPBR_PRESET_NAMES.length - 6} more`,
      );
    if (given['parameters'] === undefined) return;
    const { warnings } = validateParameters(
      object(given['parameters'], `${path}/parameters`) as Partial<OpenPbrParameters>,
    );
    if (warnings[0]) fail(`${path}/parameters`, `do not fit: ${warnings[0].message}`);
  };
  const map = object(json, '/');
  for (const key of Object.keys(map))
    if (key !== 'rules' && key !== 'fallback') fail(`/${key}`, 'is not known; there are rules and fallback');
  if (!Array.isArray(map['rules'])) fail('/rules', 'must be an array');
  (map['rules'] as unknown[]).forEach((rule, index) => {
    look(rule, `/rules/${index}`);
    const { part, color } = rule as CadRule;
    if (part === undefined && color === undefined)
      fail(`/rules/${index}`, 'has neither a part nor a color to go by; use fallback for all the rest');
  });
  if (map['fallback'] !== undefined) look(map['fallback'], '/fallback');
  return json as CadMaterialMap;
}

const encode = (x: number) => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));

/** A linear colour as sRGB codes, `#rrggbb`. */
export const hexOf = (color: CadColor): string =>
  `#${color.map((x) => encode(x).toString(16).padStart(2, '0')).join('')}`;

/**
 * Whether a text is what a pattern says, case aside; `*` is anything. Pieces are matched at their first occurrence, so that
 * time stays linear, unlike with regular expressions.
 */
function matches(pattern: string, text: string): boolean {
  const [first = '', ...rest] = pattern.toLowerCase().split(/\*+/);
  const lower = text.toLowerCase();
  const last = rest.pop();
  if (last === undefined) return lower === first;
  if (!lower.startsWith(first) || !lower.endsWith(last) || lower.length < first.length + last.length) return false;
  let at = first.length;
  for (const piece of rest) {
    const found = lower.indexOf(piece, at);
    if (found < 0) return false;
    at = found + piece.length;
  }
  return at <= lower.length - last.length;
}

function fits({ part, color }: CadRule, name: string, path: readonly string[], shown: CadColor | undefined): boolean {
  if (part !== undefined) {
    if (!matches(part, name) && !matches(part, [...path, name].join('/'))) return false;
  }
  if (color === undefined) return true;
  return (
    shown !== undefined &&
    shown.every((x, k) => Math.abs(encode(x) - Number.parseInt(color.slice(1 + 2 * k, 3 + 2 * k), 16)) <= 2)
  );
}

/** The material of a part of a colour, by the first rule that fits. The same look and colour give an equal name. */
export function materialOf(
  map: CadMaterialMap | undefined,
  name: string,
  path: readonly string[],
  color: CadColor | undefined,
): Material {
  const rule = map?.rules.find((one) => fits(one, name, path, color));
  const look: CadLook & { readonly part?: string } = rule ?? map?.fallback ?? DEFAULT;
  const kept = look.keepColor && color ? color : undefined;
  const parameters: Partial<OpenPbrParameters> = {
    ...(look.preset ? openPbrPreset(look.preset) : {}),
    ...look.parameters,
    ...(kept ? { base_color: [...kept] } : {}),
  };
  return {
    name: [look.name ?? look.preset ?? look.part ?? 'CAD', ...(kept ? [hexOf(kept)] : [])].join(' '),
    parameters,
  };
}
