import type { Attribute, Loose, ThreeMaterial, ThreeMesh, ThreeTexture } from './types';

/** Fields of a material that no conversion reads. */
const IGNORED = new Set(['uuid', 'name', 'version', 'userData', '_listeners']);

/** A text that changes when what is read of a texture changes: its image by its version, its place by its numbers. */
export function textureState(texture: ThreeTexture | null | undefined): string {
  if (!texture) return '';
  const { offset, repeat, center, rotation } = texture as unknown as Record<string, { x: number; y: number }>;
  const { source, version } = texture as unknown as {
    readonly source?: { uuid: string; version?: number };
    version: number;
  };
  return [
    texture.uuid,
    version,
    source?.uuid,
    source?.version,
    texture.mapping,
    texture.wrapS,
    texture.wrapT,
    texture.magFilter,
    texture.channel,
    texture.flipY,
    texture.colorSpace,
    ...[offset, repeat, center].flatMap((v) => (v ? [v.x, v.y] : [])),
    rotation,
    texture.matrixAutoUpdate ? '' : Array.from(texture.matrix.elements).join(),
  ].join();
}

/** A text that changes when a field of a material changes. */
export function materialState(material: ThreeMaterial): string {
  let state = '';
  for (const [name, value] of Object.entries(material)) {
    if (IGNORED.has(name)) continue;
    if (typeof value === 'number' || typeof value === 'boolean') state += `${name}=${value};`;
    else if (typeof value === 'object' && value !== null) state += `${name}=${objectState(value as Loose)};`;
  }
  return state;
}

/** Of a colour, a vector, a range or a texture; nothing of others. */
function objectState(value: Loose): string {
  if (value['isTexture'] === true) return textureState(value as unknown as ThreeTexture);
  if (value['isColor'] === true) return `${String(value['r'])},${String(value['g'])},${String(value['b'])}`;
  if (value['isVector2'] === true) return `${String(value['x'])},${String(value['y'])}`;
  if (Array.isArray(value)) return value.filter((one) => typeof one === 'number').join();
  return '';
}

const versionOf = (attribute: Attribute | null | undefined): number => {
  const { version, data } = (attribute ?? {}) as { version?: number; data?: { version: number } };
  return version ?? data?.version ?? 0;
};

/** A text that changes when the parts of a mesh do: its geometry, ranges and groups, how many instances. */
export function partsState(mesh: ThreeMesh): string {
  const { uuid, index, attributes, groups, drawRange } = mesh.geometry;
  const { count, instanceColor } = mesh as unknown as { count?: number; instanceColor?: Attribute | null };
  return [
    uuid,
    index?.count,
    drawRange.start,
    drawRange.count,
    Object.entries(attributes).map(([name, attribute]) => `${name}:${attribute?.count}`),
    groups.map(({ start, count: length, materialIndex }) => `${start}:${length}:${materialIndex}`),
    mesh.isInstancedMesh ? `${count}:${versionOf(instanceColor)}` : '',
  ].join();
}

/** A text that changes when vertices were written: `needsUpdate` of an attribute. */
export function verticesState({ geometry }: ThreeMesh): string {
  return [versionOf(geometry.index), ...Object.values(geometry.attributes).map(versionOf)].join();
}

/** The numbers that pose a mesh: influences of its morph targets, and matrices of its bones. */
export function poseState(mesh: ThreeMesh): number[] {
  const { skeleton } = mesh as unknown as {
    readonly skeleton?: {
      readonly bones: readonly { readonly matrixWorld: { readonly elements: ArrayLike<number> } }[];
    };
  };
  return [
    ...(mesh.morphTargetInfluences ?? []),
    ...(mesh.isSkinnedMesh
      ? (skeleton?.bones ?? []).flatMap(({ matrixWorld }) => Array.from(matrixWorld.elements))
      : []),
  ];
}
