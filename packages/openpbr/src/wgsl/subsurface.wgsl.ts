import { wgslModule } from '@glanz/wgsl';
import { openpbrDielectric } from './dielectric.wgsl';
import { openpbrEnergy } from './energy.wgsl';
import openpbrMedium from './medium.wesl';
import { openPbrStruct } from './record';

/**
 * What lies below a translucent surface: `openpbr_subsurface_medium(p) -> OpenPbrMedium`, the medium to walk in once a
 * sample has entered it (`OpenPbrSample.subsurface`), through the same rough interface as into glass.
 *
 * `subsurface_color` is what comes back of the light that got in. The single-scattering albedo that does so is van de
 * Hulst's for a half space (d'Eon, A Hitchhiker's Guide to Multiple Scattering), of the colour corrected for what the
 * interface reflects back inside (Saunderson 1942).
 *
 * A thin wall has no inside: its subsurface reflects and transmits like paper, in parts given by the anisotropy.
 */
export const openpbrSubsurface = wgslModule(
  'openpbr/subsurface',
  /* wgsl */ `fn openpbr_subsurface_medium(p: OpenPbrParameters) -> OpenPbrMedium {
  var medium: OpenPbrMedium;
  let g = clamp(p.subsurface_scatter_anisotropy, -0.999, 0.999);
  medium.anisotropy = g;
  if (p.geometry_thin_walled != 0u) { return medium; }
  medium.extinction = 1.0 / max(p.subsurface_radius * p.subsurface_radius_scale, vec3f(1e-6));
  let kept = openpbr_fresnel_mean(-openpbr_dielectric_epsilon(p));
  let color = clamp(p.subsurface_color, vec3f(0.0), vec3f(1.0));
  let c = color / (1.0 - kept + kept * color);
  let s = max(4.09712 + 4.20863 * c - sqrt(9.59217 + c * (41.6808 + 17.7126 * c)), vec3f(0.0));
  medium.scattering = medium.extinction * (1.0 - s * s) / (1.0 - g * s * s);
  return medium;
}

//#if OPENPBR_THIN_SUBSURFACE
struct OpenPbrThinSubsurface {
  color: vec3f,
  // Shares that go back and through, and what the interface makes of diffuse light.
  back: f32,
  through: f32,
  coupling: f32,
}

// "weight" is the share of the light that passes the interface of the dielectric.
fn openpbr_thin_subsurface_prepare(p: OpenPbrParameters, weight: f32) -> OpenPbrThinSubsurface {
  let share = select(0.0, weight * (1.0 - p.transmission_weight) * p.subsurface_weight, p.geometry_thin_walled != 0u);
  let g = clamp(p.subsurface_scatter_anisotropy, -1.0, 1.0);
  return OpenPbrThinSubsurface(p.subsurface_color, share * (0.5 - 0.5 * g), share * (0.5 + 0.5 * g), 1.0);
}
//#endif`,
  [openPbrStruct.module, openpbrMedium, openpbrEnergy, openpbrDielectric],
);
