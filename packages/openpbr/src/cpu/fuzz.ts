import type { OpenPbrColor, OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { SHEEN_COLUMNS, SHEEN_ROWS, TABLE_BLOCKS_2D, TABLE_HEIGHT_2D } from '../tables/layout';
import { OPENPBR_TABLES } from '../tables/tables';
import { cosineSample } from './diffuse';
import { tableLookup } from './energy';
import { clamp, length2, normalize } from './vector';

/** The fuzz seen from one direction; twin of the WGSL struct `OpenPbrFuzz`. */
export interface Fuzz {
  /** Albedo, tinted. */
  readonly color: OpenPbrColor;
  /** Factor on everything below. */
  readonly below: number;
  /**
   * The linearly transformed cosine (x, y, z) → (stretch·x − shear·z, stretch·y, z), x towards the viewer's azimuth.
   */
  readonly stretch: number;
  readonly shear: number;
  readonly azimuth: readonly [number, number];
}

function lookup(block: keyof typeof TABLE_BLOCKS_2D, roughness: number, mu: number): number {
  const row = TABLE_BLOCKS_2D[block][0] + 0.5 + (SHEEN_ROWS - 1) * clamp(roughness, 0, 1);
  return tableLookup(OPENPBR_TABLES.conductor, [
    (0.5 + (SHEEN_COLUMNS - 1) * clamp(mu, 0, 1)) / SHEEN_COLUMNS,
    row / TABLE_HEIGHT_2D,
  ]);
}

/** Part of white light that full fuzz reflects towards a cosine; twin of `openpbr_fuzz_albedo`. */
export const fuzzAlbedo = (roughness: number, mu: number): number => lookup('sheenAlbedo', roughness, mu);

/** Prepares the fuzz for one direction; twin of `openpbr_fuzz_prepare`. */
export function prepareFuzz(p: OpenPbrParameters, wo: OpenPbrVector, mu: number): Fuzz {
  const albedo = p.fuzz_weight * fuzzAlbedo(p.fuzz_roughness, mu);
  const flat = length2(wo[0], wo[1]);
  return {
    color: [albedo * p.fuzz_color[0], albedo * p.fuzz_color[1], albedo * p.fuzz_color[2]],
    below: 1 - albedo,
    stretch: lookup('sheenStretch', p.fuzz_roughness, mu),
    shear: lookup('sheenShear', p.fuzz_roughness, mu),
    azimuth: flat > 1e-6 ? [wo[0] / flat, wo[1] / flat] : [1, 0],
  };
}

/** Density of the fuzz's directions; times its albedo, f · cos θ_i. Twin of `openpbr_fuzz`. */
export function fuzzDensity({ stretch, shear, azimuth }: Fuzz, wi: OpenPbrVector): number {
  const x = stretch * (azimuth[0] * wi[0] + azimuth[1] * wi[1]) - shear * wi[2];
  const y = stretch * (azimuth[0] * wi[1] - azimuth[1] * wi[0]);
  return (Math.max(wi[2], 0) * stretch * stretch) / (Math.PI * (x * x + y * y + wi[2] * wi[2]) ** 2);
}

/** A direction with that density; twin of `openpbr_fuzz_sample`. */
export function fuzzSample(
  { stretch, shear, azimuth }: Fuzz,
  u: readonly [number, number, ...number[]],
): OpenPbrVector {
  const c = cosineSample(u);
  const [x, y] = [(c[0] + shear * c[2]) / stretch, c[1] / stretch];
  return normalize([azimuth[0] * x - azimuth[1] * y, azimuth[1] * x + azimuth[0] * y, c[2]]);
}
