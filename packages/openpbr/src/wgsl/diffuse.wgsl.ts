import { wgslModule } from '@glanz/wgsl';
import openpbrCircle from './circle.wesl';

/** `openpbr_cosine_sample(u)`: a direction with density cos θ / π. */
export const openpbrCosine = wgslModule(
  'openpbr/cosine',
  /* wgsl */ `fn openpbr_cosine_sample(u: vec2f) -> vec3f {
  return vec3f(sqrt(u.y) * openpbr_circle(u.x), sqrt(1.0 - u.y));
}`,
  [openpbrCircle],
);

/**
 * Energy-preserving Oren-Nayar (Portsmouth, Kutz and Hill 2024): `openpbr_eon` is f without the cosine. The directional
 * albedo of its single-scattering part is the paper's polynomial.
 */
export const openpbrEon = wgslModule(
  'openpbr/eon',
  /* wgsl */ `fn openpbr_eon_single_albedo(c: f32, roughness: f32) -> f32 {
  let m = 1.0 - c;
  let g = m * (0.0571085289 + m * (0.491881867 + m * (-0.332181442 + m * 0.0714429953)));
  return (1.0 + roughness * g) / (1.0 + 0.28779342 * roughness);
}

// Rough diffuse light goes more to where it came from: below an interface, which lets less through at grazing angles, less of
// it gets out when it came from there. A factor for either direction, about 1 in the mean, makes up for that: the one that
// leaves nothing out is a fixed point (Sinkhorn's), to which this is fitted for indices 1.05 to 3 and all roughnesses of both;
// white stays white within 0.9964 to 1.002. "reflected" is the mean share that the interface reflects.
fn openpbr_diffuse_grazing(roughness: f32, specular_roughness: f32, reflected: f32, epsilon: f32) -> f32 {
  let square = specular_roughness * specular_roughness;
  //#if OPENPBR_INNER
  if (epsilon < 0.0) { return 0.055 * roughness * reflected / (reflected + 0.01) * max(1.0 / (1.0 + 10.0 * square), 0.3); }
  //#endif
  let peak = 0.1023 * (1.0 - 2.19 * reflected) / ((reflected + 0.0416) * (1.0 + 23.0 * square * specular_roughness));
  return roughness * (1.19 - 0.13 * roughness) * reflected * (peak + 0.248 * square / (1.0 + 9.8 * reflected));
}

// A factor on all of it, for what the fit leaves. Seen from the denser side it would give back more than it gets where it peaks.
fn openpbr_diffuse_even(roughness: f32, reflected: f32, epsilon: f32) -> f32 {
  var more = 0.0009 / (reflected + 0.005);
  //#if OPENPBR_INNER
  if (epsilon < 0.0) { more = -0.0025 / (reflected + 0.01) - 0.03; }
  //#endif
  return 1.0 + roughness * reflected * more;
}

fn openpbr_diffuse_gain(grazing: f32, mu: f32) -> f32 {
  let m = 1.0 - mu;
  return 1.0 + grazing * (m * m * m / (1.0 + 0.4 * mu) - 0.08);
}

fn openpbr_eon(albedo: vec3f, roughness: f32, wo: vec3f, wi: vec3f) -> vec3f {
  let a = 1.0 / (1.0 + 0.28779342 * roughness);
  let s = dot(wo.xy, wi.xy);
  let single = a * (1.0 + roughness * select(s, s / max(max(wo.z, wi.z), 1e-7), s > 0.0));
  let mean = a * (1.0 + 0.07248821 * roughness);
  let lost = (1.0 - openpbr_eon_single_albedo(wo.z, roughness)) * (1.0 - openpbr_eon_single_albedo(wi.z, roughness)) / max(1.0 - mean, 1e-7);
  let multiple = albedo * albedo * (mean * lost) / (1.0 - albedo * (1.0 - mean));
  return (albedo * single + multiple) * 0.31830989;
}`,
);
