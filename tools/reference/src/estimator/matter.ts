import type { Material } from '@glanz/scene';
import { ReferenceError } from '../error';
import type { Vec3 } from './optics';

/** What the estimator knows of a material. */
export type Matter =
  /** Lambert's surface, the same on both sides. */
  | { readonly kind: 'matt'; readonly albedo: Vec3 }
  /** Black, and emits the same radiance from its front to everywhere. */
  | { readonly kind: 'emitter'; readonly radiance: Vec3 }
  /** A smooth sheet in air; `color` is what it leaves of light that crosses it at right angles. */
  | { readonly kind: 'pane'; readonly index: number; readonly color: Vec3 }
  /** Smooth and clear, with an interior. */
  | {
      readonly kind: 'clear';
      readonly index: number;
      /** Abbe number; infinite without dispersion. */
      readonly abbe: number;
      /** Absorption, 1/m. */
      readonly absorption: Vec3;
      readonly priority: number;
    };

const USED = new Set([
  'base_weight',
  'base_color',
  'specular_weight',
  'specular_ior',
  'specular_roughness',
  'transmission_weight',
  'transmission_color',
  'transmission_depth',
  'transmission_dispersion_scale',
  'transmission_dispersion_abbe_number',
  'emission_color',
  'emission_luminance',
  'geometry_thin_walled',
]);

/**
 * Reads an OpenPBR material by the definitions of OpenPBR 1.1.1.
 *
 * @throws {ReferenceError} `reference/unsupported` for all but matt surfaces, emitters and smooth glass.
 */
export function matterOf({ name, parameters: p, textures, dielectric_priority: priority = 0 }: Material): Matter {
  const refuse = (what: string): never => {
    throw new ReferenceError('reference/unsupported', `Material "${name}": the estimator has no ${what}.`);
  };
  const other = Object.keys(p).find((parameter) => !USED.has(parameter));
  if (other !== undefined) refuse(other);
  if (textures && Object.keys(textures).length > 0) refuse('textures');
  const { transmission_weight: clear = 0, specular_weight: specular = 1, base_weight: base = 1 } = p;
  const white: Vec3 = [1, 1, 1];
  if (clear === 0) {
    if (specular !== 0) refuse('gloss over an opaque surface');
    const [luminance, color] = [p.emission_luminance ?? 0, p.emission_color ?? white];
    if (luminance === 0)
      return { kind: 'matt', albedo: (p.base_color ?? [0.8, 0.8, 0.8]).map((x) => x * base) as unknown as Vec3 };
    if (base !== 0) refuse('emitters that reflect');
    return { kind: 'emitter', radiance: color.map((x) => x * luminance) as unknown as Vec3 };
  }
  if (clear !== 1 || specular !== 1 || p.specular_roughness !== 0 || p.emission_luminance)
    refuse('glass that is rough, cloudy or glowing');
  const [index, color, depth] = [p.specular_ior ?? 1.5, p.transmission_color ?? white, p.transmission_depth ?? 0];
  if (p.geometry_thin_walled) return { kind: 'pane', index, color };
  if (depth === 0 && color.some((x) => x !== 1)) refuse('tint of a surface');
  const scale = p.transmission_dispersion_scale ?? 0;
  return {
    kind: 'clear',
    index,
    abbe: scale === 0 ? Infinity : (p.transmission_dispersion_abbe_number ?? 20) / scale,
    // White has this colour after that depth.
    absorption: color.map((x) => (x === 1 ? 0 : -Math.log(x) / depth)) as unknown as Vec3,
    priority,
  };
}
