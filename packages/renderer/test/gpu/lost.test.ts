import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { PathTracer } from '../../src/index';
import { addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

it('the loss of a device while a scene is prepared is reported, though no call fails', async () => {
  const gone = new Proxy(device, {
    get: (target, name) => {
      if (name === 'lost') return Promise.resolve({ reason: 'unknown', message: 'fell over' });
      const value = Reflect.get(target, name) as unknown;
      return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
    },
  });
  const scene = createScene();
  addQuad(scene, 0.5, 0, lambert(0.5));
  await expect(PathTracer.create(gone, scene, { width: 4, height: 4, camera })).rejects.toMatchObject({
    code: 'renderer/device-lost',
    message: expect.stringContaining('fell over') as string,
  });
});
