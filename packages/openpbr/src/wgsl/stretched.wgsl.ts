import { wgslModule } from '@glanz/wgsl';
import { openpbrFresnelDielectric } from './fresnel.wgsl';
import { openpbrGgx } from './ggx.wgsl';

/**
 * `openpbr_stretched(eta, alpha, wo)`: the parts of the light that a dielectric with a stretched highlight reflects and
 * lets through by single scattering, seen from `wo`. The energy tables know round highlights only; this is a sum over 64
 * facets as they are seen, over the cap of visible normals at steps of the golden ratio, closer at the cap's ends.
 *
 * From inside the reflectance jumps up at the critical angle, right through the facets: each stands for its surroundings,
 * with the mean reflectance of four facets around it. Tried, largest error of the sum over indices 1.2 to 2.4, roughness
 * 0.3 to 1, anisotropy to 0.9: 32 facets by Gauss and Legendre 0.011 from outside, 0.065 from inside; 64 as here 0.006 and
 * 0.038 without the means, 0.021 with them, 0.005 in the mean square.
 */
export const openpbrStretched = wgslModule(
  'openpbr/stretched',
  /* wgsl */ `// The facet at a place of the cap: turns around its axis, and along it.
fn openpbr_stretched_facet(alpha: vec2f, wo: vec3f, azimuth: vec2f, at: vec2f) -> vec3f {
  let place = openpbr_circle(fract(at.x));
  let u = clamp(at.y, 0.002, 0.998);
  return openpbr_ggx_cap(alpha, wo, vec2f(azimuth.x * place.x - azimuth.y * place.y, azimuth.x * place.y + azimuth.y * place.x), u * u * (3.0 - 2.0 * u), 1.0);
}

fn openpbr_stretched(eta: f32, alpha: vec2f, wo: vec3f) -> vec2f {
  let azimuth = openpbr_ggx_azimuth(alpha, wo);
  let so = openpbr_ggx_stretch(alpha, wo);
  var kept = vec2f(0.0);
  for (var i = 0u; i < 64u; i++) {
    let at = vec2f(f32(i) * 0.618034, (f32(i) + 0.5) * 0.015625);
    // The facet itself comes last.
    var h = vec3f(0.0);
    var c = 0.0;
    var reflectance = 0.0;
    var offset = vec2f(-0.034375, -0.01375);
    for (var k = select(4u, 0u, eta < 1.0); k < 5u; k++) {
      h = openpbr_stretched_facet(alpha, wo, azimuth, at + select(offset, vec2f(0.0), k == 4u));
      c = clamp(dot(wo, h), 0.0, 1.0);
      reflectance += select(1.0, select(0.25, 0.0, k == 4u), eta < 1.0) * openpbr_fresnel_dielectric(eta, c);
      offset = vec2f(-offset.y, offset.x);
    }
    let mirrored = 2.0 * c * h - wo;
    let refracted = (c / eta - sqrt(max(1.0 - (1.0 - c * c) / (eta * eta), 1e-6))) * h - wo / eta;
    let up = select(0.0, mirrored.z * (wo.z + so) / (wo.z * openpbr_ggx_stretch(alpha, mirrored) + mirrored.z * so), mirrored.z > 0.0);
    let down = select(0.0, 2.0 * refracted.z / (refracted.z - openpbr_ggx_stretch(alpha, refracted)), refracted.z < 0.0);
    kept += vec2f(reflectance * up, (1.0 - reflectance) * down) * (0.09375 * at.y * (1.0 - at.y));
  }
  return kept;
}`,
  [openpbrGgx, openpbrFresnelDielectric],
);
