import type { OpenPbrVector } from '../parameters/index';
import { STRETCHED_AROUND, STRETCHED_HEIGHTS, STRETCHED_MIRRORS } from '../tables/layout';
import { seenFacets } from './conic';
import { fresnelDielectric } from './fresnel';
import { ggxSample, type Slopes } from './ggx';
import { facetSeen, insideEnergy, type Kept } from './inside';
import { clamp, dot } from './vector';

/**
 * The parts of the light that a dielectric with a stretched highlight reflects and lets through by single scattering,
 * seen from `wo`; twin of `openpbr_stretched`, which says how good it is.
 *
 * @param eta Index of the far side over that of the viewer's.
 */
export const stretchedEnergy = (eta: number, alpha: Slopes, wo: OpenPbrVector): Kept =>
  eta < 1 ? insideEnergy(eta, alpha, wo) : fromOutside(eta, alpha, wo);

/**
 * What is reflected over the facets that mirror upwards, since that has an edge; what passes, which has none, over the
 * whole cap.
 */
function fromOutside(eta: number, alpha: Slopes, given: OpenPbrVector): Kept {
  const wo: OpenPbrVector = [given[0], given[1], Math.max(given[2], 1e-5)];
  const { upwards, sum } = seenFacets(alpha, wo);
  const reflectance = (h: OpenPbrVector): number => fresnelDielectric(eta, clamp(dot(wo, h), 0, 1));
  let reflected = 0;
  sum(
    STRETCHED_MIRRORS,
    upwards,
    upwards,
    (weight, h) => (reflected += weight * reflectance(h) * Math.max(facetSeen(eta, alpha, wo, h)[0], 0)),
  );
  const turn = Math.atan2(alpha[1] * wo[1], alpha[0] * wo[0]) / (2 * Math.PI);
  let through = 0;
  STRETCHED_HEIGHTS.forEach(([height, weight], k) => {
    for (let i = 0; i < STRETCHED_AROUND; i++) {
      const h = ggxSample(alpha, wo, [turn + (i + 0.382 * k) / STRETCHED_AROUND, height]);
      through += (weight / STRETCHED_AROUND) * (1 - reflectance(h)) * facetSeen(eta, alpha, wo, h)[1];
    }
  });
  return [reflected, through];
}
