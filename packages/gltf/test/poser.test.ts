import type { Scene } from '@glanz/scene';
import { describe, expect, test } from 'vitest';
import { loadGltf } from '../src/index';
import { openAnimations, type PoseChange } from '../src/poser';
import { glb, start, write } from './build';

const TRIANGLE = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]);
const UP = new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1]);

/**
 * A document of everything that moves: a parent whose child turns, two nodes of one mesh with morph targets of which one
 * is animated, and a skin with two joints.
 */
async function robot(): Promise<Uint8Array<ArrayBuffer>> {
  const { document, scene, accessor } = start();
  const plain = document
    .createPrimitive()
    .setAttribute('POSITION', accessor('VEC3', TRIANGLE))
    .setAttribute('NORMAL', accessor('VEC3', UP));
  const arm = document.createNode('arm').setTranslation([3, 0, 0]);
  const hand = document.createNode('hand').setMesh(document.createMesh('hand').addPrimitive(plain)).setScale([2, 2, 2]);
  const still = document.createNode('still').setMesh(document.createMesh('still').addPrimitive(plain));
  arm.addChild(hand);
  const face = document.createMesh('face').addPrimitive(
    document
      .createPrimitive()
      .setAttribute('POSITION', accessor('VEC3', TRIANGLE))
      .addTarget(
        document
          .createPrimitiveTarget()
          .setAttribute('POSITION', accessor('VEC3', new Float32Array([0, 0, 1, 0, 0, 2, 0, 0, 3]))),
      ),
  );
  const smiling = document.createNode('smiling').setMesh(face);
  const stern = document.createNode('stern').setMesh(face).setTranslation([0, 5, 0]);
  const joints = [
    document.createNode('hip').setTranslation([1, 0, 0]),
    document.createNode('knee').setTranslation([0, 1, 0]),
  ];
  joints[0]!.addChild(joints[1]!);
  const body = document
    .createNode('body')
    .setSkin(document.createSkin().addJoint(joints[0]!).addJoint(joints[1]!))
    .setMesh(
      document.createMesh('body').addPrimitive(
        document
          .createPrimitive()
          .setAttribute('POSITION', accessor('VEC3', TRIANGLE))
          .setAttribute('JOINTS_0', accessor('VEC4', new Uint8Array([0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0])))
          .setAttribute('WEIGHTS_0', accessor('VEC4', new Float32Array([0.5, 0.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]))),
      ),
    );
  for (const node of [arm, still, smiling, stern, joints[0]!, body]) scene.addChild(node);
  const half = Math.SQRT1_2;
  const animate = (name: string, list: [typeof arm, 'translation' | 'rotation' | 'weights', number[], number[]][]) => {
    const animation = document.createAnimation(name);
    for (const [node, path, times, values] of list) {
      const sampler = document
        .createAnimationSampler()
        .setInput(accessor('SCALAR', new Float32Array(times)))
        .setOutput(
          accessor(path === 'rotation' ? 'VEC4' : path === 'weights' ? 'SCALAR' : 'VEC3', new Float32Array(values)),
        );
      animation
        .addSampler(sampler)
        .addChannel(document.createAnimationChannel().setTargetNode(node).setTargetPath(path).setSampler(sampler));
    }
  };
  animate('wave', [
    [arm, 'rotation', [0, 2], [0, 0, 0, 1, 0, 0, half, half]],
    [smiling, 'weights', [0, 1], [0, 1]],
  ]);
  animate('step', [[joints[1]!, 'translation', [0, 1.5], [0, 1, 0, 0, 4, 0]]]);
  return write(document);
}

/** A scene with a change made to it. */
function changed(scene: Scene, { transforms, meshes, visibility }: PoseChange): Scene {
  const next = { ...scene, meshes: [...scene.meshes], instances: scene.instances.map((one) => ({ ...one })) };
  for (const { mesh, deformed } of meshes) next.meshes[mesh] = deformed;
  for (const { instance, transform } of transforms) next.instances[instance]!.transform = transform;
  for (const { instance, visible } of visibility) next.instances[instance]!.visible = visible;
  return next;
}

