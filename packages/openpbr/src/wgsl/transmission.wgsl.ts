import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrDielectric } from './dielectric.wgsl';
import { openpbrEnergy } from './energy.wgsl';
import { openpbrFilm } from './film.wgsl';
import openpbrGgx from './ggx.wesl';
import { openPbrStruct } from './record';

/**
 * Light through the dielectric base. Directions on the far side have z < 0.
 *
 * - A solid: refraction by GGX facets (Walter et al. 2007), the same facets and the same Fresnel factor as the
 *   reflection; masking is separable. f has no factor of η²: reflection and transmission of a clear interface add up to
 *   1 from either side, and f(o, i) = η² f(i, o).
 * - A thin wall: two parallel faces, with all reflections between them: smooth, it reflects 2R / (1 + R) and lets the
 *   rest through undeflected. Rough, that share is taken at the viewer's angle for the lobe as a whole, which is the
 *   GGX reflection, and for the light let through its mirror image, narrowed, since two refractions mostly undo each
 *   other.
 *
 * `transmission_color` tints once a crossing where `transmission_depth` is 0, and along the path through a thin wall.
 */
export const openpbrTransmission = wgslModule(
  'openpbr/transmission',
  /* wgsl */ `struct OpenPbrTransmission {
  // Index of the far side over that of the viewer's, not so near 1 that half vectors are lost.
  eta: f32,
  // The share of the dielectric that is clear.
  share: f32,
  // Factor on what facets let through: share of the surface, tint; and the albedo of that.
  color: vec3f,
  albedo: vec3f,
  // Albedo of what leaves downwards after bounces among the facets.
  bounced: vec3f,
  // Probability of going down when the cosine is sampled.
  below: f32,
  // The index as it is, for the Fresnel factor of what goes through; and that of the reflection, which a coat changes.
  fresnel_eta: f32,
  mirror_eta: f32,
  // Factor on the reflection by the clear part; the albedo of that, and of further bounces.
  mirror: vec3f,
  mirror_albedo: vec3f,
  mirror_bounced: vec3f,
  //#if OPENPBR_COAT
  // Coverage of the coat that the light leaves through; 0 from outside.
  exit: f32,
  //#endif
  //#if OPENPBR_SUBSURFACE
  // The part of "color" that enters the subsurface, per channel, and the probability of choosing it.
  subsurface: vec3f,
  subsurface_chance: f32,
  //#endif
  //#if OPENPBR_THIN_WALLED
  thin: bool,
  thin_alpha: vec2f,
  // Probability of reflection when a facet is sampled.
  chance: f32,
  //#endif
}

// "outer" is the surface without what a coat does to its index, relative to the viewer's side; "d" and "bare" the interfaces of
// the opaque and of the clear part, "weight" the share of the surface that is dielectric; "films" and "filmed" what the film
// changes there.
//#if OPENPBR_THIN_FILM
fn openpbr_transmission_prepare(outer: OpenPbrParameters, d: OpenPbrDielectric, bare: OpenPbrDielectric, films: OpenPbrFilmSums, filmed: OpenPbrFilmShare, alpha: vec2f, wo: vec3f, mu: f32, weight: f32, inside: bool) -> OpenPbrTransmission {
//#else
fn openpbr_transmission_prepare(outer: OpenPbrParameters, d: OpenPbrDielectric, bare: OpenPbrDielectric, alpha: vec2f, wo: vec3f, mu: f32, weight: f32, inside: bool) -> OpenPbrTransmission {
//#endif
  var t: OpenPbrTransmission;
  t.share = outer.transmission_weight;
  let epsilon = openpbr_dielectric_epsilon(outer);
  let bend = select(epsilon, 5e-4, abs(epsilon) < 5e-4);
  t.eta = (1.0 + bend) / (1.0 - bend);
  t.fresnel_eta = (1.0 + epsilon) / (1.0 - epsilon);
  let amount = weight * outer.transmission_weight;
  var tint = vec3f(1.0);
  if (outer.transmission_depth <= 0.0 || outer.geometry_thin_walled != 0u) { tint = outer.transmission_color; }
  //#if OPENPBR_THIN_WALLED
  t.thin = outer.geometry_thin_walled != 0u;
  if (t.thin) {
    //#if OPENPBR_THIN_FILM
    let share = clamp(d.share + filmed.more, vec3f(0.0), vec3f(1.0));
    //#else
    let share = vec3f(d.share);
    //#endif
    let reflected = 2.0 * share / (1.0 + share);
    let narrowing = clamp(0.65 * max(t.eta, 1.0 / t.eta) - 0.35, 0.0, 1.0);
    t.thin_alpha = max(alpha * (narrowing * narrowing), vec2f(1e-4));
    tint = exp2(log2(max(tint, vec3f(1e-7))) * inverseSqrt(max(1.0 - (1.0 - mu * mu) / (t.eta * t.eta), 1e-4)));
    t.mirror = (amount * reflected) * outer.specular_color;
    t.mirror_albedo = t.mirror;
    t.color = (amount * (1.0 - reflected)) * tint;
    t.albedo = t.color;
    //#if OPENPBR_MULTISCATTER
    t.mirror_bounced = t.mirror * openpbr_mirror_lost(alpha, d.roughness, wo, mu);
    t.bounced = t.color * openpbr_mirror_lost(alpha, d.roughness * narrowing, wo, mu);
    t.mirror_albedo -= t.mirror_bounced;
    t.albedo -= t.bounced;
    //#endif
    return t;
  }
  //#endif
  t.color = amount * tint;
  //#if OPENPBR_SUBSURFACE
  let enters = weight * (1.0 - t.share) * outer.subsurface_weight;
  t.share += (1.0 - t.share) * outer.subsurface_weight;
  let total = t.color + enters;
  t.subsurface = select(vec3f(0.0), enters / total, total > vec3f(0.0));
  t.subsurface_chance = select(3.0 * enters / dot(total, vec3f(1.0)), 0.0, inside || enters <= 0.0);
  t.color = total;
  //#endif
  var clear = d;
  //#if OPENPBR_COAT
  // The coat leaves the base a smaller step of the index, which reflects less, but bends the light no less in the end.
  if (!inside) { t.color *= min((1.0 - d.share + 1e-6) / (1.0 - bare.share + 1e-6), 8.0); }
  //#endif
  if (inside) { clear = bare; }
  t.mirror_eta = clear.eta;
  t.mirror = (weight * t.share) * outer.specular_color;
  t.mirror_bounced = t.mirror * clear.bounced;
  t.mirror_albedo = t.mirror * max(clear.share - clear.bounced, 0.0);
  let bounced = min(bare.bounced_through, 1.0 - bare.share);
  let direct = 1.0 - bare.share - bounced;
  //#if OPENPBR_THIN_FILM
  var changed = filmed;
  if (inside) { changed = openpbr_film_share(films.clear, bare.share); }
  t.mirror_albedo = t.mirror * max(clear.share - clear.bounced + changed.more, vec3f(0.0));
  t.bounced = t.color * max(bounced * changed.passed + direct * changed.apart, vec3f(0.0));
  t.albedo = t.color * direct * changed.direct;
  //#else
  t.bounced = t.color * bounced;
  t.albedo = t.color * direct;
  //#endif
  return t;
}

// The refracted direction; zero where everything is reflected.
fn openpbr_refract(eta: f32, wo: vec3f, h: vec3f) -> vec3f {
  let c = dot(wo, h);
  let k = 1.0 - (1.0 - c * c) / (eta * eta);
  if (min(c, k) <= 0.0) { return vec3f(0.0); }
  return normalize((c / eta - sqrt(k)) * h - wo / eta);
}

// The facet that refracts wi to wo.
fn openpbr_refract_half(eta: f32, wo: vec3f, wi: vec3f) -> vec3f {
  let h = normalize(wo + eta * wi);
  return select(h, -h, h.z < 0.0);
}

// (f · |cos θ_i| without the Fresnel factor, density of wi when h is sampled by openpbr_ggx_sample).
fn openpbr_refract_ggx(eta: f32, alpha: vec2f, wo: vec3f, wi: vec3f, h: vec3f) -> vec2f {
  let c = dot(wo, h);
  let down = -dot(wi, h);
  if (min(c, down) <= 0.0) { return vec2f(0.0); }
  let across = c / eta - down;
  let visible = 4.0 * c / (wo.z + openpbr_ggx_stretch(alpha, wo)) * openpbr_ggx_density(alpha, h);
  let pdf = visible * down / max(across * across, 1e-20);
  return pdf * vec2f(-2.0 * wi.z / (openpbr_ggx_stretch(alpha, wi) - wi.z), 1.0);
}`,
  [
    openPbrStruct.module,
    openpbrGgx,
    openpbrDielectric,
    gated('OPENPBR_MULTISCATTER', openpbrEnergy),
    gated('OPENPBR_THIN_FILM', openpbrFilm),
  ],
);
