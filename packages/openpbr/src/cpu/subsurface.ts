import type { OpenPbrColor, OpenPbrParameters } from '../parameters/index';
import { fresnelMean } from './energy';
import { dielectricEpsilon } from './fresnel';
import type { Medium } from './medium';
import { clamp, rgb } from './vector';

/** The medium below a translucent surface; twin of `openpbr_subsurface_medium`. Zero for thin walls. */
export function subsurfaceMedium(p: OpenPbrParameters): Medium {
  const g = clamp(p.subsurface_scatter_anisotropy, -0.999, 0.999);
  if (p.geometry_thin_walled) return { extinction: [0, 0, 0], scattering: [0, 0, 0], anisotropy: g };
  const extinction = rgb((i) => 1 / Math.max(p.subsurface_radius * p.subsurface_radius_scale[i], 1e-6));
  const kept = fresnelMean(-dielectricEpsilon(p.specular_ior, p.specular_weight));
  return {
    extinction,
    scattering: rgb((i) => extinction[i] * subsurfaceAlbedo(p.subsurface_color[i], g, kept)),
    anisotropy: g,
  };
}

/**
 * Single-scattering albedo of a half space whose diffuse albedo is `color`.
 *
 * @param g Mean cosine of scattering.
 * @param kept Fraction of diffuse light that the interface reflects back inside.
 */
export function subsurfaceAlbedo(color: number, g: number, kept: number): number {
  const limited = clamp(color, 0, 1);
  const c = limited / (1 - kept + kept * limited);
  const s = Math.max(4.09712 + 4.20863 * c - Math.sqrt(9.59217 + 41.6808 * c + 17.7126 * c * c), 0);
  return (1 - s * s) / (1 - g * s * s);
}

/** Paper: what lies below a thin wall; twin of the WGSL struct `OpenPbrThinSubsurface`. */
export interface ThinSubsurface {
  readonly color: OpenPbrColor;
  /** Shares that go back and through. */
  readonly back: number;
  readonly through: number;
}

/** Twin of `openpbr_thin_subsurface_prepare`; `weight` is the share of the light that passes the interface. */
export function prepareThinSubsurface(p: OpenPbrParameters, weight: number): ThinSubsurface {
  const share = p.geometry_thin_walled ? weight * (1 - p.transmission_weight) * p.subsurface_weight : 0;
  const g = clamp(p.subsurface_scatter_anisotropy, -1, 1);
  return { color: p.subsurface_color, back: share * (0.5 - 0.5 * g), through: share * (0.5 + 0.5 * g) };
}
