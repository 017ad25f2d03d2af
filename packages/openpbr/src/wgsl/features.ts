import type { OpenPbrParameterName, OpenPbrParameters } from '../parameters/index';
import { resolveParameters } from '../parameters/index';
import { OPENPBR_INSIDE_NEAR } from '../tables/constants.wesl';

/**
 * The composer's flags of the modules of this package. A lobe whose flag is false is not in the shader, whatever the
 * parameters are.
 */
export interface OpenPbrFlags {
  /** Any microfacet lobe: OPENPBR_METAL, OPENPBR_DIELECTRIC or OPENPBR_COAT. */
  readonly OPENPBR_SPECULAR: boolean;
  readonly OPENPBR_METAL: boolean;
  /** The coat has its own normal or tangent. */
  readonly OPENPBR_COAT_FRAME: boolean;
  /** Reflection by the dielectric base. Without it the diffuse lobe is not attenuated. */
  readonly OPENPBR_DIELECTRIC: boolean;
  /** A dielectric interface of the base or of the coat: OPENPBR_DIELECTRIC or OPENPBR_COAT. */
  readonly OPENPBR_INTERFACE: boolean;
  /** Interfaces seen from their denser side: OPENPBR_TRANSMISSION, or an index of refraction below 1. */
  readonly OPENPBR_INNER: boolean;
  /**
   * From their denser side, interfaces are summed over facets where the tables are too coarse: above something opaque
   * of a lower index, and for clear materials near the index of the outside. Comes with OPENPBR_INNER.
   */
  readonly OPENPBR_INNER_SUMS: boolean;
  /**
   * There may be several interfaces on one surface that are summed over facets (OPENPBR_ANISOTROPY,
   * OPENPBR_INNER_SUMS): one loop goes through them; comes with OPENPBR_DIELECTRIC, and with OPENPBR_TRANSMISSION or
   * OPENPBR_COAT.
   */
  readonly OPENPBR_INTERFACE_LOOP: boolean;
  /** Transmission: refraction, thin walls; comes with OPENPBR_DIELECTRIC. */
  readonly OPENPBR_TRANSMISSION: boolean;
  /** Light may enter the subsurface; comes with OPENPBR_TRANSMISSION. */
  readonly OPENPBR_SUBSURFACE: boolean;
  /** Thin walls with a subsurface: diffuse reflection and transmission. */
  readonly OPENPBR_THIN_SUBSURFACE: boolean;
  /** Thin walls among what lets light through. */
  readonly OPENPBR_THIN_WALLED: boolean;
  /**
   * The table of the losses of mirrors is read: OPENPBR_METAL, OPENPBR_THIN_WALLED, OPENPBR_INNER, OPENPBR_THIN_FILM or
   * OPENPBR_ANISOTROPY.
   */
  readonly OPENPBR_LOSSES: boolean;
  readonly OPENPBR_COAT: boolean;
  /** A thin film on the base; comes with OPENPBR_METAL or OPENPBR_DIELECTRIC. */
  readonly OPENPBR_THIN_FILM: boolean;
  /** A layer of fibres over everything else. */
  readonly OPENPBR_FUZZ: boolean;
  /** Layers over the base: OPENPBR_COAT or OPENPBR_FUZZ. */
  readonly OPENPBR_LAYERED: boolean;
  readonly OPENPBR_DIFFUSE: boolean;
  /**
   * Directions are sampled by the cosine too: OPENPBR_DIFFUSE, or OPENPBR_METAL or OPENPBR_DIELECTRIC with
   * OPENPBR_MULTISCATTER.
   */
  readonly OPENPBR_COSINE: boolean;
  /** EON instead of Lambert. */
  readonly OPENPBR_DIFFUSE_ROUGHNESS: boolean;
  readonly OPENPBR_ANISOTROPY: boolean;
  /** Of the draft of 1.2: facets of a second roughness; comes with OPENPBR_METAL or OPENPBR_DIELECTRIC. */
  readonly OPENPBR_HAZE: boolean;
  /** Of the draft of 1.2: reflection that returns; comes with OPENPBR_METAL or OPENPBR_DIELECTRIC. */
  readonly OPENPBR_RETROREFLECTION: boolean;
  /** OPENPBR_HAZE or OPENPBR_RETROREFLECTION. */
  readonly OPENPBR_LOBES: boolean;
  /** Compensation of the energy that single scattering between microfacets loses. */
  readonly OPENPBR_MULTISCATTER: boolean;
  readonly OPENPBR_EMISSION: boolean;
}

/** Options for {@link requiredFeatures}. */
export interface FeatureOptions {
  /** Names of the parameters that textures drive in at least one material: they may take values below those given. */
  readonly textured?: readonly string[];
  /** Default true. False leaves single scattering GGX, which loses energy on rough surfaces; for comparisons. */
  readonly multipleScattering?: boolean;
}

/**
 * Which features a set of materials needs, as flags for `compose`. Every flag is present in the answer.
 *
 * @param materials The parameters of every material that the shader shall draw; missing ones have their defaults.
 * @example
 * const shader = compose([openpbr, host, kernel], { flags: { ...requiredFeatures([{ base_metalness: 1 }]) } });
 */
