import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrEnergy } from './energy.wgsl';
import openpbrFresnelDielectric from './fresnel_dielectric.wesl';
import openpbrGgx from './ggx.wesl';
import { openpbrInside } from './inside.wgsl';
import { openPbrStruct } from './record';
import { openpbrStretched } from './stretched.wgsl';
import { INNER_SUM_NODES, INSIDE_NEAR } from '../tables/layout';

/**
 * The dielectric interface of the base: specular_weight changes its index of refraction, and with it everything else.
 * `openpbr_dielectric_epsilon` is (η - 1)/(η + 1) of the changed index: its square is the reflectance at normal
 * incidence, so specular_weight simply scales that square. The reflection's tint leaves the energy balance alone.
 *
 * What single scattering loses has bounced among the facets and forgotten where it came from: it leaves in all
 * directions, a part of it upwards (openpbr_energy_bounce), the rest downwards. The lobes of single scattering are the
 * textbook's.
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
  //#if OPENPBR_INNER_SUMS
  // Seen from the denser side, summed over facets; and the share's mean where something opaque lies below (0 until it is seen),
  // else negative.
  summed: bool,
  mean: f32,
  //#endif
}

fn openpbr_dielectric_epsilon(p: OpenPbrParameters) -> f32 {
  let epsilon = (p.specular_ior - 1.0) / (p.specular_ior + 1.0);
  return sign(epsilon) * min(abs(epsilon) * sqrt(p.specular_weight), 0.9999);
}

// With what single scattering reflects and lets through.
fn openpbr_dielectric_summed(given: OpenPbrDielectric, kept: vec2f) -> OpenPbrDielectric {
  var d = given;
  let lost = max(1.0 - kept.x - kept.y, 0.0);
  let bounced = lost * openpbr_energy_bounce(d.epsilon, d.roughness);
  d.share = min(kept.x + bounced, 1.0);
  //#if OPENPBR_MULTISCATTER
  d.bounced = bounced;
  d.bounced_through = lost - bounced;
  //#endif
  return d;
}

// The parts of the light that single scattering reflects and lets through, where tables are too coarse.
fn openpbr_dielectric_kept(eta: f32, alpha: vec2f, wo: vec3f) -> vec2f {
  //#if OPENPBR_ANISOTROPY
  return openpbr_stretched(eta, alpha, wo);
  //#else
  //#if OPENPBR_INNER_SUMS
  return openpbr_inside(eta, alpha, wo);
  //#else
  return vec2f(0.0);
  //#endif
  //#endif
}

// Share of light from wi that the interface reflects, as it has it for a viewer there, so that what goes down and comes up
// again is the same both ways; but for stretched highlights, where it is that of the tables.
fn openpbr_light_share(d: OpenPbrDielectric, alpha: vec2f, wi: vec3f) -> f32 {
  //#if OPENPBR_INNER_SUMS
  // Only indices below 1 are: the sum from outside would be text for nothing.
  if (d.summed) { return openpbr_dielectric_summed(d, openpbr_inside(d.eta, alpha, wi)).share; }
  //#endif
  return openpbr_energy_share(d.epsilon, openpbr_view_roughness(alpha, d.roughness, wi), wi.z);
}

// All but what openpbr_dielectric_seen works out.
fn openpbr_dielectric(p: OpenPbrParameters) -> OpenPbrDielectric {
  var d: OpenPbrDielectric;
  d.epsilon = openpbr_dielectric_epsilon(p);
  d.eta = (1.0 + d.epsilon) / (1.0 - d.epsilon);
  d.roughness = p.specular_roughness;
  //#if OPENPBR_INNER_SUMS
  // Where something lies below the interface, and near index 1. For what is clear alone the tables do, since nothing but the
  // choice of samples hangs on its share.
  let opaque = (1.0 - p.transmission_weight) * select(1.0 - p.subsurface_weight, 1.0, p.geometry_thin_walled != 0u) > 0.0;
  d.summed = d.epsilon < 0.0 && (d.epsilon > -${INSIDE_NEAR} || opaque);
  d.mean = select(-1.0, 0.0, d.summed && opaque);
  //#endif
  return d;
}

// As it is seen from wo.
fn openpbr_dielectric_seen(given: OpenPbrDielectric, alpha: vec2f, wo: vec3f) -> OpenPbrDielectric {
  var d = given;
  var summed = false;
  //#if OPENPBR_INNER_SUMS
  summed = d.summed;
  //#endif
  //#if OPENPBR_ANISOTROPY
  //#if OPENPBR_MULTISCATTER
  summed = summed || alpha.x > alpha.y;
  //#endif
  //#endif
  //#if OPENPBR_INNER_SUMS
  if (summed) {
    // First as it is seen, then for the mean: Gauss's nodes on either side of the critical angle.
    var nodes = array<vec2f, ${INNER_SUM_NODES.length}>(${INNER_SUM_NODES.map(([x, weight]) => `vec2f(${x}, ${weight})`).join(', ')});
    let critical = sqrt(max(1.0 - d.eta * d.eta, 0.0));
    let mean = d.mean >= 0.0;
    let count = select(1u, ${2 * INNER_SUM_NODES.length + 1}u, mean);
    var result = d;
    var through = 0.0;
    for (var i = 0u; i < count; i++) {
      let node = nodes[(max(i, 1u) - 1u) >> 1u];
      let is_above = (i & 1u) == 0u;
      let m = select(critical * (1.0 - node.x * node.x), critical + (1.0 - critical) * node.x * node.x, is_above);
      let w = select(vec3f(sqrt(max(1.0 - m * m, 0.0)), 0.0, m), wo, i == 0u);
      let flat = vec2f(max(d.roughness * d.roughness, 1e-4));
      let seen = openpbr_dielectric_summed(d, openpbr_dielectric_kept(d.eta, select(flat, alpha, i == 0u), w));
      if (i == 0u) { result = seen; } else { through += (1.0 - seen.share) * m * select(critical, 1.0 - critical, is_above) * node.x * node.y; }
    }
    if (mean) { result.mean = 1.0 - 4.0 * through; }
    return result;
  }
  //#else
  //#if OPENPBR_ANISOTROPY
  if (summed) { return openpbr_dielectric_summed(d, openpbr_dielectric_kept(d.eta, alpha, wo)); }
  //#endif
  //#endif
  let mu = clamp(wo.z, 1e-5, 1.0);
  d.share = openpbr_energy_share(d.epsilon, openpbr_view_roughness(alpha, d.roughness, wo), mu);
  //#if OPENPBR_MULTISCATTER
  let bounce = openpbr_energy_bounce(d.epsilon, d.roughness);
  let lost = max(openpbr_energy_total_lost(d.epsilon, d.roughness, mu), 0.0);
  d.bounced = lost * bounce;
  d.bounced_through = lost - d.bounced;
  //#endif
  return d;
}`,
  [
    openPbrStruct.module,
    openpbrGgx,
    openpbrFresnelDielectric,
    openpbrEnergy,
    gated('OPENPBR_ANISOTROPY', openpbrStretched),
    gated('OPENPBR_INNER_SUMS', openpbrInside),
  ],
);
