import { wgslModule } from '@glanz/wgsl';

/**
 * `openpbr_fresnel_dielectric(eta, c)`: exact unpolarised reflectance of an interface of relative index `eta` = n_t / n_i
 * at cosine `c` of the angle of incidence; 1 beyond the critical angle.
 */
export const openpbrFresnelDielectric = wgslModule(
  'openpbr/fresnel-dielectric',
  /* wgsl */ `fn openpbr_fresnel_dielectric(eta: f32, c: f32) -> f32 {
  let g2 = (eta - 1.0) * (eta + 1.0) + c * c;
  if (g2 <= 0.0) { return 1.0; }
  let g = sqrt(g2);
  let a = (eta - 1.0) * (eta + 1.0) / ((g + c) * (g + c));
  let b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return min(0.5 * a * a * (1.0 + b * b), 1.0);
}`,
);

/**
 * Reflectance of metal: Schlick's formula with the F82 tint (Kutz, Hašan and Edmondson 2021). `openpbr_f82_edge` is what
 * the tint takes away; `openpbr_f82` evaluates, both factors already scaled by specular_weight.
 */
export const openpbrFresnelMetal = wgslModule(
  'openpbr/fresnel-metal',
  /* wgsl */ `// Reflectance taken away at the cosine 1/7 (82 degrees), over that cosine's μ (1 - μ)⁶.
fn openpbr_f82_edge(f0: vec3f, tint: vec3f) -> vec3f {
  let schlick = f0 + (1.0 - f0) * 0.46266436;
  return schlick * (1.0 - tint) * 17.6513846;
}

fn openpbr_f82(f0: vec3f, f90: f32, edge: vec3f, c: f32) -> vec3f {
  let m = 1.0 - c;
  let m5 = m * m * m * m * m;
  return clamp(f0 + (f90 - f0) * m5 - edge * (c * m5 * m), vec3f(0.0), vec3f(1.0));
}

// The cosine-weighted mean over all directions.
fn openpbr_f82_mean(f0: vec3f, f90: f32, edge: vec3f) -> vec3f {
  return clamp(f0 + (f90 - f0) * 0.047619048 - edge * 0.0079365079, vec3f(0.0), vec3f(min(f90, 1.0)));
}`,
);
