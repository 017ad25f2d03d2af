import { wgslModule } from '@glanz/wgsl';
import { openpbrGgx } from './ggx.wgsl';

/** `openpbr_facet_seen(eta, alpha, wo, h)`: what the facet `h` mirrors to where it is seen, and what it refracts to there; 0 or less where it does not. */
export const openpbrSeen = wgslModule(
  'openpbr/seen',
  /* wgsl */ `fn openpbr_facet_seen(eta: f32, alpha: vec2f, wo: vec3f, h: vec3f) -> vec2f {
  let c = clamp(dot(wo, h), 0.0, 1.0);
  let so = openpbr_ggx_stretch(alpha, wo);
  let mirrored = 2.0 * c * h - wo;
  let refracted = (c / eta - sqrt(max(1.0 - (1.0 - c * c) / (eta * eta), 1e-6))) * h - wo / eta;
  let up = select(0.0, mirrored.z * (wo.z + so) / (wo.z * openpbr_ggx_stretch(alpha, mirrored) + mirrored.z * so), mirrored.z > 0.0);
  let down = select(0.0, 2.0 * refracted.z / (refracted.z - openpbr_ggx_stretch(alpha, refracted)), refracted.z < 0.0);
  return vec2f(up, down);
}`,
  [openpbrGgx],
);
