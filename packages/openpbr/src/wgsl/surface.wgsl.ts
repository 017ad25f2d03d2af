import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrCoat } from './coat.wgsl';
import { openpbrDielectric } from './dielectric.wgsl';
import { openpbrFilm } from './film.wgsl';
import { openpbrFuzz } from './fuzz.wgsl';
import { openpbrMetal } from './metal.wgsl';
import { openpbrSubsurface } from './subsurface.wgsl';
import { openpbrTransmission } from './transmission.wgsl';

/**
 * The structs of the whole surface: `OpenPbrBsdf`, prepared for one direction, `OpenPbrSample`, and `OpenPbrSide`,
 * where the viewer is.
 */
export const openpbrSurface = wgslModule(
  'openpbr/surface',
  /* wgsl */ `struct OpenPbrBsdf {
  alpha: vec2f,
  // See openpbr_ggx_bound; 1 where facets let light through.
  bound: f32,
  // Probability of sampling the microfacet lobe; else it is the cosine.
  specular_probability: f32,
  // Factor on the diffuse lobe, without its colour.
  diffuse_scale: f32,
  diffuse_color: vec3f,
  diffuse_roughness: f32,
  //#if OPENPBR_DIFFUSE_ROUGHNESS
  // What rough diffuse light below an interface gets more at grazing angles: see openpbr_diffuse_gain.
  diffuse_grazing: f32,
  //#endif
  // Directional albedo.
  albedo: vec3f,
  dielectric_weight: f32,
  //#if OPENPBR_METAL
  metal: OpenPbrMetal,
  //#endif
  //#if OPENPBR_DIELECTRIC
  dielectric: OpenPbrDielectric,
  // Factor on its reflection, and albedo of what bounces on between its facets.
  dielectric_scale: vec3f,
  dielectric_bounced: vec3f,
  //#endif
  //#if OPENPBR_THIN_FILM
  film: OpenPbrFilm,
  //#endif
  //#if OPENPBR_TRANSMISSION
  transmission: OpenPbrTransmission,
  //#endif
  //#if OPENPBR_THIN_SUBSURFACE
  subsurface: OpenPbrThinSubsurface,
  //#endif
  //#if OPENPBR_COAT
  coat: OpenPbrCoat,
  //#endif
  //#if OPENPBR_FUZZ
  fuzz: OpenPbrFuzz,
  //#endif
}

struct OpenPbrSample {
  wi: vec3f,
  pdf: f32,
  // f · |cos θ_i| / pdf of the whole mixture.
  weight: vec3f,
  valid: bool,
  // wi is on the other side.
  transmitted: bool,
  // It goes into the subsurface's medium, not into the transparent interior; the weight is for this choice.
  subsurface: bool,
}

//#if OPENPBR_TRANSMISSION
struct OpenPbrSide {
  // Whether the viewer is in the object's interior.
  inside: bool,
  // Index of refraction of what is outside of the object: 1, or that of the medium around.
  outer_ior: f32,
}
//#endif`,
  [
    gated('OPENPBR_METAL', openpbrMetal),
    gated('OPENPBR_DIELECTRIC', openpbrDielectric),
    gated('OPENPBR_THIN_FILM', openpbrFilm),
    gated('OPENPBR_TRANSMISSION', openpbrTransmission),
    gated('OPENPBR_THIN_SUBSURFACE', openpbrSubsurface),
    gated('OPENPBR_COAT', openpbrCoat),
    gated('OPENPBR_FUZZ', openpbrFuzz),
  ],
);
