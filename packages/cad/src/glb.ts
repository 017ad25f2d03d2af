import type { Mesh, Scene } from '@glanz/scene';
import { toGltfMaterial } from './gltf-material';

/** Options for {@link writeGlb}. */
export interface GlbOptions {
  /** Leaves out all names. Default false. */
  readonly strip?: boolean;
}

/**
 * Writes geometry, materials without textures, and places as a GLB. Cameras, lights and the environment are not written.
 *
 * @example
 * await writeFile('part.glb', writeGlb(scene));
 */
export function writeGlb(scene: Scene, { strip = false }: GlbOptions = {}): Uint8Array<ArrayBuffer> {
  const named = (name: string | undefined) => (strip || !name ? {} : { name });
  const parts: Uint8Array[] = [];
  const bufferViews: object[] = [],
    accessors: object[] = [];
  let length = 0;
  const accessor = (
    array: Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer> | Uint16Array<ArrayBuffer>,
    type: string,
    componentType: number,
    extra: object,
  ): number => {
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    bufferViews.push({
      buffer: 0,
      byteOffset: length,
      byteLength: bytes.length,
      target: type === 'SCALAR' ? 34963 : 34962,
    });
    parts.push(bytes);
    length += Math.ceil(bytes.length / 4) * 4;
    return (
      accessors.push({
        bufferView: bufferViews.length - 1,
        componentType,
        count: array.length / (type === 'SCALAR' ? 1 : 3),
        type,
        ...extra,
      }) - 1
    );
  };
  const geometry = scene.meshes.map((mesh) => ({
    attributes: {
      POSITION: accessor(mesh.positions, 'VEC3', 5126, bounds(mesh)),
      ...(mesh.normals ? { NORMAL: accessor(mesh.normals, 'VEC3', 5126, {}) } : {}),
    },
    // The largest number of a type is kept free.
    indices:
      mesh.positions.length / 3 < 65535
        ? accessor(Uint16Array.from(mesh.indices), 'SCALAR', 5123, {})
        : accessor(mesh.indices, 'SCALAR', 5125, {}),
  }));
  const materials = scene.materials.map((material) => toGltfMaterial(material));
  const meshes: object[] = [];
  const meshOf = new Map<string, number>();
  const nodes = scene.instances
    .filter(({ visible }) => visible !== false)
    .map(({ name, mesh, material, transform }) => {
      const key = `${mesh} ${material}`;
      let at = meshOf.get(key);
      if (at === undefined) {
        at = meshes.push({ ...named(scene.meshes[mesh]?.name), primitives: [{ ...geometry[mesh], material }] }) - 1;
        meshOf.set(key, at);
      }
      return { ...named(name), mesh: at, matrix: Array.from(transform) };
    });
  const extensionsUsed = [...new Set(materials.flatMap(({ extensions }) => extensions))];
  const json = {
    asset: { version: '2.0', generator: 'Glanz' },
    scene: 0,
    scenes: [{ ...named(scene.name), nodes: nodes.map((_, index) => index) }],
    nodes,
    meshes,
    materials: materials.map(({ json: { name, ...rest } }) => ({ ...named(name as string), ...rest })),
    accessors,
    bufferViews,
    buffers: [{ byteLength: length }],
    ...(extensionsUsed.length > 0 ? { extensionsUsed } : {}),
  };
  return container(new TextEncoder().encode(JSON.stringify(json)), parts, length);
}

function bounds({ positions }: Mesh): { min: number[]; max: number[] } {
  const min = [Infinity, Infinity, Infinity],
    max = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i++) {
    min[i % 3] = Math.min(min[i % 3] as number, positions[i] as number);
    max[i % 3] = Math.max(max[i % 3] as number, positions[i] as number);
  }
  return { min, max };
}

function container(text: Uint8Array, parts: readonly Uint8Array[], length: number): Uint8Array<ArrayBuffer> {
  const padded = Math.ceil(text.length / 4) * 4;
  const bytes = new Uint8Array(28 + padded + length);
  const view = new DataView(bytes.buffer);
  [0x46546c67, 2, bytes.length, padded, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.fill(0x20, 20, 20 + padded).set(text, 20);
  view.setUint32(20 + padded, length, true);
  view.setUint32(24 + padded, 0x004e4942, true);
  let at = 28 + padded;
  for (const part of parts) {
    bytes.set(part, at);
    at += Math.ceil(part.length / 4) * 4;
  }
  return bytes;
}
