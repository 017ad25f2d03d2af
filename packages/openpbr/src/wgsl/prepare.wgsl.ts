import { gated, wgslModule } from '@glanz/wgsl';
import openpbrEon from './eon.wesl';
import openpbrGgx from './ggx.wesl';
import openpbrInterfaces from './interfaces.wesl';
import { openPbrStruct } from './record';
import openpbrSurface from './surface.wesl';

/**
 * `openpbr_prepare` and, with OPENPBR_TRANSMISSION, `openpbr_prepare_side`: weights of the lobes, albedos, and the
 * probabilities of sampling each.
 */
export const openpbrPrepare = wgslModule(
  'openpbr/prepare',
  /* wgsl */ `//#if OPENPBR_TRANSMISSION
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
  b.bound = openpbr_ggx_bound(b.alpha, wo);
  //#endif
  //#if OPENPBR_INTERFACE
  var interfaces: OpenPbrInterfaces;
  var wanted = 0u;
  //#if OPENPBR_DIELECTRIC
  wanted = OPENPBR_SEE_BASE;
  //#if OPENPBR_TRANSMISSION
  var face = p;
  face.specular_color = select(p.specular_color, vec3f(1.0), side.inside);
  interfaces.base = openpbr_dielectric(face);
  var outer = face;
  outer.specular_ior = select(whole.specular_ior, 1.0 / whole.specular_ior, side.inside);
  // From inside nothing opaque lies beyond it.
  var beyond = outer;
  beyond.transmission_weight = select(outer.transmission_weight, 1.0, side.inside);
  interfaces.bare = openpbr_dielectric(beyond);
  //#if OPENPBR_COAT
  let clear = p.geometry_thin_walled == 0u && max(p.transmission_weight, p.subsurface_weight) > 0.0;
  //#else
  let clear = side.inside;
  //#endif
  wanted |= select(0u, OPENPBR_SEE_BARE, clear);
  //#else
  interfaces.base = openpbr_dielectric(p);
  //#endif
  //#endif
  //#if OPENPBR_COAT
  b.coat = openpbr_coat_shape(whole, wo);
  interfaces.coat = openpbr_dielectric(openpbr_coat_interface(whole));
  wanted |= select(0u, OPENPBR_SEE_COAT, whole.coat_weight > 0.0);
  interfaces = openpbr_interfaces_seen(interfaces, wanted, b.alpha, wo, b.coat);
  //#else
  interfaces = openpbr_interfaces_seen(interfaces, wanted, b.alpha, wo);
  //#endif
  //#if OPENPBR_TRANSMISSION
  //#if !OPENPBR_COAT
  if (!side.inside) { interfaces.bare = interfaces.base; }
  //#endif
  //#endif
  //#endif
  //#if OPENPBR_THIN_FILM
  //#if OPENPBR_TRANSMISSION
  b.film = openpbr_film_prepare(whole, side.outer_ior, side.inside);
  //#else
  //#if OPENPBR_COAT
  b.film = openpbr_film_prepare(whole, 1.0, false);
  //#else
  b.film = openpbr_film_prepare(p, 1.0, false);
  //#endif
  //#endif
  //#endif
  //#if OPENPBR_METAL
  //#if OPENPBR_THIN_FILM
  b.metal = openpbr_metal_prepare(p, b.film, b.alpha, wo, mu);
  //#else
  b.metal = openpbr_metal_prepare(p, b.alpha, wo, mu);
  //#endif
  specular += b.metal.albedo;
  b.dielectric_weight -= p.base_metalness;
  //#endif
  b.diffuse_scale = b.dielectric_weight * p.base_weight;
  //#if OPENPBR_DIELECTRIC
  b.dielectric = interfaces.base;
  //#if OPENPBR_TRANSMISSION
  //#if OPENPBR_THIN_FILM
  let epsilon = openpbr_dielectric_epsilon(outer);
  let films = openpbr_film_sums(b.film, vec2f(b.dielectric.eta, (1.0 + epsilon) / (1.0 - epsilon)), b.alpha, wo);
  let filmed = openpbr_film_share(films.opaque, b.dielectric.share);
  b.film.passed = filmed.passed;
  b.transmission = openpbr_transmission_prepare(outer, b.dielectric, interfaces.bare, films, filmed, b.alpha, wo, mu, b.dielectric_weight, side.inside);
  //#else
  b.transmission = openpbr_transmission_prepare(outer, b.dielectric, interfaces.bare, b.alpha, wo, mu, b.dielectric_weight, side.inside);
  //#endif
  b.bound = select(b.bound, 1.0, b.transmission.share > 0.0);
  b.dielectric_scale = (b.dielectric_weight * (1.0 - b.transmission.share)) * face.specular_color;
  b.diffuse_scale *= 1.0 - p.transmission_weight;
  //#if OPENPBR_SUBSURFACE
  b.diffuse_scale *= 1.0 - p.subsurface_weight;
  //#endif
  //#else
  b.dielectric_scale = b.dielectric_weight * p.specular_color;
  //#if OPENPBR_THIN_FILM
  let filmed = openpbr_film_share(openpbr_film_sums(b.film, vec2f(b.dielectric.eta), b.alpha, wo).opaque, b.dielectric.share);
  b.film.passed = filmed.passed;
  //#endif
  //#endif
  b.dielectric_bounced = b.dielectric_scale * b.dielectric.bounced;
  //#if OPENPBR_THIN_FILM
  specular += b.dielectric_scale * max(b.dielectric.share - b.dielectric.bounced + filmed.more, vec3f(0.0));
  //#else
  specular += b.dielectric_scale * max(b.dielectric.share - b.dielectric.bounced, 0.0);
  //#endif
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
  b.albedo += b.subsurface.through * openpbr_below_film(b, b.subsurface.color);
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
  let diffuse = b.diffuse_scale * openpbr_below_film(b, p.base_color);
  spread += diffuse;
  //#if OPENPBR_THIN_SUBSURFACE
  spread += b.subsurface.back * openpbr_below_film(b, b.subsurface.color);
  //#endif
  //#if OPENPBR_DIELECTRIC
  var reflected: f32;
  //#if OPENPBR_INNER_SUMS
  reflected = b.dielectric.mean;
  if (reflected < 0.0) { reflected = openpbr_energy_share_mean(b.dielectric.epsilon, b.dielectric.roughness); }
  //#else
  reflected = openpbr_energy_share_mean(b.dielectric.epsilon, b.dielectric.roughness);
  //#endif
  //#if OPENPBR_ANISOTROPY
  reflected = openpbr_energy_stretched_mean(b.dielectric.epsilon, b.alpha, b.dielectric.roughness, reflected);
  //#endif
  var coupling = 1.0 / max(1.0 - reflected, 1e-4);
  //#if OPENPBR_DIFFUSE_ROUGHNESS
  b.diffuse_grazing = openpbr_diffuse_grazing(b.diffuse_roughness, b.dielectric.roughness, reflected, b.dielectric.epsilon);
  coupling *= openpbr_diffuse_gain(b.diffuse_grazing, mu) * openpbr_diffuse_even(b.diffuse_roughness, reflected, b.dielectric.epsilon);
  //#endif
  b.diffuse_scale *= coupling;
  //#if OPENPBR_THIN_SUBSURFACE
  b.subsurface.coupling = coupling;
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
  beneath += b.subsurface.through * openpbr_below_film(b, b.subsurface.color);
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
  b.coat = openpbr_coat_prepare(b.coat, interfaces.coat, whole, p, wo);
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

// A colour below the interface, with what a film makes of it.
fn openpbr_below_film(b: OpenPbrBsdf, color: vec3f) -> vec3f {
  //#if OPENPBR_THIN_FILM
  //#if OPENPBR_DIELECTRIC
  return color * b.film.passed;
  //#else
  return color;
  //#endif
  //#else
  return color;
  //#endif
}`,
  [
    openPbrStruct.module,
    openpbrSurface,
    gated('OPENPBR_INTERFACE', openpbrInterfaces),
    gated('OPENPBR_SPECULAR', openpbrGgx),
    gated('OPENPBR_DIFFUSE_ROUGHNESS', openpbrEon),
  ],
);
