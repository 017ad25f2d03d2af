import { wgslModule } from '@glanz/wgsl';
import { openPbrStruct } from './record';

/**
 * What fills the inside of a transparent object, in the units of its parameters (1 / length), and its index of refraction
 * by wavelength:
 *
 * ```wgsl
 * fn openpbr_medium(p: OpenPbrParameters) -> OpenPbrMedium                  // all zero for thin walls and for depth 0
 * fn openpbr_dispersed_ior(p: OpenPbrParameters, wavelength_nm: f32) -> f32 // put it into p.specular_ior
 * ```
 *
 * Extinction is that which turns white into `transmission_color` at `transmission_depth`; where the scattering asked for is
 * more than that, all channels get as much more extinction as the one that lacks the most (OpenPBR 1.1). Dispersion is
 * Cauchy's n = A + B / λ² through the index at 587.6 nm, with the Abbe number over the dispersion scale.
 */
export const openpbrMedium = wgslModule(
  'openpbr/medium',
  /* wgsl */ `struct OpenPbrMedium {
  // What is lost along the ray, and the part of it that is scattered; per length.
  extinction: vec3f,
  scattering: vec3f,
  // Henyey-Greenstein's g.
  anisotropy: f32,
}

fn openpbr_medium(p: OpenPbrParameters) -> OpenPbrMedium {
  var medium: OpenPbrMedium;
  medium.anisotropy = clamp(p.transmission_scatter_anisotropy, -0.999, 0.999);
  if (p.transmission_depth <= 0.0 || p.geometry_thin_walled != 0u) { return medium; }
  let scale = 1.0 / max(p.transmission_depth, 1e-9);
  medium.scattering = p.transmission_scatter * scale;
  let absorption = -scale * log(clamp(p.transmission_color, vec3f(1e-6), vec3f(1.0))) - medium.scattering;
  let least = min(min(absorption.x, absorption.y), min(absorption.z, 0.0));
  medium.extinction = absorption - least + medium.scattering;
  return medium;
}

fn openpbr_dispersed_ior(p: OpenPbrParameters, wavelength_nm: f32) -> f32 {
  // 1 / λ_d², and 1 / (1 / λ_F² - 1 / λ_C²), in nm.
  let curvature = (p.specular_ior - 1.0) * (p.transmission_dispersion_scale / max(p.transmission_dispersion_abbe_number, 1e-3)) * 523453.73;
  return max(p.specular_ior + curvature * (1.0 / (wavelength_nm * wavelength_nm) - 2.8962525e-6), 1e-3);
}`,
  [openPbrStruct.module],
);
