import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { PathTracer, warmUp } from '../../src/index';
import { addQuad, addSphere, camera, createScene } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

/** The device, with the labels of what is compiled on it and the bytes of its buffers that are not destroyed. */
function watch() {
  const compiled: string[] = [];
  const buffers = new Set<GPUBuffer>();
  const watched = new Proxy(device, {
    get: (target, name) => {
      const value = Reflect.get(target, name) as unknown;
      if (name === 'createComputePipelineAsync') {
        return (descriptor: GPUComputePipelineDescriptor) => {
          compiled.push(descriptor.label!);
          return target.createComputePipelineAsync(descriptor);
        };
      }
      if (name === 'createBuffer') {
        return (descriptor: GPUBufferDescriptor) => {
          const buffer = target.createBuffer(descriptor);
          const destroy = buffer.destroy.bind(buffer);
          buffers.add(buffer);
          buffer.destroy = () => {
            buffers.delete(buffer);
            return destroy();
          };
          return buffer;
        };
      }
      return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
    },
  });
  return { watched, compiled, buffers };
}

it('compiles what scenes share, and keeps no memory', async () => {
  const { watched, compiled, buffers } = watch();
  await warmUp(watched, { maxDepth: 5 });
  expect(compiled).toContain('glanz shade');
  expect(compiled).toContain('glanz first');
  expect(buffers.size).toBe(0);

  const scene = createScene();
  addQuad(scene, 0.6, 0, { name: 'lamp', parameters: { base_metalness: 1, coat_weight: 0.5, emission_luminance: 2 } });
  addSphere(scene, 0.1, [0, 0, -5], { name: 'brushed', parameters: { specular_roughness: 0.4 } }, 8);
  scene.environment = { type: 'constant', radiance: [2, 2, 2] };
  compiled.length = 0;
  const tracer = await PathTracer.create(watched, scene, {
    width: 4,
    height: 4,
    camera,
    maxDepth: 5,
    onFirstLight: () => {},
  });
  tracer.destroy();
  expect(compiled).toEqual(['glanz shade']);
});

it('can be aborted, before or meanwhile, and reports no errors of its own', async () => {
  const { watched, compiled, buffers } = watch();
  await warmUp(watched, { signal: AbortSignal.abort() });
  expect(compiled).toEqual([]);
  const control = new AbortController();
  const warm = warmUp(watched, { signal: control.signal });
  setTimeout(() => control.abort(), 5);
  await warm;
  expect(buffers.size).toBe(0);
  await warmUp({} as GPUDevice);
});
