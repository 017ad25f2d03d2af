import {
  fromGltf,
  gltfTextures,
  type GltfMaterialFactors,
  type GltfTextureReference,
  type GltfTextureUse,
} from '@glanz/openpbr/gltf';
import type { Material, Scene, TextureBinding, TextureChannels, TexturedParameter } from '@glanz/scene';
import { convertImage } from './convert-image';
import { uvTransformOf, type Textures } from './textures';
import type { Color, ThreeMaterial, ThreeTexture } from './types';

/** Sides of three's materials. */
const [BACK, DOUBLE] = [1, 2];

/** Slots that a path tracer has no place for. */
const LOST = ['bumpMap', 'displacementMap', 'lightMap', 'gradientMap', 'matcap', 'specularMap', 'envMap'] as const;

interface Reference extends GltfTextureReference {
  readonly map: ThreeTexture;
}

/**
 * Whether three turns a material's images over, as all but loaders of glTF let it. Of several that differ the first
 * decides.
 */
export function flipsOf(material: ThreeMaterial): boolean {
  for (const value of Object.values(material)) if (isTexture(value)) return value.flipY;
  return false;
}

const isTexture = (value: unknown): value is ThreeTexture =>
  typeof value === 'object' && value !== null && (value as { isTexture?: unknown }).isTexture === true;

/** A material of three as meshes of one kind show it, and its place in the scene. */
export interface MaterialEntry {
  readonly material: ThreeMaterial;
  readonly flipped: boolean;
  readonly hasTangents: boolean;
  readonly tint: Color | undefined;
  /** Index in `Scene.materials`. */
  readonly index: number;
}

/**
 * Converts materials: their factors in the shape of glTF's, whose mapping to OpenPBR then serves.
 */
export class Materials {
  readonly #scene: Scene;
  readonly #textures: Textures;
  readonly #made = new Map<string, { readonly entry: MaterialEntry; readonly ready: Promise<number> }>();

  constructor(scene: Scene, textures: Textures) {
    this.#scene = scene;
    this.#textures = textures;
  }

  /** All that have been converted. */
  get entries(): readonly MaterialEntry[] {
    return [...this.#made.values()].map(({ entry }) => entry);
  }

  /** The place of a material that was converted before; `undefined` of another one. */
  find(material: ThreeMaterial, flipped: boolean, hasTangents: boolean, tint?: Color): number | undefined {
    return this.#made.get(keyOf(material, flipped, hasTangents, tint))?.entry.index;
  }

  /**
   * Index of a material.
   *
   * @param tint Multiplies its colour, as instances' colours do.
   */
  get(material: ThreeMaterial, flipped: boolean, hasTangents: boolean, tint?: Color): Promise<number> {
    const key = keyOf(material, flipped, hasTangents, tint);
    let made = this.#made.get(key);
    if (!made) {
      // Its place is taken now, so that the order does not depend on images.
      const index = this.#scene.materials.push({ name: material.name || material.type, parameters: {} }) - 1;
      const entry = { material, flipped, hasTangents, tint, index };
      const ready = this.convert(entry).then((converted) => {
        this.#scene.materials[index] = converted;
        return index;
      });
      made = { entry, ready };
      this.#made.set(key, made);
    }
    return made.ready;
  }

  /** What a material is now. */
  convert({ material, flipped, hasTangents, tint }: MaterialEntry): Promise<Material> {
    return this.#convert(material, flipped, hasTangents, tint);
  }

  async #convert(
    material: ThreeMaterial,
    flipped: boolean,
    hasTangents: boolean,
    tint: Color | undefined,
  ): Promise<Material> {
    const read = new Reader(material);
    const { warnings } = this.#scene;
    const warn = (what: string) => {
      const message = `Material "${material.name || material.type}": ${what}.`;
      // A material that is converted again warns of what is new.
      if (!warnings.some((known) => known.path === material.uuid && known.message === message))
        warnings.push({ code: 'three/material', message, path: material.uuid });
    };
    const factors = factorsOf(read, tint, warn);
    const parameters: Record<string, unknown> = { ...fromGltf(factors) };
    const textures: NonNullable<Material['textures']> = {};
    for (const slot of LOST) if (isTexture(material[slot])) warn(`${slot} is not supported`);

    const bind = async (
      parameter: string,
      map: ThreeTexture,
      channels: TextureChannels,
      colorSpace: 'srgb' | 'linear',
      more: Pick<GltfTextureUse, 'range' | 'value' | 'image'> = {},
    ) => {
      if (map.channel > 1) return warn(`a texture reads uv${map.channel}, but two sets are supported; it is left out`);
      const texture = more.image
        ? await this.#derive(more.image, map, colorSpace)
        : await this.#textures.get(map, colorSpace);
      if (texture === undefined) return undefined;
      const binding: TextureBinding = { texture, channels };
      if (map.channel === 1) binding.uv = 1;
      const transform = uvTransformOf(map, flipped);
      if (transform) binding.transform = transform;
      if (more.range) binding.range = more.range;
      const scale =
        parameter === 'geometry_normal'
          ? material['normalScale']
          : parameter === 'geometry_coat_normal'
            ? material['clearcoatNormalScale']
            : undefined;
      if (scale) {
        const { x, y } = scale as { readonly x: number; readonly y: number };
        if (x !== 1) binding.scale = Math.abs(x);
        // Loaders of glTF turn y over where three makes the tangents from coordinates that run downwards.
        const usual = x * (flipped || hasTangents ? 1 : -1);
        if (Math.abs(y - usual) > 1e-6)
          warn(`its normal scale (${x}, ${y}) is not supported but for its size ${Math.abs(x)}`);
      }
      textures[parameter as TexturedParameter] = binding;
      if (more.value !== undefined) parameters[parameter] = more.value;
      return undefined;
    };

    const { uses, lost } = gltfTextures(factors);
    for (const { path, reason } of lost) warn(`${path} ${reason}`);
    const metalnessMap = read.texture('metalnessMap');
    for (const { parameter, texture, channels, colorSpace, ...more } of uses) {
      // glTF has both in one image; three may have one of them, or two.
      if (parameter === 'base_metalness') continue;
      await bind(parameter, (texture as Reference).map, channels, colorSpace, more);
    }
    if (metalnessMap && !factors.extensions?.KHR_materials_unlit)
      await bind('base_metalness', metalnessMap, 'b', 'linear');
    const alphaMap = read.texture('alphaMap');
    if (alphaMap && factors.alphaMode !== 'OPAQUE') {
      if (textures.geometry_opacity) warn('of its alphaMap and the alpha of its map only the former is supported');
      await bind('geometry_opacity', alphaMap, 'g', 'linear');
    }

    const made: Material = { name: material.name || material.type, parameters };
    if (Object.keys(textures).length > 0) made.textures = textures;
    if (material['side'] === DOUBLE) made.double_sided = true;
    if (material['side'] === BACK) warn('BackSide is shown from both sides');
    const alphaTest = read.number('alphaTest', 0);
    if (alphaTest > 0) made.opacity_threshold = alphaTest;
    return made;
  }

