import type { OpenPbrVector } from '../parameters/index';
import { fresnelDielectric } from './fresnel';
import { ggxMasking, ggxMaskingShadowing, ggxSample, type Slopes } from './ggx';
import { clamp, dot } from './vector';

/** The parts of the light that single scattering reflects and lets through. */
type Kept = readonly [reflected: number, through: number];

/**
 * The parts of the light that a dielectric with a stretched highlight reflects and lets through by single scattering, seen
 * from `wo`; twin of `openpbr_stretched`, which says how good it is.
 *
 * @param eta Index of the far side over that of the viewer's.
 */
export const stretchedEnergy = (eta: number, alpha: Slopes, wo: OpenPbrVector): Kept => (eta < 1 ? fromInside(eta, alpha, wo) : fromOutside(eta, alpha, wo));

/** What the facet `h` mirrors to where it is seen, and what it refracts to there; 0 or less where it does not. */
function seen(eta: number, alpha: Slopes, wo: OpenPbrVector, h: OpenPbrVector): Kept {
  const c = clamp(dot(wo, h), 0, 1);
  const along = c / eta - Math.sqrt(Math.max(1 - (1 - c * c) / (eta * eta), 1e-6));
  const mirrored: OpenPbrVector = [2 * c * h[0] - wo[0], 2 * c * h[1] - wo[1], 2 * c * h[2] - wo[2]];
  const refracted: OpenPbrVector = [along * h[0] - wo[0] / eta, along * h[1] - wo[1] / eta, along * h[2] - wo[2] / eta];
  return [mirrored[2] > 0 ? ggxMaskingShadowing(alpha, wo, mirrored) / ggxMasking(alpha, wo) : 0, refracted[2] < 0 ? ggxMasking(alpha, [refracted[0], refracted[1], -refracted[2]]) : 0];
}

/** A sum over 64 facets. */
function fromOutside(eta: number, alpha: Slopes, wo: OpenPbrVector): Kept {
  const turn = Math.atan2(alpha[1] * wo[1], alpha[0] * wo[0]) / (2 * Math.PI);
  let reflected = 0;
  let through = 0;
  for (let i = 0; i < 64; i++) {
    const y = (i + 0.5) / 64;
    const u = clamp(y, 0.002, 0.998);
    const h = ggxSample(alpha, wo, [turn + i * 0.618034, u * u * (3 - 2 * u)]);
    const [up, down] = seen(eta, alpha, wo, h);
    const reflectance = fresnelDielectric(eta, clamp(dot(wo, h), 0, 1));
    const weight = 0.09375 * y * (1 - y);
    reflected += weight * reflectance * up;
    through += weight * (1 - reflectance) * down;
  }
  return [reflected, through];
}

/**
 * The facets that mirror upwards as if all light were reflected, less those that let some through. Each kind lies within a
 * conic of slopes: for the angle `ψ` from the normal in the plane of the view, of bounds that are roots of quadratics.
 */
function fromInside(eta: number, alpha: Slopes, wo: OpenPbrVector): Kept {
  const [ax, ay] = alpha;
  const flat = Math.hypot(ax * wo[0], ay * wo[1]);
  const towards = flat > 1e-10 ? [(ax * wo[0]) / flat, (ay * wo[1]) / flat] as const : [1, 0] as const;
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
  const critical = 1 / (1 - eta * eta);

  /** Sums over the facets a with a² ≤ (a·wo)(a·axis), axis = lean p̂ + upright z. */
  const sum = (count: number, lean: number, upright: number, add: (weight: number, h: OpenPbrVector) => void): void => {
    const a = flat * lean - least;
    const b = 0.5 * (flat * upright + wo[2] * lean);
    const c = wo[2] * upright - 1;
    const discriminant = b * b - a * c;
    if (discriminant <= 0) return;
    const root = b + (b >= 0 ? 1 : -1) * Math.sqrt(discriminant);
    const [x, y] = [clamp(-root / a, -1e15, 1e15), clamp(-c / root, -1e15, 1e15)];
    // sin (ψ - ψ of the view), which is even among the facets that are seen.
    const place = (slope: number): number => (slope * cosine - sine) / Math.hypot(slope, 1);
    const first = place(a > 0 ? Math.max(x, y) : Math.min(x, y));
    const last = a > 0 ? cosine : place(Math.max(x, y));
    for (let i = 0; i < count; i++) {
      const u = (i + 0.5) / count;
      const v = (i * 0.618034 + 0.5) % 1;
      const s = first + (last - first) * u * u * (3 - 2 * u);
      const rest = Math.sqrt(Math.max(1 - s * s, 0));
      const [sinPsi, cosPsi] = [s * cosine + rest * sine, Math.max(rest * cosine - s * sine, 0)];
      const middle = -skew * sinPsi;
      const width = Math.sqrt(Math.max((sinPsi * flat + cosPsi * wo[2]) * (sinPsi * lean + cosPsi * upright) - least * sinPsi * sinPsi - cosPsi * cosPsi, 0) / square);
      const bound = (tangent: number): number => tangent / Math.hypot(tangent, 1);
      const left = bound(middle - width);
      const right = bound(middle + width);
      const sinChi = left + (right - left) * v * v * (3 - 2 * v);
      const cosChi = Math.sqrt(Math.max(1 - sinChi * sinChi, 0));
      const weight = ((last - first) / (1 + cosine)) * (right - left) * ((72 / Math.PI) * u * (1 - u) * v * (1 - v) * cosChi) / count;
      const facet: OpenPbrVector = [cosChi * sinPsi * p[0] + sinChi * q[0], cosChi * sinPsi * p[1] + sinChi * q[1], cosChi * cosPsi];
      const size = Math.hypot(...facet);
      add(weight, [facet[0] / size, facet[1] / size, facet[2] / size]);
    }
  };

  let reflected = 0;
  let through = 0;
  sum(64, 0, 2 / wo[2], (weight, h) => (reflected += weight * seen(eta, alpha, wo, h)[0]));
  sum(96, flat * critical, wo[2] * critical, (weight, h) => {
    const [up, down] = seen(eta, alpha, wo, h);
    const part = weight * (1 - fresnelDielectric(eta, clamp(dot(wo, h), 0, 1)));
    reflected -= part * up;
    through += part * down;
  });
  return [Math.max(reflected, 0), through];
}
