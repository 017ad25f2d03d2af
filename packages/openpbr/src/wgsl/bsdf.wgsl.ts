import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrCoat } from './coat.wgsl';
import { openpbrDielectric } from './dielectric.wgsl';
import { openpbrCosine, openpbrEon } from './diffuse.wgsl';
import { openpbrEmission, openpbrOpacity } from './emission.wgsl';
import { openpbrGgx } from './ggx.wgsl';
import { openpbrMetal } from './metal.wgsl';
import { openPbrStruct } from './record';

/**
 * The whole surface. Directions are unit vectors in the local frame (+z shading normal, +x tangent), away from the
 * surface; the host turns the frame so that the viewer is above. With `wo` or `wi` below the surface everything is zero.
 *
 * ```wgsl
 * fn openpbr_prepare(p: OpenPbrParameters, wo: vec3f) -> OpenPbrBsdf      // once per hit; the rest takes the same wo
 * fn openpbr_eval(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec3f          // f · |cos θ_i|
 * fn openpbr_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> f32             // density of openpbr_sample, per solid angle
 * fn openpbr_eval_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec4f      // both for the price of one: (f · |cos θ_i|, pdf)
 * fn openpbr_sample(b: OpenPbrBsdf, wo: vec3f, u: vec3f) -> OpenPbrSample // u uniform in [0, 1)³
 * fn openpbr_albedo(b: OpenPbrBsdf, wo: vec3f) -> vec3f                   // reflected part of uniform light, approximate for tinted metal
 * fn openpbr_emission(p: OpenPbrParameters, wo: vec3f) -> vec3f           // radiance
 * fn openpbr_opacity(p: OpenPbrParameters) -> f32
 * ```
 *
 * Metal and dielectric share one microfacet lobe: they differ by the Fresnel factor only. Diffuse reflection and what
 * bounces on between the facets of metal are sampled by the cosine. The diffuse lobe below the
 * dielectric is weighted by (1 - E(μ_i))(1 - E(μ_o))/(1 - E_mean), which is reciprocal and loses nothing (Ashikhmin,
 * Premože and Shirley 2000; Kelemen and Szirmay-Kalos 2001). A coat adds a lobe of its own and scales the rest.
 */
