import { wgslModule } from '@glanz/wgsl';
import { openpbrCircle } from './circle.wgsl';

/**
 * The GGX microfacet distribution with height-correlated Smith masking (Heitz 2014). `openpbr_alpha` maps roughness and
 * anisotropy to slopes, not below 1e-4, so that a smooth surface is a very narrow lobe and never a special case.
 * `openpbr_ggx` gives, for a half vector, (D G₂ / (4 cos θ_o), density of reflected directions when half vectors are
 * sampled by `openpbr_ggx_sample`). Their ratio is exact however narrow the lobe.
 *
 * The energy tables know round highlights only. For a stretched one `openpbr_view_roughness` is the round roughness that
 * reflects the same share of the light (the slope across the view counts the more, the lower the view), about, and
 * `openpbr_mirror_cosine` the view that has the same masking. They are exact for round highlights.
 */
export const openpbrGgx = wgslModule(
  'openpbr/ggx',
  /* wgsl */ `fn openpbr_alpha(roughness: f32, anisotropy: f32) -> vec2f {
  let alpha = roughness * roughness;
  //#if OPENPBR_ANISOTROPY
  let flat = 1.0 - anisotropy;
  let along = alpha * sqrt(2.0 / (1.0 + flat * flat));
  return max(vec2f(along, flat * along), vec2f(1e-4));
  //#else
  return vec2f(max(alpha, 1e-4));
  //#endif
}

// √(cos² + α² sin²): twice the projected area of the microsurface, less the cosine.
fn openpbr_ggx_stretch(alpha: vec2f, w: vec3f) -> f32 {
  return length(vec3f(alpha * w.xy, w.z));
}

// Half the distribution of facet normals.
fn openpbr_ggx_density(alpha: vec2f, h: vec3f) -> f32 {
  let slope = h.xy / alpha;
  let t = dot(slope, slope) + h.z * h.z;
  return 0.15915494 / (alpha.x * alpha.y * t * t);
}

fn openpbr_ggx(alpha: vec2f, wo: vec3f, wi: vec3f, h: vec3f, bound: f32) -> vec2f {
  let d = openpbr_ggx_density(alpha, h);
  let so = openpbr_ggx_stretch(alpha, wo);
  let si = openpbr_ggx_stretch(alpha, wi);
  return d * vec2f(wi.z / (wo.z * si + wi.z * so), 1.0 / (bound * wo.z + so));
}

fn openpbr_view_roughness(alpha: vec2f, roughness: f32, w: vec3f) -> f32 {
  //#if OPENPBR_ANISOTROPY
  return sqrt(min(length(vec3f(alpha * w.xy, roughness * roughness * w.z)), 1.0));
  //#else
  return roughness;
  //#endif
}

fn openpbr_mirror_cosine(alpha: vec2f, w: vec3f, mu: f32) -> f32 {
  //#if OPENPBR_ANISOTROPY
  return mu / length(vec2f(mu, length(alpha * w.xy) * 1.4142136 / length(alpha)));
  //#else
  return mu;
  //#endif
}

// How much of the spherical cap of visible normals reflects upwards, at most (Eto and Tokuyoshi 2023): a factor on the cap's
// depth below the equator. Normals out of the rest would only be thrown away.
fn openpbr_ggx_bound(alpha: vec2f, wo: vec3f) -> f32 {
  let a = min(min(alpha.x, alpha.y), 1.0);
  let s = 1.0 + length(wo.xy);
  return (1.0 - a * a) * s * s / (s * s + a * a * wo.z * wo.z);
}

// Where the viewer is, around the axis of the cap.
fn openpbr_ggx_azimuth(alpha: vec2f, wo: vec3f) -> vec2f {
  let flat = alpha * wo.xy;
  return select(vec2f(1.0, 0.0), flat * inverseSqrt(max(dot(flat, flat), 1e-30)), dot(flat, flat) > 1e-20);
}

// The half vector at a place of the cap: a unit vector around its axis, and a height in [0, 1).
fn openpbr_ggx_cap(alpha: vec2f, wo: vec3f, around: vec2f, height: f32, bound: f32) -> vec3f {
  let v = normalize(vec3f(alpha * wo.xy, wo.z));
  let depth = bound * v.z;
  let z = (1.0 - height) * (1.0 + depth) - depth;
  let r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
  let h = vec3f(r * around, z) + v;
  return normalize(vec3f(alpha * h.xy, max(h.z, 1e-7)));
}

// A half vector visible from wo (Dupuy and Benyoub 2023, spherical caps); all of them with the bound 1.
fn openpbr_ggx_sample(alpha: vec2f, wo: vec3f, u: vec2f, bound: f32) -> vec3f {
  return openpbr_ggx_cap(alpha, wo, openpbr_circle(u.x), u.y, bound);
}`,
  [openpbrCircle],
);
