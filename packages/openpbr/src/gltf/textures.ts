import type { OpenPbrColor, OpenPbrParameterName } from '../parameters/index';
import { anisotropicRoughness, fuzzRoughness } from './conversions';
import { fromGltf } from './from-gltf';
import type { GltfMaterialFactors, GltfTextureReference } from './material';

/**
 * An image that must be computed from an image of the document, where the mapping to a parameter is more than a
 * product.
 */
export interface GltfImageConversion {
  /** Equal for equal formulas: one image serves all uses of the same textures with the same key. */
  readonly key: string;
  /**
   * The textures that it reads, the use's own first; all at the same place of the surface, in the use's colour space.
   */
  readonly sources: readonly GltfTextureReference[];
  /**
   * One texel. `texels` holds linear RGBA, 0 to 1, for each source in order, white where an image is missing; the
   * result is linear RGBA, 0 to 1, to be encoded in the use's colour space. Alpha is never encoded.
   */
  readonly convert: (texels: ArrayLike<number>, result: { [channel: number]: number }) => void;
}

/** A texture of a glTF material that drives an OpenPBR parameter: the parameter is its value times the texel. */
export interface GltfTextureUse {
  readonly parameter: OpenPbrParameterName;
  /** The reference in the material, unchanged, and its position in it. */
  readonly texture: GltfTextureReference;
  readonly path: string;
  readonly channels: 'rgb' | 'r' | 'g' | 'b' | 'a';
  readonly colorSpace: 'srgb' | 'linear';
  /** Values of the codes 0 and 1; default 0 and 1. */
  readonly range?: readonly [number, number];
  /** Value of the parameter where this texture is read, if not that of {@link fromGltf}. */
  readonly value?: number | OpenPbrColor;
  readonly image?: GltfImageConversion;
}

/** What {@link gltfTextures} answers. */
export interface GltfTextureMapping {
  readonly uses: readonly GltfTextureUse[];
  /** Textures that OpenPBR cannot represent, and why; without those that a path tracer does not use. */
  readonly lost: readonly { readonly path: string; readonly reason: string }[];
}

const EXTENSION = 'extensions/KHR_materials_';

/** Where a texture lies on the surface: two that share it can be read as one. */
function placement({ texCoord, extensions }: GltfTextureReference): string {
  const transform = (extensions as { readonly KHR_texture_transform?: { readonly texCoord?: number } } | undefined)
    ?.KHR_texture_transform;
  return JSON.stringify([transform?.texCoord ?? texCoord ?? 0, transform ?? null]);
}

/** Splits a colour into its brightest channel, as alpha, and the rest. */
function splitColor(factor: readonly number[], texels: ArrayLike<number>, result: { [channel: number]: number }): void {
  const r = (factor[0] as number) * (texels[0] as number),
    g = (factor[1] as number) * (texels[1] as number),
    b = (factor[2] as number) * (texels[2] as number);
  const brightest = Math.max(r, g, b);
  const scale = brightest > 0 ? 1 / brightest : 0;
  result[0] = brightest > 0 ? r * scale : 1;
  result[1] = brightest > 0 ? g * scale : 1;
  result[2] = brightest > 0 ? b * scale : 1;
  result[3] = brightest;
}

/**
 * Which textures of a glTF material drive which OpenPBR parameters, in which channels and colour space. Pure; the
 * document's images are not needed. A path tracer does not use occlusion and thickness textures; they are not in the
 * result.
 *
 * @example
 * for (const { parameter, texture, channels } of gltfTextures(material).uses) bind(parameter, texture.index, channels);
 */
