import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrEnergy } from './energy.wgsl';
import { openpbrFresnelDielectric } from './fresnel.wgsl';
import { openpbrGgx } from './ggx.wgsl';
import { openPbrStruct } from './record';
import { openpbrStretched } from './stretched.wgsl';

/**
 * The dielectric interface of the base: specular_weight changes its index of refraction, and with it everything else.
 * `openpbr_dielectric_epsilon` is (η - 1)/(η + 1) of the changed index: its square is the reflectance at normal
 * incidence, so specular_weight simply scales that square. The reflection's tint leaves the energy balance alone.
 *
 * What single scattering loses has bounced among the facets and forgotten where it came from: it leaves in all directions,
 * a part of it upwards (openpbr_energy_bounce), the rest downwards. The lobes of single scattering are the textbook's.
 */
export const openpbrDielectric = wgslModule(
  'openpbr/dielectric',
  /* wgsl */ `struct OpenPbrDielectric {
  eta: f32,
  epsilon: f32,
  roughness: f32,
  // Share of the energy that is reflected towards the viewer.
  share: f32,
  // The part of the share that comes from multiple scattering, and the part of the rest that does.
  bounced: f32,
  bounced_through: f32,
}

fn openpbr_dielectric_epsilon(p: OpenPbrParameters) -> f32 {
  let epsilon = (p.specular_ior - 1.0) / (p.specular_ior + 1.0);
  return sign(epsilon) * min(abs(epsilon) * sqrt(p.specular_weight), 0.9999);
}

fn openpbr_dielectric_prepare(p: OpenPbrParameters, alpha: vec2f, wo: vec3f, mu: f32) -> OpenPbrDielectric {
  var d: OpenPbrDielectric;
  d.epsilon = openpbr_dielectric_epsilon(p);
  d.eta = (1.0 + d.epsilon) / (1.0 - d.epsilon);
  d.roughness = p.specular_roughness;
  d.share = openpbr_energy_share(d.epsilon, openpbr_view_roughness(alpha, d.roughness, wo), mu);
  //#if OPENPBR_MULTISCATTER
  let bounce = openpbr_energy_bounce(d.epsilon, d.roughness);
  //#if OPENPBR_ANISOTROPY
  if (alpha.x > alpha.y) {
    let kept = openpbr_stretched(d.eta, alpha, wo);
    let lost = max(1.0 - kept.x - kept.y, 0.0);
    d.bounced = lost * bounce;
    d.bounced_through = lost - d.bounced;
    d.share = min(kept.x + d.bounced, 1.0);
    return d;
  }
  //#endif
  let lost = max(1.0 - openpbr_energy_total(d.epsilon, d.roughness, mu), 0.0);
  d.bounced = lost * bounce;
  d.bounced_through = lost - d.bounced;
  //#endif
  return d;
}`,
  [openPbrStruct.module, openpbrGgx, openpbrFresnelDielectric, openpbrEnergy, gated('OPENPBR_ANISOTROPY', openpbrStretched)],
);
