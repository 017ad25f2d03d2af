import type { OpenPbrColor, OpenPbrParameters } from '../parameters/index';

/** Transmittances below this are taken as this, as the renderer's medium does: their logarithm must be finite. */
const DARKEST = 1e-6;

/**
 * The interior whose extinction leaves `transmittance` after `depth`, and which scatters the part `albedo` of what it
 * takes away. OpenPBR 1.1.1 has no albedo: `transmission_scatter` is the scattering coefficient times
 * `transmission_depth`, in 0..1. Where it would exceed 1, a shorter depth with a lighter colour says the same.
 *
 * @param depth Positive.
 */
export function mediumOfAlbedo(
  transmittance: OpenPbrColor,
  depth: number,
  albedo: OpenPbrColor,
): Pick<OpenPbrParameters, 'transmission_color' | 'transmission_depth' | 'transmission_scatter'> {
  const of = (value: (channel: 0 | 1 | 2) => number): OpenPbrColor => [value(0), value(1), value(2)];
  const lost = of((i) => -Math.log(Math.min(Math.max(transmittance[i], DARKEST), 1)));
  const scattered = of((i) => albedo[i] * lost[i]);
  const shorter = Math.max(1, ...scattered);
  return {
    transmission_color: shorter === 1 ? transmittance : of((i) => Math.exp(-lost[i] / shorter)),
    transmission_depth: depth / shorter,
    transmission_scatter: of((i) => scattered[i] / shorter),
  };
}
