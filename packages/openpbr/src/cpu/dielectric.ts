import type { OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { energyBounce, energyShare, energyTotalLost } from './energy';
import { ggxAlpha, viewRoughness, type Slopes } from './ggx';
import { insideEnergy } from './inside';
import { stretchedEnergy } from './stretched';
import { OPENPBR_INSIDE_NEAR } from '../tables/constants.wesl';
import { OPENPBR_INNER_SUM_NODES } from '../tables/inner_nodes.wesl';

/** What an interface does with the light towards a viewer; see the WGSL struct `OpenPbrDielectric`. */
export interface InterfaceEnergy {
  /** The part that is reflected, by all scattering. */
  readonly share: number;
  /** What multiple scattering adds to it, and to the rest. */
  readonly bounced: number;
  readonly bouncedThrough: number;
}

/**
 * Whether the interface's energies from its denser side are summed over facets: where something lies below it, and near
 * index
 * 1. For what is clear alone the tables do, since nothing but the choice of samples hangs on its share.
 */
export const isSummed = (p: OpenPbrParameters, epsilon: number): boolean =>
  epsilon < 0 && (epsilon > -OPENPBR_INSIDE_NEAR || isOverOpaque(p));

/** Whether something opaque lies below the interface. */
export const isOverOpaque = (p: OpenPbrParameters): boolean =>
  (1 - p.transmission_weight) * (p.geometry_thin_walled ? 1 : 1 - p.subsurface_weight) > 0;

/** The cosine-weighted mean of the summed share over all directions, with a round highlight. */
function sumShareMean(epsilon: number, roughness: number): number {
  const eta = (1 + epsilon) / (1 - epsilon);
  const critical = Math.sqrt(Math.max(1 - eta * eta, 0));
  const alpha = ggxAlpha(roughness, 0);
  let through = 0;
  for (const [x, weight] of OPENPBR_INNER_SUM_NODES) {
    for (const [mu, step] of [
      [critical * (1 - x * x), critical],
      [critical + (1 - critical) * x * x, 1 - critical],
    ] as const) {
      const wo: OpenPbrVector = [Math.sqrt(Math.max(1 - mu * mu, 0)), 0, mu];
      through += (1 - interfaceEnergy(epsilon, roughness, alpha, wo, mu, true, false).share) * mu * step * x * weight;
    }
  }
  return 1 - 4 * through;
}

const remembered = { epsilon: 0, roughness: 0, mean: 0 };

/** {@link sumShareMean}; remembered for the last interface, for one is mostly looked at from many sides. */
export function summedShareMean(epsilon: number, roughness: number): number {
  if (remembered.epsilon !== epsilon || remembered.roughness !== roughness)
    Object.assign(remembered, { epsilon, roughness, mean: sumShareMean(epsilon, roughness) });
  return remembered.mean;
}

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
      ? stretchedEnergy(eta, alpha, wo)
      : undefined;
  const bounce = energyBounce(epsilon, roughness);
  const lost = Math.max(kept ? 1 - kept[0] - kept[1] : energyTotalLost(epsilon, roughness, mu), 0);
  const share = kept
    ? Math.min(kept[0] + lost * bounce, 1)
    : energyShare(epsilon, viewRoughness(alpha, roughness, wo), mu);
  if (!multipleScattering) return { share, bounced: 0, bouncedThrough: 0 };
  const bounced = lost * bounce;
  return { share, bounced, bouncedThrough: lost - bounced };
}

/**
 * Share of light from `wi` that an interface reflects, as {@link interfaceEnergy} has it for a viewer there, so that
 * what goes down and comes up again is the same both ways; but for stretched highlights, where it is that of the
 * tables. Twin of `openpbr_light_share`.
 */
export function lightShare(
  { epsilon, summed, roughness }: { readonly epsilon: number; readonly summed: boolean; readonly roughness: number },
  alpha: Slopes,
  wi: OpenPbrVector,
): number {
  if (summed) return interfaceEnergy(epsilon, roughness, alpha, wi, wi[2], true, false).share;
  return energyShare(epsilon, viewRoughness(alpha, roughness, wi), wi[2]);
}
