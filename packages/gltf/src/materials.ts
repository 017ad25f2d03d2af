import { fromGltf } from '@glanz/openpbr/gltf';
import type { Material, SceneWarning, TextureBinding, TextureChannels, TexturedParameter } from '@glanz/scene';
import type { GltfMaterial, GltfTextureInfo } from './json';
import type { TextureTable } from './images';

/**
 * KHR_texture_transform as an affine map: scaled, then turned counter-clockwise as seen in the picture (v runs down), then
 * moved.
 */
export function uvTransform(info: GltfTextureInfo): TextureBinding['transform'] {
  const extension = info.extensions?.KHR_texture_transform;
  if (!extension) return undefined;
  const [x = 0, y = 0] = extension.offset ?? [];
  const [sx = 1, sy = 1] = extension.scale ?? [];
  const c = Math.cos(extension.rotation ?? 0), s = Math.sin(extension.rotation ?? 0);
  return [c * sx, -s * sx, s * sy, c * sy, x, y];
}

/** Makes a scene's material of one of the document's. */
export function readMaterial(material: GltfMaterial, index: number, table: TextureTable, warnings: SceneWarning[]): Material {
  const parameters = fromGltf(material);
  const textures: NonNullable<Material['textures']> = {};
  const bind = (parameter: TexturedParameter, info: GltfTextureInfo | undefined, channels: TextureChannels, colorSpace: 'srgb' | 'linear', field: string) => {
    if (!info) return;
    const texture = table.get(info.index, colorSpace, `/materials/${index}/${field}`);
    if (texture === undefined) return;
    const binding: TextureBinding = { texture, channels };
    const set = info.extensions?.KHR_texture_transform?.texCoord ?? info.texCoord ?? 0;
    if (set !== 0 && set !== 1) {
      warnings.push({ code: 'gltf/texture', message: `Material ${index} ("${material.name ?? ''}") reads a texture by TEXCOORD_${set}; only sets 0 and 1 are read, so it is left out.`, path: `/materials/${index}/${field}` });
      return;
    }
    if (set !== 0) binding.uv = set;
    const transform = uvTransform(info);
    if (transform) binding.transform = transform;
    if (parameter === 'geometry_normal' && info.scale !== undefined) binding.scale = info.scale;
    textures[parameter] = binding;
  };
  const pbr = material.pbrMetallicRoughness ?? {};
  const specular = material.extensions?.KHR_materials_specular;
  const clearcoat = material.extensions?.KHR_materials_clearcoat;
  bind('base_color', pbr.baseColorTexture, 'rgb', 'srgb', 'pbrMetallicRoughness/baseColorTexture');
  if (parameters.geometry_opacity !== undefined) bind('geometry_opacity', pbr.baseColorTexture, 'a', 'srgb', 'pbrMetallicRoughness/baseColorTexture');
  bind('base_metalness', pbr.metallicRoughnessTexture, 'b', 'linear', 'pbrMetallicRoughness/metallicRoughnessTexture');
  bind('specular_roughness', pbr.metallicRoughnessTexture, 'g', 'linear', 'pbrMetallicRoughness/metallicRoughnessTexture');
  bind('geometry_normal', material.normalTexture, 'rgb', 'linear', 'normalTexture');
  if (parameters.emission_color) bind('emission_color', material.emissiveTexture, 'rgb', 'srgb', 'emissiveTexture');
  bind('specular_weight', specular?.specularTexture, 'a', 'linear', 'extensions/KHR_materials_specular/specularTexture');
  bind('specular_color', specular?.specularColorTexture, 'rgb', 'srgb', 'extensions/KHR_materials_specular/specularColorTexture');
  bind('coat_weight', clearcoat?.clearcoatTexture, 'r', 'linear', 'extensions/KHR_materials_clearcoat/clearcoatTexture');
  bind('coat_roughness', clearcoat?.clearcoatRoughnessTexture, 'g', 'linear', 'extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture');
  const coatNormal = clearcoat?.clearcoatNormalTexture;
  if (coatNormal && coatNormal.index !== material.normalTexture?.index) {
    warnings.push({ code: 'gltf/ignored-extension', message: `Material ${index} ("${material.name ?? ''}") has a normal map for its clearcoat, which is not read: the coat follows the normal of the base.`, path: `/materials/${index}/extensions/KHR_materials_clearcoat/clearcoatNormalTexture` });
  }

  const made: Material = { name: material.name ?? `material ${index}`, parameters };
  if (Object.keys(textures).length > 0) made.textures = textures;
  if (material.doubleSided === true) made.double_sided = true;
  if (material.alphaMode === 'MASK') made.opacity_threshold = material.alphaCutoff ?? 0.5;
  if (material.extras !== undefined) made.extras = material.extras;
  return made;
}
