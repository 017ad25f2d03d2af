import type { PathTracer } from '@glanz/renderer';
import { createScene, type Scene } from '@glanz/scene';
import '../src/viewer/moves';
import { expect, test } from 'vitest';
import { applyPose, posedScene } from '../src/viewer/pose';

/** Two parts, a light and an image. */
function model(): Scene {
  const scene = createScene('model');
  const at = (x: number) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1];
  const mesh = (name: string) => ({
    name,
    positions: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0),
    indices: Uint32Array.of(0, 1, 2),
  });
  scene.meshes = [mesh('a'), mesh('b')];
  scene.materials = [{ name: 'paint', parameters: { base_color: [1, 0, 0], specular_roughness: 0.5 } }];
  scene.instances = [
    { name: 'a', mesh: 0, material: 0, transform: at(0) },
    { name: 'b', mesh: 1, material: 0, transform: at(1) },
  ];
  scene.lights = [{ type: 'point', name: 'light', color: [1, 1, 1], intensity: 1, position: [0, 1, 0] }];
  scene.images = [{ name: 'image', width: 1, height: 1, data: Uint8Array.of(1, 2, 3, 4) }];
  return scene;
}

/** Writes down what is asked of it. */
function recorder(scene: Scene): { readonly tracer: PathTracer; readonly asked: unknown[][] } {
  const asked: unknown[][] = [];
  const note =
    (name: string) =>
    (...given: unknown[]) =>
      Promise.resolve(void asked.push([name, ...given]));
  return {
    tracer: {
      scene,
      replaceMesh: note('mesh'),
      setInstanceTransforms: note('move'),
      setLight: note('light'),
      setMaterial: note('material'),
    } as unknown as PathTracer,
    asked,
  };
}

test('a pose moves what it moves and leaves the rest, images and all', () => {
  const [scene, pose] = [model(), model()];
  pose.images = [];
  pose.instances[1]!.transform = Array.from(pose.instances[1]!.transform).map((v, i) => (i === 12 ? 5 : v));
  pose.meshes[0]!.positions[0] = 9;
  const posed = posedScene(scene, pose)!;
  expect(posed.images).toBe(scene.images);
  expect(posed.meshes[0]).toBe(pose.meshes[0]);
  expect(posed.meshes[1]).toBe(scene.meshes[1]);
  expect(posed.instances.map(({ transform }) => transform[12])).toEqual([0, 5]);
  expect(scene.instances[1]!.transform[12]).toBe(1);
});

test('other parts are no pose', () => {
  const fewer = model();
  fewer.instances.pop();
  expect(posedScene(model(), fewer)).toBeUndefined();
  const other = model();
  other.instances[0]!.mesh = 1;
  expect(posedScene(model(), other)).toBeUndefined();
});

test('a tracer is asked for what differs only, and what the user has edited stays', async () => {
  const [scene, pose] = [model(), model()];
  pose.instances[0]!.transform = Array.from(pose.instances[0]!.transform).map((v, i) => (i === 13 ? 2 : v));
  pose.lights[0] = { ...pose.lights[0]!, intensity: 4 };
  pose.materials[0]!.parameters = { base_color: [0, 1, 0], specular_roughness: 0.25 };
  const posed = posedScene(scene, pose)!;
  const { tracer, asked } = recorder(scene);
  await applyPose(tracer, posed, { materials: { 0: { base_color: [0, 0, 1] } }, moves: {} });
  expect(asked).toEqual([
    ['move', [[0, posed.instances[0]!.transform]]],
    ['light', 0, posed.lights[0]],
    ['material', 0, { base_color: [0, 0, 1], specular_roughness: 0.25 }],
  ]);
  const still = recorder(posed);
  await applyPose(still.tracer, posed, { materials: {}, moves: {} });
  expect(still.asked).toEqual([['move', []]]);
});

test('a part that the user has moved is moved from where the pose has it', async () => {
  const [scene, pose] = [model(), model()];
  pose.instances[0]!.transform = Array.from(pose.instances[0]!.transform).map((v, i) => (i === 13 ? 2 : v));
  const posed = posedScene(scene, pose)!;
  const { tracer, asked } = recorder(scene);
  const move = { translation: [1, 0, -3] as const, rotation: [0, 0, 0] as const, scale: [1, 1, 1] as const };
  await applyPose(tracer, posed, { materials: {}, moves: { 0: move } });
  const before = posed.instances[0]!.transform;
  const expected = Array.from(before).map((v, i) => v + (i === 12 ? 1 : i === 14 ? -3 : 0));
  expect(asked[0]).toEqual(['move', [[0, expected]]]);
});