export function gltfTextures(material: GltfMaterialFactors): GltfTextureMapping {
  const uses: GltfTextureUse[] = [];
  const lost: { path: string; reason: string }[] = [];
  const parameters = fromGltf(material);
  const { pbrMetallicRoughness: pbr = {}, extensions = {}, alphaMode = 'OPAQUE' } = material;
  const use = (
    parameter: OpenPbrParameterName,
    texture: GltfTextureReference | undefined,
    channels: GltfTextureUse['channels'],
    colorSpace: GltfTextureUse['colorSpace'],
    path: string,
    more: Pick<GltfTextureUse, 'range' | 'value' | 'image'> = {},
  ) => {
    if (texture) uses.push({ parameter, texture, path, channels, colorSpace, ...more });
  };
  const baseTexture = 'pbrMetallicRoughness/baseColorTexture';
  const masked = alphaMode !== 'OPAQUE';

  if (extensions.KHR_materials_unlit) {
    use('emission_color', pbr.baseColorTexture, 'rgb', 'srgb', baseTexture);
    if (masked) use('geometry_opacity', pbr.baseColorTexture, 'a', 'srgb', baseTexture);
    return { uses, lost };
  }

  use('geometry_normal', material.normalTexture, 'rgb', 'linear', 'normalTexture');
  if (parameters.emission_color) use('emission_color', material.emissiveTexture, 'rgb', 'srgb', 'emissiveTexture');

  const glossy = extensions.KHR_materials_pbrSpecularGlossiness;
  const rough = glossy ? undefined : pbr.metallicRoughnessTexture;
  const base = glossy ? glossy.diffuseTexture : pbr.baseColorTexture;
  const basePath = glossy ? `${EXTENSION}pbrSpecularGlossiness/diffuseTexture` : baseTexture;
  use('base_color', base, 'rgb', 'srgb', basePath);
  if (masked) use('geometry_opacity', base, 'a', 'srgb', basePath);
  if (parameters.transmission_weight !== undefined && parameters.transmission_depth === undefined)
    use('transmission_color', base, 'rgb', 'srgb', basePath);
  use('base_metalness', rough, 'b', 'linear', 'pbrMetallicRoughness/metallicRoughnessTexture');

  const anisotropy = extensions.KHR_materials_anisotropy;
  const strength = anisotropy?.anisotropyStrength ?? 0;
  if (glossy) {
    const path = `${EXTENSION}pbrSpecularGlossiness/specularGlossinessTexture`;
    const texture = glossy.specularGlossinessTexture;
    const factor = [0, 1, 2].map((k) => glossy.specularFactor?.[k] ?? 1);
    const brightest = Math.max(...factor);
    if (texture) {
      use('specular_roughness', texture, 'a', 'linear', path, {
        value: 1,
        range: [1, 1 - (glossy.glossinessFactor ?? 1)],
      });
      if (brightest > 0) {
        const sources = [texture];
        use('specular_color', texture, 'rgb', 'srgb', path, {
          value: [1, 1, 1],
          image: { key: `tint ${factor}`, sources, convert: (texels, result) => splitColor(factor, texels, result) },
        });
        // In a colour channel, whose codes are fine where reflectances are.
        const weight: GltfImageConversion = {
          key: `brightest ${factor}`,
          sources,
          convert: (texels, result) => {
            result[0] =
              result[1] =
              result[2] =
                Math.max(...factor.map((f, k) => f * (texels[k] as number))) / brightest;
            result[3] = 1;
          },
        };
        use('specular_weight', texture, 'r', 'srgb', path, { value: 1, image: weight });
      }
    }
  } else if (strength > 0) {
    const roughness = pbr.roughnessFactor ?? 1;
    const stretch = anisotropy?.anisotropyTexture;
    const together = !rough || !stretch || placement(rough) === placement(stretch);
    if (!together)
      lost.push({
        path: `${EXTENSION}anisotropy/anisotropyTexture`,
        reason: 'lies elsewhere on the surface than the roughness texture; only its direction is read',
      });
    const sources = [...(rough ? [rough] : []), ...(stretch && together ? [stretch] : [])];
    const last = 4 * (sources.length - 1);
    const image: GltfImageConversion = {
      key: `anisotropy ${roughness} ${strength} ${rough ? 1 : 0}${stretch && together ? 1 : 0}`,
      sources,
      convert: (texels, result) => {
        const pair = anisotropicRoughness(
          rough ? roughness * (texels[1] as number) : roughness,
          stretch && together ? strength * (texels[last + 2] as number) : strength,
        );
        result[0] = result[1] = pair.roughness;
        result[2] = pair.anisotropy;
        result[3] = 1;
      },
    };
    const [texture, path] = rough
      ? [rough, 'pbrMetallicRoughness/metallicRoughnessTexture']
      : [stretch, `${EXTENSION}anisotropy/anisotropyTexture`];
    use('specular_roughness', texture, 'g', 'linear', path, { value: 1, image });
    use('specular_roughness_anisotropy', texture, 'b', 'linear', path, { value: 1, image });
    use('geometry_tangent', stretch, 'rgb', 'linear', `${EXTENSION}anisotropy/anisotropyTexture`);
  } else use('specular_roughness', rough, 'g', 'linear', 'pbrMetallicRoughness/metallicRoughnessTexture');

  if (!glossy) {
    use(
      'specular_weight',
      extensions.KHR_materials_specular?.specularTexture,
      'a',
      'linear',
      `${EXTENSION}specular/specularTexture`,
    );
    use(
      'specular_color',
      extensions.KHR_materials_specular?.specularColorTexture,
      'rgb',
      'srgb',
      `${EXTENSION}specular/specularColorTexture`,
    );
  }
  if (parameters.transmission_weight !== undefined)
    use(
      'transmission_weight',
      extensions.KHR_materials_transmission?.transmissionTexture,
      'r',
      'linear',
      `${EXTENSION}transmission/transmissionTexture`,
    );
  if (parameters.subsurface_weight !== undefined) {
    const path = `${EXTENSION}diffuse_transmission/diffuseTransmission`;
    use(
      'subsurface_weight',
      extensions.KHR_materials_diffuse_transmission?.diffuseTransmissionTexture,
      'a',
      'linear',
      `${path}Texture`,
    );
    use(
      'subsurface_color',
      extensions.KHR_materials_diffuse_transmission?.diffuseTransmissionColorTexture,
      'rgb',
      'srgb',
      `${path}ColorTexture`,
    );
  }
  if (extensions.KHR_materials_volume_scatter?.multiscatterColorTexture)
    lost.push({
      path: `${EXTENSION}volume_scatter/multiscatterColorTexture`,
      reason: 'would give one volume many colours; its factor is read alone',
    });
  if (parameters.coat_weight !== undefined) {
    const path = `${EXTENSION}clearcoat/clearcoat`;
    use('coat_weight', extensions.KHR_materials_clearcoat?.clearcoatTexture, 'r', 'linear', `${path}Texture`);
    use(
      'coat_roughness',
      extensions.KHR_materials_clearcoat?.clearcoatRoughnessTexture,
      'g',
      'linear',
      `${path}RoughnessTexture`,
    );
    use(
      'geometry_coat_normal',
      extensions.KHR_materials_clearcoat?.clearcoatNormalTexture,
      'rgb',
      'linear',
      `${path}NormalTexture`,
    );
  }

  const sheen = extensions.KHR_materials_sheen;
  if (sheen && parameters.fuzz_weight !== undefined) {
    const path = `${EXTENSION}sheen/sheen`;
    const { sheenColorTexture: colorTexture, sheenRoughnessTexture: roughnessTexture } = sheen;
    if (colorTexture) {
      const factor = [0, 1, 2].map((k) => sheen.sheenColorFactor?.[k] ?? 0);
      const image: GltfImageConversion = {
        key: `tint ${factor}`,
        sources: [colorTexture],
        convert: (texels, result) => splitColor(factor, texels, result),
      };
      use('fuzz_color', colorTexture, 'rgb', 'srgb', `${path}ColorTexture`, { value: [1, 1, 1], image });
      use('fuzz_weight', colorTexture, 'a', 'srgb', `${path}ColorTexture`, { value: 1, image });
    }
    if (roughnessTexture) {
      const factor = sheen.sheenRoughnessFactor ?? 0;
      const image: GltfImageConversion = {
        key: `fuzz ${factor}`,
        sources: [roughnessTexture],
        convert: (texels, result) => {
          result[0] = result[1] = result[2] = fuzzRoughness(factor * (texels[3] as number));
          result[3] = 1;
        },
      };
      use('fuzz_roughness', roughnessTexture, 'r', 'linear', `${path}RoughnessTexture`, { value: 1, image });
    }
  }

  const film = extensions.KHR_materials_iridescence;
  if (film && parameters.thin_film_weight !== undefined) {
    const path = `${EXTENSION}iridescence/iridescence`;
    use('thin_film_weight', film.iridescenceTexture, 'r', 'linear', `${path}Texture`);
    const thin = film.iridescenceThicknessMinimum ?? 100,
      thick = film.iridescenceThicknessMaximum ?? 400;
    const max = Math.max(thin, thick);
    if (max > 0)
      use('thin_film_thickness', film.iridescenceThicknessTexture, 'g', 'linear', `${path}ThicknessTexture`, {
        value: max / 1000,
        range: [thin / max, thick / max],
      });
  }
  return { uses, lost };
}
