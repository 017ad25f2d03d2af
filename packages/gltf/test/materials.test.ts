import { KHRMaterialsEmissiveStrength, KHRTextureTransform, type Transform } from '@gltf-transform/extensions';
import type { Material, Scene } from '@glanz/scene';
import sharp from 'sharp';
import { describe, expect, test } from 'vitest';
import { decodeImage, loadGltf } from '../src/node';
import { uvTransform } from '../src/materials';
import { spoiled, start, write, type TriangleJson } from './build';

const TRIANGLE = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]);

/** A PNG of one row of RGBA pixels. */
const png = (...pixels: number[]) =>
  sharp(Uint8Array.from(pixels), { raw: { width: pixels.length / 4, height: 1, channels: 4 } })
    .png()
    .toBuffer()
    .then((b) => new Uint8Array(b));

/** Loads a triangle with a material given as JSON. */
const withMaterial = (material: unknown, more: (json: TriangleJson) => void = () => undefined) =>
  loadGltf(
    spoiled((json) => {
      json['materials'] = [material];
      json['meshes'][0].primitives[0].material = 0;
      more(json);
    }),
    { decodeImage },
  );

const only = (scene: Scene): Material => {
  expect(scene.materials.length).toBe(1);
  return scene.materials[0]!;
};

describe('factors', () => {
  test('metallic-roughness with emission; sides and extras pass through', async () => {
    const material = only(
      await withMaterial({
        name: 'light',
        doubleSided: true,
        extras: { part: 7 },
        emissiveFactor: [1, 0.5, 0],
        pbrMetallicRoughness: { baseColorFactor: [0.1, 0.2, 0.3, 0.4], metallicFactor: 0.5, roughnessFactor: 0.25 },
        extensions: { KHR_materials_emissive_strength: { emissiveStrength: 12 } },
      }),
    );
    expect(material).toMatchObject({ name: 'light', double_sided: true, extras: { part: 7 } });
    expect(material.parameters).toMatchObject({
      base_color: [0.1, 0.2, 0.3],
      base_metalness: 0.5,
      specular_roughness: 0.25,
      emission_color: [1, 0.5, 0],
      emission_luminance: 12,
    });
    // OPAQUE ignores the alpha.
    expect(material.parameters.geometry_opacity).toBeUndefined();
  });

  test('a volume that scatters, by either name of its factor; drafts that still change are left out with a warning', async () => {
    const material = (more: object) => ({
      extensions: {
        KHR_materials_transmission: { transmissionFactor: 1 },
        KHR_materials_volume: { thicknessFactor: 1, attenuationDistance: 2, attenuationColor: [0.5, 0.6, 0.7] },
        ...more,
      },
    });
    const used =
      (...names: string[]) =>
      (json: TriangleJson) =>
        void (json['extensionsUsed'] = ['KHR_materials_transmission', 'KHR_materials_volume', ...names]);
    const [current, former] = await Promise.all(
      ['multiscatterColorFactor', 'multiscatterColor'].map(async (name) => {
        const scene = await withMaterial(
          material({ KHR_materials_volume_scatter: { [name]: [0.9, 0.5, 0.1], scatterAnisotropy: 7 } }),
          used('KHR_materials_volume_scatter'),
        );
        expect(scene.warnings.map(({ path }) => path)).toEqual([
          '/materials/0/extensions/KHR_materials_volume_scatter/scatterAnisotropy',
        ]);
        return only(scene).parameters;
      }),
    );
    expect(current!.transmission_scatter!.every((s) => s > 0)).toBe(true);
    expect(current!.transmission_scatter_anisotropy).toBe(1);
    expect(former).toEqual(current);
    for (const name of ['KHR_materials_scatter', 'KHR_materials_retroreflection']) {
      const { warnings, materials } = await withMaterial(material({ [name]: {} }), used(name));
      expect(materials[0]!.parameters.transmission_scatter).toBeUndefined();
      expect(warnings.map(({ code, message }) => [code, message.includes(name)])).toEqual([
        ['gltf/ignored-extension', true],
      ]);
    }
  });

  test('MASK has a threshold, BLEND a coverage', async () => {
    const mask = only(
      await withMaterial({
        alphaMode: 'MASK',
        alphaCutoff: 0.3,
        pbrMetallicRoughness: { baseColorFactor: [1, 1, 1, 0.4] },
      }),
    );
    expect([mask.opacity_threshold, mask.parameters.geometry_opacity]).toEqual([0.3, 0.4]);
    expect(only(await withMaterial({ alphaMode: 'MASK' })).opacity_threshold).toBe(0.5);
    const blend = only(
      await withMaterial({ alphaMode: 'BLEND', pbrMetallicRoughness: { baseColorFactor: [1, 1, 1, 0.4] } }),
    );
    expect([blend.opacity_threshold, blend.parameters.geometry_opacity]).toEqual([undefined, 0.4]);
  });

  test("a primitive without a material has glTF's, not OpenPBR's", async () => {
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
    expect(scene.warnings.map(({ code, path }) => [code, path])).toEqual([
      ['gltf/material', `/materials/0/pbrMetallicRoughness/${Object.keys(pbrMetallicRoughness)[0]}`],
    ]);
  });

  test('rounding is not reported', async () => {
    const scene = await withMaterial({ pbrMetallicRoughness: { baseColorFactor: [1.00000012, 0, 0, 1] } });
    expect([only(scene).parameters.base_color, scene.warnings]).toEqual([[1, 0, 0], []]);
  });
});

