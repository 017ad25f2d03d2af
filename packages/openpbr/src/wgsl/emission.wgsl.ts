import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrCoat } from './coat.wgsl';
import { openPbrStruct } from './record';

/** `openpbr_emission(p, wo)`: radiance that leaves towards `wo`: the same in all directions of the upper side, but for what a coat keeps back. */
export const openpbrEmission = wgslModule(
  'openpbr/emission',
  /* wgsl */ `fn openpbr_emission(p: OpenPbrParameters, wo: vec3f) -> vec3f {
  //#if OPENPBR_COAT
  return select(vec3f(0.0), p.emission_color * p.emission_luminance * openpbr_coat_emission(p, wo), wo.z > 0.0);
  //#else
  return select(vec3f(0.0), p.emission_color * p.emission_luminance, wo.z > 0.0);
  //#endif
}`,
  [openPbrStruct.module, gated('OPENPBR_COAT', openpbrCoat)],
);

/** `openpbr_opacity(p)`: the part of the light that meets the surface at all; the rest goes straight through. */
export const openpbrOpacity = wgslModule(
  'openpbr/opacity',
  /* wgsl */ `fn openpbr_opacity(p: OpenPbrParameters) -> f32 {
  return clamp(p.geometry_opacity, 0.0, 1.0);
}`,
  [openPbrStruct.module],
);
