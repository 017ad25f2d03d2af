import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterAll, expect, it } from 'vitest';
import { PathTracer } from '../../src/index';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

afterAll(() => expectNoGpuErrors());

setFlagsFromString('--expose_gc');
const collectGarbage = runInNewContext('gc') as () => void;

const renderOnce = async (device: GPUDevice): Promise<WeakRef<object>[]> => {
  const scene = createScene();
  addQuad(scene, 0.9, 0, lambert(0.5));
  addSphere(scene, 0.3, [0, 0, 0.3], { name: 'ball', parameters: { coat_weight: 1 } }, 24);
  const tracer = await PathTracer.create(device, scene, { width: 8, height: 8, camera, pathsInFlight: 64 });
  for await (const progress of tracer.render({ samples: 2 })) void progress;
  await tracer.read('beauty');
  await tracer.read('normal');
  await tracer.setMaterial('ball', { coat_weight: 0 });
  tracer.destroy();
  return [new WeakRef(tracer), new WeakRef(scene), ...scene.meshes.map((mesh) => new WeakRef(mesh.positions.buffer))];
};

it('a destroyed tracer and its scene can be collected while the device lives', async () => {
  const device = await testDevice();
  const references: WeakRef<object>[] = [];
  for (let i = 0; i < 4; i++) references.push(...(await renderOnce(device)));
  // Promises and finalizers of the last round settle in later turns of the event loop.
  for (let turn = 0; turn < 20 && references.some((reference) => reference.deref()); turn++) {
    await new Promise((resolve) => setTimeout(resolve, 10));
    collectGarbage();
  }
  expect(
    references.filter((reference) => reference.deref()).map((reference) => reference.deref()?.constructor.name),
  ).toEqual([]);
});
