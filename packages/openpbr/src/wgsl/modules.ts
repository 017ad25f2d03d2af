// The modules in WESL that are published, with their types and documentation.
import type { WgslModule } from '@glanz/wgsl';
import bsdf from './bsdf.wesl';
import coat from './coat.wesl';
import cosine from './cosine.wesl';
import dielectric from './dielectric.wesl';
import emission from './emission.wesl';
import energy from './energy.wesl';
import eon from './eon.wesl';
import fresnelDielectric from './fresnel_dielectric.wesl';
import fresnelMetal from './fresnel_metal.wesl';
import fuzz from './fuzz.wesl';
import ggx from './ggx.wesl';
import medium from './medium.wesl';
import metal from './metal.wesl';
import opacity from './opacity.wesl';
import phase from './phase.wesl';
import subsurface from './subsurface.wesl';
import transmission from './transmission.wesl';

/**
 * The whole surface. Directions are unit vectors in the local frame (+z shading normal, +x tangent), away from the
 * surface; the host turns the frame so that the viewer is above. With `wo` below the surface everything is zero, and
 * with `wi` below so it is unless the surface lets light through.
 *
 * ```wgsl
 * // Once per hit; the rest takes the same wo. With OPENPBR_TRANSMISSION also from either side.
 * fn openpbr_prepare(p: OpenPbrParameters, wo: vec3f) -> OpenPbrBsdf
 * fn openpbr_prepare_side(p: OpenPbrParameters, wo: vec3f, side: OpenPbrSide) -> OpenPbrBsdf
 * fn openpbr_eval(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec3f       // f · |cos θ_i|
 * fn openpbr_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> f32          // density of openpbr_sample, per solid angle
 * fn openpbr_eval_pdf(b: OpenPbrBsdf, wo: vec3f, wi: vec3f) -> vec4f   // both at the cost of one
 * fn openpbr_sample(b: OpenPbrBsdf, wo: vec3f, u: vec3f) -> OpenPbrSample // u uniform in [0, 1)³
 * // Reflected and transmitted part of uniform light, approximate for tinted metal.
 * fn openpbr_albedo(b: OpenPbrBsdf, wo: vec3f) -> vec3f
 * fn openpbr_emission(p: OpenPbrParameters, wo: vec3f) -> vec3f        // radiance
 * fn openpbr_opacity(p: OpenPbrParameters) -> f32
 * ```
 *
 * Metal and dielectric share one microfacet lobe: they differ by the Fresnel factor only. Diffuse reflection and what
 * bounces on between the facets are sampled by the cosine. The diffuse lobe below the
 * dielectric is weighted by (1 - E(μ_i))(1 - E(μ_o))/(1 - E_mean), which is reciprocal and loses nothing (Ashikhmin,
 * Premože and Shirley 2000; Kelemen and Szirmay-Kalos 2001). A thin film replaces the
 * Fresnel factor, and tints what goes through: where OPENPBR_THIN_FILM is set, compose `openpbrFilm` of
 * `@glanz/openpbr/film` too. A coat and fuzz add a lobe each and scale the rest.
 *
 * Transmission: `OpenPbrSide` says where the viewer is, `inside` the object or not, and the index of refraction of what
 * is outside of it; a thin wall has no inside. A facet, once sampled, reflects or refracts by chance, as its Fresnel
 * factor says. From inside there is no coat to be seen, only its colour on what leaves, and reflections have no tint.
 * The opaque part of a half transparent surface looks the same from inside as from outside.
 */
export const openpbr: WgslModule = bsdf;

/**
 * The GGX microfacet distribution with height-correlated Smith masking (Heitz 2014). `openpbr_alpha` maps roughness and
 * anisotropy to slopes, not below 1e-4. `openpbr_ggx` gives, for a half vector, (D G₂ / (4 cos θ_o), density of
 * reflected directions when half vectors are sampled by `openpbr_ggx_sample`). Their ratio is exact however narrow the
 * lobe.
 *
 * A lobe of that smallest slope, of roughness 0.01 or less, is a delta: `openpbr_smooth`. Its only facet is the normal.
 * `openpbr_ggx_lobe` then gives `spike` twice, which is 1e30 for the direction that was sampled, and 0 for others. Just
 * above, a lobe blurs by 1e-4 radians, a tenth of a pixel of a usual image: nobody sees where one kind ends.
 *
 * The energy tables know round highlights only. For an anisotropic one `openpbr_view_roughness` is the round roughness
 * that reflects the same share of the light (the slope across the view counts the more, the lower the view), about, and
 * `openpbr_conductor_cosine` the view that has the same masking. They are exact for round highlights.
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
 * The interior of a transparent object, in the units of its parameters (1 / length), and its index of refraction by
 * wavelength:
 *
 * ```wgsl
 * fn openpbr_medium(p: OpenPbrParameters) -> OpenPbrMedium                  // all zero for thin walls and for depth 0
 * fn openpbr_dispersed_ior(p: OpenPbrParameters, wavelength_nm: f32) -> f32 // put it into p.specular_ior
 * ```
 *
 * Extinction turns white into `transmission_color` at `transmission_depth`. Where the requested scattering exceeds it,
 * the extinction of all channels rises by as much as the channel needs that lacks most (OpenPBR 1.1.1). Dispersion is
 * Cauchy's n = A + B / λ² through the index at 587.6 nm, with the Abbe number over the dispersion scale.
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

/**
 * The metal lobe's reflectance: F82 tint times specular_weight, not above 1. Light that single scattering loses comes
 * back in all directions, coloured by its further bounces (Kulla and Conty 2017): a lobe of its own, smooth and
 * reciprocal, sampled with the diffuse one; exact in energy for white metal. Below a film its colour is that of one
 * facet, which depends on the view where the metal is smooth: only approximately reciprocal.
 */
