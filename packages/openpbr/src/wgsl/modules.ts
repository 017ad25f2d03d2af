// The modules in WESL that are published, with their types and documentation.
import type { WgslModule } from '@glanz/wgsl';
import cosine from './cosine.wesl';
import eon from './eon.wesl';
import ggx from './ggx.wesl';
import fresnelDielectric from './fresnel_dielectric.wesl';
import fresnelMetal from './fresnel_metal.wesl';
import medium from './medium.wesl';
import phase from './phase.wesl';

/**
 * The GGX microfacet distribution with height-correlated Smith masking (Heitz 2014). `openpbr_alpha` maps roughness and
 * anisotropy to slopes, not below 1e-4, so that a smooth surface is a very narrow lobe and never a special case.
 * `openpbr_ggx` gives, for a half vector, (D G₂ / (4 cos θ_o), density of reflected directions when half vectors are
 * sampled by `openpbr_ggx_sample`). Their ratio is exact however narrow the lobe.
 *
 * The energy tables know round highlights only. For a stretched one `openpbr_view_roughness` is the round roughness
 * that reflects the same share of the light (the slope across the view counts the more, the lower the view), about, and
 * `openpbr_mirror_cosine` the view that has the same masking. They are exact for round highlights.
 */
export const openpbrGgx: WgslModule = ggx;

/**
 * `openpbr_fresnel_dielectric(eta, c)`: exact unpolarised reflectance of an interface of relative index `eta` = n_t /
 * n_i at cosine `c` of the angle of incidence; 1 beyond the critical angle.
 */
export const openpbrFresnelDielectric: WgslModule = fresnelDielectric;

/**
 * Reflectance of metal: Schlick's formula with the F82 tint (Kutz, Hašan and Edmondson 2021). `openpbr_f82_edge` is
 * what the tint takes away; `openpbr_f82` evaluates, both factors already scaled by specular_weight.
 */
export const openpbrFresnelMetal: WgslModule = fresnelMetal;

/**
 * What fills the inside of a transparent object, in the units of its parameters (1 / length), and its index of
 * refraction by wavelength:
 *
 * ```wgsl
 * fn openpbr_medium(p: OpenPbrParameters) -> OpenPbrMedium                  // all zero for thin walls and for depth 0
 * fn openpbr_dispersed_ior(p: OpenPbrParameters, wavelength_nm: f32) -> f32 // put it into p.specular_ior
 * ```
 *
 * Extinction is that which turns white into `transmission_color` at `transmission_depth`; where the scattering asked
 * for is more than that, all channels get as much more extinction as the one that lacks the most (OpenPBR 1.1).
 * Dispersion is Cauchy's n = A + B / λ² through the index at 587.6 nm, with the Abbe number over the dispersion scale.
 */
export const openpbrMedium: WgslModule = medium;

/**
 * Henyey and Greenstein's phase function, 1941, in any frame; directions are unit and point away from the place of
 * scattering, so g > 0 prefers `wi` = -`wo`. Sampling is exact: the weight is 1.
 *
 * ```wgsl
 * fn openpbr_phase_eval(g: f32, wo: vec3f, wi: vec3f) -> f32   // value and density, per solid angle
 * fn openpbr_phase_sample(g: f32, wo: vec3f, u: vec2f) -> vec3f // u uniform in [0, 1)²
 * ```
 */
export const openpbrPhase: WgslModule = phase;

/** `openpbr_cosine_sample(u)`: a direction with density cos θ / π. */
export const openpbrCosine: WgslModule = cosine;

/**
 * Energy-preserving Oren-Nayar (Portsmouth, Kutz and Hill 2024): `openpbr_eon` is f without the cosine. The directional
 * albedo of its single-scattering part is the paper's polynomial.
 */
export const openpbrEon: WgslModule = eon;
