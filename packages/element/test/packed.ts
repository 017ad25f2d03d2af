import { quads } from '@glanz/browser';
import draco3d from 'draco3dgltf';

/** What is used of Draco's encoder. */
interface Encoder {
  readonly [name: string]: unknown;
  readonly Mesh: new () => object;
  readonly MeshBuilder: new () => {
    AddFacesToMesh(mesh: object, faces: number, indices: Uint32Array): void;
    AddFloatAttributeToMesh(mesh: object, type: unknown, vertices: number, size: number, values: Float32Array): number;
  };
  readonly Encoder: new () => { EncodeMeshToDracoBuffer(mesh: object, array: object): number };
  readonly DracoInt8Array: new () => { GetValue(index: number): number };
}

type Json = Record<string, never>;

/** Replaces the buffer of a document of one quad by its old one and more bytes. @returns Where they begin. */
function append(json: Json, bytes: Buffer): number {
  const { buffers, bufferViews } = json as unknown as { buffers: { byteLength: number }[]; bufferViews: object[] };
  const at = buffers[0]!.byteLength;
  buffers[0]!.byteLength += bytes.length;
  bufferViews.push({ buffer: 0, byteOffset: at, byteLength: bytes.length });
  return bufferViews.length - 1;
}

/** A square, red and matt, compressed by Draco's own encoder. */
export async function dracoModel(): Promise<Buffer> {
  const module = (await draco3d.createEncoderModule()) as Encoder;
  const mesh = new module.Mesh(),
    builder = new module.MeshBuilder(),
    array = new module.DracoInt8Array();
  builder.AddFacesToMesh(mesh, 2, Uint32Array.of(0, 1, 2, 0, 2, 3));
  const id = builder.AddFloatAttributeToMesh(
    mesh,
    module['POSITION'],
    4,
    3,
    Float32Array.of(-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0),
  );
  const length = new module.Encoder().EncodeMeshToDracoBuffer(mesh, array);
  const bytes = Buffer.from(Array.from({ length }, (_, i) => array.GetValue(i) & 255));
  return quads(
    [{ name: 'red', colour: [0.9, 0.02, 0.02] }],
    (json) => {
      const view = append(json as Json, bytes);
      const { accessors, meshes } = json as unknown as {
        accessors: { bufferView?: number }[];
        meshes: { primitives: object[] }[];
      };
      // Nothing is left to read without the decoder.
      for (const accessor of accessors) delete accessor.bufferView;
      Object.assign(meshes[0]!.primitives[0]!, {
        extensions: { KHR_draco_mesh_compression: { bufferView: view, attributes: { POSITION: id } } },
      });
      json['extensionsUsed'] = json['extensionsRequired'] = ['KHR_draco_mesh_compression'];
    },
    bytes,
  );
}

/** Numbers of given widths as bits, the lowest first. */
function bits(fields: readonly (readonly [value: number, width: number])[], bytes: number): Buffer {
  const packed = Buffer.alloc(bytes);
  let at = 0;
  for (const [value, width] of fields)
    for (let k = 0; k < width; k++, at++) packed[at >> 3]! |= ((value >> k) & 1) << (at & 7);
  return packed;
}

/**
 * A KTX2 image of 4 × 4 pixels of one colour: a block of UASTC in its mode for one colour, in the container by its
 * specification.
 */
export function ktx2Image([r, g, b]: readonly [number, number, number]): Buffer {
  // Mode 8 has the code 10111; the hints for ETC1 that follow the colour name the same one, in steps of 8.
  const block = bits(
    [
      [0x17, 5],
      [r, 8],
      [g, 8],
      [b, 8],
      [255, 8],
      [0, 1],
      [0, 3],
      [0, 2],
      [r >> 3, 5],
      [g >> 3, 5],
      [b >> 3, 5],
    ],
    16,
  );
  const file = Buffer.alloc(80 + 24 + 44 + 4 + 16);
  file.set([0xab, 0x4b, 0x54, 0x58, 0x20, 0x32, 0x30, 0xbb, 0x0d, 0x0a, 0x1a, 0x0a]);
  // vkFormat, typeSize, width, height, depth, layers, faces, levels, supercompression; then offsets and lengths.
  [0, 1, 4, 4, 0, 0, 1, 1, 0, 104, 44, 0, 0].forEach((value, i) => file.writeUInt32LE(value, 12 + 4 * i));
  [152, 16, 16].forEach((value, i) => file.writeUInt32LE(value, 80 + 8 * i));
  // A basic data format descriptor: UASTC, Rec.709 primaries, sRGB, blocks of 4 × 4 pixels in 16 bytes, one sample of
  // 128 bits.
  file.writeUInt32LE(44, 104);
  file.writeUInt32LE(0, 108);
  file.writeUInt16LE(2, 112);
  file.writeUInt16LE(40, 114);
  file.set([166, 1, 2, 0, 3, 3, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0], 116);
  file.set([0, 0, 127, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255], 132);
  file.set(block, 152);
  return file;
}

/** A square whose image is a KTX2 of one colour. */
export function ktx2Model(colour: readonly [number, number, number] = [230, 8, 8]): Buffer {
  const image = ktx2Image(colour);
  return quads(
    [{ name: 'square', colour: [1, 1, 1] }],
    (json) => {
      const view = append(json as Json, image);
      const { materials } = json as unknown as { materials: { pbrMetallicRoughness: object }[] };
      json['images'] = [{ bufferView: view, mimeType: 'image/ktx2' }];
      json['textures'] = [{ extensions: { KHR_texture_basisu: { source: 0 } } }];
      json['extensionsUsed'] = json['extensionsRequired'] = ['KHR_texture_basisu'];
      Object.assign(materials[0]!.pbrMetallicRoughness, { baseColorTexture: { index: 0 } });
    },
    image,
  );
}