export const openpbr = wgslModule(
  'openpbr',
  /* wgsl */ `struct OpenPbrBsdf {
  alpha: vec2f,
  // Probability of sampling the microfacet lobe; else it is the cosine.
  specular_probability: f32,
  // Factor on the diffuse lobe, without its colour.
  diffuse_scale: f32,
  diffuse_color: vec3f,
  diffuse_roughness: f32,
  // Directional albedo.
  albedo: vec3f,
  dielectric_weight: f32,
  //#if OPENPBR_METAL
  metal: OpenPbrMetal,
  //#endif
  //#if OPENPBR_DIELECTRIC
  dielectric: OpenPbrDielectric,
  //#endif
  //#if OPENPBR_COAT
  coat: OpenPbrCoat,
  //#endif
}

struct OpenPbrSample {
  wi: vec3f,
  pdf: f32,
  // f · |cos θ_i| / pdf of the whole mixture.
  weight: vec3f,
  valid: bool,
}

//#if OPENPBR_COAT
fn openpbr_prepare(whole: OpenPbrParameters, wo: vec3f) -> OpenPbrBsdf {
  let p = openpbr_coat_base(whole);
  //#else
fn openpbr_prepare(p: OpenPbrParameters, wo: vec3f) -> OpenPbrBsdf {
  //#endif
  var b: OpenPbrBsdf;
  let mu = clamp(wo.z, 1e-5, 1.0);
  var specular = vec3f(0.0);
  b.dielectric_weight = 1.0;
  //#if OPENPBR_SPECULAR
  b.alpha = openpbr_alpha(p.specular_roughness, p.specular_roughness_anisotropy);
  //#endif
  //#if OPENPBR_METAL
  b.metal = openpbr_metal_prepare(p, b.alpha, wo, mu);
  specular += b.metal.albedo;
  b.dielectric_weight -= p.base_metalness;
  //#endif
  b.diffuse_scale = b.dielectric_weight * p.base_weight;
  //#if OPENPBR_DIELECTRIC
  b.dielectric = openpbr_dielectric_prepare(p, b.alpha, wo, mu);
  specular += b.dielectric_weight * b.dielectric.share * p.specular_color;
  b.diffuse_scale *= 1.0 - b.dielectric.share;
  //#endif
  b.albedo = specular;
  b.specular_probability = 1.0;
  //#if OPENPBR_COSINE
  var spread = vec3f(0.0);
  //#if OPENPBR_METAL
  spread += b.metal.bounced;
  //#endif
  //#if OPENPBR_DIFFUSE
  b.diffuse_color = p.base_color;
  b.diffuse_roughness = p.base_diffuse_roughness;
  let diffuse = b.diffuse_scale * p.base_color;
  spread += diffuse;
  //#if OPENPBR_DIELECTRIC
  let reflected = openpbr_energy_share_mean(b.dielectric.epsilon, b.dielectric.roughness);
  b.diffuse_scale /= max(1.0 - reflected, 1e-4);
  //#if OPENPBR_DIFFUSE_ROUGHNESS
  // EON is not as even as Lambert: where it peaks, the weights would give back more than they get.
  b.diffuse_scale *= 1.0 - 0.08 * b.diffuse_roughness * reflected;
  //#endif
  //#endif
  //#endif
  b.albedo += spread;
  let bright = dot(specular, vec3f(1.0));
  let total = bright + dot(spread, vec3f(1.0));
  b.specular_probability = select(0.5, bright / total, total > 0.0);
  //#endif
  //#if OPENPBR_COAT
  b.coat = openpbr_coat_prepare(whole, p, wo, mu);
  // A highlight comes from about as low as it is seen, spread light from everywhere.
  b.albedo = specular * openpbr_coat_pass(b.coat, mu);
  //#if OPENPBR_COSINE
  b.albedo += spread * openpbr_coat_pass(b.coat, 0.66666667);
  //#endif
  let below = dot(b.albedo, vec3f(1.0));
  b.albedo += b.coat.albedo;
  b.coat.probability = select(0.5, 3.0 * b.coat.albedo / (below + 3.0 * b.coat.albedo), below + b.coat.albedo > 0.0);
  //#endif
  return b;
}

// (f · |cos θ_i|, pdf) of a pair of directions with its half vector.
fn openpbr_scatter(b: OpenPbrBsdf, wo: vec3f, wi: vec3f, h: vec3f) -> vec4f {
  if (min(wo.z, wi.z) <= 0.0) { return vec4f(0.0); }
  var result = vec4f(0.0);
  //#if OPENPBR_SPECULAR
  let c = clamp(dot(wo, h), 0.0, 1.0);
  let ggx = openpbr_ggx(b.alpha, wo, wi, h);
  var reflectance = vec3f(0.0);
  //#if OPENPBR_METAL
  reflectance += openpbr_metal_fresnel(b.metal, c);
  //#endif
  //#if OPENPBR_DIELECTRIC
  reflectance += b.dielectric.scale * (b.dielectric_weight * openpbr_fresnel_dielectric(b.dielectric.eta, c));
  //#endif
  result += vec4f(reflectance * ggx.x, b.specular_probability * ggx.y);
  //#endif
  //#if OPENPBR_COSINE
  var probability = 1.0;
  //#if OPENPBR_SPECULAR
  probability -= b.specular_probability;
  //#endif
  result.w += probability * wi.z * 0.31830989;
  //#if OPENPBR_METAL
  //#if OPENPBR_MULTISCATTER
  result += vec4f(openpbr_metal_bounced(b.metal, b.alpha, wi), 0.0);
  //#endif
  //#endif
  //#endif
  //#if OPENPBR_DIFFUSE
  var scale = b.diffuse_scale * wi.z;
  //#if OPENPBR_DIELECTRIC
  scale *= 1.0 - openpbr_energy_share(b.dielectric.epsilon, openpbr_view_roughness(b.alpha, b.dielectric.roughness, wi), wi.z);
  //#endif
  //#if OPENPBR_DIFFUSE_ROUGHNESS
  let diffuse = openpbr_eon(b.diffuse_color, b.diffuse_roughness, wo, wi);
  //#else
  let diffuse = b.diffuse_color * 0.31830989;
  //#endif
  result += vec4f(diffuse * scale, 0.0);
  //#endif
  //#if OPENPBR_COAT
  let top = openpbr_ggx(b.coat.alpha, wo, wi, h);
  let mirrored = b.coat.scale * openpbr_fresnel_dielectric(b.coat.eta, c) * top.x;
  result = vec4f(result.xyz * openpbr_coat_pass(b.coat, wi.z) + mirrored, mix(result.w, top.y, b.coat.probability));
  //#endif
  return result;
}

// The half vector; stays finite where two grazing directions cancel.
fn openpbr_half(wo: vec3f, wi: vec3f) -> vec3f {
  let h = wo + wi;
  return normalize(vec3f(h.xy, max(h.z, 1e-7)));
}

fn openpbr_eval_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec4f {
  return openpbr_scatter(b, wo, wi, openpbr_half(wo, wi));
}

fn openpbr_eval(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec3f {
  return openpbr_eval_pdf(b, wo, wi).xyz;
}

fn openpbr_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> f32 {
  return openpbr_eval_pdf(b, wo, wi).w;
}

fn openpbr_sample(b: OpenPbrBsdf, wo: vec3f, u: vec3f) -> OpenPbrSample {
  var s: OpenPbrSample;
  var h = vec3f(0.0, 0.0, 1.0);
  //#if OPENPBR_SPECULAR
  //#if OPENPBR_COAT
  let top = u.z < b.coat.probability;
  if (top || u.z - b.coat.probability < (1.0 - b.coat.probability) * b.specular_probability) {
    h = openpbr_ggx_sample(select(b.alpha, b.coat.alpha, top), wo, u.xy);
  //#else
  if (u.z < b.specular_probability) {
    h = openpbr_ggx_sample(b.alpha, wo, u.xy);
  //#endif
    s.wi = 2.0 * dot(wo, h) * h - wo;
  }
  //#if OPENPBR_COSINE
  else {
    s.wi = openpbr_cosine_sample(u.xy);
    h = openpbr_half(wo, s.wi);
  }
  //#endif
  //#else
  s.wi = openpbr_cosine_sample(u.xy);
  //#endif
  let f = openpbr_scatter(b, wo, s.wi, h);
  s.pdf = f.w;
  s.valid = f.w > 0.0;
  s.weight = select(vec3f(0.0), f.xyz / f.w, s.valid);
  return s;
}

fn openpbr_albedo(b: OpenPbrBsdf, wo: vec3f) -> vec3f {
  return select(vec3f(0.0), min(b.albedo, vec3f(1.0)), wo.z > 0.0);
}`,
  [
    openPbrStruct.module,
    openpbrEmission,
    openpbrOpacity,
    gated('OPENPBR_SPECULAR', openpbrGgx),
    gated('OPENPBR_METAL', openpbrMetal),
    gated('OPENPBR_DIELECTRIC', openpbrDielectric),
    gated('OPENPBR_COAT', openpbrCoat),
    gated('OPENPBR_COSINE', openpbrCosine),
    gated('OPENPBR_DIFFUSE_ROUGHNESS', openpbrEon),
  ],
);
