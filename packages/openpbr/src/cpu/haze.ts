import type { OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { coatedBase } from './coat';
import type { InterfaceEnergy } from './dielectric';
import { conductorLoss } from './energy';
import { ggxAlpha, ggxBound, type Slopes } from './ggx';
import { narrowedSlopes, thinNarrowing, type Transmission } from './transmission';
import { rgb } from './vector';

/** Facets of a second roughness, `specular_haze`; twin of the WGSL struct `OpenPbrHaze`, which says what they do. */
export interface Haze {
  /** Their share; 0: there are none. */
  readonly weight: number;
  readonly roughness: number;
  readonly alpha: Slopes;
  /** See {@link ggxBound}. */
  readonly bound: number;
}

/** The facets of the second kind, if there are any; twin of `openpbr_haze_prepare`. */
export function prepareHaze(whole: OpenPbrParameters, wo: OpenPbrVector): Haze {
  const { specular_roughness: first, specular_haze_spread: spread } = whole;
  const { specular_roughness: roughness } = coatedBase({ ...whole, specular_roughness: mix(first, 1, spread) });
  const alpha = ggxAlpha(roughness, whole.specular_roughness_anisotropy);
  return { weight: whole.specular_haze, roughness, alpha, bound: ggxBound(alpha, wo) };
}

/** What the two kinds of facets do, by their shares. */
export const mix = (first: number, second: number, weight: number): number => first * (1 - weight) + second * weight;

/** An interface with both kinds of facets. */
export const mixInterfaces = <T extends InterfaceEnergy>(first: T, second: T, weight: number): T => ({
  ...first,
  albedo: mix(first.albedo, second.albedo, weight),
  multiscatter: mix(first.multiscatter, second.multiscatter, weight),
  multiscatterThrough: mix(first.multiscatterThrough, second.multiscatterThrough, weight),
});

/** A thin wall with both kinds of facets: what either loses between them; twin of `openpbr_haze_thin`. */
export function mixThin(
  t: Transmission,
  { alpha, roughness, weight }: Haze,
  wo: OpenPbrVector,
  mu: number,
  multipleScattering: boolean,
): Transmission {
  const lostBy = (r: number): number => (multipleScattering ? conductorLoss(alpha, r, wo, mu) : 0);
  const reflected = lostBy(roughness);
  const passed = lostBy(roughness * thinNarrowing(t.eta));
  return {
    ...t,
    albedo: rgb((i) => mix(t.albedo[i], t.color[i] * (1 - passed), weight)),
    multiscatter: rgb((i) => mix(t.multiscatter[i], t.color[i] * passed, weight)),
    reflectionAlbedo: rgb((i) => mix(t.reflectionAlbedo[i], t.reflection[i] * (1 - reflected), weight)),
    reflectionMultiscatter: rgb((i) => mix(t.reflectionMultiscatter[i], t.reflection[i] * reflected, weight)),
  };
}

/** Slopes of the second kind for light that goes through. */
export const hazeThrough = ({ thin, eta }: Transmission, { alpha }: Haze): Slopes =>
  thin ? narrowedSlopes(alpha, thinNarrowing(eta)) : alpha;

/** A direction after half a revolution about the normal; twin of `openpbr_turned`. */
export const turned = ([x, y, z]: OpenPbrVector): OpenPbrVector => [-x, -y, z];
