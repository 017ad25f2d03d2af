import { KHRMaterialsEmissiveStrength, KHRTextureTransform, type Transform } from '@gltf-transform/extensions';
import type { Material, Scene } from '@glanz/scene';
import sharp from 'sharp';
import { describe, expect, test } from 'vitest';
import { decodeImage, loadGltf } from '../src/node';
import { uvTransform } from '../src/materials';
import { spoiled, start, write, type TriangleJson } from './build';

const TRIANGLE = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]);

/** A PNG of one row of RGBA pixels. */
const png = (...pixels: number[]) => sharp(Uint8Array.from(pixels), { raw: { width: pixels.length / 4, height: 1, channels: 4 } }).png().toBuffer().then((b) => new Uint8Array(b));

/** Loads a triangle with a material given as JSON. */
const withMaterial = (material: unknown, more: (json: TriangleJson) => void = () => undefined) =>
  loadGltf(spoiled((json) => { json['materials'] = [material]; json['meshes'][0].primitives[0].material = 0; more(json); }), { decodeImage });

const only = (scene: Scene): Material => {
  expect(scene.materials.length).toBe(1);
  return scene.materials[0]!;
};

describe('factors', () => {
  test('metallic-roughness with emission; sides and extras pass through', async () => {
    const material = only(await withMaterial({ name: 'lamp', doubleSided: true, extras: { part: 7 }, emissiveFactor: [1, 0.5, 0], pbrMetallicRoughness: { baseColorFactor: [0.1, 0.2, 0.3, 0.4], metallicFactor: 0.5, roughnessFactor: 0.25 }, extensions: { KHR_materials_emissive_strength: { emissiveStrength: 12 } } }));
    expect(material).toMatchObject({ name: 'lamp', double_sided: true, extras: { part: 7 } });
    expect(material.parameters).toMatchObject({ base_color: [0.1, 0.2, 0.3], base_metalness: 0.5, specular_roughness: 0.25, emission_color: [1, 0.5, 0], emission_luminance: 12 });
    // OPAQUE ignores the alpha.
    expect(material.parameters.geometry_opacity).toBeUndefined();
  });

  test('MASK has a threshold, BLEND a coverage', async () => {
    const mask = only(await withMaterial({ alphaMode: 'MASK', alphaCutoff: 0.3, pbrMetallicRoughness: { baseColorFactor: [1, 1, 1, 0.4] } }));
    expect([mask.opacity_threshold, mask.parameters.geometry_opacity]).toEqual([0.3, 0.4]);
    expect(only(await withMaterial({ alphaMode: 'MASK' })).opacity_threshold).toBe(0.5);
    const blend = only(await withMaterial({ alphaMode: 'BLEND', pbrMetallicRoughness: { baseColorFactor: [1, 1, 1, 0.4] } }));
    expect([blend.opacity_threshold, blend.parameters.geometry_opacity]).toEqual([undefined, 0.4]);
  });

  test('a primitive without a material has glTF\'s, not OpenPBR\'s', async () => {
    const scene = await loadGltf(spoiled(() => undefined));
    expect(only(scene).parameters).toMatchObject({ base_color: [1, 1, 1], base_metalness: 1, specular_roughness: 1 });
  });

  test.each([
    ['too large', { baseColorFactor: [5, 1, 1, 1] }, { base_color: [1, 1, 1] }],
    ['too short', { baseColorFactor: [0.5, 0.5, 0.5] }, { base_color: [0.5, 0.5, 0.5] }],
    ['a text', { metallicFactor: '1' }, { base_metalness: 1 }],
    ['negative', { roughnessFactor: -1 }, { specular_roughness: 0 }],
    ['null', { roughnessFactor: null }, { specular_roughness: 1 }],
  ])('one that is %s is put right, with a warning that says where', async (_, pbrMetallicRoughness, expected) => {
    const scene = await withMaterial({ pbrMetallicRoughness });
    expect(only(scene).parameters).toMatchObject(expected);
    expect(scene.warnings.map(({ code, path }) => [code, path])).toEqual([['gltf/material', `/materials/0/pbrMetallicRoughness/${Object.keys(pbrMetallicRoughness)[0]}`]]);
  });

  test('rounding is nothing to tell', async () => {
    const scene = await withMaterial({ pbrMetallicRoughness: { baseColorFactor: [1.00000012, 0, 0, 1] } });
    expect([only(scene).parameters.base_color, scene.warnings]).toEqual([[1, 0, 0], []]);
  });
});

