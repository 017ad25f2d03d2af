import { wgslModule } from '@glanz/wgsl';
import { openpbrEnergy } from './energy.wgsl';
import { openpbrFresnelDielectric } from './fresnel.wgsl';
import { openPbrStruct } from './record';

/**
 * The dielectric interface of the base: specular_weight changes its index of refraction, and with it everything else.
 * `openpbr_dielectric_epsilon` is (η - 1)/(η + 1) of the changed index: its square is the reflectance at normal
 * incidence, so specular_weight simply scales that square. The reflection's tint leaves the energy balance alone.
 */
export const openpbrDielectric = wgslModule(
  'openpbr/dielectric',
  /* wgsl */ `struct OpenPbrDielectric {
  eta: f32,
  epsilon: f32,
  roughness: f32,
  // Share of the energy that is reflected towards the viewer.
  share: f32,
  // Factor on the reflection: tint and multiple-scattering compensation.
  scale: vec3f,
}

fn openpbr_dielectric_epsilon(p: OpenPbrParameters) -> f32 {
  let epsilon = (p.specular_ior - 1.0) / (p.specular_ior + 1.0);
  return sign(epsilon) * min(abs(epsilon) * sqrt(p.specular_weight), 0.9999);
}

// view_roughness: see openpbr_view_roughness; view: see openpbr_mirror_view.
fn openpbr_dielectric_prepare(p: OpenPbrParameters, mu: f32, view_roughness: f32, view: vec2f) -> OpenPbrDielectric {
  var d: OpenPbrDielectric;
  d.epsilon = openpbr_dielectric_epsilon(p);
  d.eta = (1.0 + d.epsilon) / (1.0 - d.epsilon);
  d.roughness = p.specular_roughness;
  d.share = openpbr_energy_share(d.epsilon, view_roughness, mu);
  d.scale = p.specular_color;
  //#if OPENPBR_MULTISCATTER
  d.scale /= openpbr_energy_total(d.epsilon, view.x, view.y);
  //#endif
  return d;
}`,
  [openPbrStruct.module, openpbrFresnelDielectric, openpbrEnergy],
);
