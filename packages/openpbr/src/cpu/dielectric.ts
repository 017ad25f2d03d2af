import type { OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { energyBounce, energyShare, energyTotal } from './energy';
import { viewRoughness, type Slopes } from './ggx';
import { insideEnergy } from './inside';
import { stretchedEnergy } from './stretched';
import { INSIDE_NEAR } from '../tables/layout';

/** What an interface does with the light towards a viewer; see the WGSL struct `OpenPbrDielectric`. */
export interface InterfaceEnergy {
  /** The part that is reflected, by all scattering. */
  readonly share: number;
  /** What multiple scattering adds to it, and to the rest. */
  readonly bounced: number;
  readonly bouncedThrough: number;
}

/**
 * Whether the interface's energies from its denser side are summed over facets: where something lies below it, and near index
 * 1. For what is clear alone the tables do, since nothing but the choice of samples hangs on its share.
 */
export const isSummed = (p: OpenPbrParameters, epsilon: number): boolean =>
  epsilon < 0 && (epsilon > -INSIDE_NEAR || (1 - p.transmission_weight) * (p.geometry_thin_walled ? 1 : 1 - p.subsurface_weight) > 0);

/**
 * Of an interface with (η - 1)/(η + 1) = `epsilon`; the twin of `openpbr_interface_energy`.
 *
 * @param summed From {@link isSummed}.
 */
export function interfaceEnergy(epsilon: number, roughness: number, alpha: Slopes, wo: OpenPbrVector, mu: number, summed: boolean, multipleScattering: boolean): InterfaceEnergy {
  const eta = (1 + epsilon) / (1 - epsilon);
  const kept = summed ? insideEnergy(eta, alpha, wo) : multipleScattering && alpha[0] > alpha[1] ? stretchedEnergy(eta, alpha, wo) : undefined;
  const bounce = energyBounce(epsilon, roughness);
  const lost = Math.max(1 - (kept ? kept[0] + kept[1] : energyTotal(epsilon, roughness, mu)), 0);
  const share = kept ? Math.min(kept[0] + lost * bounce, 1) : energyShare(epsilon, viewRoughness(alpha, roughness, wo), mu);
  if (!multipleScattering) return { share, bounced: 0, bouncedThrough: 0 };
  const bounced = lost * bounce;
  return { share, bounced, bouncedThrough: lost - bounced };
}