export function requiredFeatures(
  materials: readonly Partial<OpenPbrParameters>[],
  { textured = [], multipleScattering = true }: FeatureOptions = {},
): OpenPbrFlags {
  const all = materials.map((material) => resolveParameters(material));
  const isTextured = (name: OpenPbrParameterName) => textured.includes(name);
  const metal = all.some((p) => p.base_metalness > 0 && p.specular_weight > 0);
  // A texture can only lower a parameter: metalness 1 with a texture has dielectric places.
  const insulators = all.filter((p) => p.base_metalness < 1 || isTextured('base_metalness'));
  // A base of index 1 reflects below a coat of another index.
  const solid = insulators.filter((p) => p.transmission_weight < 1 || isTextured('transmission_weight'));
  const below = solid.filter((p) => p.subsurface_weight > 0);
  const thinBelow = below.some((p) => p.geometry_thin_walled);
  const clear = [...insulators.filter((p) => p.transmission_weight > 0), ...below];
  const transmission = clear.length > 0;
  const thin = clear.some((p) => p.geometry_thin_walled);
  const film = (p: OpenPbrParameters) => p.thin_film_weight > 0 && p.thin_film_thickness > 0;
  const dielectric =
    transmission ||
    insulators.some(
      (p) =>
        film(p) || (p.specular_weight > 0 && (p.specular_ior !== 1 || isTextured('specular_ior') || p.coat_weight > 0)),
    );
  const coat = all.some((p) => p.coat_weight > 0);
  const fuzz = all.some((p) => p.fuzz_weight > 0);
  const opaque = solid.filter((p) => p.subsurface_weight < 1 || isTextured('subsurface_weight'));
  const diffuse = thinBelow || opaque.some((p) => p.base_weight > 0 && p.base_color.some((c) => c > 0));
  const specular = metal || dielectric || coat;
  const lambert = diffuse || !specular;
  const inner =
    transmission ||
    (dielectric && insulators.some((p) => p.specular_ior < 1)) ||
    all.some((p) => p.coat_weight > 0 && p.coat_ior < 1) ||
    isTextured('specular_ior') ||
    isTextured('coat_ior');
  // What is outside may be any of the clear materials, with its index.
  const media = [1, ...clear.filter((p) => !p.geometry_thin_walled).map((p) => p.specular_ior)];
  const step = (p: OpenPbrParameters, outer: number) =>
    (Math.abs(p.specular_ior - outer) / (p.specular_ior + outer)) * Math.sqrt(p.specular_weight);
  const isNear = (p: OpenPbrParameters, outer: number) =>
    p.specular_ior !== outer && (step(p, outer) < OPENPBR_INSIDE_NEAR + 1e-4 || isTextured('specular_weight'));
  const sums =
    isTextured('specular_ior') ||
    isTextured('coat_ior') ||
    media.some(
      (outer) =>
        solid.some((p) => dielectric && p.specular_ior < outer) ||
        all.some((p) => p.coat_weight > 0 && p.coat_ior < outer) ||
        clear.some((p) => isNear(p, outer)),
    );
  const anisotropic =
    specular &&
    all.some((p) => p.specular_roughness_anisotropy > 0 || (p.coat_weight > 0 && p.coat_roughness_anisotropy > 0));
  const base = metal || dielectric;
  const haze = base && all.some((p) => p.specular_haze > 0);
  const retroreflection = base && all.some((p) => p.specular_retroreflectivity > 0);
  return {
    OPENPBR_SPECULAR: specular,
    OPENPBR_METAL: metal,
    OPENPBR_COAT_FRAME:
      all.some((p) => p.coat_weight > 0 && (p.geometry_coat_normal !== null || p.geometry_coat_tangent !== null)) ||
      (coat && (isTextured('geometry_coat_normal') || isTextured('geometry_coat_tangent'))),
    OPENPBR_DIELECTRIC: dielectric,
    OPENPBR_INTERFACE: dielectric || coat,
    OPENPBR_INNER: inner,
    OPENPBR_INNER_SUMS: inner && sums,
    OPENPBR_INTERFACE_LOOP: dielectric && (transmission || coat) && (anisotropic || (inner && sums)),
    OPENPBR_TRANSMISSION: transmission,
    OPENPBR_SUBSURFACE: below.length > 0,
    OPENPBR_THIN_SUBSURFACE: thinBelow,
    OPENPBR_THIN_WALLED: thin,
    OPENPBR_LOSSES: metal || thin || inner || anisotropic || (base && all.some(film)),
    OPENPBR_COAT: coat,
    OPENPBR_THIN_FILM: base && all.some(film),
    OPENPBR_FUZZ: fuzz,
    OPENPBR_LAYERED: coat || fuzz,
    OPENPBR_DIFFUSE: lambert,
    OPENPBR_COSINE: lambert || (base && multipleScattering),
    OPENPBR_DIFFUSE_ROUGHNESS: diffuse && solid.some((p) => p.base_diffuse_roughness > 0),
    OPENPBR_ANISOTROPY: anisotropic,
    OPENPBR_HAZE: haze,
    OPENPBR_RETROREFLECTION: retroreflection,
    OPENPBR_LOBES: haze || retroreflection,
    OPENPBR_MULTISCATTER: multipleScattering,
    OPENPBR_EMISSION: all.some((p) => p.emission_luminance > 0),
  };
}
