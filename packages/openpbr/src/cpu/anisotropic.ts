import type { OpenPbrVector } from '../parameters/index';
import {
  OPENPBR_ANISOTROPIC_AROUND,
  OPENPBR_ANISOTROPIC_HEIGHTS,
  OPENPBR_ANISOTROPIC_MIRRORS,
} from '../tables/anisotropic_facets.wesl';
import { seenFacets } from './conic';
import { fresnelDielectric } from './fresnel';
import { ggxSample, type Slopes } from './ggx';
import { facetSeen, insideEnergy, type Kept } from './inside';
import { clamp, dot } from './vector';

/**
 * Albedos of reflection and transmission by single scattering of a dielectric with an anisotropic highlight, seen from
 * `wo`; twin of `openpbr_anisotropic`, whose comment states its error.
 *
 * @param eta Index of the far side over that of the viewer's.
 */
export const anisotropicEnergy = (eta: number, alpha: Slopes, wo: OpenPbrVector): Kept =>
  eta < 1 ? insideEnergy(eta, alpha, wo) : fromOutside(eta, alpha, wo);

/**
 * Reflection is summed over the facets that reflect upwards, since it has an edge; transmission, which has none, over
 * the whole cap.
 */
function fromOutside(eta: number, alpha: Slopes, given: OpenPbrVector): Kept {
  const wo: OpenPbrVector = [given[0], given[1], Math.max(given[2], 1e-5)];
  const { upwards, sum } = seenFacets(alpha, wo);
  const reflectance = (h: OpenPbrVector): number => fresnelDielectric(eta, clamp(dot(wo, h), 0, 1));
  let reflected = 0;
  sum(
    OPENPBR_ANISOTROPIC_MIRRORS,
    upwards,
    upwards,
    (weight, h) => (reflected += weight * reflectance(h) * Math.max(facetSeen(eta, alpha, wo, h)[0], 0)),
  );
  const turn = Math.atan2(alpha[1] * wo[1], alpha[0] * wo[0]) / (2 * Math.PI);
  let through = 0;
  OPENPBR_ANISOTROPIC_HEIGHTS.forEach(([height, weight], k) => {
    for (let i = 0; i < OPENPBR_ANISOTROPIC_AROUND; i++) {
      const h = ggxSample(alpha, wo, [turn + (i + 0.382 * k) / OPENPBR_ANISOTROPIC_AROUND, height]);
      through += weight * (1 - reflectance(h)) * facetSeen(eta, alpha, wo, h)[1];
    }
  });
  return [reflected, through];
}
