import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrCoat } from './coat.wgsl';
import { openpbrFuzz } from './fuzz.wgsl';
import { openPbrStruct } from './record';

/**
 * `openpbr_emission(p, wo)`: radiance that leaves towards `wo`: the same in all directions of the upper side, but for
 * what a coat and fuzz keep back.
 */
export const openpbrEmission = wgslModule(
  'openpbr/emission',
  /* wgsl */ `fn openpbr_emission(p: OpenPbrParameters, wo: vec3f) -> vec3f {
  var radiance = p.emission_color * p.emission_luminance;
  //#if OPENPBR_COAT
  radiance *= openpbr_coat_emission(p, wo);
  //#endif
  //#if OPENPBR_FUZZ
  radiance *= 1.0 - p.fuzz_weight * openpbr_fuzz_albedo(p.fuzz_roughness, wo.z);
  //#endif
  return select(vec3f(0.0), radiance, wo.z > 0.0);
}`,
  [openPbrStruct.module, gated('OPENPBR_COAT', openpbrCoat), gated('OPENPBR_FUZZ', openpbrFuzz)],
);

/** `openpbr_opacity(p)`: the part of the light that meets the surface at all; the rest goes straight through. */
export const openpbrOpacity = wgslModule(
  'openpbr/opacity',
  /* wgsl */ `fn openpbr_opacity(p: OpenPbrParameters) -> f32 {
  return clamp(p.geometry_opacity, 0.0, 1.0);
}`,
  [openPbrStruct.module],
);
