import { fromGltf, gltfTextures, type GltfMaterialFactors, type GltfTextureUse } from '@glanz/openpbr/gltf';
import type { Material, SceneWarning, TextureBinding, TexturedParameter } from '@glanz/scene';
import type { GltfMaterial, GltfTextureInfo } from './json';
import { isShallow } from './json-value';
import type { TextureTable } from './images';

/**
 * KHR_texture_transform as an affine map: scaled, then rotated counter-clockwise as seen in the texture (v runs down),
 * then moved.
 */
export function uvTransform(info: GltfTextureInfo): TextureBinding['transform'] {
  const extension = info.extensions?.KHR_texture_transform;
  if (!extension) return undefined;
  const [x = 0, y = 0] = extension.offset ?? [];
  const [sx = 1, sy = 1] = extension.scale ?? [];
  const c = Math.cos(extension.rotation ?? 0),
    s = Math.sin(extension.rotation ?? 0);
  return [c * sx, -s * sx, s * sy, c * sy, x, y];
}

/** The sets of UVs that a scene's mesh holds, by the numbers that they have in the document. */
export type UvSets = readonly [number, number];

/** A material, and what its `uv` 0 and 1 are in the document. */
export interface ReadMaterial {
  readonly made: Material;
  readonly uvSets: UvSets;
}

const setOf = (info: GltfTextureInfo) => info.extensions?.KHR_texture_transform?.texCoord ?? info.texCoord ?? 0;

/** Meshes hold two sets: those that a material's textures ask for. */
function uvSetsOf(uses: readonly GltfTextureUse[]): UvSets {
  const [first = 0, second = 1] = [...new Set(uses.map(({ texture }) => setOf(texture as GltfTextureInfo)))];
  return first <= 1 && second <= 1 ? [0, 1] : [first, second === first ? 0 : second];
}

/** Makes a scene's material of one of the document's, as `@glanz/openpbr/gltf` maps it. */
export function readMaterial(
  material: GltfMaterial,
  index: number,
  table: TextureTable,
  warnings: SceneWarning[],
): ReadMaterial {
  const factors = material as GltfMaterialFactors;
  const parameters: Record<string, unknown> = { ...fromGltf(factors) };
  const textures: NonNullable<Material['textures']> = {};
  const { uses, lost } = gltfTextures(factors);
  const uvSets = uvSetsOf(uses);
  const leaveOut = (path: string, why: string) =>
    warnings.push({
      code: 'gltf/texture',
      message: `Material ${index} ("${material.name ?? ''}"): ${path} ${why}.`,
      path: `/materials/${index}/${path}`,
    });
  const bind = ({ parameter, texture: reference, path, channels, colorSpace, range, value, image }: GltfTextureUse) => {
    const info = reference as GltfTextureInfo;
    const set = uvSets.indexOf(setOf(info));
    if (set < 0)
      return void leaveOut(
        path,
        `reads a texture by TEXCOORD_${setOf(info)}, but its others by TEXCOORD_${uvSets.join(' and ')}; two sets are read, so it is left out`,
      );
    const where = `/materials/${index}/${path}`;
    const texture = image ? table.derive(image, colorSpace, where) : table.get(info.index, colorSpace, where);
    if (texture === undefined) return;
    const binding: TextureBinding = { texture, channels };
    if (set !== 0) binding.uv = set;
    const transform = uvTransform(info);
    if (transform) binding.transform = transform;
    if ((parameter === 'geometry_normal' || parameter === 'geometry_coat_normal') && info.scale !== undefined)
      binding.scale = info.scale;
    if (range) binding.range = range;
    textures[parameter as TexturedParameter] = binding;
    if (value !== undefined) parameters[parameter] = value;
  };
  for (const use of uses) bind(use);
  for (const { path, reason } of lost) leaveOut(path, reason);

  const made: Material = { name: material.name ?? `material ${index}`, parameters };
  if (Object.keys(textures).length > 0) made.textures = textures;
  if (material.doubleSided === true) made.double_sided = true;
  if (material.alphaMode === 'MASK') made.opacity_threshold = material.alphaCutoff ?? 0.5;
  if (material.extras !== undefined) {
    if (isShallow(material.extras)) made.extras = material.extras;
    else
      warnings.push({
        code: 'gltf/material',
        message: `Material ${index} ("${material.name ?? ''}"): its extras lie more than 100 deep in one another; they are left out.`,
        path: `/materials/${index}/extras`,
      });
  }
  return { made, uvSets };
}
