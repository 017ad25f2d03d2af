import { describe, expect, test } from 'vitest';
import { loadGltf } from '../src/index';
import { glb, start, triangle, write } from './build';

const TRIANGLE = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]);

/** A node that an animation moves, written by glTF-Transform. */
async function animated(
  path: 'translation' | 'rotation' | 'scale',
  interpolation: 'LINEAR' | 'STEP' | 'CUBICSPLINE',
  times: number[],
  values: number[],
) {
  const { document, scene, accessor } = start();
  const node = document
    .createNode('moved')
    .setMesh(
      document
        .createMesh()
        .addPrimitive(document.createPrimitive().setAttribute('POSITION', accessor('VEC3', TRIANGLE))),
    );
  scene.addChild(node);
  const sampler = document
    .createAnimationSampler()
    .setInterpolation(interpolation)
    .setInput(accessor('SCALAR', new Float32Array(times)))
    .setOutput(accessor(path === 'rotation' ? 'VEC4' : 'VEC3', new Float32Array(values)));
  document
    .createAnimation('go')
    .addSampler(sampler)
    .addChannel(document.createAnimationChannel().setTargetNode(node).setTargetPath(path).setSampler(sampler));
  return write(document);
}

const at = async (bytes: Uint8Array<ArrayBuffer>, time: number) =>
  Array.from((await loadGltf(bytes, { time })).instances[0]!.transform);

describe('interpolation', () => {
  test('steps hold the last key', async () => {
    const bytes = await animated('translation', 'STEP', [1, 2, 4], [0, 0, 0, 5, 0, 0, 9, 0, 0]);
    for (const [time, x] of [
      [0, 0],
      [1.9, 0],
      [2, 5],
      [3.99, 5],
      [4, 9],
      [100, 9],
    ] as const)
      expect((await at(bytes, time))[12]).toBe(x);
  });

  test('linear, held before the first and after the last key', async () => {
    const bytes = await animated('scale', 'LINEAR', [1, 3], [1, 1, 1, 3, 5, 7]);
    for (const [time, f] of [
      [0, 0],
      [1, 0],
      [1.5, 0.25],
      [2, 0.5],
      [3, 1],
      [9, 1],
    ] as const) {
      const m = await at(bytes, time);
      [1 + 2 * f, 1 + 4 * f, 1 + 6 * f].forEach((s, k) => expect(m[5 * k]).toBeCloseTo(s, 12));
    }
  });

  test('rotations turn at an even speed, the shorter way round', async () => {
    // From 0° to −120° about z, the second with its sign turned: the same rotation.
    const q = (degrees: number, sign = 1) => [
      0,
      0,
      sign * Math.sin((degrees * Math.PI) / 360),
      sign * Math.cos((degrees * Math.PI) / 360),
    ];
    const bytes = await animated('rotation', 'LINEAR', [0, 1], [...q(0), ...q(-120, -1)]);
    for (const f of [0.1, 0.5, 0.75]) {
      const m = await at(bytes, f);
      expect(m[0]).toBeCloseTo(Math.cos((-120 * f * Math.PI) / 180), 6);
      expect(m[1]).toBeCloseTo(Math.sin((-120 * f * Math.PI) / 180), 6);
    }
  });

  test('cubic splines with tangents in units per second: a parabola stays one', async () => {
    // x(t) = t², whose derivative is 2t: a cubic through its keys and tangents is the parabola itself.
    const times = [0, 0.5, 2],
      values = times.flatMap((t) => [2 * t, 0, 0, t * t, 0, 0, 2 * t, 0, 0]);
    const bytes = await animated('translation', 'CUBICSPLINE', times, values);
    for (const t of [0, 0.2, 0.5, 1.1, 1.9, 2]) expect((await at(bytes, t))[12]).toBeCloseTo(t * t, 6);
  });
});

