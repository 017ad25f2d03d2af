import { readFileSync } from 'node:fs';
import { validateScene, type Scene } from '@glanz/scene';
import sharp from 'sharp';
import { describe, expect, test } from 'vitest';
import { loadModelFile } from '../../src/node';
import { readCrate } from '../../src/usd/crate';
import type { UsdLayer } from '../../src/usd/layer';
import { readUsd, usdFiles } from '../../src/usd/read';
import { readText } from '../../src/usd/text';
import { readStoredZip } from '../../src/usd/zip';

// The files are OpenUSD's, and so is what they hold: make-files.py.
const bytes = (file: string) => new Uint8Array(readFileSync(new URL(`./${file}`, import.meta.url)));
const text = (file: string) => readFileSync(new URL(`./${file}`, import.meta.url), 'utf8');
const said = JSON.parse(text('said.json')) as {
  readonly world: Readonly<Record<string, readonly (readonly number[])[]>>;
  readonly values: Readonly<Record<string, number | string | boolean | readonly (number | string)[]>>;
};
const decode = async (file: Uint8Array) => {
  const { data, info } = await sharp(file).ensureAlpha().raw().toBuffer({ resolveWithObject: true });
  return { width: info.width, height: info.height, data: new Uint8Array(data) };
};
const color = readStoredZip(bytes('model.usdz')).get('0/color.png')!;

const numbers = (value: unknown) =>
  (Array.isArray(value) || ArrayBuffer.isView(value) ? Array.from(value as ArrayLike<number>) : [value]) as (
    | number
    | string
    | boolean
  )[];

describe.each([
  ['crate', () => readCrate(bytes('values.usdc')), 0],
  // Texts have six digits or more.
  ['text', () => readText(text('values.usda')), 5e-6],
] as const)('a %s layer', (_, read: () => UsdLayer, tolerance) => {
  const prim = read().root.children[0]!;

  test.each(Object.entries(said.values))('%s is what OpenUSD reads', (name, expected) => {
    const found = numbers(prim.attributes.get(name)!.value);
    const needed = numbers(expected);
    expect(found.length).toBe(needed.length);
    needed.forEach((value, i) => {
      const own = found[i]!;
      if (typeof value === 'string') expect(own).toBe(value);
      else expect(Math.abs(Number(own) - Number(value))).toBeLessThanOrEqual(tolerance * Math.abs(Number(value)));
    });
  });

  test('the first time sample, connections, targets, and what is no definition', () => {
    expect(numbers(prim.attributes.get('sampled')!.value)).toEqual([1.5, 2, 3]);
    expect(prim.attributes.get('connected')!.connections).toEqual(['/Values.float']);
    expect(prim.relationships.get('both')).toEqual(['/Values/Over', '/Values']);
    expect(prim.children.map(({ name, defined }) => [name, defined])).toEqual([['Over', false]]);
    expect([prim.type, prim.defined]).toEqual(['Scope', true]);
  });
});

const loaded: Readonly<Record<string, () => Promise<Scene>>> = {
  'a USDZ with a binary layer': () => readUsd(bytes('model.usdz'), { name: 'model.usdz', decodeImage: decode }),
  'a text layer with its image beside it': () =>
    readUsd(bytes('model.usda'), {
      name: 'model.usda',
      decodeImage: decode,
      read: (path) => Promise.resolve(path === 'textures/color.png' ? color : undefined),
    }),
};

