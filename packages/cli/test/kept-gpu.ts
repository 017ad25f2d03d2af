import { nodeBackend, type Backend, type OpenedGpu } from '../src/index';

interface KeptGpu {
  readonly opened: OpenedGpu;
  onError: (error: Error) => void;
}

const closed = new Set<KeptGpu>();
const losses = new WeakMap<GPUDevice, () => void>();

/**
 * The real backend on software GPUs that outlive commands. A command takes one that another has closed, with the
 * programs that were compiled there: to compile them is most of the time of a small image.
 */
export function keptBackend(): Backend {
  const real = nodeBackend();
  return {
    ...real,
    async openGpu(_name, onError = () => undefined) {
      const [reused] = closed;
      if (reused) closed.delete(reused);
      const kept = reused ?? (await open(real));
      kept.onError = onError;
      return kept.opened;
    },
  };
}

/** Loses a device of {@link keptBackend} as a driver does: reason `unknown`, and everything that is under way fails. */
export const loseGpu = (device: GPUDevice): void => losses.get(device)!();

async function open(real: Backend): Promise<KeptGpu> {
  const opened = await real.openGpu('software', (error) => kept.onError(error));
  const kept: KeptGpu = { opened, onError: () => undefined };
  const { device } = opened;
  const destroy = device.destroy.bind(device);
  const create = device.createComputePipelineAsync.bind(device);
  // Dawn answers a request for a pipeline that exists with that one.
  const pipelines = new Set<GPUComputePipeline>();
  let fire: (info: GPUDeviceLostInfo) => void = () => undefined;
  const injected = new Promise<GPUDeviceLostInfo>((done) => (fire = done));
  Object.defineProperty(device, 'lost', { value: Promise.race([injected, device.lost]) });
  let lost = false;
  losses.set(device, () => {
    lost = true;
    fire({ reason: 'unknown', message: 'injected loss' } as GPUDeviceLostInfo);
    destroy();
  });
  Object.assign(device, {
    destroy: () => void (lost || closed.add(kept)),
    createComputePipelineAsync: async (descriptor: GPUComputePipelineDescriptor) => {
      const pipeline = await create(descriptor);
      pipelines.add(pipeline);
      return pipeline;
    },
  });
  return kept;
}
