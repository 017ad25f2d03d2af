import type { OpenPbrColor } from '../parameters/index';
import { clamp } from './vector';

/**
 * Exact unpolarised reflectance of a dielectric interface; twin of `openpbr_fresnel_dielectric`.
 *
 * @param eta Relative index of refraction n_t / n_i.
 * @param c Cosine of the angle of incidence, in [0, 1].
 */
export function fresnelDielectric(eta: number, c: number): number {
  const index = (eta - 1) * (eta + 1);
  const g2 = index + c * c;
  if (g2 <= 0) return 1;
  const g = Math.sqrt(g2);
  const a = index / ((g + c) * (g + c));
  const b = (c * (g + c) - 1) / (c * (g - c) + 1);
  return Math.min(0.5 * a * a * (1 + b * b), 1);
}

/**
 * Reflectance of metal by the F82 tint (Kutz, Hašan and Edmondson 2021); twin of `openpbr_f82`.
 *
 * @param f0 Reflectance at normal incidence.
 * @param tint Factor on Schlick's formula at 82° (cosine 1/7).
 * @param c Cosine of the angle of incidence.
 * @param weight specular_weight: scales the whole; the result never exceeds 1.
 */
export function fresnelMetal(f0: OpenPbrColor, tint: OpenPbrColor, c: number, weight = 1): [number, number, number] {
  const m5 = (1 - c) ** 5;
  const channel = (i: 0 | 1 | 2): number => {
    const edge = (f0[i] + (1 - f0[i]) * (6 / 7) ** 5) * (1 - tint[i]) * (7 ** 7 / 6 ** 6);
    return clamp(weight * (f0[i] + (1 - f0[i]) * m5 - edge * c * m5 * (1 - c)), 0, 1);
  };
  return [channel(0), channel(1), channel(2)];
}

/** The cosine-weighted mean of {@link fresnelMetal} over all directions; twin of `openpbr_f82_mean`. */
export function fresnelMetalMean(f0: OpenPbrColor, tint: OpenPbrColor, weight = 1): [number, number, number] {
  const channel = (i: 0 | 1 | 2): number => {
    const edge = (f0[i] + (1 - f0[i]) * (6 / 7) ** 5) * (1 - tint[i]) * (7 ** 7 / 6 ** 6);
    return clamp(weight * (f0[i] + (1 - f0[i]) / 21 - edge / 126), 0, Math.min(weight, 1));
  };
  return [channel(0), channel(1), channel(2)];
}

/**
 * The signed root of the reflectance at normal incidence, (η - 1)/(η + 1), after specular_weight has scaled its square;
 * twin of `openpbr_dielectric_epsilon`.
 */
export function dielectricEpsilon(ior: number, specularWeight: number): number {
  const epsilon = (ior - 1) / (ior + 1);
  return Math.sign(epsilon) * Math.min(Math.abs(epsilon) * Math.sqrt(specularWeight), 0.9999);
}