describe.each(Object.entries(loaded))('%s', (_, load) => {
  test('is a valid scene in metres, +Y up, with the corners that OpenUSD has', async () => {
    const scene = await load();
    expect(validateScene(scene)).toEqual([]);
    expect(scene.instances.map(({ name, visible }) => [name, visible])).toEqual([
      ['Quads', undefined],
      ['Quads right', undefined],
      ['LeftHanded', undefined],
      ['Hidden', false],
    ]);
    /** Corners of triangles in the world. */
    const corners = (at: number) => {
      const { mesh, transform: m } = scene.instances[at]!;
      const { positions, indices } = scene.meshes[mesh]!;
      return Array.from(indices, (v) =>
        [0, 1, 2].map((row) =>
          [0, 1, 2].reduce((sum, k) => sum + m[4 * k + row]! * positions[3 * v + k]!, m[12 + row]!),
        ),
      );
    };
    // Centimetres, +Z up.
    const expected = (name: string, ...order: number[]) =>
      order.map((corner) => {
        const [x, y, z] = said.world[name]![corner]! as [number, number, number];
        return [x, z, -y].map((value) => 0.01 * value);
      });
    const close = (found: number[][], needed: number[][]) => {
      expect(found.length).toBe(needed.length);
      // Any corner may come first, and either diagonal cut a quad.
      const key = (point: number[]) =>
        point.map((value) => value.toFixed(6).replace('-0.000000', '0.000000')).join(' ');
      expect(new Set(found.map(key))).toEqual(new Set(needed.map(key)));
    };
    close(corners(0), expected('Quads', 0, 1, 2, 2, 3, 0));
    close(corners(1), expected('Quads', 4, 5, 6, 6, 7, 4));
    // Counter-clockwise seen from the front: the other way round than the file has it.
    const [a, b, c] = corners(2) as [number[], number[], number[]];
    const [p, q, r] = expected('LeftHanded', 0, 1, 2) as [number[], number[], number[]];
    const normal = ([x, y, z]: [number[], number[], number[]]) => {
      const [u, v] = [y, z].map((corner) => corner.map((value, k) => value - x[k]!)) as [number[], number[]];
      return [0, 1, 2].map((k) => u[(k + 1) % 3]! * v[(k + 2) % 3]! - u[(k + 2) % 3]! * v[(k + 1) % 3]!);
    };
    normal([a, b, c]).forEach((value, k) => expect(value).toBeCloseTo(-normal([p, q, r])[k]!, 12));
  });

  test('normals and texture coordinates, whose v runs down', async () => {
    const { meshes } = await load();
    const [quad] = meshes;
    expect(Array.from(quad!.normals!)).toEqual(Array.from(quad!.positions, (_x, i) => (i % 3 === 2 ? 1 : 0)));
    const uvs = new Map<string, number[]>();
    for (let v = 0; v < quad!.positions.length / 3; v++)
      uvs.set(
        Array.from(quad!.positions.subarray(3 * v, 3 * v + 2)).join(),
        Array.from(quad!.uvs![0]!.subarray(2 * v, 2 * v + 2)),
      );
    expect(Object.fromEntries(uvs)).toEqual({ '0,0': [0, 1], '1,0': [0.5, 1], '1,1': [0.5, 0], '0,1': [0, 0] });
    // Hidden is a subdivision surface without normals: smooth; LeftHanded a polygon mesh without: flat.
    expect([meshes[2]!.normals, meshes[3]!.normals?.length]).toEqual([undefined, 9]);
  });

  test('UsdPreviewSurface is OpenPBR', async () => {
    const scene = await load();
    const [painted, shiny, plain] = scene.materials;
    expect(painted).toMatchObject({ name: 'Painted', opacity_threshold: 0.75 });
    const near = (found: object, needed: Record<string, unknown>) => {
      expect(Object.keys(found).sort()).toEqual(Object.keys(needed).sort());
      for (const [name, value] of Object.entries(needed))
        numbers(value).forEach((number, k) =>
          typeof number === 'number'
            ? expect(numbers((found as Record<string, unknown>)[name])[k]).toBeCloseTo(number, 6)
            : expect((found as Record<string, unknown>)[name]).toBe(number),
        );
    };
    near(painted!.parameters, {
      base_color: [0.5, 0.5, 0.5],
      base_metalness: 0.25,
      specular_roughness: 0.4,
      specular_ior: 1.4,
      coat_weight: 0.5,
      coat_roughness: 0.01,
      coat_ior: 1.5,
      coat_darkening: 0,
      emission_color: [0, 0.5, 2],
      emission_luminance: 1,
      geometry_opacity: 1,
    });
    near(shiny!.parameters, {
      base_color: [0.1, 0.2, 0.3],
      specular_roughness: 0.5,
      specular_ior: (1 + Math.sqrt(0.08)) / (1 - Math.sqrt(0.08)),
      specular_color: [1, 0.5, 0.25],
      transmission_weight: 0.75,
      geometry_thin_walled: true,
    });
    expect(plain).toMatchObject({ double_sided: true, parameters: { base_color: expect.anything() } });
    plain!.parameters.base_color!.forEach((c, k) => expect(c).toBeCloseTo([0.7, 0.6, 0.5][k]!, 6));
  });

  test('images with their placement and edges', async () => {
    const scene = await load();
    const { base_color: base, geometry_opacity: opacity } = scene.materials[0]!.textures!;
    expect(scene.images.map(({ width, height, data }) => [width, height, Array.from(data.subarray(0, 4))])).toEqual([
      [2, 2, [255, 0, 0, 255]],
    ]);
    const of = (texture: number) => scene.textures[texture];
    expect(of(base!.texture)).toMatchObject({ image: 0, color_space: 'srgb', wrap_u: 'clamp', wrap_v: 'mirror' });
    expect(of(opacity!.texture)).toMatchObject({ image: 0, color_space: 'linear' });
    expect([base!.channels, opacity!.channels]).toEqual(['rgb', 'a']);
    // A point of the surface: scaled by (2, 3), turned by 90°, moved by (0.25, 0.5), as the specification has it.
    const [u, v] = [0.3, 0.1];
    const [a, b, c, d, x, y] = base!.transform!;
    const below = 1 - v;
    expect(a * u + c * below + x).toBeCloseTo(-3 * v + 0.25, 6);
    expect(b * u + d * below + y).toBeCloseTo(1 - (2 * u + 0.5), 6);
  });

  test('what is left out is reported', async () => {
    expect((await load()).warnings.map(({ code, path }) => [code, path])).toEqual([
      ['formats/ignored', '/Root/Camera'],
    ]);
  });
});

