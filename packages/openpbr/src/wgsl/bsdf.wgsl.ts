import { gated, wgslModule } from '@glanz/wgsl';
import openpbrEmission from './emission.wesl';
import openpbrOpacity from './opacity.wesl';
import openpbrMedium from './medium.wesl';
import openpbrPhase from './phase.wesl';
import { openpbrSample } from './sample.wgsl';
import { openpbrScatter } from './scatter.wgsl';
import openpbrSubsurface from './subsurface.wesl';

/**
 * The whole surface. Directions are unit vectors in the local frame (+z shading normal, +x tangent), away from the
 * surface; the host turns the frame so that the viewer is above. With `wo` below the surface everything is zero, and
 * with `wi` below so it is unless the surface lets light through.
 *
 * ```wgsl
 * fn openpbr_prepare(p: OpenPbrParameters, wo: vec3f) -> OpenPbrBsdf      // once per hit; the rest takes the same wo
 * fn openpbr_prepare_side(p: OpenPbrParameters, wo: vec3f, side: OpenPbrSide) -> OpenPbrBsdf // with
 * OPENPBR_TRANSMISSION: from either side fn openpbr_eval(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec3f // f · |cos
 * θ_i| fn openpbr_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> f32 // density of openpbr_sample, per solid angle fn
 * openpbr_eval_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec4f // both for the price of one: (f · |cos θ_i|, pdf) fn
 * openpbr_sample(b: OpenPbrBsdf, wo: vec3f, u: vec3f) -> OpenPbrSample // u uniform in [0, 1)³ fn openpbr_albedo(b:
 * OpenPbrBsdf, wo: vec3f) -> vec3f // reflected and transmitted part of uniform light, approximate for tinted metal fn
 * openpbr_emission(p: OpenPbrParameters, wo: vec3f) -> vec3f // radiance fn openpbr_opacity(p: OpenPbrParameters) ->
 * f32
 * ```
 *
 * Metal and dielectric share one microfacet lobe: they differ by the Fresnel factor only. Diffuse reflection and what
 * bounces on between the facets are sampled by the cosine. The diffuse lobe below the
 * dielectric is weighted by (1 - E(μ_i))(1 - E(μ_o))/(1 - E_mean), which is reciprocal and loses nothing (Ashikhmin,
 * Premože and Shirley 2000; Kelemen and Szirmay-Kalos 2001). A thin film takes the place of the
 * Fresnel factor, and tints what goes through. A coat and fuzz add a lobe each and scale the rest.
 *
 * Transmission: `OpenPbrSide` says where the viewer is, `inside` the object or not, and the index of refraction of what
 * is outside of it; a thin wall has no inside. A facet, once sampled, reflects or refracts by chance, as its Fresnel
 * factor says. From inside there is no coat to be seen, only its colour on what leaves, and reflections have no tint.
 * The opaque part of a half transparent surface looks the same from inside as from outside.
 */
export const openpbr = wgslModule(
  'openpbr',
  /* wgsl */ `fn openpbr_eval_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec4f {
  //#if !OPENPBR_TRANSMISSION
  if (min(wo.z, wi.z) <= 0.0) { return vec4f(0.0); }
  //#endif
  var h = openpbr_half(wo, wi);
  //#if OPENPBR_TRANSMISSION
  if (wi.z < 0.0) { h = openpbr_through_half(b, wo, wi); }
  //#endif
  return openpbr_scatter(b, wo, wi, openpbr_facet(b, wo, h));
}

fn openpbr_eval(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec3f {
  return openpbr_eval_pdf(b, wo, wi).xyz;
}

fn openpbr_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> f32 {
  return openpbr_eval_pdf(b, wo, wi).w;
}

fn openpbr_albedo(b: OpenPbrBsdf, wo: vec3f) -> vec3f {
  return select(vec3f(0.0), min(b.albedo, vec3f(1.0)), wo.z > 0.0);
}`,
  [
    openpbrEmission,
    openpbrOpacity,
    openpbrScatter,
    openpbrSample,
    gated('OPENPBR_TRANSMISSION', openpbrMedium),
    gated('OPENPBR_TRANSMISSION', openpbrPhase),
    gated('OPENPBR_SUBSURFACE', openpbrSubsurface),
  ],
);
