import type { OpenPbrVector } from '../parameters/index';
import { fresnelDielectric } from './fresnel';
import { ggxSample, type Slopes } from './ggx';
import { facetSeen, insideEnergy, type Kept } from './inside';
import { clamp, dot } from './vector';

/**
 * The parts of the light that a dielectric with a stretched highlight reflects and lets through by single scattering, seen
 * from `wo`; twin of `openpbr_stretched`, which says how good it is.
 *
 * @param eta Index of the far side over that of the viewer's.
 */
export const stretchedEnergy = (eta: number, alpha: Slopes, wo: OpenPbrVector): Kept => (eta < 1 ? insideEnergy(eta, alpha, wo) : fromOutside(eta, alpha, wo));

/** A sum over 64 facets. */
function fromOutside(eta: number, alpha: Slopes, wo: OpenPbrVector): Kept {
  const turn = Math.atan2(alpha[1] * wo[1], alpha[0] * wo[0]) / (2 * Math.PI);
  let reflected = 0;
  let through = 0;
  for (let i = 0; i < 64; i++) {
    const y = (i + 0.5) / 64;
    const u = clamp(y, 0.002, 0.998);
    const h = ggxSample(alpha, wo, [turn + i * 0.618034, u * u * (3 - 2 * u)]);
    const [up, down] = facetSeen(eta, alpha, wo, h);
    const reflectance = fresnelDielectric(eta, clamp(dot(wo, h), 0, 1));
    const weight = 0.09375 * y * (1 - y);
    reflected += weight * reflectance * up;
    through += weight * (1 - reflectance) * down;
  }
  return [reflected, through];
}
