import type { OpenPbrColor } from '../parameters/index';

/**
 * Mean free paths per channel as a radius and a scale up to 1, as `subsurface_radius` and `subsurface_radius_scale`
 * are: converted colours may lie outside, lengths below 0 are 0.
 */
export function scatteringRadius(
  radius: number,
  scale: OpenPbrColor,
): { readonly radius: number; readonly scale: OpenPbrColor } {
  const longest = Math.max(...scale, 1);
  return { radius: radius * longest, scale: scale.map((c) => Math.max(c, 0) / longest) as unknown as OpenPbrColor };
}
