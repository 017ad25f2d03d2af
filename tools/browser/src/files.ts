const pad = (bytes: Buffer, fill: number) => Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4, fill)]);

/** A binary glTF around a JSON document and its buffer. */
export function glb(json: object, binary: Buffer): Buffer {
  const text = pad(Buffer.from(JSON.stringify(json)), 0x20);
  const data = pad(binary, 0);
  const header = Buffer.alloc(12);
  header.write('glTF');
  header.writeUInt32LE(2, 4);
  header.writeUInt32LE(12 + 8 + text.length + 8 + data.length, 8);
  const chunk = (type: string, body: Buffer) => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(body.length);
    head.write(type, 4);
    return Buffer.concat([head, body]);
  };
  return Buffer.concat([header, chunk('JSON', text), chunk('BIN\0', data)]);
}

/** A square of side 2 in a plane of constant z, facing +z, matt. */
export interface Quad {
  readonly name: string;
  readonly colour: readonly [number, number, number];
  /** Middle; default the origin. */
  readonly at?: readonly [number, number, number];
  /** Colour in each variant of the document. */
  readonly variants?: Readonly<Record<string, readonly [number, number, number]>>;
}

/**
 * A glTF file of squares, with `KHR_materials_variants` where one names variants. `change` edits the document; `more`
 * is added to its buffer.
 */
export function quads(
  list: readonly Quad[],
  change: (json: Record<string, unknown>) => void = () => undefined,
  more: Buffer = Buffer.alloc(0),
): Buffer {
  const positions = Float32Array.of(-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0);
  const indices = Uint32Array.of(0, 1, 2, 0, 2, 3);
  const matt = (name: string, colour: readonly number[]) => ({
    name,
    pbrMetallicRoughness: { baseColorFactor: [...colour, 1], metallicFactor: 0, roughnessFactor: 1 },
  });
  const names = [...new Set(list.flatMap(({ variants = {} }) => Object.keys(variants)))];
  const materials: object[] = [];
  const meshes = list.map(({ name, colour, variants = {} }) => {
    const material = materials.push(matt(name, colour)) - 1;
    const mappings = Object.entries(variants).map(([variant, other]) => ({
      material: materials.push(matt(`${name} ${variant}`, other)) - 1,
      variants: [names.indexOf(variant)],
    }));
    return {
      name,
      primitives: [
        {
          attributes: { POSITION: 0 },
          indices: 1,
          material,
          ...(mappings.length > 0 ? { extensions: { KHR_materials_variants: { mappings } } } : {}),
        },
      ],
    };
  });
  const json: Record<string, unknown> = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: list.map((_, i) => i) }],
    nodes: list.map(({ name, at = [0, 0, 0] }, mesh) => ({ name, mesh, translation: at })),
    meshes,
    materials,
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: 'VEC3', min: [-1, -1, 0], max: [1, 1, 0] },
      { bufferView: 1, componentType: 5125, count: 6, type: 'SCALAR' },
    ],
    bufferViews: [
      { buffer: 0, byteLength: 48 },
      { buffer: 0, byteOffset: 48, byteLength: 24 },
    ],
    buffers: [{ byteLength: 72 }],
    ...(names.length > 0
      ? {
          extensionsUsed: ['KHR_materials_variants'],
          extensions: { KHR_materials_variants: { variants: names.map((name) => ({ name })) } },
        }
      : {}),
  };
  change(json);
  return glb(json, Buffer.concat([Buffer.from(positions.buffer), Buffer.from(indices.buffer), more]));
}

/** One triangle in the plane z = 0, facing +z, matt in a colour; `change` edits the document. */
export function triangle(
  colour: readonly [number, number, number],
  change: (json: Record<string, unknown>) => void = () => undefined,
): Buffer {
  const positions = Float32Array.of(-1, -1, 0, 1, -1, 0, 0, 1, 0);
  const json: Record<string, unknown> = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ name: 'Sail', mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, material: 0 }] }],
    materials: [
      {
        name: 'cloth',
        pbrMetallicRoughness: { baseColorFactor: [...colour, 1], metallicFactor: 0, roughnessFactor: 1 },
      },
    ],
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [-1, -1, 0], max: [1, 1, 0] }],
    bufferViews: [{ buffer: 0, byteLength: 36 }],
    buffers: [{ byteLength: 36 }],
  };
  change(json);
  return glb(json, Buffer.from(positions.buffer));
}

/** A Radiance image of one colour, 4 × 2 pixels, flat RGBE: mantissas of 128 and exponent 129 are 1. */
export function hdr(rgbe: readonly [number, number, number, number]): Buffer {
  return Buffer.concat([
    Buffer.from('#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n'),
    Buffer.from(Array.from({ length: 8 }, () => rgbe).flat()),
  ]);
}
