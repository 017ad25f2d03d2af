import { NodeIO, type Document } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { triangle } from '@glanz/browser/files';
import { loadGltf } from '@glanz/gltf';
import type { Scene } from '@glanz/scene';
import { describe, expect, test } from 'vitest';
import { modelAsGltf } from '../src/output/model-as-gltf';
import { initialState, type Move } from '../src/state/state';
import { placedTransform } from '../src/viewer/placement';

const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);
const MOVE: Move = { translation: [0.5, -2, 3], rotation: [20, -70, 130], scale: [1, 1, 1] };
const STRETCH: Move = { translation: [1, 0, 0], rotation: [0, 0, 30], scale: [2, 0.5, 1] };
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** A triangle as it lies in the world, with its material. */
interface Seen {
  readonly material: string;
  readonly points: readonly number[];
}

const through = (m: ArrayLike<number>, positions: ArrayLike<number>): number[] =>
  Array.from({ length: positions.length }, (_, i) => {
    const [k, at] = [i % 3, i - (i % 3)];
    return m[k]! * positions[at]! + m[4 + k]! * positions[at + 1]! + m[8 + k]! * positions[at + 2]! + m[12 + k]!;
  });
const sorted = (list: Seen[]) =>
  list.toSorted((a, b) => a.material.localeCompare(b.material) || a.points[0]! - b.points[0]!);

const seenIn = (scene: Scene, moves: Readonly<Record<string, Move>> = {}): Seen[] =>
  sorted(
    scene.instances.map(({ mesh, material }, index) => ({
      material: scene.materials[material]!.name,
      points: through(placedTransform(scene, index, moves), scene.meshes[mesh]!.positions),
    })),
  );

/** By an independent reader. */
const seenBy = (document: Document): Seen[] =>
  sorted(
    document
      .getRoot()
      .listNodes()
      .flatMap((node) =>
        (node.getMesh()?.listPrimitives() ?? []).map((primitive) => ({
          material: primitive.getMaterial()!.getName(),
          points: through(node.getWorldMatrix(), primitive.getAttribute('POSITION')!.getArray()!),
        })),
      ),
  );

function expectSame(found: readonly Seen[], expected: readonly Seen[]): void {
  expect(found.map(({ material }) => material)).toEqual(expected.map(({ material }) => material));
  found.forEach(({ points, material }, i) =>
    points.forEach((value, k) => expect(value, `${material}, number ${k}`).toBeCloseTo(expected[i]!.points[k]!, 5)),
  );
}

type Json = Record<string, unknown>;

/** Opens a file, moves parts by their indices, saves it, and reads the result by both readers. */
async function saved(change: (json: Json) => void, moves: Readonly<Record<number, Move>>) {
  const bytes = new Uint8Array(
    triangle([0.5, 0.5, 0.5], (json) => {
      json['materials'] = ['red', 'green', 'blue'].map((name) => ({ name }));
      change(json);
    }),
  );
  const scene = await loadGltf(bytes, { partNodes: true });
  const request = { kind: 'files', files: new Map([['a.glb', new Blob([bytes])]]), entry: 'a.glb' } as const;
  const state = { ...initialState('studio'), moves };
  const file = await modelAsGltf({ scene, request, title: 'a', name: 'a.glb' }, state);
  const again = await loadGltf(file.bytes, { partNodes: true });
  expect(again.warnings).toEqual(scene.warnings);
  return { scene, again, note: file.note, document: await io.readBinary(file.bytes), moved: seenIn(scene, moves) };
}

const primitive = (material: number) => ({ attributes: { POSITION: 0 }, material });
const mesh = (...materials: number[]) => ({ primitives: materials.map(primitive) });
/** Turned and stretched: a node below it that is turned shears. */
const PARENT = { rotation: [0, Math.SQRT1_2, 0, Math.SQRT1_2], scale: [1, 2, 3], translation: [1, 2, 3] };