describe('a scene that is posed', () => {
  test('is the one that is loaded in the same pose, from pose to pose', async () => {
    const bytes = await robot();
    let posed = await loadGltf(bytes);
    const poser = await openAnimations(bytes, posed);
    expect(poser.animations).toEqual([
      { name: 'wave', duration: 2 },
      { name: 'step', duration: 1.5 },
    ]);
    for (const [animation, time] of [
      ['wave', 0.5],
      ['wave', 1.7],
      ['step', 0.9],
      ['step', 99],
      ['wave', 0],
      [undefined, 0],
    ] as const) {
      posed = changed(posed, poser.pose(animation, time));
      const { meshes, instances } = await loadGltf(bytes, animation === undefined ? {} : { animation, time });
      expect(posed.meshes).toEqual(meshes);
      expect(posed.instances).toEqual(instances);
    }
    // That something moves at all.
    const wave = await loadGltf(bytes, { animation: 'wave', time: 1 });
    expect(wave.instances).not.toEqual(posed.instances);
    expect(wave.meshes).not.toEqual(posed.meshes);
  });

  test('says only what differs from the pose before', async () => {
    const bytes = await robot();
    const scene = await loadGltf(bytes);
    const poser = await openAnimations(bytes, scene);
    poser.pose('wave', 0.2);
    const { transforms, meshes, visibility, lights } = poser.pose('wave', 0.4);
    expect(transforms.map(({ instance }) => scene.instances[instance]!.name)).toEqual(['hand']);
    expect(meshes.map(({ mesh }) => scene.meshes[mesh]!.name)).toEqual(['face']);
    expect([visibility, lights]).toEqual([[], []]);
    const again = poser.pose('wave', 0.4);
    expect([again.transforms, again.meshes]).toEqual([[], []]);
    // Triangles stay the same array, so that hierarchies can be refitted.
    expect(meshes[0]!.deformed.indices).toBe(poser.pose('wave', 0.6).meshes[0]!.deformed.indices);
  });

  test('nodes of one mesh that an animation morphs apart have meshes of their own', async () => {
    const { meshes, instances } = await loadGltf(await robot());
    const of = (name: string) => instances.find((one) => one.name === name)!.mesh;
    expect(of('smiling')).not.toBe(of('stern'));
    expect(meshes).toHaveLength(new Set(instances.map(({ mesh }) => mesh)).size);
  });
});

test('visibility and lights follow pointers and nodes', async () => {
  const binary = new Uint8Array(36 + 8 + 4 + 24);
  new Float32Array(binary.buffer, 0, 9).set(TRIANGLE);
  new Float32Array(binary.buffer, 36, 2).set([0, 1]);
  binary.set([1, 0], 44);
  new Float32Array(binary.buffer, 48, 6).set([0, 0, 0, 4, 0, 0]);
  const bytes = glb(
    {
      asset: { version: '2.0' },
      extensionsUsed: ['KHR_lights_punctual', 'KHR_animation_pointer', 'KHR_node_visibility'],
      extensions: { KHR_lights_punctual: { lights: [{ type: 'point', intensity: 5 }] } },
      scene: 0,
      scenes: [{ nodes: [0, 1] }],
      nodes: [
        { mesh: 0, extensions: { KHR_node_visibility: { visible: true } } },
        { extensions: { KHR_lights_punctual: { light: 0 } } },
      ],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
      animations: [
        {
          samplers: [
            { input: 1, output: 2, interpolation: 'STEP' },
            { input: 1, output: 3 },
          ],
          channels: [
            {
              sampler: 0,
              target: {
                path: 'pointer',
                extensions: { KHR_animation_pointer: { pointer: '/nodes/0/extensions/KHR_node_visibility/visible' } },
              },
            },
            { sampler: 1, target: { node: 1, path: 'translation' } },
          ],
        },
      ],
      buffers: [{ byteLength: binary.length }],
      bufferViews: [
        { buffer: 0, byteLength: 36 },
        { buffer: 0, byteOffset: 36, byteLength: 8 },
        { buffer: 0, byteOffset: 44, byteLength: 2 },
        { buffer: 0, byteOffset: 48, byteLength: 24 },
      ],
      accessors: [
        { bufferView: 0, componentType: 5126, type: 'VEC3', count: 3 },
        { bufferView: 1, componentType: 5126, type: 'SCALAR', count: 2 },
        { bufferView: 2, componentType: 5121, type: 'SCALAR', count: 2 },
        { bufferView: 3, componentType: 5126, type: 'VEC3', count: 2 },
      ],
    },
    binary,
  );
  const scene = await loadGltf(bytes);
  const poser = await openAnimations(bytes, scene);
  const half = poser.pose(0, 0.5);
  expect(half.visibility).toEqual([]);
  expect(half.lights).toEqual([{ index: 0, light: { ...scene.lights[0], position: [2, 0, 0] } }]);
  expect(poser.pose(0, 1).visibility).toEqual([{ instance: 0, visible: false }]);
});

test('an animation that is none, and a scene of another document, are refused', async () => {
  const bytes = await robot();
  const scene = await loadGltf(bytes);
  const poser = await openAnimations(bytes, scene);
  expect(() => poser.pose('dance')).toThrow(expect.objectContaining({ code: 'gltf/no-such-part' }));
  expect(() => poser.pose('wave', NaN)).toThrow(expect.objectContaining({ code: 'gltf/no-such-part' }));
  const { animatedParts: _, ...other } = scene;
  await expect(openAnimations(bytes, other)).rejects.toMatchObject({ code: 'gltf/no-such-part' });
});
