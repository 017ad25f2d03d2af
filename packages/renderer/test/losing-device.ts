import { nullDevice } from '@glanz/gpu';
import { requestDevice } from '../src/index';
import { createGpu } from '../src/node';

/**
 * A device of its own that is lost as a buffer with this label is made.
 * @param computes Whether it computes what comes before; without, it compiles nothing, and its buffers hold anything.
 */
export async function losingDevice(label: string, computes = false): Promise<GPUDevice> {
  const device = computes
    ? await requestDevice({ gpu: (await createGpu({ software: 'only' })).gpu })
    : (await nullDevice()).device;
  return new Proxy(device, {
    get: (target, name) => {
      const value = Reflect.get(target, name) as unknown;
      if (name === 'createBuffer')
        return (descriptor: GPUBufferDescriptor) => {
          if (descriptor.label === label) target.destroy();
          return target.createBuffer(descriptor);
        };
      return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
    },
  });
}