describe('textures', () => {
  test('each goes to its parameters, in its colour space and channels', async () => {
    const { document, scene, accessor } = start();
    const texture = async (name: string, ...pixels: number[]) =>
      document
        .createTexture(name)
        .setMimeType('image/png')
        .setImage(await png(...pixels));
    const base = await texture('base', 255, 128, 0, 64, 0, 0, 0, 255),
      rough = await texture('rough', 0, 100, 200, 255);
    const material = document
      .createMaterial('m')
      .setBaseColorTexture(base)
      .setAlphaMode('BLEND')
      .setMetallicRoughnessTexture(rough)
      .setNormalTexture(await texture('normal', 128, 128, 255, 255))
      .setNormalScale(0.5)
      .setEmissiveTexture(await texture('glow', 9, 9, 9, 255))
      .setEmissiveFactor([1, 1, 1])
      .setExtension(
        'KHR_materials_emissive_strength',
        document.createExtension(KHRMaterialsEmissiveStrength).createEmissiveStrength().setEmissiveStrength(3),
      );
    material.getEmissiveTextureInfo()!.setTexCoord(1);
    material.getBaseColorTextureInfo()!.setWrapS(33071).setWrapT(33648).setMagFilter(9728);
    scene.addChild(
      document.createNode().setMesh(
        document.createMesh().addPrimitive(
          document
            .createPrimitive()
            .setMaterial(material)
            .setAttribute('POSITION', accessor('VEC3', TRIANGLE))
            .setAttribute('TEXCOORD_0', accessor('VEC2', new Float32Array(6)))
            .setAttribute('TEXCOORD_1', accessor('VEC2', new Float32Array(6))),
        ),
      ),
    );
    const loaded = await loadGltf(await write(document, [KHRMaterialsEmissiveStrength]), { decodeImage });
    expect(loaded.warnings).toEqual([]);
    const { textures = {} } = only(loaded);
    const facts = Object.fromEntries(
      Object.entries(textures).map(([parameter, binding]) => {
        const t = loaded.textures[binding.texture]!;
        return [
          parameter,
          [loaded.images[t.image]!.name, t.color_space, binding.channels, binding.uv ?? 0, binding.scale ?? 1],
        ];
      }),
    );
    expect(facts).toEqual({
      base_color: ['base', 'srgb', 'rgb', 0, 1],
      geometry_opacity: ['base', 'srgb', 'a', 0, 1],
      base_metalness: ['rough', 'linear', 'b', 0, 1],
      specular_roughness: ['rough', 'linear', 'g', 0, 1],
      geometry_normal: ['normal', 'linear', 'rgb', 0, 0.5],
      emission_color: ['glow', 'srgb', 'rgb', 1, 1],
    });
    expect(loaded.images.length).toBe(4);
    expect(loaded.textures[textures.base_color!.texture]).toMatchObject({
      wrap_u: 'clamp',
      wrap_v: 'mirror',
      filter: 'nearest',
    });
    // Codes as they are in the file, alpha straight, top row first.
    const image = loaded.images[loaded.textures[textures.base_color!.texture]!.image]!;
    expect([image.width, image.height, ...image.data]).toEqual([2, 1, 255, 128, 0, 64, 0, 0, 0, 255]);
  });

  /** A material whose textures 0, 1, … are images of the given pixels; all extensions count as used. */
  const withImages = async (material: { extensions: object }, ...images: number[][]) => {
    const uris = await Promise.all(
      images.map(async (pixels) => `data:image/png;base64,${Buffer.from(await png(...pixels)).toString('base64')}`),
    );
    return withMaterial(material, (json) => {
      json['images'] = uris.map((uri) => ({ uri }));
      json['textures'] = uris.map((_, source) => ({ source }));
      json['extensionsUsed'] = Object.keys(material.extensions);
    });
  };
  const bound = (scene: Scene) =>
    Object.fromEntries(
      Object.entries(only(scene).textures ?? {}).map(([parameter, { texture, channels }]) => {
        const { image, color_space } = scene.textures[texture]!;
        return [parameter, { channels, color_space, data: Array.from(scene.images[image]!.data) }];
      }),
    );

  test('of a clearcoat: its weight from red, its roughness from green, its own normal', async () => {
    const texture = { index: 0 };
    const scene = await withImages(
      {
        extensions: {
          KHR_materials_clearcoat: {
            clearcoatFactor: 0.8,
            clearcoatTexture: texture,
            clearcoatRoughnessFactor: 3,
            clearcoatRoughnessTexture: texture,
            clearcoatNormalTexture: { index: 0, scale: 0.5 },
          },
        },
      },
      [200, 100, 0, 255],
    );
    expect(only(scene).parameters).toMatchObject({
      coat_weight: 0.8,
      coat_roughness: 1,
      coat_ior: 1.5,
      coat_darkening: 0,
    });
    expect(
      Object.entries(bound(scene)).map(([parameter, { channels, color_space }]) => [parameter, channels, color_space]),
    ).toEqual([
      ['coat_weight', 'r', 'linear'],
      ['coat_roughness', 'g', 'linear'],
      ['geometry_coat_normal', 'rgb', 'linear'],
    ]);
    expect(only(scene).textures!.geometry_coat_normal!.scale).toBe(0.5);
    expect(scene.warnings.map(({ path }) => path)).toEqual([
      '/materials/0/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor',
    ]);
  });

  test('of a film: its thickness between two ends', async () => {
    const scene = await withImages(
      {
        extensions: {
          KHR_materials_iridescence: {
            iridescenceFactor: 1,
            iridescenceThicknessMinimum: 100,
            iridescenceThicknessMaximum: 500,
            iridescenceThicknessTexture: { index: 0 },
          },
        },
      },
      [0, 100, 0, 255],
    );
    expect(only(scene).parameters.thin_film_thickness).toBe(0.5);
    expect(only(scene).textures!.thin_film_thickness).toMatchObject({ channels: 'g', range: [0.2, 1] });
    expect(scene.warnings).toEqual([]);
  });

  const toLinear = (code: number) =>
    code / 255 <= 0.04045 ? code / 255 / 12.92 : ((code / 255 + 0.055) / 1.055) ** 2.4;

  test('of sheen: one image, split into coverage and colour', async () => {
    const pixels = [255, 128, 64, 255, 10, 200, 10, 128, 0, 0, 0, 255];
    const scene = await withImages(
      {
        extensions: {
          KHR_materials_sheen: {
            sheenColorFactor: [0.5, 0.8, 1],
            sheenRoughnessFactor: 0.5,
            sheenColorTexture: { index: 0 },
            sheenRoughnessTexture: { index: 0 },
          },
        },
      },
      pixels,
    );
    const { fuzz_color: color, fuzz_weight: weight, fuzz_roughness: roughness } = bound(scene);
    expect([weight!.channels, color!.data]).toEqual(['a', weight!.data]);
    for (let texel = 0; texel < 3; texel++) {
      for (let k = 0; k < 3; k++) {
        const product = toLinear(color!.data[4 * texel + k]!) * (weight!.data[4 * texel + 3]! / 255);
        // A coverage of 8 bits.
        expect(Math.abs(product - [0.5, 0.8, 1][k]! * toLinear(pixels[4 * texel + k]!))).toBeLessThan(0.004);
      }
      const r = 0.5 * (pixels[4 * texel + 3]! / 255);
      expect(roughness!.data[4 * texel]).toBe(Math.round(255 * (0.164 + 0.906 * r - 0.281 * r * r)));
    }
    expect(only(scene).parameters).toMatchObject({ fuzz_color: [1, 1, 1], fuzz_weight: 1, fuzz_roughness: 1 });
    // The file's own image is not used any more.
    expect([scene.images.length, scene.warnings]).toEqual([2, []]);
  });

  test('of anisotropy: two images of two sizes become one; the direction is read as it is', async () => {
    const rough = [0, 255, 0, 255, 0, 51, 0, 255],
      stretch = [255, 128, 102, 255];
    const scene = await withImages(
      {
        pbrMetallicRoughness: { metallicRoughnessTexture: { index: 0 } },
        extensions: {
          KHR_materials_anisotropy: { anisotropyStrength: 1, anisotropyRotation: 0.3, anisotropyTexture: { index: 1 } },
        },
      } as { extensions: object },
      rough,
      stretch,
    );
    const {
      specular_roughness: r,
      specular_roughness_anisotropy: a,
      geometry_tangent: tangent,
      base_metalness: metalness,
    } = bound(scene);
    expect([r!.channels, a!.channels, tangent!.data, metalness!.data, r!.data]).toEqual([
      'g',
      'b',
      stretch,
      rough,
      a!.data,
    ]);
    [1, 0.2].forEach((roughness, texel) => {
      // glTF's slopes along and across.
      const across = roughness ** 2,
        along = across + (1 - across) * 0.4 ** 2;
      expect(Math.abs(r!.data[4 * texel + 1]! - 255 * ((along ** 2 + across ** 2) / 2) ** 0.25)).toBeLessThanOrEqual(
        0.51,
      );
      expect(Math.abs(a!.data[4 * texel + 2]! - 255 * (1 - across / along))).toBeLessThanOrEqual(0.51);
    });
    expect(only(scene).parameters.geometry_tangent!.map((c) => +c.toFixed(6))).toEqual([
      +Math.cos(0.3).toFixed(6),
      +Math.sin(0.3).toFixed(6),
      0,
    ]);
    expect(scene.warnings).toEqual([]);
  });

  test('a broken image below a formula counts as white', async () => {
    const scene = await withMaterial(
      { extensions: { KHR_materials_sheen: { sheenColorFactor: [0.25, 0.5, 0], sheenColorTexture: { index: 0 } } } },
      (json) => {
        json['images'] = [{ uri: 'data:image/png;base64,iVBORw0KGgo=' }];
        json['textures'] = [{ source: 0 }];
        json['extensionsUsed'] = ['KHR_materials_sheen'];
      },
    );
    const { fuzz_color: color } = bound(scene);
    expect(color!.data).toEqual([188, 255, 0, 128]);
    expect(scene.warnings.map(({ code }) => code)).toEqual(['gltf/image']);
  });

  test('specular-glossiness', async () => {
    const scene = await withImages(
      {
        extensions: {
          KHR_materials_pbrSpecularGlossiness: {
            diffuseFactor: [1, 0.5, 1, 1],
            diffuseTexture: { index: 0 },
            specularGlossinessTexture: { index: 1 },
            glossinessFactor: 0.5,
          },
        },
      },
      [255, 0, 0, 255],
      [60, 60, 60, 128],
    );
    expect(Object.keys(bound(scene)).toSorted()).toEqual([
      'base_color',
      'specular_color',
      'specular_roughness',
      'specular_weight',
    ]);
    expect(only(scene).textures!.specular_roughness).toMatchObject({ channels: 'a', range: [1, 0.5] });
    expect(bound(scene)['specular_weight']!.data.slice(0, 3)).toEqual([60, 60, 60]);
    expect(bound(scene)['specular_color']!.data.slice(0, 3)).toEqual([255, 255, 255]);
    expect(scene.warnings).toEqual([]);
  });

  test('KHR_texture_transform: scaled, turned, moved', async () => {
    const { document, scene, accessor } = start();
    const extension = document.createExtension(KHRTextureTransform);
    const material = document.createMaterial().setBaseColorTexture(
      document
        .createTexture()
        .setMimeType('image/png')
        .setImage(await png(1, 2, 3, 255)),
    );
    const transform: Transform = extension
      .createTransform()
      .setOffset([0.25, 0.5])
      .setRotation(Math.PI / 2)
      .setScale([2, 3])
      .setTexCoord(1);
    material.getBaseColorTextureInfo()!.setExtension('KHR_texture_transform', transform);
    scene.addChild(
      document
        .createNode()
        .setMesh(
          document
            .createMesh()
            .addPrimitive(
              document.createPrimitive().setMaterial(material).setAttribute('POSITION', accessor('VEC3', TRIANGLE)),
            ),
        ),
    );
    const binding = only(await loadGltf(await write(document, [KHRTextureTransform]), { decodeImage })).textures!
      .base_color!;
    expect(binding.uv).toBe(1);
    // A quarter turn counter-clockwise in the image, where v runs down, takes (0, 1) to (1, 0).
    const [a, b, c, d, x, y] = binding.transform!;
    const map = (u: number, v: number) => [a * u + c * v + x, b * u + d * v + y];
    [
      [0, 1, 3.25, 0.5],
      [1, 0, 0.25, -1.5],
    ].forEach(([u, v, eu, ev]) => {
      const [mu, mv] = map(u!, v!);
      expect(mu).toBeCloseTo(eu!, 6);
      expect(mv).toBeCloseTo(ev!, 6);
    });
    expect(uvTransform({ index: 0 })).toBeUndefined();
  });

  test('colour profiles in images do not count', async () => {
    const pixels = { raw: { width: 1, height: 1, channels: 3 } } as const;
    const plain = await sharp(Uint8Array.of(200, 40, 90), pixels)
      .png()
      .toBuffer();
    // The same codes under a profile that is not sRGB: the chunk of an image that was converted to it.
    const converted = await sharp(Uint8Array.of(200, 40, 90), pixels)
      .withIccProfile('p3')
      .png()
      .toBuffer();
    const codes = (await sharp(converted, { ignoreIcc: true }).raw().toBuffer()).subarray(0, 3);
    const read = await decodeImage(new Uint8Array(converted), 'image/png');
    expect(Array.from(read.data.subarray(0, 3))).toEqual(Array.from(codes));
    // The test means something only if the profile changes the codes.
    expect(Array.from(codes)).not.toEqual([200, 40, 90]);
    expect(Array.from((await decodeImage(new Uint8Array(plain), 'image/png')).data)).toEqual([200, 40, 90, 255]);
  });

  const image = (uri: string) => (json: TriangleJson) => {
    json['images'] = [{ uri }];
    json['textures'] = [{ source: 0 }];
  };
  const textured = { pbrMetallicRoughness: { baseColorTexture: { index: 0 } } };
  test.each([
    ['an image that is broken', textured, image('data:image/png;base64,iVBORw0KGgo='), 'gltf/image', '/images/0'],
    [
      'an SVG, which could name other files',
      textured,
      image(`data:image/png;base64,${btoa('<svg xmlns="http://www.w3.org/2000/svg" width="1" height="1"/>')}`),
      'gltf/image',
      '/images/0',
    ],
    [
      'a texture that does not exist',
      { pbrMetallicRoughness: { baseColorTexture: { index: 3 } } },
      () => undefined,
      'gltf/texture',
      '/materials/0/pbrMetallicRoughness/baseColorTexture',
    ],
    [
      'a texture that is no object',
      { normalTexture: 5 },
      () => undefined,
      'gltf/texture',
      '/materials/0/normalTexture',
    ],
    [
      'a third UV set in a material',
      {
        normalTexture: { index: 0, texCoord: 1 },
        emissiveTexture: { index: 0, texCoord: 3 },
        emissiveFactor: [1, 1, 1],
        pbrMetallicRoughness: { baseColorTexture: { index: 0, texCoord: 2 } },
      },
      image('data:image/png;base64,iVBORw0KGgo='),
      'gltf/texture',
      /^\/materials\/0\//,
    ],
  ])('%s costs the texture, not the scene', async (_, material, more, code, path) => {
    const scene = await withMaterial(material, more);
    expect(only(scene).textures?.base_color).toBeUndefined();
    expect(scene.warnings[0]).toMatchObject({
      code,
      path: path instanceof RegExp ? expect.stringMatching(path) : path,
    });
  });
});