describe('textures', () => {
  test('each goes to its parameters, in its colour space and channels', async () => {
    const { document, scene, accessor } = start();
    const texture = async (name: string, ...pixels: number[]) => document.createTexture(name).setMimeType('image/png').setImage(await png(...pixels));
    const base = await texture('base', 255, 128, 0, 64, 0, 0, 0, 255), rough = await texture('rough', 0, 100, 200, 255);
    const material = document.createMaterial('m')
      .setBaseColorTexture(base).setAlphaMode('BLEND')
      .setMetallicRoughnessTexture(rough)
      .setNormalTexture(await texture('normal', 128, 128, 255, 255)).setNormalScale(0.5)
      .setEmissiveTexture(await texture('glow', 9, 9, 9, 255)).setEmissiveFactor([1, 1, 1])
      .setExtension('KHR_materials_emissive_strength', document.createExtension(KHRMaterialsEmissiveStrength).createEmissiveStrength().setEmissiveStrength(3));
    material.getEmissiveTextureInfo()!.setTexCoord(1);
    material.getBaseColorTextureInfo()!.setWrapS(33071).setWrapT(33648).setMagFilter(9728);
    scene.addChild(document.createNode().setMesh(document.createMesh().addPrimitive(document.createPrimitive().setMaterial(material)
      .setAttribute('POSITION', accessor('VEC3', TRIANGLE)).setAttribute('TEXCOORD_0', accessor('VEC2', new Float32Array(6))).setAttribute('TEXCOORD_1', accessor('VEC2', new Float32Array(6))))));
    const loaded = await loadGltf(await write(document, [KHRMaterialsEmissiveStrength]), { decodeImage });
    expect(loaded.warnings).toEqual([]);
    const { textures = {} } = only(loaded);
    const facts = Object.fromEntries(Object.entries(textures).map(([parameter, binding]) => {
      const t = loaded.textures[binding.texture]!;
      return [parameter, [loaded.images[t.image]!.name, t.color_space, binding.channels, binding.uv ?? 0, binding.scale ?? 1]];
    }));
    expect(facts).toEqual({
      base_color: ['base', 'srgb', 'rgb', 0, 1],
      geometry_opacity: ['base', 'srgb', 'a', 0, 1],
      base_metalness: ['rough', 'linear', 'b', 0, 1],
      specular_roughness: ['rough', 'linear', 'g', 0, 1],
      geometry_normal: ['normal', 'linear', 'rgb', 0, 0.5],
      emission_color: ['glow', 'srgb', 'rgb', 1, 1],
    });
    expect(loaded.images.length).toBe(4);
    expect(loaded.textures[textures.base_color!.texture]).toMatchObject({ wrap_u: 'clamp', wrap_v: 'mirror', filter: 'nearest' });
    // Codes as they are in the file, alpha straight, top row first.
    const image = loaded.images[loaded.textures[textures.base_color!.texture]!.image]!;
    expect([image.width, image.height, ...image.data]).toEqual([2, 1, 255, 128, 0, 64, 0, 0, 0, 255]);
  });

  test('of a clearcoat: its weight from red, its roughness from green; its normal map is left out with a warning', async () => {
    const pixel = await png(200, 100, 0, 255);
    const uri = `data:image/png;base64,${Buffer.from(pixel).toString('base64')}`;
    const scene = await withMaterial(
      { name: 'car', extensions: { KHR_materials_clearcoat: { clearcoatFactor: 0.8, clearcoatTexture: { index: 0 }, clearcoatRoughnessFactor: 3, clearcoatRoughnessTexture: { index: 0 }, clearcoatNormalTexture: { index: 0 } } } },
      (json) => { json['images'] = [{ uri }]; json['textures'] = [{ source: 0 }]; json['extensionsUsed'] = ['KHR_materials_clearcoat']; },
    );
    const { parameters, textures = {} } = only(scene);
    expect(parameters).toMatchObject({ coat_weight: 0.8, coat_roughness: 1, coat_ior: 1.5, coat_darkening: 0 });
    expect(Object.entries(textures).map(([parameter, { texture, channels }]) => [parameter, channels, scene.textures[texture]!.color_space])).toEqual([['coat_weight', 'r', 'linear'], ['coat_roughness', 'g', 'linear']]);
    expect(scene.warnings.map(({ path }) => path)).toEqual(['clearcoatRoughnessFactor', 'clearcoatNormalTexture'].map((field) => `/materials/0/extensions/KHR_materials_clearcoat/${field}`));
  });

  test('KHR_texture_transform: scaled, turned, moved', async () => {
    const { document, scene, accessor } = start();
    const extension = document.createExtension(KHRTextureTransform);
    const material = document.createMaterial().setBaseColorTexture(document.createTexture().setMimeType('image/png').setImage(await png(1, 2, 3, 255)));
    const transform: Transform = extension.createTransform().setOffset([0.25, 0.5]).setRotation(Math.PI / 2).setScale([2, 3]).setTexCoord(1);
    material.getBaseColorTextureInfo()!.setExtension('KHR_texture_transform', transform);
    scene.addChild(document.createNode().setMesh(document.createMesh().addPrimitive(document.createPrimitive().setMaterial(material).setAttribute('POSITION', accessor('VEC3', TRIANGLE)))));
    const binding = only(await loadGltf(await write(document, [KHRTextureTransform]), { decodeImage })).textures!.base_color!;
    expect(binding.uv).toBe(1);
    // A quarter turn counter-clockwise in the picture, where v runs down, takes (0, 1) to (1, 0).
    const [a, b, c, d, x, y] = binding.transform!;
    const map = (u: number, v: number) => [a * u + c * v + x, b * u + d * v + y];
    [[0, 1, 3.25, 0.5], [1, 0, 0.25, -1.5]].forEach(([u, v, eu, ev]) => {
      const [mu, mv] = map(u!, v!);
      expect(mu).toBeCloseTo(eu!, 6);
      expect(mv).toBeCloseTo(ev!, 6);
    });
    expect(uvTransform({ index: 0 })).toBeUndefined();
  });

  test('colour profiles in pictures do not count', async () => {
    const pixels = { raw: { width: 1, height: 1, channels: 3 } } as const;
    const plain = await sharp(Uint8Array.of(200, 40, 90), pixels).png().toBuffer();
    // The same codes under a profile that is not sRGB: the chunk of a picture that was converted to it.
    const converted = await sharp(Uint8Array.of(200, 40, 90), pixels).withIccProfile('p3').png().toBuffer();
    const codes = (await sharp(converted, { ignoreIcc: true }).raw().toBuffer()).subarray(0, 3);
    const read = await decodeImage(new Uint8Array(converted), 'image/png');
    expect(Array.from(read.data.subarray(0, 3))).toEqual(Array.from(codes));
    // The test means something only if the profile changes the codes.
    expect(Array.from(codes)).not.toEqual([200, 40, 90]);
    expect(Array.from((await decodeImage(new Uint8Array(plain), 'image/png')).data)).toEqual([200, 40, 90, 255]);
  });

  const picture = (uri: string) => (json: TriangleJson) => { json['images'] = [{ uri }]; json['textures'] = [{ source: 0 }]; };
  const textured = { pbrMetallicRoughness: { baseColorTexture: { index: 0 } } };
  test.each([
    ['a picture that is broken', textured, picture('data:image/png;base64,iVBORw0KGgo='), 'gltf/image', '/images/0'],
    ['an SVG, which could name other files', textured, picture(`data:image/png;base64,${btoa('<svg xmlns="http://www.w3.org/2000/svg" width="1" height="1"/>')}`), 'gltf/image', '/images/0'],
    ['a texture that is not there', { pbrMetallicRoughness: { baseColorTexture: { index: 3 } } }, () => undefined, 'gltf/texture', '/materials/0/pbrMetallicRoughness/baseColorTexture'],
    ['a texture that is no object', { normalTexture: 5 }, () => undefined, 'gltf/texture', '/materials/0/normalTexture'],
    ['a UV set beyond the second', { pbrMetallicRoughness: { baseColorTexture: { index: 0, texCoord: 2 } } }, picture('data:image/png;base64,iVBORw0KGgo='), 'gltf/texture', '/materials/0/pbrMetallicRoughness/baseColorTexture'],
  ])('%s costs the texture, not the scene', async (_, material, more, code, path) => {
    const scene = await withMaterial(material, more);
    expect(only(scene).textures?.base_color).toBeUndefined();
    expect(scene.warnings[0]).toMatchObject({ code, path });
  });
});
