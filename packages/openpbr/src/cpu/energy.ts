import type { OpenPbrVector } from '../parameters/index';
import { OPENPBR_MIN_ROUGHNESS, OPENPBR_ANISOTROPIC_FLATS } from '../tables/constants.wesl';
import {
  ANISOTROPIC_VIEWS,
  TABLE_ANGLES,
  TABLE_BLOCKS,
  TABLE_CONDUCTOR,
  TABLE_DEPTH,
  TABLE_HEIGHT_2D,
  TABLE_ROUGHNESSES,
} from '../tables/layout';
import { OPENPBR_TABLES, type OpenPbrTable } from '../tables/tables';
import { fresnelDielectric } from './fresnel';
import { conductorCosine, isSmooth, type Slopes } from './ggx';
import { clamp, length2 } from './vector';

/** What a texture with linear filtering and clamping gives at `coords` in [0, 1]. */
export function tableLookup(table: OpenPbrTable, coords: readonly [number, number, number?]): number {
  const { width, height, depth, data } = table;
  const axis = (u: number, size: number): [low: number, high: number, weight: number] => {
    const at = clamp(u * size - 0.5, 0, size - 1);
    const low = Math.min(Math.floor(at), Math.max(size - 2, 0));
    return [low, Math.min(low + 1, size - 1), at - low];
  };
  const [x0, x1, fx] = axis(coords[0], width);
  const [y0, y1, fy] = axis(coords[1], height);
  const [z0, z1, fz] = axis(coords[2] ?? 0.5, depth);
  const at = (x: number, y: number, z: number) => data[(z * height + y) * width + x] as number;
  const plane = (z: number) =>
    (at(x0, y0, z) * (1 - fx) + at(x1, y0, z) * fx) * (1 - fy) + (at(x0, y1, z) * (1 - fx) + at(x1, y1, z) * fx) * fy;
  return plane(z0) * (1 - fz) + plane(z1) * fz;
}

const MIN_ROOT = Math.sqrt(OPENPBR_MIN_ROUGHNESS);
const texel = (u: number, first: number, count: number, size: number): number => (u * (count - 1) + 0.5 + first) / size;
const roughnessAxis = (r: number, count: number, size = count): number =>
  texel(clamp((Math.sqrt(r) - MIN_ROOT) / (1 - MIN_ROOT), 0, 1), 0, count, size);
const slice = (block: keyof typeof TABLE_BLOCKS, epsilon: number): number =>
  texel(Math.sqrt(Math.abs(epsilon)), TABLE_BLOCKS[block][0], TABLE_BLOCKS[block][1], TABLE_DEPTH);
const totalSlice = (epsilon: number): number =>
  epsilon >= 0
    ? texel(Math.cbrt(epsilon), TABLE_BLOCKS.outerTotal[0], TABLE_BLOCKS.outerTotal[1], TABLE_DEPTH)
    : slice('innerTotal', epsilon);
/** In the blocks of totals. */
const totalRoughness = (r: number): number =>
  texel(clamp((r - OPENPBR_MIN_ROUGHNESS) / (1 - OPENPBR_MIN_ROUGHNESS), 0, 1), 0, TABLE_ANGLES + 1, TABLE_ANGLES + 1);
const angleAxis = (t: number): number => texel(t, 0, TABLE_ANGLES, TABLE_ANGLES + 1);

function spread(r: number, mu: number): number {
  const x = Math.sqrt(mu);
  return (x * (1 + r)) / (x + r);
}

/** Where a cosine inside of the denser medium lies: the critical angle in the middle, and columns crowd around it. */
function innerPosition(eta: number, mu: number): number {
  const critical = Math.sqrt(1 - eta * eta);
  return mu > critical
    ? 0.5 + 0.5 * Math.sqrt((mu - critical) / (1 - critical))
    : (0.5 * Math.sqrt(mu)) / (Math.sqrt(mu) + Math.sqrt(critical - mu));
}

/** Cosine-weighted mean of the reflectance of a smooth interface, about; twin of `openpbr_fresnel_mean`. */
export function fresnelMean(epsilon: number): number {
  const e = Math.abs(epsilon);
  const mean = (2 * e) / (5.0864 - 3.085 * e);
  return epsilon >= 0 ? mean : 1 - ((1 - e) / (1 + e)) ** 2 * (1 - mean);
}

