import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrFresnelDielectric } from './fresnel.wgsl';
import { openpbrGgx } from './ggx.wgsl';
import { openpbrInside } from './inside.wgsl';
import { openpbrSeen } from './seen.wgsl';

/**
 * `openpbr_stretched(eta, alpha, wo)`: the parts of the light that a dielectric with a stretched highlight reflects and
 * lets through by single scattering, seen from `wo`. The energy tables know round highlights only; this is a sum over
 * facets as they are seen. From outside over 64, on the cap of visible normals at steps of the golden ratio, closer at the
 * cap's ends; from inside see `openpbr_inside`.
 *
 * Tried, largest error (and in the mean square) over 300 interfaces of indices 1.1 to 2.5, roughness 0.05 to 1, anisotropy
 * 0.2 to 0.9: from outside 64 facets by Gauss and Legendre 0.011; as here 0.0028 (0.0009).
 */
export const openpbrStretched = wgslModule(
  'openpbr/stretched',
  /* wgsl */ `fn openpbr_stretched(eta: f32, alpha: vec2f, wo: vec3f) -> vec2f {
  //#if OPENPBR_INNER
  if (eta < 1.0) { return openpbr_inside(eta, alpha, wo); }
  //#endif
  let azimuth = openpbr_ggx_azimuth(alpha, wo);
  var kept = vec2f(0.0);
  for (var i = 0u; i < 64u; i++) {
    let at = (f32(i) + 0.5) * 0.015625;
    let place = openpbr_circle(fract(f32(i) * 0.618034));
    let u = clamp(at, 0.002, 0.998);
    let h = openpbr_ggx_cap(alpha, wo, vec2f(azimuth.x * place.x - azimuth.y * place.y, azimuth.x * place.y + azimuth.y * place.x), u * u * (3.0 - 2.0 * u), 1.0);
    let seen = openpbr_facet_seen(eta, alpha, wo, h);
    let reflectance = openpbr_fresnel_dielectric(eta, clamp(dot(wo, h), 0.0, 1.0));
    kept += vec2f(reflectance * seen.x, (1.0 - reflectance) * seen.y) * (0.09375 * at * (1.0 - at));
  }
  return kept;
}`,
  [openpbrGgx, openpbrFresnelDielectric, openpbrSeen, gated('OPENPBR_INNER', openpbrInside)],
);
