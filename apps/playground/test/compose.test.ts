import { sceneBounds, type Scene } from '@glanz/scene';
import { expect, test, vi } from 'vitest';
import { initialState } from '../src/state/state';
import { composeScene, FLOOR } from '../src/viewer/compose';
import { CameraRig } from '../src/viewer/camera-rig';
import { Store } from '../src/state/store';

const state = { ...initialState('none'), floor: true };
const scene = (): Scene => ({
  meshes: [{ name: 'box', positions: Float32Array.of(-1, 2, -3, 4, 2, 5, 0, 6, 0), indices: Uint32Array.of(0, 1, 2) }],
  materials: [{ name: 'grey', parameters: {} }],
  images: [],
  textures: [],
  instances: [{ name: 'box', mesh: 0, material: 0, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }],
  lights: [],
  cameras: [],
  warnings: [],
});

const floorOf = ({ meshes, instances }: Scene) =>
  meshes[instances.find(({ name }) => name === FLOOR)?.mesh ?? -1]?.positions;

test('the floor takes the bounds that are known, and no vertex is read', async () => {
  const loaded = scene();
  const rig = new CameraRig(new Store(state), () => 1);
  await rig.setScene(loaded, state);
  const bounds = rig.boundsOf(loaded);
  expect(bounds).toEqual(sceneBounds(loaded));
  expect(rig.boundsOf(scene())).toBeUndefined();
  const read = vi.fn<() => Float32Array>(() => {
    throw new Error('the vertices are read');
  });
  Object.defineProperty(loaded.meshes[0], 'positions', { get: read, enumerable: false });
  const floor = floorOf(composeScene(loaded, state, undefined, bounds));
  expect(read).not.toHaveBeenCalled();
  // Just under the lowest point, about the middle of the model.
  const y = floor?.[1] ?? NaN;
  expect(y).toBeLessThan(2);
  expect(y).toBeGreaterThan(1.99);
  expect([((floor?.[0] ?? 0) + (floor?.[3] ?? 0)) / 2, ((floor?.[2] ?? 0) + (floor?.[8] ?? 0)) / 2]).toEqual([1.5, 1]);
  // Where nobody knows them, they are found.
  expect(floorOf(composeScene(scene(), state, undefined))).toEqual(floor);
});