/** Energy that a perfect mirror of the given roughness loses by single scattering; twin of `openpbr_energy_lost`. */
export function energyLost(roughness: number, mu: number): number {
  const r = Math.max(roughness, OPENPBR_MIN_ROUGHNESS);
  return tableLookup(OPENPBR_TABLES.conductor, [
    texel(spread(r, mu), 0, TABLE_CONDUCTOR, TABLE_CONDUCTOR + 1),
    roughnessAxis(r, TABLE_CONDUCTOR, TABLE_HEIGHT_2D),
  ]);
}

/** The cosine-weighted mean of {@link energyLost} over all directions; twin of `openpbr_energy_lost_mean`. */
export function energyLostMean(roughness: number): number {
  const r = Math.max(roughness, OPENPBR_MIN_ROUGHNESS);
  return (
    r ** 3 *
    tableLookup(OPENPBR_TABLES.conductor, [
      (TABLE_CONDUCTOR + 0.5) / (TABLE_CONDUCTOR + 1),
      roughnessAxis(r, TABLE_CONDUCTOR, TABLE_HEIGHT_2D),
    ])
  );
}

/**
 * What an anisotropic mirror keeps more than a round one of the same masking, and in the last column how much less of
 * the round one's mean it loses; twin of `openpbr_energy_anisotropic`.
 *
 * @param x The table's column.
 * @param along Where the slope along the view lies, as a coordinate.
 */
function anisotropicMore(alpha: Slopes, roughness: number, x: number, along: number): number {
  const flat = (1 - alpha[1] / alpha[0]) * OPENPBR_ANISOTROPIC_FLATS;
  const block = Math.min(Math.floor(flat), OPENPBR_ANISOTROPIC_FLATS - 1);
  const z = texel(
    clamp((roughness - OPENPBR_MIN_ROUGHNESS) / (1 - OPENPBR_MIN_ROUGHNESS), 0, 1),
    TABLE_BLOCKS.anisotropic[0],
    TABLE_BLOCKS.anisotropic[1],
    TABLE_DEPTH,
  );
  const at = (k: number) =>
    k < 0
      ? 0
      : tableLookup(OPENPBR_TABLES.dielectric, [
          x,
          texel(along, k * ANISOTROPIC_VIEWS, ANISOTROPIC_VIEWS, TABLE_ROUGHNESSES),
          z,
        ]);
  return at(block - 1) * (1 - flat + block) + at(block) * (flat - block);
}

/**
 * Energy that a perfect mirror loses by single scattering towards `w`, of cosine `mu`; twin of
 * `openpbr_conductor_loss`.
 */
export function conductorLoss(alpha: Slopes, roughness: number, w: OpenPbrVector, mu: number): number {
  if (isSmooth(alpha)) return 0;
  const cosine = conductorCosine(alpha, w, mu);
  const lost = energyLost(roughness, cosine);
  if (alpha[0] <= alpha[1]) return lost;
  const slope = clamp(
    length2(alpha[0] * w[0], alpha[1] * w[1]) / Math.max(length2(w[0], w[1]), 1e-20),
    alpha[1],
    alpha[0],
  );
  const along = (alpha[1] * (alpha[0] - slope)) / (slope * (alpha[0] - alpha[1]));
  // Angles crowd towards the normal.
  const t = 1 - Math.max(1 - spread(Math.max(roughness, OPENPBR_MIN_ROUGHNESS), cosine), 0) ** 0.75;
  return Math.max(lost - anisotropicMore(alpha, roughness, angleAxis(t), along), 0);
}

/** The cosine-weighted mean of {@link conductorLoss} over all directions; twin of `openpbr_conductor_loss_mean`. */
export function conductorLossMean(alpha: Slopes, roughness: number): number {
  const lost = energyLostMean(roughness);
  return alpha[0] > alpha[1]
    ? lost * (1 - anisotropicMore(alpha, roughness, (TABLE_ANGLES + 0.5) / (TABLE_ANGLES + 1), 0))
    : lost;
}

/**
 * Share of the energy that an interface reflects by all scattering, the rest being refracted; twin of
 * `openpbr_energy_albedo`.
 */
