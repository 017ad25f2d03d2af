import type { WgslModule } from '@glanz/wgsl';
import sample from './lobes_sample.wesl';

/**
 * The lobes of the draft of OpenPBR 1.2, haze and retroreflection: compose it with `openpbr` where the flag
 * OPENPBR_LOBES is set, that is, where materials have them. It is a module of its own so that hosts can load it then.
 *
 * - Haze: the share `specular_haze` of the base's facets has the roughness mix(specular_roughness, 1,
 *   specular_haze_spread), made rougher by a coat as the others are, with the same anisotropy and Fresnel factor. They
 *   reflect and refract: what all facets do is the weighted sum of what either kind does alone, each with its
 *   compensation of the energy that single scattering loses. The whole is as reciprocal as one kind is, and conserves as
 *   much energy. What a film changes of the albedo, a coat's darkening, and the gain of rough diffuse light use the
 *   first kind's roughness.
 * - Retroreflection: of what facets reflect, the share `specular_retroreflectivity` leaves in the direction that is
 *   turned by half a revolution about the normal: f(-x, -y, z) of the lobe (Portsmouth et al., "A Minimal Retroreflective
 *   Microfacet Model", JCGT 15(1), 2026). Such a pair has the same masking and albedo, so that energy and its
 *   compensation stay as they are; so do light that bounces on between facets, and what is refracted.
 */
export const openpbrLobes: WgslModule = sample;
