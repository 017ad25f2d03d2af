import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrEnergy } from './energy.wgsl';
import { openpbrFresnelMetal } from './fresnel.wgsl';
import { openPbrStruct } from './record';

/**
 * The metal lobe's reflectance: F82 tint times specular_weight, not above 1. Light that single scattering loses comes
 * back as a view-dependent factor (Turquin 2019), exact in energy for white metal.
 */
export const openpbrMetal = wgslModule(
  'openpbr/metal',
  /* wgsl */ `struct OpenPbrMetal {
  // Reflectance at normal incidence, and what the edge tint takes away, times specular_weight.
  f0: vec3f,
  f90: f32,
  edge: vec3f,
  // Factor on the lobe: metalness and the multiple-scattering compensation.
  scale: vec3f,
  // Directional albedo towards the viewer, about: the reflectance at a typical visible facet, and all that bounces on.
  albedo: vec3f,
}

// view: see openpbr_mirror_view.
fn openpbr_metal_prepare(p: OpenPbrParameters, mu: f32, view: vec2f) -> OpenPbrMetal {
  let f0 = p.base_weight * p.base_color;
  var metal: OpenPbrMetal;
  let weight = min(p.specular_weight, 1e6);
  metal.f0 = weight * f0;
  metal.f90 = weight;
  metal.edge = weight * openpbr_f82_edge(f0, p.specular_color);
  metal.scale = vec3f(p.base_metalness);
  //#if OPENPBR_MULTISCATTER
  let energy = openpbr_energy_conductor(view.x, view.y);
  metal.scale *= 1.0 + min(f0 * max(weight, 1.0), vec3f(1.0)) * ((1.0 - energy) / energy);
  //#endif
  metal.albedo = openpbr_metal_fresnel(metal, mu + 0.8 * p.specular_roughness * p.specular_roughness * (1.0 - mu));
  //#if OPENPBR_MULTISCATTER
  metal.albedo *= energy;
  //#endif
  return metal;
}

fn openpbr_metal_fresnel(metal: OpenPbrMetal, c: f32) -> vec3f {
  return metal.scale * openpbr_f82(metal.f0, metal.f90, metal.edge, c);
}`,
  [openPbrStruct.module, openpbrFresnelMetal, gated('OPENPBR_MULTISCATTER', openpbrEnergy)],
);
