import { requestDevice } from '../src/index';
import { createGpu } from '../src/node';

/** A device of its own that is lost as a buffer with this label is made. */
export async function losingDevice(label: string): Promise<GPUDevice> {
  const { gpu } = await createGpu({ software: 'only' });
  const own = await requestDevice({ gpu });
  return new Proxy(own, {
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
