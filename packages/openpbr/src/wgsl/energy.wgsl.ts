import { wgslModule } from '@glanz/wgsl';
import {
  STRETCHED_FLATS,
  STRETCHED_VIEWS,
  TABLE_ANGLES,
  TABLE_BLOCKS,
  TABLE_CONDUCTOR,
  TABLE_DEPTH,
  TABLE_HEIGHT_2D,
  TABLE_MIN_ROUGHNESS,
  TABLE_ROUGHNESSES,
} from '../tables/layout';
import openpbrFresnelDielectric from './fresnel_dielectric.wesl';
import openpbrGgx from './ggx.wesl';

const float = (value: number): string => (Number.isInteger(value) ? `${value}.0` : String(value));
/**
 * `(u·(count - 1) + ½ + first) / size`: the texture coordinate of u ∈ [0, 1] between two texels' centres, as an offset
 * and a factor.
 */
const axis = (first: number, count: number, size: number): [offset: string, factor: string] => [
  float((first + 0.5) / size),
  float((count - 1) / size),
];

const angle = axis(0, TABLE_ANGLES, TABLE_ANGLES + 1);
const rough = axis(0, TABLE_ROUGHNESSES, TABLE_ROUGHNESSES);
const metal = axis(0, TABLE_CONDUCTOR, TABLE_CONDUCTOR + 1);
const metalRough = axis(0, TABLE_CONDUCTOR, TABLE_HEIGHT_2D);
const slice = (block: keyof typeof TABLE_BLOCKS) => axis(TABLE_BLOCKS[block][0], TABLE_BLOCKS[block][1], TABLE_DEPTH);
const outer = slice('outer');
const outerTotal = slice('outerTotal');
const inner = slice('inner');
const innerTotal = slice('innerTotal');
const stretchedRough = slice('stretched');
const stretchedView = axis(0, STRETCHED_VIEWS, TABLE_ROUGHNESSES);
const stretchedBlock = float(STRETCHED_VIEWS / TABLE_ROUGHNESSES);
const linear = `clamp((r - ${float(TABLE_MIN_ROUGHNESS)}) * ${float(1 / (1 - TABLE_MIN_ROUGHNESS))}, 0.0, 1.0)`;
// In the blocks of totals.
const totalRough = axis(0, TABLE_ANGLES + 1, TABLE_ANGLES + 1);
const totalAngle = axis(0, TABLE_ROUGHNESSES - 1, TABLE_ROUGHNESSES);
const totalMean = float((TABLE_ROUGHNESSES - 0.5) / TABLE_ROUGHNESSES);
const minRoot = Math.sqrt(TABLE_MIN_ROUGHNESS);
const unit = `clamp((sqrt(r) - ${float(minRoot)}) * ${float(1 / (1 - minRoot))}, 0.0, 1.0)`;

/**
 * Directional albedos of GGX interfaces, read from the energy tables through the host's accessors
 * (`openpbr_table_dielectric`, `openpbr_table_conductor`). A dielectric is given by `epsilon` = (η - 1)/(η + 1), the
 * signed root of its reflectance at normal incidence. The coordinates are explained in scripts/tables.mjs.
 */
