import { DeviceError } from '../errors';

/** Options for {@link requestDevice}. */
export interface DeviceOptions {
  /**
   * Where to look for adapters; default `navigator.gpu`. In Node pass what `createGpu()` of `@glanz/renderer/node`
   * gives.
   */
  readonly gpu?: GPU;
  /** Default `high-performance`. */
  readonly powerPreference?: GPUPowerPreference;
  /** Stay within WebGPU's default limits even where the adapter offers more. Default false. */
  readonly defaultLimits?: boolean;
  /**
   * Called with errors that the device reports outside of any error scope. Glanz makes its own calls inside error
   * scopes and throws their errors, so these come from other code that uses the device. Default: the browser writes
   * them to its console.
   */
  readonly onError?: (error: DeviceError) => void;
}

/** Limits that large scenes profit from; each is raised to what the adapter offers. */
const RAISED_LIMITS = [
  'maxStorageBufferBindingSize',
  'maxBufferSize',
  'maxTextureDimension2D',
  'maxTextureArrayLayers',
  'maxStorageBuffersPerShaderStage',
  'maxSampledTexturesPerShaderStage',
] as const;

/** Features that are used when present and never required. */
const WELCOME_FEATURES = [
  'timestamp-query',
  'subgroups',
  // With it @glanz/denoise loads and stores halves directly, with both it multiplies matrices of them.
  'shader-f16',
  'chromium-experimental-subgroup-matrix',
  'float32-filterable',
  'texture-compression-bc',
  'texture-compression-astc',
  'texture-compression-etc2',
] as const;

/**
 * Requests a WebGPU device with everything that Glanz can use: limits as high as the adapter offers, timestamp queries,
 * compressed textures.
 *
 * @throws {DeviceError} `renderer/no-webgpu` without WebGPU, `renderer/no-adapter` without a usable GPU,
 * `renderer/no-device` when the adapter refuses a device.
 */
export async function requestDevice(options: DeviceOptions = {}): Promise<GPUDevice> {
  const gpu = options.gpu ?? (globalThis as { navigator?: { gpu?: GPU } }).navigator?.gpu;
  if (!gpu) {
    throw new DeviceError(
      'renderer/no-webgpu',
      'WebGPU is missing: use a current browser over https, or pass the gpu of createGpu() of @glanz/renderer/node.',
    );
  }
  const adapter = await gpu.requestAdapter({ powerPreference: options.powerPreference ?? 'high-performance' });
  if (!adapter) {
    throw new DeviceError(
      'renderer/no-adapter',
      'WebGPU found no usable GPU: update its driver, or allow hardware acceleration.',
    );
  }
  const requiredLimits: Record<string, number> = {};
  if (!options.defaultLimits) for (const name of RAISED_LIMITS) requiredLimits[name] = adapter.limits[name];
  const requiredFeatures = WELCOME_FEATURES.filter((feature) => adapter.features.has(feature)) as GPUFeatureName[];
  try {
    const device = await adapter.requestDevice({ label: 'glanz', requiredFeatures, requiredLimits });
    const { onError } = options;
    if (onError) {
      device.addEventListener('uncapturederror', (event) => {
        event.preventDefault();
        onError(uncaptured((event as GPUUncapturedErrorEvent).error));
      });
    }
    return device;
  } catch (cause) {
    throw new DeviceError('renderer/no-device', `The GPU refused a device: ${(cause as Error).message}`, { cause });
  }
}

/** By name, since not every environment has WebGPU's error classes as globals. */
function uncaptured(error: GPUError): DeviceError {
  const memory = error.constructor.name === 'GPUOutOfMemoryError';
  return new DeviceError(
    memory ? 'renderer/out-of-memory' : 'renderer/gpu-error',
    `The GPU reported an error: ${error.message}`,
  );
}