  async #derive(
    conversion: NonNullable<GltfTextureUse['image']>,
    like: ThreeTexture,
    colorSpace: 'srgb' | 'linear',
  ): Promise<number | undefined> {
    const images = await Promise.all(
      conversion.sources.map((source) => this.#textures.imageOf((source as Reference).map)),
    );
    if (images.every((image) => image === undefined)) return undefined;
    return this.#textures.add(convertImage(conversion.key, images, conversion, colorSpace), like, colorSpace);
  }
}

const keyOf = (material: ThreeMaterial, flipped: boolean, hasTangents: boolean, tint?: Color): string =>
  [material.uuid, flipped, hasTangents, tint ? [tint.r, tint.g, tint.b] : ''].join(' ');

/** Reads a material's properties, with defaults. */
class Reader {
  readonly material: ThreeMaterial;

  constructor(material: ThreeMaterial) {
    this.material = material;
  }

  number(name: string, fallback: number): number {
    const value = this.material[name];
    return typeof value === 'number' && !Number.isNaN(value) ? value : fallback;
  }

  color(name: string, fallback: readonly [number, number, number]): [number, number, number] {
    const value = this.material[name] as Partial<Color> | undefined;
    return value && typeof value.r === 'number' ? [value.r, value.g as number, value.b as number] : [...fallback];
  }

  texture(name: string): ThreeTexture | undefined {
    const value = this.material[name];
    return isTexture(value) ? value : undefined;
  }

  /** A reference as glTF's mapping wants it: it only compares where textures lie. */
  reference(name: string): Reference | undefined {
    const map = this.texture(name);
    if (!map) return undefined;
    if (map.matrixAutoUpdate) map.updateMatrix();
    return {
      index: 0,
      map,
      texCoord: map.channel,
      extensions: { KHR_texture_transform: { matrix: Array.from(map.matrix.elements), flipY: map.flipY } },
    };
  }
}

const given = <T extends object>(object: T): T =>
  Object.fromEntries(Object.entries(object).filter(([, value]) => value !== undefined)) as T;

