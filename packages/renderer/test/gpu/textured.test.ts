import { testDevice } from '@glanz/gpu';
import type { OpenPbrParameters } from '@glanz/openpbr';
import type { Material, Mesh, TextureBinding } from '@glanz/scene';
import { beforeAll, expect, it } from 'vitest';
import { PathTracer } from '../../src/index';
import { addQuad, camera, createScene } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});

interface Look {
  readonly parameters: Partial<OpenPbrParameters>;
  /** A texture of one texel a parameter. */
  readonly textures?: Record<string, { readonly texel: readonly number[] } & Omit<TextureBinding, 'texture'>>;
  readonly tangents?: readonly number[];
}

/** A quad under a slanting light, seen from above. */
async function show({ parameters, textures = {}, tangents }: Look): Promise<Float32Array> {
  const scene = createScene();
  const material: Material = { name: 'look', parameters, textures: {} };
  for (const [name, { texel, ...binding }] of Object.entries(textures)) {
    const image = scene.images.push({ name, width: 1, height: 1, data: new Float32Array(texel) }) - 1;
    const texture = scene.textures.push({ image, color_space: 'linear' }) - 1;
    material.textures![name as keyof NonNullable<Material['textures']>] = { ...binding, texture };
  }
  addQuad(scene, 10, 0, material);
  if (tangents)
    (scene.meshes[0] as Mesh).tangents = new Float32Array([...tangents, ...tangents, ...tangents, ...tangents]);
  scene.lights.push({
    type: 'directional',
    name: 'sun',
    color: [1, 0.8, 0.6],
    intensity: 3,
    direction: [0.6, 0, -0.8],
  });
  const tracer = await PathTracer.create(device, scene, {
    width: 8,
    height: 8,
    camera,
    maxDepth: 2,
    pathsInFlight: 1 << 10,
  });
  for await (const _ of tracer.render({ samples: 2, maxSubmitMs: 1000 }));
  const pixels = await tracer.read('beauty');
  tracer.destroy();
  return pixels;
}

const apart = (a: Float32Array, b: Float32Array) =>
  Math.max(...a.map((value, i) => Math.abs(value - (b[i] as number)) / Math.max(1e-3, Math.abs(b[i] as number))));
const metal = { base_metalness: 1, base_color: [0.9, 0.6, 0.3], specular_roughness: 0.5 } as const;

it.each<[string, Look, Look]>([
  [
    'a range',
    {
      parameters: { ...metal, specular_roughness: 0.8 },
      textures: { specular_roughness: { texel: [0, 0.5, 0, 1], channels: 'g', range: [1, 0.25] } },
    },
    { parameters: { ...metal, specular_roughness: 0.5 } },
  ],
  [
    'one channel for a colour, three for another',
    {
      parameters: { ...metal, specular_color: [0.5, 1, 1] },
      textures: {
        base_color: { texel: [0.1, 0.75, 0.2, 1], channels: 'g' },
        specular_color: { texel: [1, 0.5, 0.25, 1], channels: 'rgb' },
      },
    },
    { parameters: { ...metal, base_color: [0.675, 0.45, 0.225], specular_color: [0.5, 0.5, 0.25] } },
  ],
  [
    'a coat',
    {
      parameters: { coat_weight: 1, coat_roughness: 1 },
      textures: {
        coat_weight: { texel: [0, 0, 0, 0.5], channels: 'a' },
        coat_roughness: { texel: [0.25, 0, 0, 1], channels: 'r' },
      },
    },
    { parameters: { coat_weight: 0.5, coat_roughness: 0.25 } },
  ],
])('%s by texture is as by value', async (_, textured, plain) => {
  const [a, b] = [await show(textured), await show(plain)];
  expect(Math.max(...b)).toBeGreaterThan(0.01);
  expect(apart(a, b)).toBeLessThan(1e-4);
  // The texture does something.
  expect(apart(await show({ parameters: textured.parameters }), b)).toBeGreaterThan(0.02);
});