test('weights of morph targets', async () => {
  const { document, scene, accessor } = start();
  const target = (z: number) =>
    document
      .createPrimitiveTarget()
      .setAttribute('POSITION', accessor('VEC3', new Float32Array([0, 0, z, 0, 0, z, 0, 0, z])));
  const node = document.createNode().setMesh(
    document
      .createMesh()
      .setWeights([0, 0])
      .addPrimitive(
        document
          .createPrimitive()
          .setAttribute('POSITION', accessor('VEC3', TRIANGLE))
          .addTarget(target(4))
          .addTarget(target(8)),
      ),
  );
  scene.addChild(node);
  const sampler = document
    .createAnimationSampler()
    .setInput(accessor('SCALAR', new Float32Array([0, 1])))
    .setOutput(accessor('SCALAR', new Float32Array([0, 0, 1, 0.5])));
  document
    .createAnimation()
    .addSampler(sampler)
    .addChannel(document.createAnimationChannel().setTargetNode(node).setTargetPath('weights').setSampler(sampler));
  const bytes = await write(document);
  expect((await loadGltf(bytes)).meshes[0]!.positions[2]).toBe(0);
  expect((await loadGltf(bytes, { time: 0.5 })).meshes[0]!.positions[2]).toBe(0.5 * 4 + 0.25 * 8);
});

test('an animation by name or index; without one, the pose at rest', async () => {
  const bytes = await animated('translation', 'LINEAR', [0, 2], [1, 0, 0, 3, 0, 0]);
  const x = async (options: Parameters<typeof loadGltf>[1]) =>
    (await loadGltf(bytes, options)).instances[0]!.transform[12];
  expect(await x({})).toBe(0);
  expect(await x({ animation: 'go' })).toBe(1);
  expect(await x({ animation: 0, time: 1 })).toBe(2);
  expect((await loadGltf(bytes)).animations).toEqual([{ name: 'go', duration: 2 }]);
  await expect(loadGltf(bytes, { animation: 'stop' })).rejects.toMatchObject({
    code: 'gltf/no-such-part',
    message: expect.stringMatching(/"stop".*"go"/),
  });
  await expect(loadGltf(bytes, { time: NaN })).rejects.toMatchObject({ code: 'gltf/no-such-part' });
});

test('channels that make no sense are left out, with a warning each; the others move', async () => {
  const { json, binary } = triangle();
  const bytes = new Uint8Array(44 + 8 + 24);
  bytes.set(binary);
  new Float32Array(bytes.buffer, 44, 8).set([0, 1, 0, 0, 0, 2, 0, 0]);
  json['buffers'][0].byteLength = bytes.length;
  json['bufferViews'].push({ buffer: 0, byteOffset: 44, byteLength: 8 }, { buffer: 0, byteOffset: 52, byteLength: 24 });
  json['accessors'].push(
    { bufferView: 2, componentType: 5126, type: 'SCALAR', count: 2 },
    { bufferView: 3, componentType: 5126, type: 'VEC3', count: 2 },
  );
  const target = { node: 0, path: 'translation' };
  json['animations'] = [
    {
      samplers: [
        { input: 2, output: 3 },
        { input: 2, output: 99 },
        { input: 3, output: 3 },
        { input: 2, output: 3, interpolation: 'SMOOTH' },
      ],
      channels: [
        { sampler: 1, target },
        { sampler: 2, target },
        { sampler: 9, target },
        { sampler: 0, target: { node: 5, path: 'scale' } },
        { sampler: 0, target: { node: 0, path: 'colour' } },
        { sampler: 0, target: { node: 0, path: 'rotation' } },
        { sampler: 0, target: { path: 'scale' } },
        { sampler: 0, target },
      ],
    },
  ];
  const scene = await loadGltf(glb(json, bytes), { time: 0.5 });
  expect(scene.instances[0]!.transform[12]).toBe(1);
  expect(scene.warnings.map(({ path }) => path)).toEqual([
    '/animations/0/samplers/1',
    '/animations/0/samplers/2',
    '/animations/0/samplers/3',
    '/animations/0/channels/2',
    '/animations/0/channels/3',
    '/animations/0/channels/4',
    '/animations/0/channels/5',
  ]);
});

test('keys that do not count are reported when the scene is posed by them', async () => {
  const posed = async (times: number[], values: number[]) => {
    const { warnings, instances } = await loadGltf(await animated('translation', 'LINEAR', times, values), { time: 1 });
    return [instances[0]!.transform[12], warnings.map(({ path, message }) => [path, message])];
  };
  expect(await posed([0, 2], [1, 0, 0, 3, 0, 0])).toEqual([2, []]);
  expect(await posed([0, 2], [1, 0, 0, NaN, 0, 0])).toEqual([
    0,
    [['/animations/0/samplers/0', expect.stringMatching(/translation of node \d that is not finite/)]],
  ]);
  const [, warnings] = await posed([2, 0, 1], [1, 0, 0, 3, 0, 0, 5, 0, 0]);
  expect(warnings).toEqual([['/animations/0/samplers/0', expect.stringMatching(/times that do not rise/)]]);
});
