import { createGpu, type NodeGpu } from '@glanz/renderer/node';

/** Options for {@link testDevice}. */
export interface TestDeviceOptions {
  /**
   * Stay within WebGPU's default limits (8 storage buffers a stage, 128 MiB a binding). Default: all that the adapter
   * has.
   */
  readonly defaultLimits?: boolean;
  /** Features to have; ones that the adapter lacks are left out. Default: timestamp queries and subgroups. */
  readonly features?: readonly GPUFeatureName[];
  /**
   * `swiftshader` for files that compile many programs and render few pixels with each, where there is SwiftShader:
   * the programs of one scene take it 3.6 s of processor time, lavapipe 16.3 s. `any`, the default, takes lavapipe
   * where it is installed, which renders five times as fast.
   */
  readonly driver?: 'swiftshader' | 'any';
}

interface Shared {
  readonly device: Promise<GPUDevice>;
  readonly errors: string[];
}

const shared = new Map<string, Shared>();

/**
 * Compiling is most of the time that tests take on a software GPU, and Dawn's bounds checks are up to a fifth of it. `npm
 * test -- --full` compiles them, as do all tests that open GPUs of their own.
 */
const TOGGLES = process.env['GLANZ_FULL'] === undefined ? ['disable_robustness'] : [];

/**
 * The GPU to test on: the one that GLANZ_TEST_GPU names, e.g. `nvidia`; else a software GPU, so that tests give the same
 * results on every machine.
 */
async function findGpu(driver: TestDeviceOptions['driver']): Promise<NodeGpu> {
  const name = process.env['GLANZ_TEST_GPU'];
  if (name) return createGpu({ gpu: name });
  const software = { software: 'only', toggles: TOGGLES } as const;
  if (driver !== 'swiftshader') return createGpu(software);
  // Elsewhere than on x86-64 Linux there may be none.
  return createGpu({ gpu: 'swiftshader', ...software }).catch(() => createGpu(software));
}

/**
 * Keeps the pipelines that a device compiles. Dawn answers a request for a pipeline that exists with that one, without
 * compiling: tests create the same ones many times, and compiling is most of their time.
 */
function keepPipelines(device: GPUDevice): void {
  const kept = new Set<GPUComputePipeline>();
  const create = device.createComputePipelineAsync.bind(device);
  device.createComputePipelineAsync = async (descriptor) => {
    const pipeline = await create(descriptor);
    kept.add(pipeline);
    return pipeline;
  };
}

async function request(gpu: GPU, options: TestDeviceOptions, errors: string[]): Promise<GPUDevice> {
  const adapter = await gpu.requestAdapter();
  if (!adapter) throw new Error('testDevice: the adapter that createGpu() found is gone');
  const requiredLimits: Record<string, number> = {};
  if (!options.defaultLimits) {
    for (const key in adapter.limits) {
      const value = adapter.limits[key as keyof GPUSupportedLimits];
      if (typeof value === 'number') requiredLimits[key] = value;
    }
  }
  const requested = options.features ?? ['timestamp-query', 'subgroups'];
  const requiredFeatures = requested.filter((feature) => adapter.features.has(feature)) as GPUFeatureName[];
  const device = await adapter.requestDevice({ label: 'glanz test', requiredLimits, requiredFeatures });
  keepPipelines(device);
  device.addEventListener('uncapturederror', (event) => {
    event.preventDefault();
    errors.push((event as GPUUncapturedErrorEvent).error.message);
  });
  void device.lost.then((info) => {
    if (info.reason !== 'destroyed') errors.push(`device lost: ${info.message}`);
  });
  return device;
}

/**
 * A WebGPU device on the software GPU for tests in Node. One per test process and options: calls share it, and nobody
 * destroys it. Test files that use it must run in forked processes (Vitest `pool: 'forks'`), on the main thread.
 *
 * Errors that nobody captures are collected: end each test, or each file, with {@link expectNoGpuErrors}.
 *
 * @throws {DeviceError} when the machine has no software GPU, saying what to install.
 * @example
 * const device = await testDevice();
 * afterEach(() => expectNoGpuErrors());
 */
export async function testDevice({ driver, ...options }: TestDeviceOptions = {}): Promise<GPUDevice> {
  const { gpu, adapterName } = await findGpu(driver);
  // Where there is one driver, who asks for it by name shares its device and programs with the others.
  const key = JSON.stringify([adapterName, options]);
  let entry = shared.get(key);
  if (!entry) {
    const errors: string[] = [];
    entry = { device: request(gpu, options, errors), errors };
    shared.set(key, entry);
  }
  return entry.device;
}

/**
 * Waits for the GPU and fails on any validation, memory or loss error that the process's test devices have reported
 * since the last call.
 *
 * @throws {Error} with all messages.
 */
export async function expectNoGpuErrors(): Promise<void> {
  const found: string[] = [];
  for (const entry of shared.values()) {
    const device = await entry.device;
    await device.queue.onSubmittedWorkDone().catch(() => undefined);
    // The event of an error comes in a later turn than the work's end.
    await new Promise((resolve) => setTimeout(resolve, 0));
    found.push(...entry.errors.splice(0));
  }
  if (found.length > 0) throw new Error(`${found.length} GPU error(s):\n${found.join('\n')}`);
}