/** A material in the shape of glTF's. */
function factorsOf(read: Reader, tint: Color | undefined, warn: (message: string) => void): GltfMaterialFactors {
  const { material } = read;
  const base = read
    .color('color', [1, 1, 1])
    .map((value, k) => value * (tint ? ([tint.r, tint.g, tint.b][k] as number) : 1));
  const alphaMode = read.number('alphaTest', 0) > 0 ? 'MASK' : material['transparent'] === true ? 'BLEND' : 'OPAQUE';
  const baseColorFactor = [...base, alphaMode === 'OPAQUE' ? 1 : read.number('opacity', 1)];
  const baseColorTexture = read.reference('map');
  if (material['isMeshBasicMaterial'] === true)
    return {
      alphaMode,
      pbrMetallicRoughness: given({ baseColorFactor, baseColorTexture }) as object,
      extensions: { KHR_materials_unlit: {} },
    };

  const standard = material['isMeshStandardMaterial'] === true;
  if (!standard) warn(`${material.type} is shown as a standard material of its colours`);
  const shininess = read.number('shininess', Number.NaN);
  // Of the Phong lobe's exponent: Walter et al. 2007.
  const roughnessFactor = standard ? read.number('roughness', 1) : shininess >= 0 ? Math.sqrt(2 / (shininess + 2)) : 1;
  const pbr = given({
    baseColorFactor,
    baseColorTexture,
    metallicFactor: standard ? read.number('metalness', 0) : 0,
    roughnessFactor,
    metallicRoughnessTexture: read.reference('roughnessMap'),
  });
  const emissive = read.color('emissive', [0, 0, 0]);
  const strength = read.number('emissiveIntensity', 1);
  const extensions: Record<string, unknown> =
    strength === 1 ? {} : { KHR_materials_emissive_strength: { emissiveStrength: strength } };
  if (material['isMeshPhysicalMaterial'] === true) Object.assign(extensions, physical(read));
  return given({
    alphaMode,
    pbrMetallicRoughness: pbr as object,
    normalTexture: read.reference('normalMap'),
    emissiveTexture: read.reference('emissiveMap'),
    emissiveFactor: emissive,
    extensions: extensions as object,
  }) as GltfMaterialFactors;
}

/** What MeshPhysicalMaterial adds, as the extensions of glTF that it was made for. */
function physical(read: Reader): NonNullable<GltfMaterialFactors['extensions']> {
  const { number, color, reference } = {
    number: read.number.bind(read),
    color: read.color.bind(read),
    reference: read.reference.bind(read),
  };
  const extensions: Record<string, unknown> = { KHR_materials_ior: { ior: number('ior', 1.5) } };
  if (number('clearcoat', 0) > 0) {
    extensions['KHR_materials_clearcoat'] = given({
      clearcoatFactor: number('clearcoat', 0),
      clearcoatTexture: reference('clearcoatMap'),
      clearcoatRoughnessFactor: number('clearcoatRoughness', 0),
      clearcoatRoughnessTexture: reference('clearcoatRoughnessMap'),
      clearcoatNormalTexture: reference('clearcoatNormalMap'),
    });
  }
  if (number('transmission', 0) > 0)
    extensions['KHR_materials_transmission'] = given({
      transmissionFactor: number('transmission', 0),
      transmissionTexture: reference('transmissionMap'),
    });
  if (number('thickness', 0) > 0) {
    const distance = number('attenuationDistance', Infinity);
    extensions['KHR_materials_volume'] = given({
      thicknessFactor: number('thickness', 0),
      attenuationDistance: distance > 0 && distance < Infinity ? distance : undefined,
      attenuationColor: color('attenuationColor', [1, 1, 1]),
    });
  }
  if (number('sheen', 0) > 0) {
    const weight = number('sheen', 0);
    extensions['KHR_materials_sheen'] = given({
      sheenColorFactor: color('sheenColor', [0, 0, 0]).map((value) => value * weight),
      sheenColorTexture: reference('sheenColorMap'),
      sheenRoughnessFactor: number('sheenRoughness', 1),
      sheenRoughnessTexture: reference('sheenRoughnessMap'),
    });
  }
  extensions['KHR_materials_specular'] = given({
    specularFactor: number('specularIntensity', 1),
    specularTexture: reference('specularIntensityMap'),
    specularColorFactor: color('specularColor', [1, 1, 1]),
    specularColorTexture: reference('specularColorMap'),
  });
  if (number('iridescence', 0) > 0) {
    const [thin, thick] = (read.material['iridescenceThicknessRange'] as readonly [number, number] | undefined) ?? [
      100, 400,
    ];
    extensions['KHR_materials_iridescence'] = given({
      iridescenceFactor: number('iridescence', 0),
      iridescenceTexture: reference('iridescenceMap'),
      iridescenceIor: number('iridescenceIOR', 1.3),
      iridescenceThicknessMinimum: thin,
      iridescenceThicknessMaximum: thick,
      iridescenceThicknessTexture: reference('iridescenceThicknessMap'),
    });
  }
  if (number('anisotropy', 0) > 0)
    extensions['KHR_materials_anisotropy'] = given({
      anisotropyStrength: number('anisotropy', 0),
      anisotropyRotation: number('anisotropyRotation', 0),
      anisotropyTexture: reference('anisotropyMap'),
    });
  if (number('dispersion', 0) > 0) extensions['KHR_materials_dispersion'] = { dispersion: number('dispersion', 0) };
  return extensions as NonNullable<GltfMaterialFactors['extensions']>;
}