describe('extensions', () => {
  test.each([
    ['KHR_materials_anisotropy', { anisotropyStrength: 2 }, 'anisotropyStrength', { specular_roughness_anisotropy: 0 }],
    ['KHR_materials_diffuse_transmission', { diffuseTransmissionFactor: -1 }, 'diffuseTransmissionFactor', {}],
    ['KHR_materials_dispersion', { dispersion: 'much' }, 'dispersion', {}],
    [
      'KHR_materials_iridescence',
      { iridescenceFactor: 1, iridescenceIor: 0 },
      'iridescenceIor',
      { thin_film_weight: 1, thin_film_ior: 1 },
    ],
    [
      'KHR_materials_pbrSpecularGlossiness',
      { specularFactor: [4, 0, 0] },
      'specularFactor',
      { specular_color: [1, 0, 0] },
    ],
    ['KHR_materials_sheen', { sheenColorFactor: [1, null, 0] }, 'sheenColorFactor', { fuzz_color: [1, 0, 0] }],
    ['KHR_materials_transmission', { transmissionFactor: 7 }, 'transmissionFactor', { transmission_weight: 1 }],
    ['KHR_materials_volume', { thicknessFactor: -3 }, 'thicknessFactor', {}],
  ])('%s with a bad number is put right, with a warning that says where', async (name, extension, field, expected) => {
    const scene = await withMaterial({ extensions: { [name]: extension } }, (json) => {
      json['extensionsUsed'] = [name];
    });
    expect(only(scene).parameters).toMatchObject(expected);
    expect(scene.warnings.map(({ code, path }) => [code, path])).toEqual([
      ['gltf/material', `/materials/0/extensions/${name}/${field}`],
    ]);
  });
});