export const openpbrEnergy = wgslModule(
  'openpbr/energy',
  /* wgsl */ `// √cosine, spread so that the dip of masking keeps its place as the roughness varies.
fn openpbr_energy_angle(r: f32, mu: f32) -> f32 {
  let x = sqrt(mu);
  return x * (1.0 + r) / (x + r);
}

//#if OPENPBR_LOSSES
// Energy that a perfect mirror of roughness r loses by single scattering.
fn openpbr_energy_lost(roughness: f32, mu: f32) -> f32 {
  let r = max(roughness, ${TABLE_MIN_ROUGHNESS});
  return openpbr_table_conductor(vec2f(${metal[0]} + ${metal[1]} * openpbr_energy_angle(r, mu), ${metalRough[0]} + ${metalRough[1]} * ${unit}));
}

// Its cosine-weighted mean over all directions.
fn openpbr_energy_lost_mean(roughness: f32) -> f32 {
  let r = max(roughness, ${TABLE_MIN_ROUGHNESS});
  return r * r * r * openpbr_table_conductor(vec2f(${float((TABLE_CONDUCTOR + 0.5) / (TABLE_CONDUCTOR + 1))}, ${metalRough[0]} + ${metalRough[1]} * ${unit}));
}

//#if OPENPBR_ANISOTROPY
// What a stretched highlight keeps more of than a round one of the same masking; "x" is the column, "along" where one over the
// slope along the view lies between the least and the most. The last column holds how much less of the round one's mean it loses.
fn openpbr_energy_stretched(alpha: vec2f, roughness: f32, x: f32, along: f32) -> f32 {
  let r = max(roughness, ${TABLE_MIN_ROUGHNESS});
  let flat = (1.0 - alpha.y / alpha.x) * ${float(STRETCHED_FLATS)};
  let block = min(floor(flat), ${float(STRETCHED_FLATS - 1)});
  let at = vec3f(x, ${stretchedView[0]} + ${stretchedView[1]} * along + ${stretchedBlock} * block, ${stretchedRough[0]} + ${stretchedRough[1]} * ${linear});
  let rounder = select(0.0, openpbr_table_dielectric(at - vec3f(0.0, ${stretchedBlock}, 0.0)), block > 0.0);
  return mix(rounder, openpbr_table_dielectric(at), flat - block);
}
//#endif

// Energy that a perfect mirror loses by single scattering towards w.
fn openpbr_mirror_lost(alpha: vec2f, roughness: f32, w: vec3f, mu: f32) -> f32 {
  let cosine = openpbr_mirror_cosine(alpha, w, mu);
  let lost = openpbr_energy_lost(roughness, cosine);
  //#if OPENPBR_ANISOTROPY
  if (alpha.x > alpha.y) {
    let slope = clamp(length(alpha * w.xy) / max(length(w.xy), 1e-20), alpha.y, alpha.x);
    let along = alpha.y * (alpha.x - slope) / (slope * (alpha.x - alpha.y));
    // Angles crowd towards the normal.
    let rest = sqrt(max(1.0 - openpbr_energy_angle(max(roughness, ${TABLE_MIN_ROUGHNESS}), cosine), 0.0));
    return max(lost - openpbr_energy_stretched(alpha, roughness, ${angle[0]} + ${angle[1]} * (1.0 - rest * sqrt(rest)), along), 0.0);
  }
  //#endif
  return lost;
}

fn openpbr_mirror_lost_mean(alpha: vec2f, roughness: f32) -> f32 {
  let lost = openpbr_energy_lost_mean(roughness);
  //#if OPENPBR_ANISOTROPY
  if (alpha.x > alpha.y) { return lost * (1.0 - openpbr_energy_stretched(alpha, roughness, ${float((TABLE_ANGLES + 0.5) / (TABLE_ANGLES + 1))}, 0.0)); }
  //#endif
  return lost;
}
//#endif

//#if OPENPBR_INTERFACE
// Cosine-weighted mean of the reflectance of a smooth interface, about; from inside it follows from reciprocity.
fn openpbr_fresnel_mean(epsilon: f32) -> f32 {
  let e = abs(epsilon);
  let mean = 2.0 * e / (5.0864 - 3.085 * e);
  let eta = (1.0 - e) / (1.0 + e);
  return select(1.0 - eta * eta * (1.0 - mean), mean, epsilon >= 0.0);
}

//#if OPENPBR_INNER
// Where a cosine inside of the denser medium lies: the critical angle in the middle, and columns crowd around it.
fn openpbr_energy_inner_angle(eta: f32, mu: f32) -> f32 {
  let critical = sqrt(1.0 - eta * eta);
  return select(0.5 * sqrt(mu) / (sqrt(mu) + sqrt(max(critical - mu, 0.0))), 0.5 + 0.5 * sqrt(max(mu - critical, 0.0) / (1.0 - critical)), mu > critical);
}

//#endif
fn openpbr_energy_total_lost_at(epsilon: f32, r: f32, y: f32) -> f32 {
  var z = ${outerTotal[0]} + ${outerTotal[1]} * pow(abs(epsilon), 0.33333333);
  //#if OPENPBR_INNER
  if (epsilon < 0.0) { z = ${innerTotal[0]} + ${innerTotal[1]} * sqrt(-epsilon); }
  //#endif
  return openpbr_table_dielectric(vec3f(${totalRough[0]} + ${totalRough[1]} * ${linear}, y, z));
}

// Energy that single scattering by the interface neither reflects nor refracts. Where it is tiny it keeps its digits, which 1
// less it would not.
fn openpbr_energy_total_lost(epsilon: f32, roughness: f32, mu: f32) -> f32 {
  let r = max(roughness, ${TABLE_MIN_ROUGHNESS});
  let angle = openpbr_energy_angle(r, mu);
  // Columns crowd towards the normal.
  var t = 1.0 - pow(max(1.0 - angle, 1e-9), 0.6);
  //#if OPENPBR_INNER
  if (epsilon < 0.0) { t = 0.5 * (angle + openpbr_energy_inner_angle((1.0 + epsilon) / (1.0 - epsilon), mu)); }
  //#endif
  return openpbr_energy_total_lost_at(epsilon, r, ${totalAngle[0]} + ${totalAngle[1]} * t);
}

// The part of what single scattering loses that is reflected after more bounces. Seen from the thinner medium, the mean
// reflectance; from inside, where total reflection dominates, such that as much goes through to either side.
fn openpbr_energy_bounce(epsilon: f32, roughness: f32) -> f32 {
  let reflected = openpbr_fresnel_mean(abs(epsilon));
  //#if OPENPBR_INNER
  if (epsilon < 0.0) {
    let outside = openpbr_energy_total_lost_at(-epsilon, roughness, ${totalMean});
    let inside = openpbr_energy_total_lost_at(epsilon, roughness, ${totalMean});
    return clamp(1.0 - (1.0 - reflected) * outside / max(inside, 1e-4), 0.0, 1.0);
  }
  //#endif
  return reflected;
}

//#if OPENPBR_INNER
fn openpbr_energy_inner_share(epsilon: f32, r: f32, mu: f32, bounce: f32) -> f32 {
  let eta = (1.0 + epsilon) / (1.0 - epsilon);
  let direct = openpbr_table_dielectric(vec3f(${angle[0]} + ${angle[1]} * openpbr_energy_inner_angle(eta, mu), ${rough[0]} + ${rough[1]} * ${unit}, ${inner[0]} + ${inner[1]} * sqrt(-epsilon)));
  return mix(min(direct, 1.0), bounce, openpbr_energy_total_lost(epsilon, r, mu));
}

//#endif
// Share of the energy that the interface reflects by all scattering, the rest being refracted.
fn openpbr_energy_share(epsilon: f32, roughness: f32, mu: f32) -> f32 {
  if (epsilon == 0.0) { return 0.0; }
  let r = max(roughness, ${TABLE_MIN_ROUGHNESS});
  let eta = (1.0 + epsilon) / (1.0 - epsilon);
  let z = sqrt(abs(epsilon));
  let y = ${rough[0]} + ${rough[1]} * ${unit};
  //#if OPENPBR_INNER
  if (epsilon < 0.0) { return openpbr_energy_inner_share(epsilon, r, mu, openpbr_energy_bounce(epsilon, roughness)); }
  //#endif
  let outside = openpbr_table_dielectric(vec3f(${angle[0]} + ${angle[1]} * openpbr_energy_angle(r, mu), y, ${outer[0]} + ${outer[1]} * z));
  return min(outside * openpbr_fresnel_dielectric(eta, mu + 0.8 * r * r * (1.0 - mu)), 1.0);
}

// The cosine-weighted mean of openpbr_energy_share over all directions, seen from the thinner medium. From inside it is summed
// (openpbr_dielectric_seen), or counts for nothing, since nothing opaque lies below: 0.
fn openpbr_energy_share_mean(epsilon: f32, roughness: f32) -> f32 {
  if (epsilon <= 0.0) { return 0.0; }
  let r = max(roughness, ${TABLE_MIN_ROUGHNESS});
  return 1.0 - min((1.0 - openpbr_fresnel_mean(epsilon)) * openpbr_table_dielectric(vec3f(${float((TABLE_ANGLES + 0.5) / (TABLE_ANGLES + 1))}, ${rough[0]} + ${rough[1]} * ${unit}, ${outer[0]} + ${outer[1]} * sqrt(epsilon))), 1.0);
}

//#if OPENPBR_ANISOTROPY
// The same for a stretched highlight: the share at openpbr_view_roughness lets a little less through in the mean, up to 0.0043,
// which this has within 0.001 (0.0002 in the mean square) for indices 1.05 to 3.
fn openpbr_energy_stretched_mean(epsilon: f32, alpha: vec2f, roughness: f32, reflected: f32) -> f32 {
  let square = alpha * alpha;
  let stretched = (square.x - square.y) / (square.x + square.y);
  let less = 0.03 * roughness * roughness * (1.03 - roughness) * stretched * stretched * stretched * max(epsilon, 0.0) / (abs(epsilon) + 0.06);
  return reflected + (1.0 - reflected) * less;
}
//#endif
//#endif`,
  [openpbrGgx, openpbrFresnelDielectric],
);
