import { gated, wgslModule } from '@glanz/wgsl';
import openpbrFresnelDielectric from './fresnel_dielectric.wesl';
import { openpbrSurface } from './surface.wgsl';

/**
 * What one facet of the base does: metal, dielectric and clear part at once, and whether it reflects when it is
 * sampled.
 */
export const openpbrFacet = wgslModule(
  'openpbr/facet',
  /* wgsl */ `// A facet that sends light between two directions.
struct OpenPbrFacet {
  // Its normal, their half vector.
  h: vec3f,
  //#if OPENPBR_COAT_FRAME
  // In the coat's frame: turned there and back it would lose the digits that a narrow highlight hangs on.
  coat_h: vec3f,
  //#endif
  //#if OPENPBR_SPECULAR
  // What it reflects, all microfacet lobes of the base, and what it lets through.
  reflected: vec3f,
  //#if OPENPBR_TRANSMISSION
  through: vec3f,
  //#endif
  //#endif
}

// Films make it costly, and compilers copy it to every place that calls it: one for samples, one for pairs of directions.
fn openpbr_facet(b: OpenPbrBsdf, wo: vec3f, h: vec3f) -> OpenPbrFacet {
  var facet: OpenPbrFacet;
  facet.h = h;
  //#if OPENPBR_COAT_FRAME
  facet.coat_h = h * b.coat.frame;
  //#endif
  //#if OPENPBR_SPECULAR
  let c = clamp(dot(wo, h), 0.0, 1.0);
  //#if OPENPBR_THIN_FILM
  let film = openpbr_film_facet(b.film, c, b.film.bases);
  //#endif
  //#if OPENPBR_METAL
  //#if OPENPBR_THIN_FILM
  facet.reflected += b.metal.weight * openpbr_film_metal(b.film, b.metal.f90, film.metal, openpbr_f82(b.metal.f0, b.metal.f90, b.metal.edge, c));
  //#else
  facet.reflected += openpbr_metal_fresnel(b.metal, c);
  //#endif
  //#endif
  //#if OPENPBR_DIELECTRIC
  let opaque = openpbr_fresnel_dielectric(b.dielectric.eta, c);
  //#if OPENPBR_THIN_FILM
  facet.reflected += b.dielectric_scale * mix(vec3f(opaque), film.dielectric.reflected, b.film.weight);
  //#else
  facet.reflected += b.dielectric_scale * opaque;
  //#endif
  //#endif
  //#if OPENPBR_TRANSMISSION
  //#if OPENPBR_THIN_WALLED
  if (b.transmission.thin) {
    facet.reflected += b.transmission.mirror;
    facet.through = b.transmission.color;
    return facet;
  }
  //#endif
  let clear = openpbr_fresnel_dielectric(b.transmission.mirror_eta, c);
  facet.through = b.transmission.color * (1.0 - openpbr_fresnel_dielectric(b.transmission.fresnel_eta, c));
  //#if OPENPBR_THIN_FILM
  facet.reflected += b.transmission.mirror * mix(vec3f(clear), film.dielectric.reflected, b.film.weight);
  facet.through *= 1.0 - b.film.weight + b.film.weight * film.dielectric.through / max(1.0 - clear, 1e-6);
  //#else
  facet.reflected += b.transmission.mirror * clear;
  //#endif
  //#endif
  //#endif
  return facet;
}

//#if OPENPBR_TRANSMISSION
// Probability that a facet reflects, once it is sampled; else it lets light through.
fn openpbr_reflection_chance(b: OpenPbrBsdf, facet: OpenPbrFacet) -> f32 {
  //#if OPENPBR_THIN_WALLED
  if (b.transmission.thin) { return b.transmission.chance; }
  //#endif
  let through = dot(facet.through, vec3f(1.0));
  let reflected = dot(facet.reflected, vec3f(1.0));
  return select(1.0, min(reflected / (reflected + through), 1.0), through > 0.0);
}
//#endif`,
  [openpbrSurface, gated('OPENPBR_DIELECTRIC', openpbrFresnelDielectric)],
);
