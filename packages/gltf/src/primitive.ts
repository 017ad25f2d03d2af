import type { Accessors } from './accessors';
import { dracoFloats, unpackDraco, type DracoAttribute, type DracoPrimitive } from './draco';
import { GltfError } from './error';
import type { GltfPrimitive } from './json';
import type { Budget } from './limits';

/** Indices that restart a primitive in graphics interfaces, by the type of the indices. */
const RESTART: Readonly<Record<number, number>> = { 5121: 255, 5123: 65535, 5125: 4294967295 };

/** The data of a primitive, whether it is compressed or not. */
export interface PrimitiveData {
  readonly json: GltfPrimitive;
  /** Number of entries of an attribute; undefined if it does not exist. */
  count(semantic: string): number | undefined;
  /** Numbers of an attribute that is there, `size` for each vertex. A copy. */
  floats(semantic: string, size: number): Float32Array<ArrayBuffer>;
  /** A copy; undefined if there are none. */
  indices(): Uint32Array<ArrayBuffer> | undefined;
  /**
   * The largest value of the type of its indices, which glTF keeps free; undefined if there are none, or they were
   * compressed.
   */
  readonly restart: number | undefined;
  /** Moves of the vertices by a morph target; undefined if it does not move this attribute. */
  target(index: number, semantic: string): Float32Array<ArrayBuffer> | undefined;
}

/** What primitives are read with. */
export interface PrimitiveReader {
  readonly file: string;
  readonly accessors: Accessors;
  readonly viewBytes: (index: number) => Uint8Array<ArrayBuffer>;
  /** Whether the buffer of a view has been read. */
  readonly exists: (view: number) => boolean;
  readonly draco: unknown;
  /** Primitives that workers have unpacked already. */
  readonly ahead: Map<GltfPrimitive, DracoPrimitive>;
  readonly budget: Budget;
  /** Bytes of the document and its buffers. */
  readonly bytes: number;
}

/** The attributes of a compressed primitive that the document knows. */
export const dracoAttributes = (
  { attributes, extensions }: GltfPrimitive,
  { accessors }: PrimitiveReader,
): DracoAttribute[] =>
  Object.entries(extensions?.KHR_draco_mesh_compression?.attributes ?? {}).flatMap(([semantic, id]) =>
    attributes[semantic] === undefined ? [] : [[semantic, id, accessors.at(attributes[semantic])] as const],
  );

/** Opens a primitive; one that is compressed and has not been unpacked yet is unpacked here. */
export function openPrimitive(json: GltfPrimitive, path: string, reader: PrimitiveReader): PrimitiveData {
  const { file, accessors, viewBytes, draco, budget, ahead } = reader;
  const packed = json.extensions?.KHR_draco_mesh_compression;
  const unpacked: DracoPrimitive | undefined = packed && draco ? (ahead.get(json) ?? unpack(packed)) : undefined;
  return {
    json,
    count: (semantic) => {
      if (unpacked?.attributes.has(semantic)) return unpacked.vertices;
      const index = json.attributes[semantic];
      return index === undefined ? undefined : accessors.at(index).count;
    },
    floats: (semantic, size) => {
      const attribute = unpacked?.attributes.get(semantic);
      return attribute ? dracoFloats(attribute, size) : accessors.floats(json.attributes[semantic] as number, size);
    },
    indices: () =>
      unpacked?.indices.slice() ?? (json.indices === undefined ? undefined : accessors.indices(json.indices)),
    restart: json.indices === undefined || unpacked ? undefined : RESTART[accessors.at(json.indices).componentType],
    target: (index, semantic) => {
      const accessor = json.targets?.[index]?.[semantic];
      return accessor === undefined ? undefined : accessors.floats(accessor, 3);
    },
  };

  function unpack({ bufferView }: NonNullable<typeof packed>): DracoPrimitive {
    const at = `${path}/extensions/KHR_draco_mesh_compression`;
    try {
      return unpackDraco(draco, viewBytes(bufferView), dracoAttributes(json, reader), (bytes) =>
        budget.take(bytes, at),
      );
    } catch (cause) {
      if (cause instanceof GltfError) throw cause;
      throw new GltfError(
        'gltf/malformed',
        `${file}: ${at} cannot be unpacked: ${cause instanceof Error ? cause.message : String(cause)}; export the file again.`,
        { cause, location: { file, path: at } },
      );
    }
  }
}
