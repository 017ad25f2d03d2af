import { describe, expect, test } from 'vitest';
import { loadGltf, type ImageDecoder } from '../src/index';
import { glb, triangle, type TriangleJson } from './build';

const white: ImageDecoder = async () => ({ width: 1, height: 1, data: new Uint8Array([255, 255, 255, 255]) });
const PNG = 'data:image/png;base64,iVBORw0KGgo=';

/** The triangle with five UV sets, the coordinates of each being its number, and a material. */
function withSets(material: object): { json: TriangleJson; bytes: Uint8Array<ArrayBuffer> } {
  const { json, binary } = triangle();
  const bytes = new Uint8Array(44 + 5 * 24);
  bytes.set(binary);
  for (let set = 0; set < 5; set++) {
    new Float32Array(bytes.buffer, 44 + 24 * set, 6).fill(set);
    json['bufferViews'].push({ buffer: 0, byteOffset: 44 + 24 * set, byteLength: 24 });
    json['accessors'].push({ bufferView: 2 + set, componentType: 5126, type: 'VEC2', count: 3 });
    json['meshes'][0].primitives[0].attributes[`TEXCOORD_${set}`] = 2 + set;
  }
  json['buffers'][0].byteLength = bytes.length;
  json['images'] = [{ uri: PNG }];
  json['textures'] = [{ source: 0 }];
  json['materials'] = [material];
  json['extensionsUsed'] = ['KHR_texture_transform', 'KHR_materials_variants'];
  json['meshes'][0].primitives[0].material = 0;
  return { json, bytes };
}

describe('UV sets', () => {
  test.each([
    ['0 and 1 stay what they are', 1, 0],
    ['one beyond the second', 4, 4],
    ['two of any number', 3, 2],
    ['one from below and one from above', 0, 4],
  ])('%s', async (_, base, glow) => {
    const { json, bytes } = withSets({
      pbrMetallicRoughness: { baseColorTexture: { index: 0, texCoord: base } },
      emissiveTexture: { index: 0, texCoord: 9, extensions: { KHR_texture_transform: { texCoord: glow } } },
      emissiveFactor: [1, 1, 1],
    });
    const scene = await loadGltf(glb(json, bytes), { decodeImage: white });
    expect(scene.warnings).toEqual([]);
    const { textures } = scene.materials[0]!;
    // Whatever they are called, each texture lies by the coordinates that it asks for.
    expect(scene.meshes[0]!.uvs![textures!.base_color!.uv ?? 0]![0]).toBe(base);
    expect(scene.meshes[0]!.uvs![textures!.emission_color!.uv ?? 0]![0]).toBe(glow);
  });

  test('a variant that asks for others is reported', async () => {
    const { json, bytes } = withSets({ pbrMetallicRoughness: { baseColorTexture: { index: 0, texCoord: 3 } } });
    json['materials'].push({ name: 'other', pbrMetallicRoughness: { baseColorTexture: { index: 0, texCoord: 2 } } });
    json['extensions'] = { KHR_materials_variants: { variants: [{ name: 'a' }] } };
    json['meshes'][0].primitives[0].extensions = {
      KHR_materials_variants: { mappings: [{ material: 1, variants: [0] }] },
    };
    const scene = await loadGltf(glb(json, bytes), { decodeImage: white });
    expect(scene.warnings).toEqual([
      expect.objectContaining({ code: 'gltf/variant', message: expect.stringMatching(/"other"/) }),
    ]);
  });
});