describe('errors', () => {
  const refused = async (given: Uint8Array<ArrayBuffer>) => {
    const error = (await readUsd(given, { name: 'x' }).catch((thrown: unknown) => thrown)) as { code?: string };
    return error.code;
  };

  test('what is no USD, or cut off anywhere, is refused with a code', async () => {
    expect(await refused(new Uint8Array([1, 2, 3]))).toBe('formats/malformed');
    const whole = bytes('model.usdz');
    for (let length = 0; length < whole.length; length += 97)
      expect(await refused(whole.slice(0, length))).toBe('formats/malformed');
    const layer = bytes('values.usdc');
    expect(await refused(layer)).toBe('formats/no-triangles');
    for (let length = 0; length < layer.length; length += 61)
      expect(await refused(layer.slice(0, length))).toBe('formats/malformed');
  });

  test('a compressed archive is refused', async () => {
    const packed = bytes('model.usdz');
    const directory = packed.findLastIndex(
      (_, i) => packed[i] === 0x50 && packed[i + 1] === 0x4b && packed[i + 2] === 1 && packed[i + 3] === 2,
    );
    packed[directory + 10] = 8;
    expect(await refused(packed)).toBe('formats/malformed');
  });

  test('an error in a text says in which line', async () => {
    const spoilt = new TextEncoder().encode('#usda 1.0\ndef Mesh "A"\n{\n  int[] a = [1, oops]\n}\n');
    await expect(readUsd(spoilt, { name: 'a.usda' })).rejects.toMatchObject({
      code: 'formats/malformed',
      message: expect.stringMatching(/line 4.*oops/),
    });
  });

  test('1,500 files with bytes changed at random are read, or refused with a code', async () => {
    let seed = 1;
    const next = (below: number) => {
      seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
      return Math.floor((seed / 2 ** 32) * below);
    };
    const sources = [bytes('model.usdz'), bytes('model.usda'), bytes('values.usdc')];
    const codes = new Set<string>();
    for (let i = 0; i < 1500; i++) {
      const spoilt = (sources[i % 3] as Uint8Array<ArrayBuffer>).slice();
      for (let k = 0; k <= i % 5; k++) spoilt[next(spoilt.length)] = next(256);
      codes.add((await refused(spoilt)) ?? 'read');
    }
    expect([...codes].sort()).toEqual(['formats/malformed', 'formats/no-triangles', 'read']);
  });
});

test('composition is not followed, and says so', async () => {
  const scene = await readUsd(
    new TextEncoder().encode(`#usda 1.0
( subLayers = [@other.usda@]
  metersPerUnit = 1 )
class "Unseen" { def Mesh "M" { } }
def Xform "A" ( prepend references = @chair.usdz@</Root>
  variants = { string color = "red" }
  prepend variantSets = "color" )
{
  token visibility.timeSamples = { 0: "inherited", 5: "invisible", }
  variantSet "color" = { "red" ( doc = "a" ) { over "M" { int[] faceVertexCounts = [9] } } }
  def Mesh "M" ( active = true ) {
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    int[] faceVertexCounts = [3, 3]
    int[] faceVertexIndices = [0, 1, 2, 0, 1, 7]
    double3 xformOp:translate:pivot = (0, 5, 0)
    uniform token[] xformOpOrder = ["xformOp:translate:pivot", "!invert!xformOp:translate:pivot"]
    rel material:binding = </Missing>
  }
  def SphereLight 'Light' { float inputs:intensity = inf }
}
`),
    { name: 'a.usda' },
  );
  expect(validateScene(scene)).toEqual([]);
  expect(scene.instances.map(({ name }) => name)).toEqual(['M']);
  expect(Array.from(scene.instances[0]!.transform)).toEqual([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
  expect(Array.from(scene.meshes[0]!.indices)).toEqual([0, 1, 2]);
  expect(scene.warnings.map(({ code, path }) => [code, path]).sort()).toEqual([
    ['formats/face', '/A/M'],
    ['formats/ignored', '/A/Light'],
    ['formats/missing-material', '/Missing'],
    ['formats/unsupported', '/'],
    ['formats/unsupported', '/A'],
  ]);
});

test('in Node a file is loaded by its name', async () => {
  const scene = await loadModelFile(new URL('./model.usdz', import.meta.url));
  expect([scene.instances.length, scene.images.length]).toEqual([4, 1]);
});

test('the files that a layer names, in text and in binary; an archive needs none', () => {
  const inside = readStoredZip(bytes('model.usdz'));
  const [layer] = [...inside].find(([path]) => path.endsWith('.usdc'))!;
  expect(usdFiles(inside.get(layer)!)).toEqual(['0/color.png']);
  expect(usdFiles(bytes('model.usda'))).toEqual(['textures/color.png']);
  expect(usdFiles(bytes('model.usdz'))).toEqual([]);
  const several = new TextEncoder().encode(`#usda 1.0
def Shader "A" {
  asset inputs:file = @./textures/a b.png@
  asset[] more = [@../up.jpg@, @./textures/a b.png@]
  string text = "no.png"
}
`);
  expect(usdFiles(several).sort()).toEqual(['../up.jpg', './textures/a b.png']);
  expect(() => usdFiles(new Uint8Array(9), 'x.usdc')).toThrow(/x\.usdc cannot be read/);
});
