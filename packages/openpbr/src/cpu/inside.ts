import type { OpenPbrVector } from '../parameters/index';
import { energyLost } from './energy';
import { fresnelDielectric } from './fresnel';
import { ggxMasking, ggxMaskingShadowing, type Slopes } from './ggx';
import { clamp, dot } from './vector';

/** The parts of the light that single scattering reflects and lets through. */
export type Kept = readonly [reflected: number, through: number];

/** What the facet `h` mirrors to where it is seen, and what it refracts to there; 0 or less where it does not. */
export function facetSeen(eta: number, alpha: Slopes, wo: OpenPbrVector, h: OpenPbrVector): Kept {
  const c = clamp(dot(wo, h), 0, 1);
  const along = c / eta - Math.sqrt(Math.max(1 - (1 - c * c) / (eta * eta), 1e-6));
  const mirrored: OpenPbrVector = [2 * c * h[0] - wo[0], 2 * c * h[1] - wo[1], 2 * c * h[2] - wo[2]];
  const refracted: OpenPbrVector = [along * h[0] - wo[0] / eta, along * h[1] - wo[1] / eta, along * h[2] - wo[2] / eta];
  return [mirrored[2] > 0 ? ggxMaskingShadowing(alpha, wo, mirrored) / ggxMasking(alpha, wo) : 0, refracted[2] < 0 ? ggxMasking(alpha, [refracted[0], refracted[1], -refracted[2]]) : 0];
}

/** Facets a with a² ≤ (a·wo) (a·axis), axis = lean p̂ + upright z. */
type Conic = readonly [lean: number, upright: number];

/**
 * The parts of the light that a dielectric seen from its denser side reflects and lets through by single scattering; twin of
 * `openpbr_inside`, which says how it is summed and how good it is.
 *
 * @param eta Index of the far side over that of the viewer's, below 1.
 * @param given Unit direction to the viewer in the local frame; below cosine 1e-5 taken as of that.
 */
export function insideEnergy(eta: number, alpha: Slopes, given: OpenPbrVector): Kept {
  const wo: OpenPbrVector = [given[0], given[1], Math.max(given[2], 1e-5)];
  const [ax, ay] = alpha;
  // Directions are bent by a least step of the index (see prepareTransmission).
  const bend = eta > 0.9990005 ? 1.0010005 : eta;
  const flat = Math.hypot(ax * wo[0], ay * wo[1]);
  const towards = flat > 1e-10 ? ([(ax * wo[0]) / flat, (ay * wo[1]) / flat] as const) : ([1, 0] as const);
  // Where facets are stretched to a round highlight the view has this sine and cosine.
  const length = Math.hypot(flat, wo[2]);
  const sine = flat / length;
  const cosine = wo[2] / length;
  // Facets are cos χ (sin ψ p + cos ψ z) + sin χ q; of p, what is not along q is `least` long, squared.
  const p = [ax * towards[0], ay * towards[1]] as const;
  const q = [-ax * towards[1], ay * towards[0]] as const;
  const square = q[0] * q[0] + q[1] * q[1];
  const skew = (p[0] * q[0] + p[1] * q[1]) / square;
  const least = (ax * ay) ** 2 / square;
  const critical = 1 / ((1 - eta) * (1 + eta));
  const upwards: Conic = [0, 2 / wo[2]];
  const passing: Conic = [flat * critical, wo[2] * critical];

  /** Of the facets within a conic, sin (ψ - ψ of the view), which is even among those that are seen. */
  const range = ([lean, upright]: Conic): readonly [first: number, last: number] => {
    const a = flat * lean - least;
    const b = 0.5 * (flat * upright + wo[2] * lean);
    const c = wo[2] * upright - 1;
    const discriminant = b * b - a * c;
    if (discriminant <= 0) return [1, -1];
    const root = b + (b >= 0 ? 1 : -1) * Math.sqrt(discriminant);
    // At the critical angle a is 0, and the conic open at one end.
    const [x, y] = [clamp(-root / (a >= 0 ? Math.max(a, 1e-30) : a), -1e15, 1e15), clamp(-c / root, -1e15, 1e15)];
    const place = (slope: number): number => (slope * cosine - sine) / Math.hypot(slope, 1);
    return [place(a >= 0 ? Math.max(x, y) : Math.min(x, y)), a >= 0 ? cosine : place(Math.max(x, y))];
  };
  /** The square of tan χ at the conic's bounds, about its middle. */
  const reach = ([lean, upright]: Conic, sinPsi: number, cosPsi: number): number => ((sinPsi * flat + cosPsi * wo[2]) * (sinPsi * lean + cosPsi * upright) - least * sinPsi * sinPsi - cosPsi * cosPsi) / square;

  /** Sums over facets within both conics. */
  const sum = (count: number, one: Conic, other: Conic, add: (weight: number, h: OpenPbrVector) => void): void => {
    const [rangeOne, rangeOther] = [range(one), range(other)];
    const first = Math.max(rangeOne[0], rangeOther[0]);
    const last = Math.min(rangeOne[1], rangeOther[1]);
    if (first >= last) return;
    for (let i = 0; i < count; i++) {
      const u = (i + 0.5) / count;
      const v = (i * 0.618034 + 0.5) % 1;
      const s = first + (last - first) * u * u * (3 - 2 * u);
      const rest = Math.sqrt(Math.max(1 - s * s, 0));
      const [sinPsi, cosPsi] = [s * cosine + rest * sine, Math.max(rest * cosine - s * sine, 0)];
      const middle = -skew * sinPsi;
      const width = Math.sqrt(Math.max(Math.min(reach(one, sinPsi, cosPsi), reach(other, sinPsi, cosPsi)), 0));
      const bound = (tangent: number): number => tangent / Math.hypot(tangent, 1);
      const left = bound(middle - width);
      const right = bound(middle + width);
      const sinChi = left + (right - left) * v * v * (3 - 2 * v);
      const cosChi = Math.sqrt(Math.max(1 - sinChi * sinChi, 0));
      const weight = (((last - first) / (1 + cosine)) * (right - left) * ((72 / Math.PI) * u * (1 - u) * v * (1 - v) * cosChi)) / count;
      const facet: OpenPbrVector = [cosChi * sinPsi * p[0] + sinChi * q[0], cosChi * sinPsi * p[1] + sinChi * q[1], cosChi * cosPsi];
      const size = Math.hypot(...facet);
      add(weight, [facet[0] / size, facet[1] / size, facet[2] / size]);
    }
  };
  const transmittance = (h: OpenPbrVector): number => 1 - fresnelDielectric(eta, clamp(dot(wo, h), 0, 1));

  // What mirrors would reflect: tabulated where the highlight is round.
  let reflected = 0;
  if (ax > ay) sum(64, upwards, upwards, (weight, h) => (reflected += weight * facetSeen(bend, alpha, wo, h)[0]));
  else reflected = 1 - energyLost(Math.sqrt(ax), wo[2]);
  let through = 0;
  sum(48, passing, passing, (weight, h) => (through += weight * transmittance(h) * facetSeen(bend, alpha, wo, h)[1]));
  sum(48, passing, upwards, (weight, h) => (reflected -= weight * transmittance(h) * facetSeen(bend, alpha, wo, h)[0]));
  return [Math.max(reflected, 0), through];
}
