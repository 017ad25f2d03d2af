import { crc32 } from 'node:zlib';

/** A USD layer with a square of 2 m that faces +Z, matt, of one colour. @param colour Linear RGB. */
export const usdSquare = (colour: readonly [number, number, number]): string => `#usda 1.0
(
    defaultPrim = "Square"
    metersPerUnit = 1
    upAxis = "Y"
)

def Mesh "Square" ( prepend apiSchemas = ["MaterialBindingAPI"] )
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    uniform token subdivisionScheme = "none"
    rel material:binding = </Square/Paint>

    def Material "Paint"
    {
        token outputs:surface.connect = </Square/Paint/Surface.outputs:surface>

        def Shader "Surface"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (${colour.join(', ')})
            float inputs:roughness = 0.9
            token outputs:surface
        }
    }
}
`;

/** A USDZ archive with one layer, stored as the format wants it: the data begins at a multiple of 64 bytes. */
export function usdz(layer: string, name = 'model.usda'): Buffer {
  const data = Buffer.from(layer);
  const common = Buffer.alloc(26);
  common.writeUInt16LE(10, 0);
  common.writeUInt32LE(crc32(data), 10);
  common.writeUInt32LE(data.length, 14);
  common.writeUInt32LE(data.length, 18);
  common.writeUInt16LE(name.length, 22);
  const padding = (128 - ((30 + name.length + 4) % 64)) % 64;
  const extra = Buffer.alloc(4 + padding);
  extra.writeUInt16LE(0x1986, 0);
  extra.writeUInt16LE(padding, 2);
  const inLocal = Buffer.from(common);
  inLocal.writeUInt16LE(extra.length, 24);
  const local = Buffer.concat([Buffer.from('PK\x03\x04'), inLocal, Buffer.from(name), extra, data]);
  const entry = Buffer.concat([Buffer.from('PK\x01\x02\x0a\x00'), common, Buffer.alloc(14), Buffer.from(name)]);
  const end = Buffer.alloc(22);
  end.write('PK\x05\x06', 0, 'latin1');
  end.writeUInt16LE(1, 8);
  end.writeUInt16LE(1, 10);
  end.writeUInt32LE(entry.length, 12);
  end.writeUInt32LE(local.length, 16);
  return Buffer.concat([local, entry, end]);
}
