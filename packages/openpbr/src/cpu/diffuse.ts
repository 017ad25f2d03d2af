import type { OpenPbrColor, OpenPbrVector } from '../parameters/index';

const C1 = 0.5 - 2 / (3 * Math.PI);
const C2 = 2 / 3 - 28 / (15 * Math.PI);

/** Directional albedo of EON's single-scattering part for albedo 1, the paper's polynomial. */
function singleAlbedo(c: number, roughness: number): number {
  const m = 1 - c;
  const g = m * (0.0571085289 + m * (0.491881867 + m * (-0.332181442 + m * 0.0714429953)));
  return (1 + roughness * g) / (1 + C1 * roughness);
}

/**
 * Energy-preserving Oren-Nayar (Portsmouth, Kutz and Hill 2024), f without the cosine; twin of `openpbr_eon`.
 *
 * @param albedo Reflected part of uniform light when roughness is 0, per channel.
 * @param roughness σ in [0, 1]; 0 is Lambert.
 */
export function eon(
  albedo: OpenPbrColor,
  roughness: number,
  wo: OpenPbrVector,
  wi: OpenPbrVector,
): [number, number, number] {
  const a = 1 / (1 + C1 * roughness);
  const s = wo[0] * wi[0] + wo[1] * wi[1];
  const single = a * (1 + roughness * (s > 0 ? s / Math.max(wo[2], wi[2], 1e-7) : s));
  const mean = a * (1 + C2 * roughness);
  const lost = ((1 - singleAlbedo(wo[2], roughness)) * (1 - singleAlbedo(wi[2], roughness))) / Math.max(1 - mean, 1e-7);
  const channel = (rho: number): number =>
    (rho * single + (rho * rho * mean * lost) / (1 - rho * (1 - mean))) / Math.PI;
  return [channel(albedo[0]), channel(albedo[1]), channel(albedo[2])];
}

/**
 * How much rough diffuse light below an interface wants at grazing angles; twin of `openpbr_diffuse_grazing`.
 *
 * @param roughness σ in [0, 1] of the diffuse lobe.
 * @param specularRoughness Of the interface, in [0, 1].
 * @param reflected Mean share that the interface reflects, in [0, 1].
 * @param epsilon (η - 1)/(η + 1) of the interface; negative seen from its denser side.
 */
export function diffuseGrazing(
  roughness: number,
  specularRoughness: number,
  reflected: number,
  epsilon: number,
): number {
  const square = specularRoughness * specularRoughness;
  if (epsilon < 0) return ((0.055 * roughness * reflected) / (reflected + 0.01)) * Math.max(1 / (1 + 10 * square), 0.3);
  return (
    roughness *
    (1.19 - 0.13 * roughness) *
    reflected *
    ((0.1023 * (1 - 2.19 * reflected)) / ((reflected + 0.0416) * (1 + 23 * square * specularRoughness)) +
      (0.248 * square) / (1 + 9.8 * reflected))
  );
}

/**
 * Factor on all of it, for what the fit leaves; takes what {@link diffuseGrazing} does. Twin of `openpbr_diffuse_even`.
 */
export const diffuseEven = (roughness: number, reflected: number, epsilon: number): number =>
  1 + roughness * reflected * (epsilon < 0 ? -0.0025 / (reflected + 0.01) - 0.03 : 0.0009 / (reflected + 0.005));

/**
 * Factor on it for either direction, of {@link diffuseGrazing} and the direction's cosine; twin of
 * `openpbr_diffuse_gain`.
 */
export const diffuseGain = (grazing: number, mu: number): number =>
  1 + grazing * ((1 - mu) ** 3 / (1 + 0.4 * mu) - 0.08);

/** A direction with density cos θ / π; twin of `openpbr_cosine_sample`. */
export function cosineSample(u: readonly [number, number, ...number[]]): OpenPbrVector {
  const phi = 2 * Math.PI * u[0];
  const r = Math.sqrt(u[1]);
  return [r * Math.cos(phi), r * Math.sin(phi), Math.sqrt(1 - u[1])];
}
