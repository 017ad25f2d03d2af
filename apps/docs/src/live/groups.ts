import {
  OPENPBR_PARAMETERS,
  type OpenPbrColor,
  type OpenPbrGroup,
  type OpenPbrParameterInfo,
  type OpenPbrParameterName,
  type OpenPbrParameters,
} from '@glanz/openpbr/parameters';
import { srgbDecode, srgbEncode } from '@glanz/tonemap';

/** One control of a group's live sphere. */
export type GroupControl =
  | {
      readonly kind: 'number';
      readonly name: OpenPbrParameterName;
      readonly doc: string;
      readonly min: number;
      readonly max: number;
      readonly value: number;
    }
  | { readonly kind: 'color'; readonly name: OpenPbrParameterName; readonly doc: string; readonly value: string }
  | { readonly kind: 'switch'; readonly name: OpenPbrParameterName; readonly doc: string; readonly value: boolean };

interface Look {
  /** What the sphere has besides the group's own parameters, and where its sliders begin. */
  readonly start: Partial<OpenPbrParameters>;
  /** Where another range than that of the table suits a sphere of radius 1 in a studio. */
  readonly ranges?: Partial<Record<OpenPbrParameterName, readonly [number, number]>>;
  /** Parameters of other groups that belong here. */
  readonly also?: readonly OpenPbrParameterName[];
}

const RED: OpenPbrColor = [0.55, 0.06, 0.03];

const LOOKS: Readonly<Record<OpenPbrGroup, Look>> = {
  base: { start: { base_color: [0.58, 0.15, 0.03] } },
  specular: {
    start: { base_color: [0.9, 0.62, 0.3], base_metalness: 1, specular_roughness: 0.35 },
    also: ['base_metalness'],
  },
  transmission: {
    start: {
      transmission_weight: 1,
      transmission_color: [0.55, 0.85, 0.75],
      transmission_depth: 1,
      specular_roughness: 0.05,
    },
    ranges: { transmission_depth: [0, 4] },
    also: ['specular_roughness', 'specular_ior'],
  },
  subsurface: {
    start: {
      subsurface_weight: 1,
      subsurface_color: [0.85, 0.5, 0.35],
      subsurface_radius: 0.2,
      specular_roughness: 0.4,
    },
  },
  coat: {
    start: { base_color: RED, coat_weight: 1, specular_roughness: 0.6, coat_roughness: 0.05 },
    also: ['specular_roughness'],
  },
  fuzz: { start: { base_color: [0.08, 0.01, 0.05], specular_weight: 0, fuzz_weight: 1, fuzz_color: [0.9, 0.35, 0.5] } },
  emission: {
    start: { base_color: [0.1, 0.1, 0.1], emission_luminance: 2, emission_color: [1, 0.45, 0.12] },
    ranges: { emission_luminance: [0, 20] },
  },
  thin_film: {
    start: { base_color: [0.02, 0.02, 0.02], specular_roughness: 0.1, thin_film_weight: 1, thin_film_thickness: 0.45 },
    also: ['base_metalness'],
  },
  geometry: { start: { base_color: [0.05, 0.25, 0.5], geometry_opacity: 0.6 } },
};

const byte = (c: number) =>
  Math.round(255 * Math.min(Math.max(srgbEncode(c), 0), 1))
    .toString(16)
    .padStart(2, '0');
const hexOf = (color: OpenPbrColor) => `#${color.map(byte).join('')}`;
const colorOf = (hex: string): OpenPbrColor =>
  [1, 3, 5].map((at) => srgbDecode(Number.parseInt(hex.slice(at, at + 2), 16) / 255)) as unknown as OpenPbrColor;

function controlOf(
  { name, type, doc, default: initial, softRange = [0, 1] }: OpenPbrParameterInfo,
  { start, ranges = {} }: Look,
): GroupControl[] {
  const value = start[name] ?? initial;
  if (type === 'boolean') return [{ kind: 'switch', name, doc, value: value as boolean }];
  if (type === 'color3') return [{ kind: 'color', name, doc, value: hexOf(value as OpenPbrColor) }];
  if (type !== 'float') return [];
  const [min, max] = ranges[name] ?? softRange;
  return [{ kind: 'number', name, doc, min, max, value: value as number }];
}

/** The controls of a group, in the order of the table: all that a sphere without textures can show. */
export function groupControls(group: OpenPbrGroup): GroupControl[] {
  const look = LOOKS[group];
  return Object.values(OPENPBR_PARAMETERS)
    .filter((info: OpenPbrParameterInfo) => info.group === group || look.also?.includes(info.name))
    .flatMap((info) => controlOf(info as OpenPbrParameterInfo, look));
}

/** What the controls' values mean, with what the sphere has besides. */
export function groupParameters(
  group: OpenPbrGroup,
  values: Readonly<Record<string, number | string | boolean>>,
): Partial<OpenPbrParameters> {
  const set = Object.entries(values).map(([name, value]) => [name, typeof value === 'string' ? colorOf(value) : value]);
  return { ...LOOKS[group].start, ...(Object.fromEntries(set) as Partial<OpenPbrParameters>) };
}
