import { OPENPBR_PARAMETERS, type OpenPbrParameterName } from '@glanz/openpbr/parameters';
import type { Material } from '@glanz/scene';
import { srgbDecode } from '@glanz/tonemap';

/** One number of the OpenPBR table that the sphere lets one turn. */
export interface SphereSlider {
  readonly name: string;
  readonly min: number;
  readonly max: number;
  readonly value: number;
  readonly doc: string;
}

const NAMES = [
  'base_metalness',
  'base_diffuse_roughness',
  'specular_weight',
  'specular_roughness',
  'specular_roughness_anisotropy',
  'specular_ior',
] as const satisfies readonly OpenPbrParameterName[];

/** Ranges, defaults and words come from the table of `@glanz/openpbr`. */
export const SPHERE_SLIDERS: readonly SphereSlider[] = NAMES.map((name) => {
  const { softRange: [min, max] = [0, 1], default: value, doc } = OPENPBR_PARAMETERS[name];
  return { name, min, max, value, doc };
});

/** What the sliders and the colour field (`#rrggbb`, sRGB) mean. */
export function sphereParameters(values: Readonly<Record<string, number>>, hex: string): Material['parameters'] {
  const code = Number.parseInt(hex.slice(1), 16);
  const channel = (shift: number) => srgbDecode(((code >> shift) & 255) / 255);
  return { ...values, base_color: [channel(16), channel(8), channel(0)] };
}
