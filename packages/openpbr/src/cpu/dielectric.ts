import type { OpenPbrVector } from '../parameters/index';
import { energyBounce, energyShare, energyTotal } from './energy';
import { viewRoughness, type Slopes } from './ggx';
import { stretchedEnergy } from './stretched';

/** What an interface does with the light towards a viewer; see the WGSL struct `OpenPbrDielectric`. */
export interface InterfaceEnergy {
  /** The part that is reflected, by all scattering. */
  readonly share: number;
  /** What multiple scattering adds to it, and to the rest. */
  readonly bounced: number;
  readonly bouncedThrough: number;
}

/** Of an interface with (η - 1)/(η + 1) = `epsilon`; the twin of `openpbr_dielectric_prepare`'s energies. */
export function interfaceEnergy(epsilon: number, roughness: number, alpha: Slopes, wo: OpenPbrVector, mu: number, multipleScattering: boolean): InterfaceEnergy {
  const share = energyShare(epsilon, viewRoughness(alpha, roughness, wo), mu);
  if (!multipleScattering) return { share, bounced: 0, bouncedThrough: 0 };
  const bounce = energyBounce(epsilon, roughness);
  const stretched = alpha[0] > alpha[1] ? stretchedEnergy((1 + epsilon) / (1 - epsilon), alpha, wo) : undefined;
  const lost = Math.max(1 - (stretched ? stretched[0] + stretched[1] : energyTotal(epsilon, roughness, mu)), 0);
  const bounced = lost * bounce;
  return { share: stretched ? Math.min(stretched[0] + bounced, 1) : share, bounced, bouncedThrough: lost - bounced };
}