it('a texture turns the tangent, the parameter turns it further, both in the frame of the mesh', async () => {
  const brushed = { ...metal, specular_roughness: 0.6, specular_roughness_anisotropy: 0.8 } as const;
  const s = Math.SQRT1_2;
  const straight = await show({ parameters: brushed });
  // (0, 1) as 0..1, whatever blue says.
  const byTexture = await show({
    parameters: brushed,
    textures: { geometry_tangent: { texel: [0.5, 1, 0.3, 1], channels: 'rgb' } },
  });
  const byBoth = await show({
    parameters: { ...brushed, geometry_tangent: [s, s, 0] },
    textures: { geometry_tangent: { texel: [0.5 + s / 2, 0.5 + s / 2, 0, 1], channels: 'rgb' } },
  });
  const byMesh = await show({ parameters: brushed, tangents: [0, 1, 0, 1] });
  expect(apart(byTexture, byMesh)).toBeLessThan(1e-4);
  expect(apart(byBoth, byMesh)).toBeLessThan(1e-3);
  expect(apart(straight, byMesh)).toBeGreaterThan(0.2);
  expect(apart(await show({ parameters: brushed, tangents: [1, 0, 0, 1] }), straight)).toBeLessThan(1e-4);
});

it("a coat has its own normal map, and none of its base's", async () => {
  // A black base: only the coat is seen.
  const parameters = { base_weight: 0, specular_weight: 0, coat_weight: 1, coat_roughness: 0.4 } as const;
  const [x, y, z] = [0.2, -0.1, Math.sqrt(0.95)];
  const tilt = { texel: [0.5 + x / 2, 0.5 + y / 2, 0.5 + z / 2, 1], channels: 'rgb' } as const;
  const level = { texel: [0.5, 0.5, 1, 1], channels: 'rgb' } as const;
  const shown = (base: typeof tilt | typeof level, coat: typeof tilt | typeof level) =>
    show({ parameters, textures: { geometry_normal: base, geometry_coat_normal: coat } });
  const flat = await shown(level, level);
  const own = await shown(level, tilt);
  expect(apart(own, flat)).toBeGreaterThan(0.2);
  expect(apart(await shown(tilt, tilt), own)).toBeLessThan(1e-3);
  expect(apart(await shown(tilt, level), flat)).toBeLessThan(1e-3);
  // Texels of floats have eleven bits on the GPU.
  expect(apart(await show({ parameters: { ...parameters, geometry_coat_normal: [x, y, z] } }), own)).toBeLessThan(4e-3);
});

it('textures that the surface does not read do no harm', async () => {
  const parameters = { ...metal, geometry_tangent: [0, 1, 0] } as const;
  const a = await show({
    parameters,
    textures: {
      geometry_tangent: { texel: [1, 0.5, 0, 1], channels: 'rgb' },
      geometry_coat_normal: { texel: [0.5, 0.5, 1, 1], channels: 'rgb' },
      geometry_coat_tangent: { texel: [0.5, 0.5, 1, 1], channels: 'rgb' },
    },
  });
  expect(apart(a, await show({ parameters: metal }))).toBeLessThan(1e-4);
});

it('vertex colours paint the light of what only emits, seen and as a light', async () => {
  const glowing = async (parameters: Partial<OpenPbrParameters>, colors: readonly number[]) => {
    const scene = createScene();
    addQuad(scene, 1, 0, {
      name: 'glow',
      parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 1, ...parameters },
    });
    (scene.meshes[0] as Mesh).colors = new Float32Array([...colors, ...colors, ...colors, ...colors]);
    // Below the camera's view, lit by the glow.
    addQuad(
      scene,
      1,
      0,
      { name: 'wall', parameters: { specular_weight: 0 } },
      { transform: [0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 1, 1] },
    );
    const tracer = await PathTracer.create(device, scene, {
      width: 8,
      height: 8,
      camera,
      maxDepth: 2,
      pathsInFlight: 1 << 10,
    });
    for await (const _ of tracer.render({ samples: 16, maxSubmitMs: 1000 }));
    const pixels = await tracer.read('beauty');
    tracer.destroy();
    return pixels;
  };
  const painted = await glowing({}, [0.5, 0.25, 1, 1]);
  expect(apart(painted, await glowing({ emission_color: [0.5, 0.25, 1] }, [1, 1, 1, 1]))).toBeLessThan(1e-4);
  // A surface that also reflects keeps its own light.
  expect(apart(await glowing({ specular_weight: 1 }, [0.5, 0.25, 1, 1]), painted)).toBeGreaterThan(0.2);
});
