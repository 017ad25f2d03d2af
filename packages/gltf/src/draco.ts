import { ELEMENT_SIZE, toFloats, type Numbers } from './accessors';
import type { GltfAccessor } from './json';

/** The parts of the module of `draco3dgltf` (`createDecoderModule()`) that are used. */
interface DracoModule {
  readonly DecoderBuffer: new () => object & { Init(bytes: Uint8Array, length: number): void };
  readonly Decoder: new () => DracoDecoder;
  readonly Mesh: new () => DracoMesh;
  readonly TRIANGULAR_MESH: number;
  readonly DT_INT8: number;
  readonly DT_UINT8: number;
  readonly DT_INT16: number;
  readonly DT_UINT16: number;
  readonly DT_UINT32: number;
  readonly DT_FLOAT32: number;
  readonly HEAPU8: Uint8Array;
  destroy(object: object): void;
  _malloc(bytes: number): number;
  _free(address: number): void;
}

type DracoMesh = object & { num_points(): number; num_faces(): number; ptr: number };

interface DracoDecoder {
  GetEncodedGeometryType(buffer: object): number;
  DecodeBufferToMesh(buffer: object, mesh: DracoMesh): object & { ok(): boolean; error_msg(): string };
  GetAttributeByUniqueId(mesh: DracoMesh, id: number): object & { ptr: number; num_components(): number };
  GetAttributeDataArrayForAllPoints(
    mesh: DracoMesh,
    attribute: object,
    type: number,
    bytes: number,
    address: number,
  ): boolean;
  GetTrianglesUInt32Array(mesh: DracoMesh, bytes: number, address: number): boolean;
}

const TYPES = {
  5120: ['DT_INT8', Int8Array],
  5121: ['DT_UINT8', Uint8Array],
  5122: ['DT_INT16', Int16Array],
  5123: ['DT_UINT16', Uint16Array],
  5125: ['DT_UINT32', Uint32Array],
  5126: ['DT_FLOAT32', Float32Array],
} as const;

/** A decoded mesh. Attributes by their semantics. */
export interface DracoPrimitive {
  readonly vertices: number;
  readonly indices: Uint32Array<ArrayBuffer>;
  readonly attributes: ReadonlyMap<string, { readonly numbers: Numbers; readonly accessor: GltfAccessor }>;
}

/** An attribute that a compressed mesh holds: its semantic, Draco's id, and what it is in the document. */
export type DracoAttribute = readonly [semantic: string, id: number, accessor: GltfAccessor];

/** The floats of a decoded attribute, as `Accessors.floats` returns them. */
export const dracoFloats = (
  { numbers, accessor }: { readonly numbers: Numbers; readonly accessor: GltfAccessor },
  size: number,
): Float32Array<ArrayBuffer> =>
  toFloats(numbers, accessor.componentType, accessor.normalized ?? false, ELEMENT_SIZE[accessor.type] as number, size);

/**
 * Decodes KHR_draco_mesh_compression.
 *
 * @param module The decoder's module.
 * @param attributes Accessors and Draco's ids by semantics.
 * @param checkSize Called with the bytes of each array before it is allocated; may throw.
 * @throws {Error} if the data are broken.
 */
export function unpackDraco(
  module: unknown,
  bytes: Uint8Array,
  attributes: readonly DracoAttribute[],
  checkSize: (bytes: number) => void,
): DracoPrimitive {
  const draco = module as DracoModule;
  const buffer = new draco.DecoderBuffer();
  const decoder = new draco.Decoder();
  const mesh = new draco.Mesh();
  const read = <T extends Numbers>(
    Type: { new (buffer: ArrayBuffer): T; readonly BYTES_PER_ELEMENT: number },
    count: number,
    fill: (length: number, address: number) => boolean,
  ): T => {
    const length = count * Type.BYTES_PER_ELEMENT;
    const address = draco._malloc(length);
    try {
      if (!fill(length, address)) throw new Error('its numbers cannot be read');
      return new Type(draco.HEAPU8.slice(address, address + length).buffer as ArrayBuffer);
    } finally {
      draco._free(address);
    }
  };
  try {
    buffer.Init(bytes, bytes.length);
    if (decoder.GetEncodedGeometryType(buffer) !== draco.TRIANGULAR_MESH)
      throw new Error('it is not a mesh of triangles');
    const status = decoder.DecodeBufferToMesh(buffer, mesh);
    if (!status.ok() || mesh.ptr === 0) throw new Error(status.error_msg() || 'it is broken');
    const vertices = mesh.num_points(),
      faces = mesh.num_faces();
    checkSize(12 * faces);
    const indices = read<Uint32Array<ArrayBuffer>>(Uint32Array, 3 * faces, (length, address) =>
      decoder.GetTrianglesUInt32Array(mesh, length, address),
    );
    const found = new Map<string, { numbers: Numbers; accessor: GltfAccessor }>();
    for (const [semantic, id, accessor] of attributes) {
      const attribute = decoder.GetAttributeByUniqueId(mesh, id);
      const size = ELEMENT_SIZE[accessor.type] as number;
      if (attribute.ptr === 0 || attribute.num_components() !== size)
        throw new Error(`it has no attribute ${id} of ${accessor.type} for ${semantic}`);
      const [type, Type] = TYPES[accessor.componentType as keyof typeof TYPES];
      checkSize(vertices * size * Type.BYTES_PER_ELEMENT);
      found.set(semantic, {
        accessor,
        numbers: read<Numbers>(
          Type as { new (buffer: ArrayBuffer): Numbers; readonly BYTES_PER_ELEMENT: number },
          vertices * size,
          (length, address) => decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, draco[type], length, address),
        ),
      });
    }
    return { vertices, indices, attributes: found };
  } finally {
    for (const object of [mesh, decoder, buffer]) draco.destroy(object);
  }
}
