import { wgslModule } from '@glanz/wgsl';
import { openpbrDielectric } from './dielectric.wgsl';
import { openpbrEnergy } from './energy.wgsl';
import openpbrFresnelDielectric from './fresnel_dielectric.wesl';
import openpbrGgx from './ggx.wesl';
import { openPbrStruct } from './record';

/**
 * The coat: a clear or tinted dielectric layer over everything else, in the frame of the base or, with
 * OPENPBR_COAT_FRAME, in one of its own, given by geometry_coat_normal and geometry_coat_tangent in the frame of the
 * base. Its reflection is that of an interface (`openpbrDielectric`); what lies below is the base with other parameters
 * (`openpbr_coat_base`), times `openpbr_coat_pass`. Formulas of the specification, with these choices where it leaves
 * one:
 *
 * - The base becomes rougher as proposed for the specification's next version: refraction widens the base's highlight,
 *   a rough coat blurs it. It is never made smoother.
 * - Darkening by reflections inside the coat takes the roughness of the base as seen through the coat, and of a rough
 *   coat the facets that are typically seen; the coat's colour does not count at every bounce, only once.
 * - What the coat lets through is 1 less its albedo towards the viewer: no energy is made, but the whole is not
 *   reciprocal.
 */
export const openpbrCoat = wgslModule(
  'openpbr/coat',
  /* wgsl */ `struct OpenPbrCoat {
  alpha: vec2f,
  // See openpbr_ggx_bound.
  bound: f32,
  eta: f32,
  // Coverage times multiple-scattering compensation.
  scale: f32,
  // Directional albedo, times coverage.
  albedo: f32,
  // Probability of sampling this lobe; else it is the base.
  probability: f32,
  // 1/η².
  bend: f32,
  // Factors on the base where there is no coat, and where light comes through it towards the viewer; log2 of the
  // transmittance along the normal.
  bare: vec3f,
  through: vec3f,
  absorption: vec3f,
  //#if OPENPBR_TRANSMISSION
  // Factor on light that the base lets through upwards, so far as the viewer's side goes.
  entry: vec3f,
  //#endif
  //#if OPENPBR_COAT_FRAME
  // Tangent, bitangent and normal of the coat in the frame of the base.
  frame: mat3x3f,
  //#endif
}

//#if OPENPBR_COAT_FRAME
// The normal turns towards the viewer as far as it must, so that the coat is never seen from below.
fn openpbr_coat_frame(p: OpenPbrParameters, wo: vec3f) -> mat3x3f {
  let facing = dot(p.geometry_coat_normal, wo);
  let n = normalize(p.geometry_coat_normal + wo * max(1e-3 - facing, 0.0));
  let t = p.geometry_coat_tangent - n * dot(n, p.geometry_coat_tangent);
  // A tangent along the normal says nothing.
  let other = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(n.x) > 0.7);
  let length2 = dot(t, t);
  let tangent = normalize(select(other - n * dot(n, other), t, length2 > 1e-6));
  return mat3x3f(tangent, cross(n, tangent), n);
}
//#endif

// Its own interface, as if it were the base.
fn openpbr_coat_interface(p: OpenPbrParameters) -> OpenPbrParameters {
  var layer = p;
  layer.specular_weight = 1.0;
  layer.specular_color = vec3f(1.0);
  layer.specular_ior = p.coat_ior;
  layer.specular_roughness = p.coat_roughness;
  layer.specular_roughness_anisotropy = p.coat_roughness_anisotropy;
  // Something lies below it.
  layer.transmission_weight = 0.0;
  layer.subsurface_weight = 0.0;
  return layer;
}

// tanh, precise for small x too.
fn openpbr_coat_saturate(x: f32) -> f32 {
  return select(1.0 - 2.0 / (exp(2.0 * min(x, 20.0)) + 1.0), x * (1.0 - x * x * (0.33333333 - 0.13333333 * x * x)), x < 0.2);
}

// Roughness of the base as seen through the coat.
fn openpbr_coat_roughening(p: OpenPbrParameters) -> f32 {
  let eta = min(p.coat_ior, 1e3);
  let blur = 1.05 * (eta - 1.0) * sqrt(1.0 + eta * eta) / eta * p.coat_roughness * p.coat_roughness;
  let slope = length(vec2f(eta * p.specular_roughness * p.specular_roughness, blur));
  return max(p.specular_roughness, sqrt(0.85 * openpbr_coat_saturate(slope / 0.85)));
}

// The base below the coat: rougher, and with the step of the index that is left.
fn openpbr_coat_base(p: OpenPbrParameters) -> OpenPbrParameters {
  var base = p;
  base.specular_roughness = mix(p.specular_roughness, openpbr_coat_roughening(p), p.coat_weight);
  // The larger over the smaller: an index below that of the coat shall not reflect all light, since the rays that it
  // would do so to cannot come in through the coat.
  base.specular_ior = mix(p.specular_ior, max(p.specular_ior, p.coat_ior) / min(p.specular_ior, p.coat_ior), p.coat_weight);
  return base;
}

// 1 / cosine inside the coat.
fn openpbr_coat_path(bend: f32, mu: f32) -> f32 {
  return inverseSqrt(max(1.0 - (1.0 - mu * mu) * bend, 1e-4));
}

// log2 of what is left after one passage along the normal.
fn openpbr_coat_absorption(p: OpenPbrParameters) -> vec3f {
  return 0.5 * log2(max(p.coat_color, vec3f(1e-7)));
}

// Factor on the base by light that goes on being reflected in the coat.
fn openpbr_coat_darkening(p: OpenPbrParameters, base: OpenPbrParameters, epsilon: f32, eta: f32, mu: f32) -> vec3f {
  let inner = openpbr_dielectric_epsilon(base);
  let f0 = inner * inner;
  //#if OPENPBR_TRANSMISSION
  // What goes through the base does not come back to be darkened.
  //#if OPENPBR_SUBSURFACE
  let opaque = mix(p.base_weight * p.base_color, p.subsurface_color, p.subsurface_weight);
  //#else
  let opaque = p.base_weight * p.base_color;
  //#endif
  let dielectric = mix(mix(opaque, vec3f(1.0), p.transmission_weight), p.specular_color, f0);
  //#else
  let dielectric = mix(p.base_weight * p.base_color, p.specular_color, f0);
  //#endif
  let albedo = mix(dielectric, min(p.base_weight * p.base_color * p.specular_weight, vec3f(1.0)), p.base_metalness);
  let roughness = mix(mix(1.0, base.specular_roughness, f0), base.specular_roughness, p.base_metalness);
  let facet = mu + 0.8 * p.coat_roughness * p.coat_roughness * (1.0 - mu);
  let kept = min(mix(openpbr_fresnel_dielectric(eta, facet), openpbr_fresnel_mean(-epsilon), roughness), 0.9999);
  return mix(vec3f(1.0), (1.0 - kept) / (1.0 - kept * albedo), p.coat_weight * p.coat_darkening);
}

// Its slopes, and where it has one, its frame.
fn openpbr_coat_shape(p: OpenPbrParameters, wo: vec3f) -> OpenPbrCoat {
  var coat: OpenPbrCoat;
  //#if OPENPBR_COAT_FRAME
  coat.frame = openpbr_coat_frame(p, wo);
  //#endif
  coat.alpha = openpbr_alpha(p.coat_roughness, p.coat_roughness_anisotropy);
  coat.bound = openpbr_ggx_bound(coat.alpha, openpbr_coat_view(coat, wo));
  return coat;
}

// A direction in the coat's frame.
fn openpbr_coat_view(coat: OpenPbrCoat, w: vec3f) -> vec3f {
  //#if OPENPBR_COAT_FRAME
  return w * coat.frame;
  //#else
  return w;
  //#endif
}

// "base" is openpbr_coat_base(p); "surface" the coat's own interface.
fn openpbr_coat_prepare(shape: OpenPbrCoat, surface: OpenPbrDielectric, p: OpenPbrParameters, base: OpenPbrParameters, wo: vec3f) -> OpenPbrCoat {
  var coat = shape;
  let mu = clamp(openpbr_coat_view(coat, wo).z, 1e-5, 1.0);
  coat.eta = surface.eta;
  // Few bounces: they are left in the highlight.
  coat.scale = p.coat_weight * surface.share / max(surface.share - surface.bounced, 0.1 * surface.share + 1e-7);
  coat.albedo = p.coat_weight * surface.share;
  coat.bend = 1.0 / (coat.eta * coat.eta);
  coat.absorption = openpbr_coat_absorption(p);
  let darkening = openpbr_coat_darkening(p, base, surface.epsilon, surface.eta, mu);
  coat.bare = darkening * (1.0 - p.coat_weight);
  let passage = (p.coat_weight * (1.0 - surface.share)) * exp2(coat.absorption * openpbr_coat_path(coat.bend, mu));
  coat.through = darkening * passage;
  //#if OPENPBR_TRANSMISSION
  coat.entry = darkening * (passage + (1.0 - p.coat_weight));
  //#endif
  return coat;
}

// Factor on the base for light from the cosine mu.
fn openpbr_coat_pass(coat: OpenPbrCoat, mu: f32) -> vec3f {
  return coat.bare + coat.through * exp2(coat.absorption * openpbr_coat_path(coat.bend, mu));
}

// Factor on light that the base emits towards wo: one passage, and no darkening.
//#if OPENPBR_COAT_FRAME
fn openpbr_coat_emission(p: OpenPbrParameters, base_wo: vec3f) -> vec3f {
  let wo = base_wo * openpbr_coat_frame(p, base_wo);
//#else
fn openpbr_coat_emission(p: OpenPbrParameters, wo: vec3f) -> vec3f {
//#endif
  let mu = clamp(wo.z, 1e-5, 1.0);
  let layer = openpbr_coat_interface(p);
  let epsilon = openpbr_dielectric_epsilon(layer);
  let alpha = openpbr_alpha(layer.specular_roughness, layer.specular_roughness_anisotropy);
  let share = openpbr_energy_share(epsilon, openpbr_view_roughness(alpha, layer.specular_roughness, wo), mu);
  let eta = (1.0 + epsilon) / (1.0 - epsilon);
  return mix(vec3f(1.0), (1.0 - share) * exp2(openpbr_coat_absorption(p) * openpbr_coat_path(1.0 / (eta * eta), mu)), p.coat_weight);
}`,
  [openPbrStruct.module, openpbrGgx, openpbrFresnelDielectric, openpbrEnergy, openpbrDielectric],
);
