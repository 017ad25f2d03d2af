/** What {@link makeGlb} puts into the file besides one red square of 2 × 2 m at the origin that faces +Z. */
export interface GlbParts {
  /** Adds a camera called "front" at z = 4. */
  readonly camera?: boolean;
  /** URI of the base colour texture. */
  readonly texture?: string;
  /** Leave the triangles out. */
  readonly empty?: boolean;
  /** Adds the looks "green", which glows, and "blue", which is glossy, beside the red one. */
  readonly variants?: boolean;
}

/** A small binary glTF, put together byte by byte. */
export function makeGlb({ camera = false, texture, empty = false, variants = false }: GlbParts = {}): Uint8Array {
  const positions = new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]);
  const uvs = new Float32Array([0, 1, 1, 1, 1, 0, 0, 0]);
  const indices = new Uint16Array([0, 1, 2, 0, 2, 3]);
  const bin = new Uint8Array(48 + 32 + 12);
  bin.set(new Uint8Array(positions.buffer), 0);
  bin.set(new Uint8Array(uvs.buffer), 48);
  bin.set(new Uint8Array(indices.buffer), 80);
  const json = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: camera ? [0, 1] : [0] }],
    nodes: [
      { name: 'square', ...(empty ? {} : { mesh: 0 }) },
      ...(camera ? [{ name: 'front', camera: 0, translation: [0, 0, 4] }] : []),
    ],
    ...(camera ? { cameras: [{ name: 'front', type: 'perspective', perspective: { yfov: 0.6, znear: 0.1 } }] } : {}),
    ...(empty
      ? {}
      : {
          meshes: [
            {
              name: 'square',
              primitives: [
                {
                  attributes: { POSITION: 0, TEXCOORD_0: 1 },
                  indices: 2,
                  material: 0,
                  ...(variants
                    ? {
                        extensions: {
                          KHR_materials_variants: {
                            mappings: [
                              { material: 1, variants: [1] },
                              { material: 2, variants: [2] },
                            ],
                          },
                        },
                      }
                    : {}),
                },
              ],
            },
          ],
          accessors: [
            { bufferView: 0, componentType: 5126, count: 4, type: 'VEC3', min: [-1, -1, 0], max: [1, 1, 0] },
            { bufferView: 1, componentType: 5126, count: 4, type: 'VEC2' },
            { bufferView: 2, componentType: 5123, count: 6, type: 'SCALAR' },
          ],
          bufferViews: [
            { buffer: 0, byteOffset: 0, byteLength: 48 },
            { buffer: 0, byteOffset: 48, byteLength: 32 },
            { buffer: 0, byteOffset: 80, byteLength: 12 },
          ],
          buffers: [{ byteLength: bin.length }],
        }),
    materials: [
      {
        name: 'red',
        pbrMetallicRoughness: {
          baseColorFactor: [0.8, 0.1, 0.05, 1],
          metallicFactor: 0,
          roughnessFactor: 1,
          ...(texture ? { baseColorTexture: { index: 0 } } : {}),
        },
      },
      ...(variants
        ? [
            {
              name: 'green',
              pbrMetallicRoughness: { baseColorFactor: [0, 0.5, 0, 1], metallicFactor: 0 },
              emissiveFactor: [0, 0.3, 0],
            },
            {
              name: 'blue',
              pbrMetallicRoughness: { baseColorFactor: [0, 0, 0.7, 1], metallicFactor: 0, roughnessFactor: 0.2 },
            },
          ]
        : []),
    ],
    ...(variants
      ? {
          extensionsUsed: ['KHR_materials_variants'],
          extensions: {
            KHR_materials_variants: { variants: [{ name: 'red' }, { name: 'green' }, { name: 'deep blue' }] },
          },
        }
      : {}),
    ...(texture ? { textures: [{ source: 0 }], images: [{ uri: texture }] } : {}),
  };
  const text = new TextEncoder().encode(JSON.stringify(json));
  const padded = new Uint8Array(Math.ceil(text.length / 4) * 4).fill(0x20);
  padded.set(text);
  const out = new Uint8Array(12 + 8 + padded.length + (empty ? 0 : 8 + bin.length));
  const view = new DataView(out.buffer);
  view.setUint32(0, 0x46546c67, true);
  view.setUint32(4, 2, true);
  view.setUint32(8, out.length, true);
  view.setUint32(12, padded.length, true);
  view.setUint32(16, 0x4e4f534a, true);
  out.set(padded, 20);
  if (!empty) {
    view.setUint32(20 + padded.length, bin.length, true);
    view.setUint32(24 + padded.length, 0x004e4942, true);
    out.set(bin, 28 + padded.length);
  }
  return out;
}