export function energyAlbedo(epsilon: number, roughness: number, mu: number): number {
  if (epsilon === 0) return 0;
  const r = Math.max(roughness, OPENPBR_MIN_ROUGHNESS);
  const eta = (1 + epsilon) / (1 - epsilon);
  const y = roughnessAxis(r, TABLE_ROUGHNESSES);
  if (epsilon > 0) {
    const fresnel = fresnelDielectric(eta, mu + 0.8 * r * r * (1 - mu));
    return Math.min(
      fresnel * tableLookup(OPENPBR_TABLES.dielectric, [angleAxis(spread(r, mu)), y, slice('outer', epsilon)]),
      1,
    );
  }
  const split = Math.min(
    tableLookup(OPENPBR_TABLES.dielectric, [angleAxis(innerPosition(eta, mu)), y, slice('inner', epsilon)]),
    1,
  );
  const lost = energyTotalLost(epsilon, roughness, mu);
  return split * (1 - lost) + lost * energyBounce(epsilon, roughness);
}

/**
 * The cosine-weighted mean of {@link energyAlbedo} over all directions; from inside, of the albedo that is summed over
 * facets, within 0.5 % of what goes through for indices to 1.6 and 1.3 % to 3. Twin of `openpbr_energy_albedo_mean`.
 */
export function energyAlbedoMean(epsilon: number, roughness: number): number {
  if (epsilon === 0) return 0;
  const r = Math.max(roughness, OPENPBR_MIN_ROUGHNESS);
  const y = roughnessAxis(r, TABLE_ROUGHNESSES);
  if (epsilon < 0) {
    const eta = (1 + epsilon) / (1 - epsilon);
    const through = tableLookup(OPENPBR_TABLES.dielectric, [
      (TABLE_ANGLES + 0.5) / (TABLE_ANGLES + 1),
      y,
      slice('inner', epsilon),
    ]);
    return 1 - Math.min(eta ** (2 - r) * through, 1);
  }
  return (
    1 -
    Math.min(
      (1 - fresnelMean(epsilon)) *
        tableLookup(OPENPBR_TABLES.dielectric, [(TABLE_ANGLES + 0.5) / (TABLE_ANGLES + 1), y, slice('outer', epsilon)]),
      1,
    )
  );
}

/**
 * {@link energyAlbedoMean} of an anisotropic highlight, whose share at `viewRoughness` is a little more in the mean;
 * from inside it is what is given. Twin of `openpbr_energy_anisotropic_mean`.
 *
 * @param reflected The mean share with a round highlight.
 */
export function anisotropicAlbedoMean(epsilon: number, [x, y]: Slopes, roughness: number, reflected: number): number {
  if (epsilon <= 0) return reflected;
  const anisotropic = (x * x - y * y) / (x * x + y * y);
  return (
    reflected +
    ((1 - reflected) * 0.03 * roughness ** 2 * (1.03 - roughness) * anisotropic ** 3 * epsilon) / (epsilon + 0.06)
  );
}

/** Cosine-weighted mean of what single scattering loses. */
const energyTotalLostMean = (epsilon: number, roughness: number): number =>
  tableLookup(OPENPBR_TABLES.dielectric, [
    totalRoughness(roughness),
    (TABLE_ROUGHNESSES - 0.5) / TABLE_ROUGHNESSES,
    totalSlice(epsilon),
  ]);

/**
 * The reflected fraction of the energy that single scattering loses; twin of `openpbr_energy_bounce`. Seen from the
 * thinner medium, the mean reflectance; from inside, where total reflection dominates, such that as much goes through
 * to either side.
 */
export function energyBounce(epsilon: number, roughness: number): number {
  const reflected = fresnelMean(Math.abs(epsilon));
  if (epsilon >= 0) return reflected;
  return clamp(
    1 -
      ((1 - reflected) * energyTotalLostMean(-epsilon, roughness)) /
        Math.max(energyTotalLostMean(epsilon, roughness), 1e-4),
    0,
    1,
  );
}

/** Energy that single scattering by an interface neither reflects nor refracts; twin of `openpbr_energy_total_lost`. */
export function energyTotalLost(epsilon: number, roughness: number, mu: number): number {
  const r = Math.max(roughness, OPENPBR_MIN_ROUGHNESS);
  const t =
    epsilon >= 0
      ? 1 - Math.max(1 - spread(r, mu), 0) ** 0.6
      : 0.5 * (spread(r, mu) + innerPosition((1 + epsilon) / (1 - epsilon), mu));
  return tableLookup(OPENPBR_TABLES.dielectric, [
    totalRoughness(r),
    texel(t, 0, TABLE_ROUGHNESSES - 1, TABLE_ROUGHNESSES),
    totalSlice(epsilon),
  ]);
}
