import { wgslModule } from '@glanz/wgsl';
import { SHEEN_COLUMNS, SHEEN_ROWS, TABLE_BLOCKS_2D, TABLE_HEIGHT_2D } from '../tables/layout';
import openpbrCosine from './cosine.wesl';
import { openPbrStruct } from './record';

const float = (value: number): string => (Number.isInteger(value) ? `${value}.0` : String(value));
const row = (block: keyof typeof TABLE_BLOCKS_2D) => float((TABLE_BLOCKS_2D[block][0] + 0.5) / TABLE_HEIGHT_2D);

/**
 * Fuzz: a layer of fibres over everything else (Zeltner, Burley and Chiang 2022). Its reflection is a linearly
 * transformed cosine towards the viewer, of two numbers and an energy from the two-dimensional table
 * (scripts/sheen.mjs); what lies below gets what it does not reflect, in grey. It depends on the viewer, and is not
 * reciprocal.
 */
export const openpbrFuzz = wgslModule(
  'openpbr/fuzz',
  /* wgsl */ `struct OpenPbrFuzz {
  // Albedo, tinted.
  color: vec3f,
  // Factor on everything below.
  below: f32,
  // The transformed cosine, and the azimuth of the viewer.
  stretch: f32,
  shear: f32,
  azimuth: vec2f,
  // Probability of sampling this lobe; else it is what lies below.
  probability: f32,
}

// Part of white light that the fuzz reflects towards a cosine, at full coverage.
fn openpbr_fuzz_albedo(roughness: f32, mu: f32) -> f32 {
  return openpbr_fuzz_table(roughness, mu, ${row('sheenAlbedo')});
}

fn openpbr_fuzz_table(roughness: f32, mu: f32, first: f32) -> f32 {
  let at = vec2f(${float(0.5 / SHEEN_COLUMNS)} + ${float((SHEEN_COLUMNS - 1) / SHEEN_COLUMNS)} * clamp(mu, 0.0, 1.0), first + ${float((SHEEN_ROWS - 1) / TABLE_HEIGHT_2D)} * clamp(roughness, 0.0, 1.0));
  return openpbr_table_conductor(at);
}

fn openpbr_fuzz_prepare(p: OpenPbrParameters, wo: vec3f, mu: f32) -> OpenPbrFuzz {
  var fuzz: OpenPbrFuzz;
  let albedo = p.fuzz_weight * openpbr_fuzz_albedo(p.fuzz_roughness, mu);
  fuzz.color = albedo * p.fuzz_color;
  fuzz.below = 1.0 - albedo;
  fuzz.stretch = openpbr_fuzz_table(p.fuzz_roughness, mu, ${row('sheenStretch')});
  fuzz.shear = openpbr_fuzz_table(p.fuzz_roughness, mu, ${row('sheenShear')});
  let flat = dot(wo.xy, wo.xy);
  fuzz.azimuth = select(vec2f(1.0, 0.0), wo.xy * inverseSqrt(max(flat, 1e-20)), flat > 1e-12);
  return fuzz;
}

// Density of its directions; times the albedo, f · cos θ_i.
fn openpbr_fuzz(fuzz: OpenPbrFuzz, wi: vec3f) -> f32 {
  let x = fuzz.stretch * dot(fuzz.azimuth, wi.xy) - fuzz.shear * wi.z;
  let y = fuzz.stretch * (fuzz.azimuth.x * wi.y - fuzz.azimuth.y * wi.x);
  let square = x * x + y * y + wi.z * wi.z;
  return max(wi.z, 0.0) * fuzz.stretch * fuzz.stretch * 0.31830989 / (square * square);
}

fn openpbr_fuzz_sample(fuzz: OpenPbrFuzz, u: vec2f) -> vec3f {
  let c = openpbr_cosine_sample(u);
  let flat = vec2f(c.x + fuzz.shear * c.z, c.y) / fuzz.stretch;
  return normalize(vec3f(fuzz.azimuth.x * flat.x - fuzz.azimuth.y * flat.y, fuzz.azimuth.y * flat.x + fuzz.azimuth.x * flat.y, c.z));
}`,
  [openPbrStruct.module, openpbrCosine],
);
