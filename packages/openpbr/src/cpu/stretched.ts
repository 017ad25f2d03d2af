import type { OpenPbrVector } from '../parameters/index';
import { fresnelDielectric } from './fresnel';
import { ggxMasking, ggxMaskingShadowing, ggxSample, type Slopes } from './ggx';
import { clamp, dot } from './vector';

/**
 * The parts of the light that a dielectric with a stretched highlight reflects and lets through by single scattering, seen
 * from `wo`: a sum over 64 facets; twin of `openpbr_stretched`, which says how good it is.
 *
 * @param eta Index of the far side over that of the viewer's.
 */
export function stretchedEnergy(eta: number, alpha: Slopes, wo: OpenPbrVector): readonly [reflected: number, through: number] {
  const turn = Math.atan2(alpha[1] * wo[1], alpha[0] * wo[0]) / (2 * Math.PI);
  const facet = (x: number, y: number) => {
    const u = clamp(y, 0.002, 0.998);
    return ggxSample(alpha, wo, [turn + x, u * u * (3 - 2 * u)]);
  };
  const fresnel = (h: OpenPbrVector) => fresnelDielectric(eta, clamp(dot(wo, h), 0, 1));
  let up = 0;
  let down = 0;
  for (let i = 0; i < 64; i++) {
    const x = i * 0.618034;
    const y = (i + 0.5) / 64;
    const h = facet(x, y);
    const c = clamp(dot(wo, h), 0, 1);
    let reflectance = fresnel(h);
    // From inside the critical angle is an edge: the facet stands for its surroundings.
    if (eta < 1) reflectance = (fresnel(facet(x - 0.034375, y - 0.01375)) + fresnel(facet(x + 0.01375, y - 0.034375)) + fresnel(facet(x + 0.034375, y + 0.01375)) + fresnel(facet(x - 0.01375, y + 0.034375))) / 4;
    const along = c / eta - Math.sqrt(Math.max(1 - (1 - c * c) / (eta * eta), 1e-6));
    const mirrored: OpenPbrVector = [2 * c * h[0] - wo[0], 2 * c * h[1] - wo[1], 2 * c * h[2] - wo[2]];
    const refracted: OpenPbrVector = [along * h[0] - wo[0] / eta, along * h[1] - wo[1] / eta, along * h[2] - wo[2] / eta];
    const weight = 0.09375 * y * (1 - y);
    if (mirrored[2] > 0) up += (weight * reflectance * ggxMaskingShadowing(alpha, wo, mirrored)) / ggxMasking(alpha, wo);
    if (refracted[2] < 0) down += weight * (1 - reflectance) * ggxMasking(alpha, [refracted[0], refracted[1], -refracted[2]]);
  }
  return [up, down];
}