describe('moves in the glTF of a file', () => {
  test('a node that is nothing but its mesh is moved itself', async () => {
    const { again, document, moved, note } = await saved(
      (json) =>
        Object.assign(json, {
          scenes: [{ nodes: [0] }],
          nodes: [
            { name: 'Boat', children: [1, 2], translation: [0, 5, 0] },
            { name: 'Sail', mesh: 0, rotation: [0, 0, Math.SQRT1_2, Math.SQRT1_2], scale: [2, 2, 2] },
            { name: 'Jib', mesh: 1 },
          ],
          meshes: [mesh(0), mesh(1)],
        }),
      { 0: MOVE },
    );
    expect(note).toBe('');
    expect(document.getRoot().listNodes()).toHaveLength(3);
    expectSame(seenBy(document), moved);
    expectSame(seenIn(again), moved);
    expect(again.instances.map(({ name }) => name)).toEqual(['Sail', 'Jib']);
  });

  test('of a node with several primitives, the moved ones become children; meshes that others share stay', async () => {
    const { again, document, moved } = await saved(
      (json) =>
        Object.assign(json, {
          scenes: [{ nodes: [0, 1] }],
          nodes: [
            { name: 'Sail', mesh: 0, translation: [0, 1, 0] },
            { name: 'Twin', mesh: 0, translation: [5, 1, 0] },
          ],
          meshes: [{ name: 'cloth', ...mesh(0, 1, 2) }],
        }),
      { 1: MOVE, 2: STRETCH },
    );
    expectSame(seenBy(document), moved);
    expectSame(seenIn(again), moved);
    const [sail, twin] = document.getRoot().listNodes();
    expect(sail!.getMesh()!.listPrimitives()).toHaveLength(1);
    expect(sail!.listChildren().map((child) => child.getName())).toEqual(['Sail', 'Sail']);
    expect(twin!.getMesh()!.listPrimitives()).toHaveLength(3);
    // The data of the geometry is there once.
    expect(document.getRoot().listAccessors()).toHaveLength(1);
  });

  test('children, cameras and lights of a moved part stay where they are', async () => {
    const { again, document, moved, scene } = await saved(
      (json) =>
        Object.assign(json, {
          extensionsUsed: ['KHR_lights_punctual'],
          extensions: { KHR_lights_punctual: { lights: [{ type: 'point' }] } },
          cameras: [{ type: 'perspective', perspective: { yfov: 1, znear: 0.1 } }],
          scenes: [{ nodes: [0] }],
          nodes: [
            { name: 'Hull', mesh: 0, children: [1], ...PARENT },
            {
              name: 'Mast',
              mesh: 1,
              camera: 0,
              translation: [0, 3, 0],
              extensions: { KHR_lights_punctual: { light: 0 } },
            },
          ],
          meshes: [mesh(0), mesh(1)],
        }),
      { 0: MOVE, 1: STRETCH },
    );
    expectSame(seenBy(document), moved);
    expectSame(seenIn(again), moved);
    expect(again.cameras).toEqual(scene.cameras);
    expect(again.lights).toEqual(scene.lights);
  });

  test('what shears becomes two nodes, each of a translation, a rotation and a scale', async () => {
    const { again, document, moved } = await saved(
      (json) =>
        Object.assign(json, {
          scenes: [{ nodes: [0] }],
          nodes: [
            { children: [1], ...PARENT },
            { name: 'Sail', mesh: 0, rotation: [0.5, 0.5, 0.5, 0.5], scale: [1, -1, 1] },
          ],
        }),
      { 0: { translation: [1, 0, 0], rotation: [0, 0, 0], scale: [3, 1, 0.25] } },
    );
    expectSame(seenBy(document), moved);
    expectSame(seenIn(again), moved);
  });

  test('an instance of several at a node moves alone', async () => {
    const { again, document, moved } = await saved(
      (json) => {
        const offsets = { bufferView: 0, componentType: 5126, count: 3, type: 'VEC3' };
        (json['accessors'] as object[]).push(offsets);
        Object.assign(json, {
          extensionsUsed: ['EXT_mesh_gpu_instancing'],
          extensionsRequired: ['EXT_mesh_gpu_instancing'],
          scenes: [{ nodes: [0] }],
          nodes: [
            {
              name: 'Leaf',
              mesh: 0,
              ...PARENT,
              extensions: { EXT_mesh_gpu_instancing: { attributes: { TRANSLATION: 1 } } },
            },
          ],
          meshes: [mesh(0)],
        });
      },
      { 1: MOVE },
    );
    expect(moved).toHaveLength(3);
    expectSame(seenBy(document), moved);
    expectSame(seenIn(again), moved);
    expect(document.getRoot().listExtensionsUsed()).toEqual([]);
  });

  /** A clip of one key that turns a node, and one that changes its weights. */
  const animated = (json: Json, path: 'rotation' | 'weights', node: number) => {
    (json['accessors'] as object[]).push(
      { bufferView: 1, componentType: 5126, count: 1, type: 'SCALAR', min: [0], max: [0] },
      path === 'rotation'
        ? { bufferView: 1, byteOffset: 4, componentType: 5126, count: 1, type: 'VEC4' }
        : { bufferView: 1, byteOffset: 16, componentType: 5126, count: 1, type: 'SCALAR' },
    );
    (json['bufferViews'] as object[]).push({ buffer: 1, byteLength: 20 });
    const clip = Float32Array.of(0, Math.SQRT1_2, 0, 0, Math.SQRT1_2);
    (json['buffers'] as object[]).push({
      byteLength: 20,
      uri: `data:application/octet-stream;base64,${Buffer.from(clip.buffer).toString('base64')}`,
    });
    json['animations'] = [{ samplers: [{ input: 1, output: 2 }], channels: [{ sampler: 0, target: { node, path } }] }];
  };

  test('an animated part is where it was put at rest, and its move follows the animation', async () => {
    const { again, document, moved, note } = await saved(
      (json) => {
        Object.assign(json, {
          scenes: [{ nodes: [0] }],
          nodes: [{ name: 'Sail', mesh: 0, translation: [0, 1, 0] }],
          meshes: [mesh(0)],
        });
        animated(json, 'rotation', 0);
      },
      { 0: MOVE },
    );
    expectSame(seenBy(document), moved);
    expectSame(seenIn(again), moved);
    expect(note).toBe('In the file, the moves of animated parts turn with the animation: Sail.');
    const target = document.getRoot().listAnimations()[0]!.listChannels()[0]!.getTargetNode()!;
    expect(target.getName()).toBe('Sail');
    expect(target.getMesh()).toBeNull();
    expect(target.listChildren()[0]!.getMesh()).not.toBeNull();
  });

  test('an animation of weights follows the mesh', async () => {
    const { again, document, moved, note } = await saved(
      (json) => {
        Object.assign(json, {
          scenes: [{ nodes: [0] }],
          nodes: [{ name: 'Sail', mesh: 0, weights: [0], camera: 0 }],
          cameras: [{ type: 'perspective', perspective: { yfov: 1, znear: 0.1 } }],
          meshes: [
            {
              primitives: [0, 1].map((material) => ({ ...primitive(material), targets: [{ POSITION: 0 }] })),
              weights: [0],
            },
          ],
        });
        animated(json, 'weights', 0);
      },
      { 1: MOVE },
    );
    expect(note).toBe('');
    expectSame(seenBy(document), moved);
    expectSame(seenIn(again), moved);
    const targets = document
      .getRoot()
      .listAnimations()[0]!
      .listChannels()
      .map((channel) => channel.getTargetNode()!.getMesh()!.listPrimitives()[0]!.getMaterial()!.getName());
    expect(targets.toSorted()).toEqual(['green', 'red']);
  });

  test('a part that a skeleton places stays, and the note says so', async () => {
    const { again, scene, note } = await saved(
      (json) => {
        (json['accessors'] as object[]).push(
          { componentType: 5121, count: 3, type: 'VEC4' },
          { componentType: 5126, count: 3, type: 'VEC4' },
        );
        Object.assign(json, {
          scenes: [{ nodes: [0, 1] }],
          nodes: [{ name: 'Arm', mesh: 0, skin: 0 }, { name: 'Joint' }],
          skins: [{ joints: [1] }],
          meshes: [{ primitives: [{ ...primitive(0), attributes: { POSITION: 0, JOINTS_0: 1, WEIGHTS_0: 2 } }] }],
        });
      },
      { 0: MOVE },
    );
    expect(scene.instances[0]!.transform).toEqual(IDENTITY);
    expectSame(seenIn(again), seenIn(scene));
    expect(note).toBe('The file keeps these parts where its skeleton or animation puts them: Arm.');
  });
});
