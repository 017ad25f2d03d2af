import { gated, wgslModule } from '@glanz/wgsl';
import openpbrEon from './eon.wesl';
import openpbrCosine from './cosine.wesl';
import openpbrFacet from './facet.wesl';
import { openpbrPrepare } from './prepare.wgsl';

/**
 * (f · |cos θ_i|, pdf) of a pair of directions and its facet, all lobes together: on the same side, and through the
 * surface.
 */
export const openpbrScatter = wgslModule(
  'openpbr/scatter',
  /* wgsl */ `//#if OPENPBR_TRANSMISSION
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
  let passes = wi.z * (1.0 - openpbr_light_share(b.dielectric, b.alpha, wi));
  //#if OPENPBR_DIFFUSE_ROUGHNESS
  return passes * openpbr_diffuse_gain(b.diffuse_grazing, wi.z);
  //#else
  return passes;
  //#endif
  //#else
  return wi.z;
  //#endif
}
//#endif

//#if OPENPBR_TRANSMISSION
// (f · |cos θ_i|, pdf) of a pair of directions on either side, with its facet.
fn openpbr_scatter_through(b: OpenPbrBsdf, wo: vec3f, wi: vec3f, facet: OpenPbrFacet) -> vec4f {
  if (wo.z <= 0.0) { return vec4f(0.0); }
  let probability = b.specular_probability * (1.0 - openpbr_reflection_chance(b, facet));
  var ggx: vec2f;
  //#if OPENPBR_THIN_WALLED
  if (b.transmission.thin) {
    ggx = openpbr_ggx(b.transmission.thin_alpha, wo, vec3f(wi.xy, -wi.z), facet.h, 1.0);
  } else {
    ggx = openpbr_refract_ggx(b.transmission.eta, b.alpha, wo, wi, facet.h);
  }
  //#else
  ggx = openpbr_refract_ggx(b.transmission.eta, b.alpha, wo, wi, facet.h);
  //#endif
  var result = vec4f(facet.through * ggx.x, probability * ggx.y);
  //#if OPENPBR_COSINE
  result -= vec4f(b.transmission.bounced, (1.0 - b.specular_probability) * b.transmission.below) * (wi.z * 0.31830989);
  //#if OPENPBR_THIN_SUBSURFACE
  let mirrored = vec3f(wi.xy, -wi.z);
  result += vec4f(openpbr_below_film(b, openpbr_diffuse(b.subsurface.color, b.diffuse_roughness, wo, mirrored)) * (b.subsurface.through * b.subsurface.coupling * openpbr_diffuse_pass(b, mirrored)), 0.0);
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

// (f · |cos θ_i|, pdf) of a pair of directions with its facet.
fn openpbr_scatter(b: OpenPbrBsdf, wo: vec3f, wi: vec3f, facet: OpenPbrFacet) -> vec4f {
  //#if OPENPBR_TRANSMISSION
  if (wi.z < 0.0) { return openpbr_scatter_through(b, wo, wi, facet); }
  //#endif
  if (min(wo.z, wi.z) <= 0.0) { return vec4f(0.0); }
  var result = vec4f(0.0);
  //#if OPENPBR_SPECULAR
  let ggx = openpbr_ggx(b.alpha, wo, wi, facet.h, b.bound);
  var facet_probability = b.specular_probability;
  //#if OPENPBR_TRANSMISSION
  facet_probability *= openpbr_reflection_chance(b, facet);
  //#endif
  result += vec4f(facet.reflected * ggx.x, facet_probability * ggx.y);
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
  result += vec4f(openpbr_below_film(b, openpbr_diffuse(b.diffuse_color, b.diffuse_roughness, wo, wi)) * (b.diffuse_scale * diffuse_pass), 0.0);
  //#if OPENPBR_THIN_SUBSURFACE
  result += vec4f(openpbr_below_film(b, openpbr_diffuse(b.subsurface.color, b.diffuse_roughness, wo, wi)) * (b.subsurface.back * b.subsurface.coupling * diffuse_pass), 0.0);
  //#endif
  //#endif
  //#if OPENPBR_COAT
  //#if OPENPBR_COAT_FRAME
  let coat_wi = wi * b.coat.frame;
  let top = select(vec2f(0.0), openpbr_ggx(b.coat.alpha, wo * b.coat.frame, vec3f(coat_wi.xy, max(coat_wi.z, 1e-5)), facet.coat_h, b.coat.bound), coat_wi.z > 0.0);
  let coat_mu = max(coat_wi.z, 1e-5);
  //#else
  let top = openpbr_ggx(b.coat.alpha, wo, wi, facet.h, b.coat.bound);
  let coat_mu = wi.z;
  //#endif
  let mirrored = b.coat.scale * openpbr_fresnel_dielectric(b.coat.eta, clamp(dot(wo, facet.h), 0.0, 1.0)) * top.x;
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
//#endif`,
  [
    openpbrPrepare,
    openpbrFacet,
    gated('OPENPBR_COSINE', openpbrCosine),
    gated('OPENPBR_DIFFUSE_ROUGHNESS', openpbrEon),
  ],
);
