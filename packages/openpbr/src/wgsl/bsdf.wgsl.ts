import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrCoat } from './coat.wgsl';
import { openpbrDielectric } from './dielectric.wgsl';
import { openpbrCosine, openpbrEon } from './diffuse.wgsl';
import { openpbrEmission, openpbrOpacity } from './emission.wgsl';
import { openpbrGgx } from './ggx.wgsl';
import { openpbrMetal } from './metal.wgsl';
import { openpbrFuzz } from './fuzz.wgsl';
import { openpbrMedium } from './medium.wgsl';
import { openpbrPhase } from './phase.wgsl';
import { openPbrStruct } from './record';
import { openpbrSubsurface } from './subsurface.wgsl';
import { openpbrTransmission } from './transmission.wgsl';

/**
 * The whole surface. Directions are unit vectors in the local frame (+z shading normal, +x tangent), away from the
 * surface; the host turns the frame so that the viewer is above. With `wo` below the surface everything is zero, and with
 * `wi` below so it is unless the surface lets light through.
 *
 * ```wgsl
 * fn openpbr_prepare(p: OpenPbrParameters, wo: vec3f) -> OpenPbrBsdf      // once per hit; the rest takes the same wo
 * fn openpbr_prepare_side(p: OpenPbrParameters, wo: vec3f, side: OpenPbrSide) -> OpenPbrBsdf // with OPENPBR_TRANSMISSION: from either side
 * fn openpbr_eval(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec3f          // f · |cos θ_i|
 * fn openpbr_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> f32             // density of openpbr_sample, per solid angle
 * fn openpbr_eval_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec4f      // both for the price of one: (f · |cos θ_i|, pdf)
 * fn openpbr_sample(b: OpenPbrBsdf, wo: vec3f, u: vec3f) -> OpenPbrSample // u uniform in [0, 1)³
 * fn openpbr_albedo(b: OpenPbrBsdf, wo: vec3f) -> vec3f                   // reflected and transmitted part of uniform light, approximate for tinted metal
 * fn openpbr_emission(p: OpenPbrParameters, wo: vec3f) -> vec3f           // radiance
 * fn openpbr_opacity(p: OpenPbrParameters) -> f32
 * ```
 *
 * Metal and dielectric share one microfacet lobe: they differ by the Fresnel factor only. Diffuse reflection and what
 * bounces on between the facets are sampled by the cosine. The diffuse lobe below the
 * dielectric is weighted by (1 - E(μ_i))(1 - E(μ_o))/(1 - E_mean), which is reciprocal and loses nothing (Ashikhmin,
 * Premože and Shirley 2000; Kelemen and Szirmay-Kalos 2001). A coat and fuzz add a lobe each and
 * scale the rest.
 *
 * Transmission: `OpenPbrSide` says where the viewer is, `inside` the object or not, and the index of refraction of what is
 * outside of it; a thin wall has no inside. A facet, once sampled, reflects or refracts by chance, as its Fresnel factor
 * says. From inside there is no coat to be seen, only its colour on what leaves, and reflections have no tint. The opaque
 * part of a half transparent surface looks the same from inside as from outside.
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
  // Factor on its reflection, and albedo of what bounces on between its facets.
  dielectric_scale: vec3f,
  dielectric_bounced: vec3f,
  //#endif
  //#if OPENPBR_TRANSMISSION
  transmission: OpenPbrTransmission,
  //#endif
  //#if OPENPBR_THIN_SUBSURFACE
  subsurface: OpenPbrThinSubsurface,
  //#endif
  //#if OPENPBR_COAT
  coat: OpenPbrCoat,
  //#endif
  //#if OPENPBR_FUZZ
  fuzz: OpenPbrFuzz,
  //#endif
}

struct OpenPbrSample {
  wi: vec3f,
  pdf: f32,
  // f · |cos θ_i| / pdf of the whole mixture.
  weight: vec3f,
  valid: bool,
  // wi is on the other side.
  transmitted: bool,
  // It goes into the subsurface's medium, not into the transparent interior; the weight is for this choice.
  subsurface: bool,
}

//#if OPENPBR_TRANSMISSION
struct OpenPbrSide {
  // Whether the viewer is in the object's interior.
  inside: bool,
  // Index of refraction of what is outside of the object: 1, or that of the medium around.
  outer_ior: f32,
}

fn openpbr_prepare(p: OpenPbrParameters, wo: vec3f) -> OpenPbrBsdf {
  return openpbr_prepare_side(p, wo, OpenPbrSide(false, 1.0));
}

fn openpbr_prepare_side(given: OpenPbrParameters, wo: vec3f, side: OpenPbrSide) -> OpenPbrBsdf {
  // Indices relative to what is outside. From inside there is no coat in front.
  var whole = given;
  whole.specular_ior = given.specular_ior / side.outer_ior;
  whole.coat_ior = given.coat_ior / side.outer_ior;
  whole.coat_weight = select(given.coat_weight, 0.0, side.inside);
  whole.fuzz_weight = select(given.fuzz_weight, 0.0, side.inside);
//#else
//#if OPENPBR_COAT
fn openpbr_prepare(whole: OpenPbrParameters, wo: vec3f) -> OpenPbrBsdf {
//#else
fn openpbr_prepare(p: OpenPbrParameters, wo: vec3f) -> OpenPbrBsdf {
//#endif
//#endif
  //#if OPENPBR_COAT
  let p = openpbr_coat_base(whole);
  //#else
  //#if OPENPBR_TRANSMISSION
  let p = whole;
  //#endif
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
  //#if OPENPBR_TRANSMISSION
  var face = p;
  face.specular_color = select(p.specular_color, vec3f(1.0), side.inside);
  b.dielectric = openpbr_dielectric_prepare(face, b.alpha, wo, mu);
  var outer = face;
  outer.specular_ior = select(whole.specular_ior, 1.0 / whole.specular_ior, side.inside);
  b.transmission = openpbr_transmission_prepare(outer, b.dielectric, b.alpha, wo, mu, b.dielectric_weight, side.inside);
  b.dielectric_scale = (b.dielectric_weight * (1.0 - b.transmission.share)) * face.specular_color;
  b.diffuse_scale *= 1.0 - p.transmission_weight;
  //#if OPENPBR_SUBSURFACE
  b.diffuse_scale *= 1.0 - p.subsurface_weight;
  //#endif
  //#else
  b.dielectric = openpbr_dielectric_prepare(p, b.alpha, wo, mu);
  b.dielectric_scale = b.dielectric_weight * p.specular_color;
  //#endif
  b.dielectric_bounced = b.dielectric_scale * b.dielectric.bounced;
  specular += b.dielectric_scale * max(b.dielectric.share - b.dielectric.bounced, 0.0);
  //#if OPENPBR_TRANSMISSION
  specular += b.transmission.mirror_albedo;
  b.dielectric_bounced += b.transmission.mirror_bounced;
  //#endif
  b.diffuse_scale *= 1.0 - b.dielectric.share;
  //#endif
  //#if OPENPBR_THIN_SUBSURFACE
  b.subsurface = openpbr_thin_subsurface_prepare(p, b.dielectric_weight * (1.0 - b.dielectric.share));
  //#endif
  b.albedo = specular;
  b.specular_probability = 1.0;
  //#if OPENPBR_TRANSMISSION
  b.albedo += b.transmission.albedo + b.transmission.bounced;
  //#if OPENPBR_THIN_SUBSURFACE
  b.albedo += b.subsurface.through * b.subsurface.color;
  //#endif
  //#if OPENPBR_THIN_WALLED
  let facets = dot(specular + b.transmission.albedo, vec3f(1.0));
  b.transmission.chance = select(1.0, min(dot(specular, vec3f(1.0)) / facets, 1.0), facets > 0.0);
  //#endif
  //#endif
  //#if OPENPBR_COSINE
  var spread = vec3f(0.0);
  //#if OPENPBR_METAL
  spread += b.metal.bounced;
  //#endif
  //#if OPENPBR_DIELECTRIC
  spread += b.dielectric_bounced;
  //#endif
  //#if OPENPBR_DIFFUSE
  b.diffuse_color = p.base_color;
  b.diffuse_roughness = p.base_diffuse_roughness;
  let diffuse = b.diffuse_scale * p.base_color;
  spread += diffuse;
  //#if OPENPBR_THIN_SUBSURFACE
  spread += b.subsurface.back * b.subsurface.color;
  //#endif
  //#if OPENPBR_DIELECTRIC
  let reflected = openpbr_energy_share_mean(b.dielectric.epsilon, b.dielectric.roughness);
  b.diffuse_scale /= max(1.0 - reflected, 1e-4);
  //#if OPENPBR_DIFFUSE_ROUGHNESS
  // EON is not as even as Lambert: where it peaks, the weights would give back more than they get.
  b.diffuse_scale *= 1.0 - 0.08 * b.diffuse_roughness * reflected;
  //#endif
  //#if OPENPBR_THIN_SUBSURFACE
  b.subsurface.coupling = (1.0 - 0.08 * p.base_diffuse_roughness * reflected) / max(1.0 - reflected, 1e-4);
  //#endif
  //#endif
  //#endif
  b.albedo += spread;
  //#if OPENPBR_TRANSMISSION
  let bright = dot(specular + b.transmission.albedo, vec3f(1.0));
  //#else
  let bright = dot(specular, vec3f(1.0));
  //#endif
  //#if OPENPBR_TRANSMISSION
  var beneath = b.transmission.bounced;
  //#if OPENPBR_THIN_SUBSURFACE
  beneath += b.subsurface.through * b.subsurface.color;
  //#endif
  let down = dot(beneath, vec3f(1.0));
  let total = bright + down + dot(spread, vec3f(1.0));
  b.transmission.below = select(0.0, min(down / (down + dot(spread, vec3f(1.0))), 1.0), down > 0.0);
  //#else
  let total = bright + dot(spread, vec3f(1.0));
  //#endif
  b.specular_probability = select(0.5, min(bright / total, 1.0), total > 0.0);
  //#endif
  //#if OPENPBR_COAT
  b.coat = openpbr_coat_prepare(whole, p, wo, mu);
  // A highlight comes from about as low as it is seen, spread light from everywhere.
  b.albedo = specular * openpbr_coat_pass(b.coat, mu);
  //#if OPENPBR_COSINE
  b.albedo += spread * openpbr_coat_pass(b.coat, 0.66666667);
  //#endif
  //#if OPENPBR_TRANSMISSION
  b.transmission.exit = select(0.0, given.coat_weight, side.inside);
  //#if OPENPBR_COSINE
  b.albedo += (b.transmission.albedo + beneath) * openpbr_coat_through(b, mu);
  //#else
  b.albedo += b.transmission.albedo * openpbr_coat_through(b, mu);
  //#endif
  //#endif
  let below = dot(b.albedo, vec3f(1.0));
  b.albedo += b.coat.albedo;
  b.coat.probability = select(0.5, 3.0 * b.coat.albedo / (below + 3.0 * b.coat.albedo), below + b.coat.albedo > 0.0);
  //#endif
  //#if OPENPBR_FUZZ
  //#if OPENPBR_TRANSMISSION
  b.fuzz = openpbr_fuzz_prepare(whole, wo, mu);
  //#else
  b.fuzz = openpbr_fuzz_prepare(p, wo, mu);
  //#endif
  let covered = dot(b.albedo, vec3f(b.fuzz.below));
  let fibres = dot(b.fuzz.color, vec3f(1.0));
  b.fuzz.probability = select(0.5, fibres / (fibres + covered), fibres + covered > 0.0);
  b.albedo = b.albedo * b.fuzz.below + b.fuzz.color;
  //#endif
  return b;
}

//#if OPENPBR_TRANSMISSION
//#if OPENPBR_COAT
// Factor of the coat on light that goes through the base, with the cosine on the far side.
fn openpbr_coat_through(b: OpenPbrBsdf, mu: f32) -> vec3f {
  return b.coat.entry * mix(vec3f(1.0), exp2(b.coat.absorption * openpbr_coat_path(b.coat.bend, mu)), b.transmission.exit);
}
//#endif
//#endif

//#if OPENPBR_DIFFUSE
fn openpbr_diffuse(color: vec3f, roughness: f32, wo: vec3f, wi: vec3f) -> vec3f {
  //#if OPENPBR_DIFFUSE_ROUGHNESS
  return openpbr_eon(color, roughness, wo, wi);
  //#else
  return color * 0.31830989;
  //#endif
}

// Cosine, and what the interface lets through on the way of the light to the diffuse lobe.
fn openpbr_diffuse_pass(b: OpenPbrBsdf, wi: vec3f) -> f32 {
  //#if OPENPBR_DIELECTRIC
  return wi.z * (1.0 - openpbr_energy_share(b.dielectric.epsilon, openpbr_view_roughness(b.alpha, b.dielectric.roughness, wi), wi.z));
  //#else
  return wi.z;
  //#endif
}
//#endif

//#if OPENPBR_SPECULAR
// Reflectance of a facet seen at cosine c, all microfacet lobes of the base.
fn openpbr_reflectance(b: OpenPbrBsdf, c: f32) -> vec3f {
  var result = vec3f(0.0);
  //#if OPENPBR_METAL
  result += openpbr_metal_fresnel(b.metal, c);
  //#endif
  //#if OPENPBR_DIELECTRIC
  result += b.dielectric_scale * openpbr_fresnel_dielectric(b.dielectric.eta, c);
  //#endif
  //#if OPENPBR_TRANSMISSION
  var mirror = 1.0;
  //#if OPENPBR_THIN_WALLED
  if (!b.transmission.thin) { mirror = openpbr_fresnel_dielectric(b.transmission.mirror_eta, c); }
  //#else
  mirror = openpbr_fresnel_dielectric(b.transmission.mirror_eta, c);
  //#endif
  result += b.transmission.mirror * mirror;
  //#endif
  return result;
}
//#endif

//#if OPENPBR_TRANSMISSION
// Probability that a facet reflects, once it is sampled; else it lets light through.
fn openpbr_reflection_chance(b: OpenPbrBsdf, reflectance: vec3f, c: f32) -> f32 {
  //#if OPENPBR_THIN_WALLED
  if (b.transmission.thin) { return b.transmission.chance; }
  //#endif
  let through = dot(b.transmission.color, vec3f(1.0 - openpbr_fresnel_dielectric(b.transmission.fresnel_eta, c)));
  let reflected = dot(reflectance, vec3f(1.0));
  return select(1.0, min(reflected / (reflected + through), 1.0), through > 0.0);
}

// (f · |cos θ_i|, pdf) of a pair of directions on either side, with its facet.
fn openpbr_scatter_through(b: OpenPbrBsdf, wo: vec3f, wi: vec3f, h: vec3f) -> vec4f {
  if (wo.z <= 0.0) { return vec4f(0.0); }
  let c = clamp(dot(wo, h), 0.0, 1.0);
  let reflectance = openpbr_reflectance(b, c);
  let probability = b.specular_probability * (1.0 - openpbr_reflection_chance(b, reflectance, c));
  var ggx: vec2f;
  //#if OPENPBR_THIN_WALLED
  if (b.transmission.thin) {
    ggx = openpbr_ggx(b.transmission.thin_alpha, wo, vec3f(wi.xy, -wi.z), h);
  } else {
    ggx = openpbr_refract_ggx(b.transmission.eta, b.alpha, wo, wi, h) * vec2f(1.0 - openpbr_fresnel_dielectric(b.transmission.fresnel_eta, c), 1.0);
  }
  //#else
  ggx = openpbr_refract_ggx(b.transmission.eta, b.alpha, wo, wi, h) * vec2f(1.0 - openpbr_fresnel_dielectric(b.transmission.fresnel_eta, c), 1.0);
  //#endif
  var result = vec4f(b.transmission.color * ggx.x, probability * ggx.y);
  //#if OPENPBR_COSINE
  result -= vec4f(b.transmission.bounced, (1.0 - b.specular_probability) * b.transmission.below) * (wi.z * 0.31830989);
  //#if OPENPBR_THIN_SUBSURFACE
  let mirrored = vec3f(wi.xy, -wi.z);
  result += vec4f(openpbr_diffuse(b.subsurface.color, b.diffuse_roughness, wo, mirrored) * (b.subsurface.through * b.subsurface.coupling * openpbr_diffuse_pass(b, mirrored)), 0.0);
  //#endif
  //#endif
  //#if OPENPBR_COAT
  result *= vec4f(openpbr_coat_through(b, -wi.z), 1.0 - b.coat.probability);
  //#endif
  //#if OPENPBR_FUZZ
  result *= vec4f(vec3f(b.fuzz.below), 1.0 - b.fuzz.probability);
  //#endif
  return result;
}
//#endif

// (f · |cos θ_i|, pdf) of a pair of directions with its half vector.
fn openpbr_scatter(b: OpenPbrBsdf, wo: vec3f, wi: vec3f, h: vec3f) -> vec4f {
  //#if OPENPBR_TRANSMISSION
  if (wi.z < 0.0) { return openpbr_scatter_through(b, wo, wi, h); }
  //#endif
  if (min(wo.z, wi.z) <= 0.0) { return vec4f(0.0); }
  var result = vec4f(0.0);
  //#if OPENPBR_SPECULAR
  let c = clamp(dot(wo, h), 0.0, 1.0);
  let ggx = openpbr_ggx(b.alpha, wo, wi, h);
  let reflectance = openpbr_reflectance(b, c);
  var facet_probability = b.specular_probability;
  //#if OPENPBR_TRANSMISSION
  facet_probability *= openpbr_reflection_chance(b, reflectance, c);
  //#endif
  result += vec4f(reflectance * ggx.x, facet_probability * ggx.y);
  //#endif
  //#if OPENPBR_COSINE
  var probability = 1.0;
  //#if OPENPBR_SPECULAR
  probability -= b.specular_probability;
  //#endif
  //#if OPENPBR_TRANSMISSION
  probability *= 1.0 - b.transmission.below;
  //#endif
  result.w += probability * wi.z * 0.31830989;
  //#if OPENPBR_DIELECTRIC
  result += vec4f(b.dielectric_bounced * (wi.z * 0.31830989), 0.0);
  //#endif
  //#if OPENPBR_METAL
  //#if OPENPBR_MULTISCATTER
  result += vec4f(openpbr_metal_bounced(b.metal, b.alpha, wi), 0.0);
  //#endif
  //#endif
  //#endif
  //#if OPENPBR_DIFFUSE
  let diffuse_pass = openpbr_diffuse_pass(b, wi);
  result += vec4f(openpbr_diffuse(b.diffuse_color, b.diffuse_roughness, wo, wi) * (b.diffuse_scale * diffuse_pass), 0.0);
  //#if OPENPBR_THIN_SUBSURFACE
  result += vec4f(openpbr_diffuse(b.subsurface.color, b.diffuse_roughness, wo, wi) * (b.subsurface.back * b.subsurface.coupling * diffuse_pass), 0.0);
  //#endif
  //#endif
  //#if OPENPBR_COAT
  //#if OPENPBR_COAT_FRAME
  let coat_wi = wi * b.coat.frame;
  let top = select(vec2f(0.0), openpbr_ggx(b.coat.alpha, wo * b.coat.frame, vec3f(coat_wi.xy, max(coat_wi.z, 1e-5)), h * b.coat.frame), coat_wi.z > 0.0);
  let coat_mu = max(coat_wi.z, 1e-5);
  //#else
  let top = openpbr_ggx(b.coat.alpha, wo, wi, h);
  let coat_mu = wi.z;
  //#endif
  let mirrored = b.coat.scale * openpbr_fresnel_dielectric(b.coat.eta, c) * top.x;
  result = vec4f(result.xyz * openpbr_coat_pass(b.coat, coat_mu) + mirrored, mix(result.w, top.y, b.coat.probability));
  //#endif
  //#if OPENPBR_FUZZ
  let fibres = openpbr_fuzz(b.fuzz, wi);
  result = vec4f(result.xyz * b.fuzz.below + b.fuzz.color * fibres, mix(result.w, fibres, b.fuzz.probability));
  //#endif
  return result;
}

// The half vector; stays finite where two grazing directions cancel.
fn openpbr_half(wo: vec3f, wi: vec3f) -> vec3f {
  let h = wo + wi;
  return normalize(vec3f(h.xy, max(h.z, 1e-7)));
}

//#if OPENPBR_TRANSMISSION
// The facet that lets light through from wi to wo.
fn openpbr_through_half(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec3f {
  //#if OPENPBR_THIN_WALLED
  if (b.transmission.thin) { return openpbr_half(wo, vec3f(wi.xy, -wi.z)); }
  //#endif
  return openpbr_refract_half(b.transmission.eta, wo, wi);
}
//#endif

fn openpbr_eval_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec4f {
  //#if OPENPBR_TRANSMISSION
  if (wi.z < 0.0) { return openpbr_scatter_through(b, wo, wi, openpbr_through_half(b, wo, wi)); }
  //#endif
  return openpbr_scatter(b, wo, wi, openpbr_half(wo, wi));
}

fn openpbr_eval(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec3f {
  return openpbr_eval_pdf(b, wo, wi).xyz;
}

fn openpbr_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> f32 {
  return openpbr_eval_pdf(b, wo, wi).w;
}

//#if OPENPBR_FUZZ
fn openpbr_sample(b: OpenPbrBsdf, wo: vec3f, numbers: vec3f) -> OpenPbrSample {
  let fuzzy = numbers.z < b.fuzz.probability;
  let u = vec3f(numbers.xy, min((numbers.z - b.fuzz.probability) / max(1.0 - b.fuzz.probability, 1e-7), 0.99999994));
//#else
fn openpbr_sample(b: OpenPbrBsdf, wo: vec3f, u: vec3f) -> OpenPbrSample {
//#endif
  var s: OpenPbrSample;
  var h = vec3f(0.0, 0.0, 1.0);
  //#if OPENPBR_SUBSURFACE
  var medium = 1.0;
  //#endif
  //#if OPENPBR_SPECULAR
  //#if OPENPBR_COAT
  let top = u.z < b.coat.probability;
  let chosen = u.z - b.coat.probability;
  let limit = (1.0 - b.coat.probability) * b.specular_probability;
  //#if OPENPBR_FUZZ
  if (fuzzy) {
    s.wi = openpbr_fuzz_sample(b.fuzz, u.xy);
    h = openpbr_half(wo, s.wi);
  } else
  //#endif
  if (top || chosen < limit) {
    var alpha = select(b.alpha, b.coat.alpha, top);
  //#else
  let chosen = u.z;
  let limit = b.specular_probability;
  //#if OPENPBR_FUZZ
  if (fuzzy) {
    s.wi = openpbr_fuzz_sample(b.fuzz, u.xy);
    h = openpbr_half(wo, s.wi);
  } else
  //#endif
  if (chosen < limit) {
    var alpha = b.alpha;
  //#endif
    //#if OPENPBR_TRANSMISSION
    // What is left of the random number tells whether the facet reflects.
    let side = chosen / limit;
    //#if OPENPBR_THIN_WALLED
    if (b.transmission.thin && side >= b.transmission.chance) { alpha = b.transmission.thin_alpha; }
    //#endif
    //#endif
    //#if OPENPBR_COAT_FRAME
    h = openpbr_ggx_sample(alpha, select(wo, wo * b.coat.frame, top), u.xy);
    h = select(h, b.coat.frame * h, top);
    //#else
    h = openpbr_ggx_sample(alpha, wo, u.xy);
    //#endif
    s.wi = 2.0 * dot(wo, h) * h - wo;
    //#if OPENPBR_COAT_FRAME
    // Down below the coat's plane: lost, though it may be above that of the base.
    if (top && dot(s.wi, b.coat.frame[2]) <= 0.0) { return s; }
    //#endif
    //#if OPENPBR_TRANSMISSION
    let c = clamp(dot(wo, h), 0.0, 1.0);
    // Below 0 for the coat, which always reflects.
    let chance = openpbr_reflection_chance(b, openpbr_reflectance(b, c), c);
    s.transmitted = side >= chance;
    //#if OPENPBR_SUBSURFACE
    medium = (side - chance) / (1.0 - chance);
    //#endif
    if (s.transmitted) {
      //#if OPENPBR_THIN_WALLED
      if (b.transmission.thin) { s.wi.z = -s.wi.z; } else { s.wi = openpbr_refract(b.transmission.eta, wo, h); }
      //#else
      s.wi = openpbr_refract(b.transmission.eta, wo, h);
      //#endif
    }
    // A facet may reflect downwards or refract upwards: lost.
    if (s.transmitted != (s.wi.z < 0.0)) { return s; }
    //#endif
  }
  //#if OPENPBR_COSINE
  else {
    s.wi = openpbr_cosine_sample(u.xy);
    h = openpbr_half(wo, s.wi);
    //#if OPENPBR_TRANSMISSION
    //#if OPENPBR_COAT
    let rest = 1.0 - b.coat.probability - limit;
    //#else
    let rest = 1.0 - limit;
    //#endif
    s.transmitted = chosen - limit < b.transmission.below * rest;
    //#if OPENPBR_SUBSURFACE
    medium = (chosen - limit) / (b.transmission.below * rest);
    //#endif
    if (s.transmitted) {
      s.wi.z = -s.wi.z;
      h = openpbr_through_half(b, wo, s.wi);
    }
    //#endif
  }
  //#endif
  //#else
  s.wi = openpbr_cosine_sample(u.xy);
  //#if OPENPBR_FUZZ
  if (fuzzy) { s.wi = openpbr_fuzz_sample(b.fuzz, u.xy); }
  //#endif
  //#endif
  let f = openpbr_scatter(b, wo, s.wi, h);
  s.pdf = f.w;
  s.valid = f.w > 0.0;
  s.weight = select(vec3f(0.0), f.xyz / f.w, s.valid);
  //#if OPENPBR_SUBSURFACE
  let enters = b.transmission.subsurface_chance;
  if (s.transmitted && enters > 0.0) {
    s.subsurface = medium < enters;
    s.weight *= select((1.0 - b.transmission.subsurface) / (1.0 - enters), b.transmission.subsurface / enters, s.subsurface);
  }
  //#endif
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
    gated('OPENPBR_TRANSMISSION', openpbrTransmission),
    gated('OPENPBR_TRANSMISSION', openpbrMedium),
    gated('OPENPBR_TRANSMISSION', openpbrPhase),
    gated('OPENPBR_SUBSURFACE', openpbrSubsurface),
    gated('OPENPBR_COAT', openpbrCoat),
    gated('OPENPBR_FUZZ', openpbrFuzz),
    gated('OPENPBR_COSINE', openpbrCosine),
    gated('OPENPBR_DIFFUSE_ROUGHNESS', openpbrEon),
  ],
);
