import type { OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { energyBounce, energyAlbedo, energyTotalLost } from './energy';
import { isSmooth, viewRoughness, type Slopes } from './ggx';
import { insideEnergy } from './inside';
import { anisotropicEnergy } from './anisotropic';
import { OPENPBR_INSIDE_NEAR } from '../tables/constants.wesl';

/** What an interface does with the light towards a viewer; see the WGSL struct `OpenPbrDielectric`. */
export interface InterfaceEnergy {
  /** Directional albedo of its reflection, by all scattering. */
  readonly albedo: number;
  /** What multiple scattering adds to it, and to the rest. */
  readonly multiscatter: number;
  readonly multiscatterThrough: number;
}

/**
 * Whether the interface's albedos from its denser side are summed over facets: where something opaque lies below it,
 * and near index 1. Elsewhere the tables are exact enough, since the albedo decides only how samples are chosen.
 */
export const isSummed = (p: OpenPbrParameters, epsilon: number): boolean =>
  epsilon < 0 && (epsilon > -OPENPBR_INSIDE_NEAR || isOverOpaque(p));

/** Whether something opaque lies below the interface. */
export const isOverOpaque = (p: OpenPbrParameters): boolean =>
  (1 - p.transmission_weight) * (p.geometry_thin_walled ? 1 : 1 - p.subsurface_weight) > 0;

/**
 * Of an interface with (η - 1)/(η + 1) = `epsilon`; the twin of `openpbr_interface_energy`.
 *
 * @param summed From {@link isSummed}.
 */
export function interfaceEnergy(
  epsilon: number,
  roughness: number,
  alpha: Slopes,
  wo: OpenPbrVector,
  mu: number,
  summed: boolean,
  multipleScattering: boolean,
): InterfaceEnergy {
  const eta = (1 + epsilon) / (1 - epsilon);
  const kept = summed
    ? insideEnergy(eta, alpha, wo)
    : multipleScattering && alpha[0] > alpha[1]
      ? anisotropicEnergy(eta, alpha, wo)
      : undefined;
  const bounce = energyBounce(epsilon, roughness);
  // Nothing is lost between the facets of a delta.
  const tabulated = isSmooth(alpha) ? 0 : energyTotalLost(epsilon, roughness, mu);
  const lost = Math.max(kept ? 1 - kept[0] - kept[1] : tabulated, 0);
  const albedo = kept
    ? Math.min(kept[0] + lost * bounce, 1)
    : energyAlbedo(epsilon, viewRoughness(alpha, roughness, wo), mu);
  if (!multipleScattering) return { albedo, multiscatter: 0, multiscatterThrough: 0 };
  const multiscatter = lost * bounce;
  return { albedo, multiscatter, multiscatterThrough: lost - multiscatter };
}

/**
 * Directional albedo of an interface for light from `wi`, the same as {@link interfaceEnergy} has for a viewer there,
 * so that the lobes below it are reciprocal; for anisotropic highlights, that of the tables. Twin of
 * `openpbr_interface_albedo`.
 */
export function interfaceAlbedo(
  { epsilon, summed, roughness }: { readonly epsilon: number; readonly summed: boolean; readonly roughness: number },
  alpha: Slopes,
  wi: OpenPbrVector,
): number {
  if (summed) return interfaceEnergy(epsilon, roughness, alpha, wi, wi[2], true, false).albedo;
  return energyAlbedo(epsilon, viewRoughness(alpha, roughness, wi), wi[2]);
}
