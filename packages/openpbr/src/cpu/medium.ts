import type { OpenPbrColor, OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { clamp, dot, rgb } from './vector';

/** What fills an object, per unit of length; twin of the WGSL struct `OpenPbrMedium`. */
export interface Medium {
  /** What is lost along the ray. */
  readonly extinction: OpenPbrColor;
  /** The part of it that is scattered. */
  readonly scattering: OpenPbrColor;
  /** Henyey and Greenstein's g. */
  readonly anisotropy: number;
}

/**
 * The interior of a transparent object (OpenPBR 1.1.1); twin of `openpbr_medium`. Zero for thin walls and for depth 0.
 */
export function transmissionMedium(p: OpenPbrParameters): Medium {
  const anisotropy = clamp(p.transmission_scatter_anisotropy, -0.999, 0.999);
  if (p.transmission_depth <= 0 || p.geometry_thin_walled)
    return { extinction: [0, 0, 0], scattering: [0, 0, 0], anisotropy };
  const depth = Math.max(p.transmission_depth, 1e-9);
  const scattering = rgb((i) => p.transmission_scatter[i] / depth);
  const absorption = rgb((i) => -Math.log(clamp(p.transmission_color[i], 1e-6, 1)) / depth - scattering[i]);
  const min = Math.min(...absorption, 0);
  return { extinction: rgb((i) => absorption[i] - min + scattering[i]), scattering, anisotropy };
}

/**
 * Index of refraction at a wavelength in nm: Cauchy's formula through `specular_ior` at 587.6 nm; twin of
 * `openpbr_dispersed_ior`. Evaluate the surface with it in the place of `specular_ior`.
 */
export function dispersedIor(p: OpenPbrParameters, wavelength: number): number {
  const slope =
    ((p.specular_ior - 1) * p.transmission_dispersion_scale) / Math.max(p.transmission_dispersion_abbe_number, 1e-3);
  return Math.max(p.specular_ior + (slope * (wavelength ** -2 - 587.6 ** -2)) / (486.1 ** -2 - 656.3 ** -2), 1e-3);
}

/**
 * Henyey and Greenstein's phase function; twin of `openpbr_phase_eval`. Directions point away from the place of
 * scattering.
 */
export const phaseEval = (g: number, wo: OpenPbrVector, wi: OpenPbrVector): number =>
  (1 - g * g) / (4 * Math.PI * (1 + g * g + 2 * g * dot(wo, wi)) ** 1.5);

/** A direction with the density of {@link phaseEval}; twin of `openpbr_phase_sample`. */
export function phaseSample(g: number, wo: OpenPbrVector, u: readonly [number, number]): OpenPbrVector {
  const x = 1 - 2 * u[1];
  const c = clamp(Math.abs(g) < 1e-6 ? x : (1 + g * g - ((1 - g * g) / (1 + g * x)) ** 2) / (2 * g), -1, 1);
  const s = Math.sqrt(1 - c * c);
  const side = wo[2] >= 0 ? 1 : -1;
  const a = -1 / (side + wo[2]);
  const b = wo[0] * wo[1] * a;
  const [x0, y0] = [s * Math.cos(2 * Math.PI * u[0]), s * Math.sin(2 * Math.PI * u[0])];
  return [
    x0 * (1 + side * wo[0] * wo[0] * a) + y0 * b - c * wo[0],
    x0 * side * b + y0 * (side + wo[1] * wo[1] * a) - c * wo[1],
    -x0 * side * wo[0] - y0 * wo[1] - c * wo[2],
  ];
}
