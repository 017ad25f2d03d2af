import type { OpenPbrVector } from '../parameters/index';
import { seenFacets, type Conic } from './conic';
import { energyLost } from './energy';
import { fresnelDielectric } from './fresnel';
import { ggxMasking, ggxMaskingShadowing, type Slopes } from './ggx';
import { clamp, dot } from './vector';

/** The parts of the light that single scattering reflects and lets through. */
export type Kept = readonly [reflected: number, through: number];

/** The visible parts of what the facet `h` reflects and refracts; 0 or less where it does not. */
export function facetSeen(eta: number, alpha: Slopes, wo: OpenPbrVector, h: OpenPbrVector): Kept {
  const c = clamp(dot(wo, h), 0, 1);
  const along = c / eta - Math.sqrt(Math.max(1 - (1 - c * c) / (eta * eta), 1e-6));
  const mirrored: OpenPbrVector = [2 * c * h[0] - wo[0], 2 * c * h[1] - wo[1], 2 * c * h[2] - wo[2]];
  const refracted: OpenPbrVector = [along * h[0] - wo[0] / eta, along * h[1] - wo[1] / eta, along * h[2] - wo[2] / eta];
  return [
    mirrored[2] > 0 ? ggxMaskingShadowing(alpha, wo, mirrored) / ggxMasking(alpha, wo) : 0,
    refracted[2] < 0 ? ggxMasking(alpha, [refracted[0], refracted[1], -refracted[2]]) : 0,
  ];
}

/**
 * The parts of the light that a dielectric seen from its denser side reflects and lets through by single scattering;
 * twin of `openpbr_inside`, which says how it is summed and how good it is.
 *
 * @param eta Index of the far side over that of the viewer's, below 1.
 * @param given Unit direction to the viewer in the local frame; below cosine 1e-5 taken as of that.
 */
export function insideEnergy(eta: number, alpha: Slopes, given: OpenPbrVector): Kept {
  const wo: OpenPbrVector = [given[0], given[1], Math.max(given[2], 1e-5)];
  // Directions are bent by a least step of the index (see prepareTransmission).
  const bend = eta > 0.9990005 ? 1.0010005 : eta;
  const { flat, upwards, sum } = seenFacets(alpha, wo);
  const critical = 1 / ((1 - eta) * (1 + eta));
  const passing: Conic = [flat * critical, wo[2] * critical];
  const transmittance = (h: OpenPbrVector): number => 1 - fresnelDielectric(eta, clamp(dot(wo, h), 0, 1));

  // What mirrors would reflect: tabulated where the highlight is round.
  let reflected = 0;
  if (alpha[0] > alpha[1])
    sum(64, upwards, upwards, (weight, h) => (reflected += weight * facetSeen(bend, alpha, wo, h)[0]));
  else reflected = 1 - energyLost(Math.sqrt(alpha[0]), wo[2]);
  let through = 0;
  sum(48, passing, passing, (weight, h) => (through += weight * transmittance(h) * facetSeen(bend, alpha, wo, h)[1]));
  sum(48, passing, upwards, (weight, h) => (reflected -= weight * transmittance(h) * facetSeen(bend, alpha, wo, h)[0]));
  return [Math.max(reflected, 0), through];
}
