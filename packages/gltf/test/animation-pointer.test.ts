import { describe, expect, test } from 'vitest';
import { loadGltf } from '../src/index';
import { glb, triangle, type TriangleJson } from './build';

/**
 * The triangle with an animation of 2 seconds whose channels move what pointers name, from the first value to the
 * second.
 */
function pointed(
  channels: readonly { pointer: unknown; from: number[]; to: number[]; type?: string; interpolation?: string }[],
  more: (json: TriangleJson) => void = () => undefined,
): Uint8Array<ArrayBuffer> {
  const { json, binary } = triangle();
  const numbers = [0, 2, ...channels.flatMap(({ from, to }) => [...from, ...to])];
  const bytes = new Uint8Array(44 + 4 * numbers.length);
  bytes.set(binary);
  new Float32Array(bytes.buffer, 44).set(numbers);
  json['buffers'][0].byteLength = bytes.length;
  const accessor = (offset: number, count: number, type: string) => {
    const width = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 }[type]!;
    json['bufferViews'].push({ buffer: 0, byteOffset: 44 + 4 * offset, byteLength: 4 * count * width });
    return json['accessors'].push({ bufferView: json['bufferViews'].length - 1, componentType: 5126, type, count }) - 1;
  };
  const input = accessor(0, 2, 'SCALAR');
  let offset = 2;
  json['animations'] = [
    {
      samplers: channels.map(({ from, type, interpolation }) => {
        const kind = type ?? ['SCALAR', 'SCALAR', 'VEC2', 'VEC3', 'VEC4'][from.length]!;
        const output = accessor(offset, kind === 'SCALAR' ? 2 * from.length : 2, kind);
        offset += 2 * from.length;
        return { input, output, ...(interpolation ? { interpolation } : {}) };
      }),
      channels: channels.map(({ pointer }, sampler) => ({
        sampler,
        target: { path: 'pointer', extensions: { KHR_animation_pointer: { pointer } } },
      })),
    },
  ];
  json['materials'] = [
    {
      name: 'm',
      pbrMetallicRoughness: { baseColorFactor: [1, 1, 1, 1] },
      extensions: { KHR_materials_emissive_strength: {} },
      emissiveFactor: [1, 1, 1],
    },
  ];
  json['meshes'][0].primitives[0].material = 0;
  more(json);
  json['extensionsUsed'] ??= [...new Set([...JSON.stringify(json).matchAll(/"(KHR_\w+)":/g)].map(([, name]) => name))];
  return glb(json, bytes);
}

describe('KHR_animation_pointer', () => {
  test('factors, also of extensions and such as have a default only, at the time asked for', async () => {
    const bytes = pointed([
      { pointer: '/materials/0/pbrMetallicRoughness/baseColorFactor', from: [0, 0, 0, 1], to: [1, 0.5, 0.25, 1] },
      { pointer: '/materials/0/pbrMetallicRoughness/roughnessFactor', from: [0], to: [1] },
      { pointer: '/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength', from: [2], to: [6] },
      { pointer: '/materials/0/emissiveFactor/1', from: [0], to: [1] },
    ]);
    const scene = await loadGltf(bytes, { time: 0.5 });
    expect(scene.warnings).toEqual([]);
    const still = await loadGltf(bytes);
    expect(scene.materials[0]!.parameters).toMatchObject({
      base_color: [0.25, 0.125, 0.0625],
      specular_roughness: 0.25,
      emission_luminance: 3 * Number(still.materials[0]!.parameters.emission_luminance),
      emission_color: [1, 0.25, 1],
    });
    expect(still.materials[0]!.parameters).toMatchObject({ base_color: [1, 1, 1], specular_roughness: 1 });
  });

  test('nodes by pointers move as nodes by themselves, rotations along the arc', async () => {
    const bytes = pointed([
      { pointer: '/nodes/0/translation', from: [0, 0, 0], to: [4, 0, 0] },
      { pointer: '/nodes/0/rotation', from: [0, 0, 0, 1], to: [0, 0, Math.SQRT1_2, Math.SQRT1_2] },
    ]);
    const m = (await loadGltf(bytes, { time: 1 })).instances[0]!.transform;
    expect(m[12]).toBe(2);
    expect(m[0]).toBeCloseTo(Math.cos(Math.PI / 4), 6);
    expect(m[1]).toBeCloseTo(Math.sin(Math.PI / 4), 6);
  });

  test('visibility, lights and cameras', async () => {
    const bytes = pointed(
      [
        { pointer: '/nodes/0/extensions/KHR_node_visibility/visible', from: [1], to: [0], interpolation: 'STEP' },
        { pointer: '/extensions/KHR_lights_punctual/lights/0/intensity', from: [10], to: [30] },
        { pointer: '/cameras/0/perspective/yfov', from: [0.5], to: [1] },
      ],
      (json) => {
        json['extensions'] = { KHR_lights_punctual: { lights: [{ type: 'point', intensity: 10 }] } };
        json['cameras'] = [{ type: 'perspective', perspective: { yfov: 0.5, znear: 0.1 } }];
        json['nodes'] = [
          { mesh: 0, extensions: { KHR_node_visibility: { visible: true } } },
          { extensions: { KHR_lights_punctual: { light: 0 } }, camera: 0 },
        ];
        json['scenes'][0].nodes = [0, 1];
      },
    );
    const [before, after] = [await loadGltf(bytes, { time: 1 }), await loadGltf(bytes, { time: 2 })];
    expect([before.instances[0]!.visible, after.instances[0]!.visible]).toEqual([undefined, false]);
    expect([before.lights[0]!.intensity, after.lights[0]!.intensity]).toEqual([20, 30]);
    expect(before.cameras[0]).toMatchObject({ type: 'perspective', yfov: 0.75 });
  });

  test('values out of range are brought back, with a warning', async () => {
    const scene = await loadGltf(
      pointed([{ pointer: '/materials/0/pbrMetallicRoughness/metallicFactor', from: [0], to: [4] }]),
      { time: 2 },
    );
    expect(scene.materials[0]!.parameters.base_metalness).toBe(1);
    expect(scene.warnings).toEqual([
      expect.objectContaining({ code: 'gltf/material', path: '/materials/0/pbrMetallicRoughness/metallicFactor' }),
    ]);
  });

  test.each([
    ['to a prototype', '/materials/0/__proto__/polluted'],
    ['to a constructor', '/materials/0/constructor/prototype/polluted'],
    ['to what has no place', '/materials/7/pbrMetallicRoughness/metallicFactor'],
    ['through an object that does not exist', '/materials/0/extensions/KHR_materials_ior/ior'],
    ['to something of another kind', '/materials/0/name/0'],
    ['into an array by a name', '/materials/length/x'],
  ])('a pointer %s moves nothing, with a warning', async (_, pointer) => {
    const scene = await loadGltf(pointed([{ pointer, from: [0], to: [1] }]), { time: 1 });
    expect(scene.warnings).toEqual([expect.objectContaining({ code: 'gltf/animation', path: pointer })]);
    expect('polluted' in {}).toBe(false);
  });

  test.each(['/accessors/0/count', '/buffers/0/byteLength', '', 7, '/materials'])(
    'the pointer %j is left out before anything moves',
    async (pointer) => {
      const scene = await loadGltf(pointed([{ pointer, from: [0], to: [1] }]), { time: 1 });
      expect(scene.warnings).toEqual([
        expect.objectContaining({ code: 'gltf/animation', path: '/animations/0/channels/0' }),
      ]);
    },
  );
});