export const openpbrMetal: WgslModule = metal;

/**
 * The dielectric interface of the base: specular_weight changes its index of refraction, and with it everything else.
 * `openpbr_dielectric_epsilon` is (η - 1)/(η + 1) of the changed index: its square is the reflectance at normal
 * incidence, so specular_weight simply scales that square. The reflection's tint leaves the energy balance alone.
 *
 * Light that single scattering loses leaves in all directions after more bounces between facets: a part of it upwards
 * (openpbr_energy_bounce), the rest downwards.
 */
export const openpbrDielectric: WgslModule = dielectric;

/**
 * Light through the dielectric base. Directions on the far side have z < 0.
 *
 * - A solid: refraction by GGX facets (Walter et al. 2007), the same facets and the same Fresnel factor as the
 *   reflection; masking is separable. f has no factor of η²: reflection and transmission of a clear interface add up to
 *   1 from either side, and f(o, i) = η² f(i, o).
 * - A thin wall: two parallel faces, with all reflections between them: smooth, it reflects 2R / (1 + R) and lets the
 *   rest through undeflected. Rough, that share is taken at the viewer's angle for the lobe as a whole, which is the
 *   GGX reflection, and for the light let through its mirror image, narrowed, since two refractions mostly undo each
 *   other.
 *
 * `transmission_color` tints once a crossing where `transmission_depth` is 0, and along the path through a thin wall.
 */
export const openpbrTransmission: WgslModule = transmission;

/**
 * The medium below a translucent surface: `openpbr_subsurface_medium(p) -> OpenPbrMedium`, for random walks after a
 * sample has entered it (`OpenPbrSample.subsurface`), through the same rough interface as into glass.
 *
 * `subsurface_color` is the albedo of the subsurface for light that has entered it. The single-scattering albedo
 * follows by van de Hulst's inversion for a half space (d'Eon, A Hitchhiker's Guide to Multiple Scattering), after
 * correcting the colour for internal reflection by the interface (Saunderson 1942).
 *
 * A thin wall has no interior: its subsurface reflects and transmits diffusely, like paper, split by the anisotropy.
 */
export const openpbrSubsurface: WgslModule = subsurface;

/**
 * Fuzz: a layer of fibres over everything else (Zeltner, Burley and Chiang 2022). Its reflection is a linearly
 * transformed cosine towards the viewer, of two numbers and an albedo from the two-dimensional table
 * (scripts/sheen.mjs); the layers below get the rest, without a tint. It depends on the viewer, and is not reciprocal.
 */
export const openpbrFuzz: WgslModule = fuzz;

/**
 * The coat: a clear or tinted dielectric layer over everything else, in the frame of the base or, with
 * OPENPBR_COAT_FRAME, in one of its own, given by geometry_coat_normal and geometry_coat_tangent in the frame of the
 * base. Its reflection is that of an interface (`openpbrDielectric`); below it is the base with other parameters
 * (`openpbr_coat_base`), times `openpbr_coat_pass`. It follows the specification, with these choices where that leaves
 * room:
 *
 * - The base becomes rougher as proposed for the specification's next version: refraction widens the base's highlight,
 *   a rough coat blurs it. It is never made smoother.
 * - Darkening by reflections inside the coat uses the roughness of the base as seen through the coat, and for a rough
 *   coat the typical visible facet; the coat's colour counts once, not at every bounce.
 * - The coat transmits 1 less its albedo towards the viewer: energy is conserved, but the whole is not reciprocal.
 */
export const openpbrCoat: WgslModule = coat;

/**
 * Directional albedos of GGX interfaces, read from the energy tables through the host's accessors
 * (`openpbr_table_dielectric`, `openpbr_table_conductor`). A dielectric is given by `epsilon` = (η - 1)/(η + 1), the
 * signed root of its reflectance at normal incidence. The coordinates are explained in scripts/tables.mjs.
 */
export const openpbrEnergy: WgslModule = energy;

/**
 * `openpbr_emission(p, wo)`: radiance that leaves towards `wo`: the same in all directions of the upper side, reduced
 * by coat and fuzz.
 */
export const openpbrEmission: WgslModule = emission;

/**
 * `openpbr_opacity(p)`: the fraction of the light that interacts with the surface; the rest passes straight through.
 */
export const openpbrOpacity: WgslModule = opacity;
