import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrEnergy } from './energy.wgsl';
import { openpbrFilm } from './film.wgsl';
import openpbrFresnelMetal from './fresnel_metal.wesl';
import openpbrGgx from './ggx.wesl';
import { openPbrStruct } from './record';

/**
 * The metal lobe's reflectance: F82 tint times specular_weight, not above 1. Light that single scattering loses comes
 * back in all directions, coloured by its further bounces (Kulla and Conty 2017): a lobe of its own, smooth and
 * reciprocal, sampled with the diffuse one; exact in energy for white metal.
 */
export const openpbrMetal = wgslModule(
  'openpbr/metal',
  /* wgsl */ `struct OpenPbrMetal {
  // Reflectance at normal incidence, and what the edge tint takes away, times specular_weight.
  f0: vec3f,
  f90: f32,
  edge: vec3f,
  // Metalness.
  weight: f32,
  // Directional albedo of single scattering towards the viewer, about: the reflectance at a typical visible facet.
  albedo: vec3f,
  roughness: f32,
  // Directional albedo of multiple scattering, and its mean loss.
  bounced: vec3f,
  mean_lost: f32,
}

//#if OPENPBR_THIN_FILM
fn openpbr_metal_prepare(p: OpenPbrParameters, film: OpenPbrFilm, alpha: vec2f, wo: vec3f, mu: f32) -> OpenPbrMetal {
//#else
fn openpbr_metal_prepare(p: OpenPbrParameters, alpha: vec2f, wo: vec3f, mu: f32) -> OpenPbrMetal {
//#endif
  let f0 = p.base_weight * p.base_color;
  var metal: OpenPbrMetal;
  let f90 = min(p.specular_weight, 1e6);
  metal.weight = p.base_metalness;
  metal.f0 = f90 * f0;
  metal.f90 = f90;
  metal.edge = f90 * openpbr_f82_edge(f0, p.specular_color);
  let seen = mu + 0.8 * p.specular_roughness * p.specular_roughness * (1.0 - mu);
  var tint = openpbr_f82(metal.f0, f90, metal.edge, seen);
  var mean = openpbr_f82_mean(metal.f0, f90, metal.edge);
  //#if OPENPBR_THIN_FILM
  // Either facet below the film, by one loop, as in openpbr_film_facet; over the bases that are metal.
  let bases = min(film.bases, vec2u(3u));
  for (var i = 0u; i < min(bases.y - bases.x, 2u); i++) {
    let color = openpbr_film_facet(film, select(0.7, seen, i == 0u), bases).metal;
    if (i == 0u) { tint = openpbr_film_metal(film, f90, color, tint); } else { mean = openpbr_film_metal(film, f90, color, mean); }
  }
  //#endif
  metal.albedo = metal.weight * tint;
  //#if OPENPBR_MULTISCATTER
  metal.roughness = p.specular_roughness;
  metal.mean_lost = max(openpbr_mirror_lost_mean(alpha, metal.roughness), 1e-7);
  let lost = openpbr_mirror_lost(alpha, metal.roughness, wo, mu);
  metal.albedo *= 1.0 - lost;
  let limit = clamp(f90, 1e-6, 1.0);
  metal.bounced = metal.weight * lost * (1.0 - metal.mean_lost) * mean * mean / max(limit - mean * metal.mean_lost, vec3f(1e-7));
  //#endif
  return metal;
}

fn openpbr_metal_fresnel(metal: OpenPbrMetal, c: f32) -> vec3f {
  return metal.weight * openpbr_f82(metal.f0, metal.f90, metal.edge, c);
}

//#if OPENPBR_MULTISCATTER
// f · cos θ_i of multiple scattering.
fn openpbr_metal_bounced(metal: OpenPbrMetal, alpha: vec2f, wi: vec3f) -> vec3f {
  return metal.bounced * (openpbr_mirror_lost(alpha, metal.roughness, wi, wi.z) / metal.mean_lost * wi.z * 0.31830989);
}
//#endif`,
  [
    openPbrStruct.module,
    openpbrGgx,
    openpbrFresnelMetal,
    gated('OPENPBR_MULTISCATTER', openpbrEnergy),
    gated('OPENPBR_THIN_FILM', openpbrFilm),
  ],
);
