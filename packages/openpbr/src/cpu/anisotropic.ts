import type { OpenPbrVector } from '../parameters/index';
import {
  OPENPBR_ANISOTROPIC_ENDS,
  OPENPBR_ANISOTROPIC_FACETS,
  OPENPBR_ANISOTROPIC_MILD,
  OPENPBR_ANISOTROPIC_MIRRORS,
} from '../tables/anisotropic_facets.wesl';
import { seenFacets } from './conic';
import { conductorLoss } from './energy';
import { fresnelDielectric } from './fresnel';
import { ggxRoughness, type Slopes } from './ggx';
import { facetSeen, insideEnergy, type Kept } from './inside';
import { clamp, dot, length2, normalize } from './vector';

/**
 * Albedos of reflection and transmission by single scattering of a dielectric with an anisotropic highlight, seen from
 * `wo`; twin of `openpbr_anisotropic`, whose comment states its error.
 *
 * @param eta Index of the far side over that of the viewer's.
 */
export const anisotropicEnergy = (eta: number, alpha: Slopes, wo: OpenPbrVector): Kept =>
  eta < 1 ? insideEnergy(eta, alpha, wo) : fromOutside(eta, alpha, wo);

type Facet = readonly [place: number, across: number, weight: number];

/** The facets for such slopes, of the table whose ends start at `at`. */
function facetsFor(alpha: Slopes, facets: readonly Facet[], at: 0 | 2): readonly Facet[] {
  const any = OPENPBR_ANISOTROPIC_ENDS[at];
  if (alpha[1] < Math.fround(OPENPBR_ANISOTROPIC_MILD) * alpha[0]) return facets.slice(0, any);
  return facets.slice(any, OPENPBR_ANISOTROPIC_ENDS[at + 1]);
}

/** Reflection is the mean over facets that reflect upwards, since it has an edge, times what mirrors reflect. */
function fromOutside(eta: number, alpha: Slopes, given: OpenPbrVector): Kept {
  const wo: OpenPbrVector = [given[0], given[1], Math.max(given[2], 1e-5)];
  const { upwards, sumOver } = seenFacets(alpha, wo);
  const reflectance = (h: OpenPbrVector): number => fresnelDielectric(eta, clamp(dot(wo, h), 0, 1));
  let reflected = 0;
  let mirrored = 1e-20;
  const mirrors = facetsFor(alpha, OPENPBR_ANISOTROPIC_MIRRORS, 0);
  sumOver(mirrors, upwards, upwards, (weight, h) => {
    const mirror = weight * Math.max(facetSeen(eta, alpha, wo, h)[0], 0);
    reflected += mirror * reflectance(h);
    mirrored += mirror;
  });
  const kept = 1 - conductorLoss(alpha, ggxRoughness(alpha), wo, wo[2]);
  return [(reflected / mirrored) * kept, transmitted(eta, alpha, wo, reflectance)];
}

/**
 * The mean over all visible facets: cos χ (sin ψ p̂ + cos ψ ẑ) + sin χ q̂ where they are stretched to a round highlight, p̂
 * towards the view. By sin (ψ - ψ of the view) and tan χ; the weights add up to 1.
 */
function transmitted(eta: number, alpha: Slopes, wo: OpenPbrVector, reflectance: (h: OpenPbrVector) => number): number {
  const flat = [alpha[0] * wo[0], alpha[1] * wo[1]] as const;
  const tilt = Math.atan2(length2(...flat), wo[2]);
  const azimuth = length2(...flat) > 1e-10 ? Math.atan2(flat[1], flat[0]) : 0;
  const [cos, sin] = [Math.cos(azimuth), Math.sin(azimuth)];
  let through = 0;
  const facets = facetsFor(alpha, OPENPBR_ANISOTROPIC_FACETS, 2);
  for (const [place, across, weight] of facets) {
    const psi = tilt + Math.asin(clamp((1 + Math.cos(tilt)) * place - 1, -1, 1));
    const chi = Math.atan(across);
    const along = Math.cos(chi) * Math.sin(psi);
    const h = normalize([
      alpha[0] * (along * cos - Math.sin(chi) * sin),
      alpha[1] * (along * sin + Math.sin(chi) * cos),
      Math.max(Math.cos(chi) * Math.cos(psi), 0),
    ]);
    through += weight * (1 - reflectance(h)) * facetSeen(eta, alpha, wo, h)[1];
  }
  return through;
}
