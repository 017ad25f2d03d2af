import { LATE_MS, type FaultRecorder, type LiveObject } from './recorder';

type Method = (...args: never[]) => unknown;
type Loose = Record<string, (...args: unknown[]) => unknown>;

/** Bytes of a texel, or of a block of 4 × 4, by the beginning of the format's name. */
const TEXEL_BYTES: readonly (readonly [RegExp, number])[] = [
  [/^rgba32/, 16],
  [/^(rgba16|rg32)/, 8],
  [/^(r8|stencil8)/, 1],
  [/^(rg8|r16|depth16)/, 2],
  [/^(bc1|bc4|etc2-rgb8|eac-r11)/, 0.5],
  [/^(bc|astc|etc2|eac)/, 1],
];

function textureBytes({ size, format, mipLevelCount = 1 }: GPUTextureDescriptor): number {
  const [width, height = 1, layers = 1] =
    'width' in size ? [size.width, size.height, size.depthOrArrayLayers] : ([...size] as [number, number?, number?]);
  const texel = TEXEL_BYTES.find(([pattern]) => pattern.test(format))?.[1] ?? 4;
  return Math.round(width * height * layers * texel * (mipLevelCount > 1 ? 4 / 3 : 1));
}

/**
 * Descriptors that no device accepts, so that what it makes of them is an invalid object, as after a failed allocation.
 */
const INVALID: Readonly<Record<string, (descriptor: never) => object>> = {
  createBuffer: () => ({ size: 4, usage: 0 }),
  createTexture: ({ format }: GPUTextureDescriptor) => ({ size: [1, 1], format, usage: 0 }),
  createQuerySet: () => ({ type: 'occlusion', count: 2 ** 20 }),
  createSampler: () => ({ lodMinClamp: -1 }),
  createBindGroupLayout: () => ({
    entries: [0, 0].map((binding) => ({ binding, visibility: 4, buffer: { type: 'uniform' } })),
  }),
  createPipelineLayout: ({ bindGroupLayouts }: GPUPipelineLayoutDescriptor) => ({
    bindGroupLayouts: Array.from({ length: 64 }, () => [...bindGroupLayouts][0]),
  }),
  createBindGroup: ({ layout }: GPUBindGroupDescriptor) => ({ layout, entries: [] }),
  createShaderModule: () => ({ code: 'injected compile failure' }),
  createComputePipeline: (descriptor: GPUComputePipelineDescriptor) => ({
    ...descriptor,
    compute: { ...descriptor.compute, entryPoint: 'injected_compile_failure' },
  }),
  createRenderPipeline: (descriptor: GPURenderPipelineDescriptor) => ({
    ...descriptor,
    vertex: { ...descriptor.vertex, entryPoint: 'injected_compile_failure' },
  }),
};

const later = () => new Promise<void>((resolve) => setTimeout(resolve, LATE_MS));

function gpuError(filter: GPUErrorFilter, message: string): GPUError {
  const classes = globalThis as unknown as Record<string, new (text: string) => GPUError>;
  const Class = classes[filter === 'out-of-memory' ? 'GPUOutOfMemoryError' : 'GPUValidationError'];
  try {
    if (Class) return new Class(message);
  } catch {
    // Some implementations let nobody else make one.
  }
  return { message } as GPUError;
}

/** Dawn for Node never releases listeners, nor what they capture: here that is not the device. */
function collectUncaptured(device: GPUDevice, recorder: FaultRecorder, listeners: ReadonlySet<unknown>): void {
  const reference = new WeakRef(device);
  device.addEventListener('uncapturederror', (event) => {
    if (listeners.size > 0 || reference.deref()?.onuncapturederror) return;
    event.preventDefault();
    recorder.uncaptured.push((event as GPUUncapturedErrorEvent).error.message);
  });
}

/** What is known of an instrumented device. */
interface Instrumented {
  /** Loses it now, for the reason that drivers give (`unknown`), or by `destroy()`. */
  lose(reason: 'unknown' | 'destroyed'): void;
}

const instrumented = new WeakMap<GPUDevice, Instrumented>();

/**
 * Makes a device count its calls in a recorder and fail where that says so. Works on the object itself, in Node and in
 * browsers; other devices are not touched. Errors are reported as WebGPU does: to the innermost error scope of their
 * kind, or as `uncapturederror`; what a failed call makes is an invalid object.
 */
export function instrumentDevice(device: GPUDevice, recorder: FaultRecorder): GPUDevice {
  const own = device as unknown as Loose & GPUDevice;
  const replace = (target: object, name: string, make: (original: (...args: unknown[]) => unknown) => Method) => {
    const original = (target as Loose)[name];
    if (typeof original === 'function')
      Object.defineProperty(target, name, { configurable: true, writable: true, value: make(original.bind(target)) });
  };

  // Error scopes: an injected error belongs to the innermost scope of its kind, like a real one.
  const scopes: { readonly filter: GPUErrorFilter; error: GPUError | undefined }[] = [];
  const listeners = new Set<(event: GPUUncapturedErrorEvent) => void>();
  const uncaptured = (error: GPUError) => {
    let handled = false;
    const event = {
      type: 'uncapturederror',
      error,
      preventDefault: () => (handled = true),
    } as unknown as GPUUncapturedErrorEvent;
    for (const listener of listeners) listener(event);
    device.onuncapturederror?.(event);
    if (listeners.size === 0 && !device.onuncapturederror) handled = false;
    else handled = true;
    if (!handled) recorder.uncaptured.push(error.message);
  };
  const report = (filter: GPUErrorFilter, message: string) => {
    const error = gpuError(filter, message);
    const scope = scopes.findLast((one) => one.filter === filter);
    if (scope) scope.error ??= error;
    else queueMicrotask(() => uncaptured(error));
  };
  const pushErrorScope = device.pushErrorScope.bind(device);
  const popErrorScope = device.popErrorScope.bind(device);
  collectUncaptured(device, recorder, listeners);
  replace(device, 'addEventListener', (original) => (...args: unknown[]) => {
    if (args[0] === 'uncapturederror') listeners.add(args[1] as (event: GPUUncapturedErrorEvent) => void);
    return original(...args);
  });
  replace(device, 'removeEventListener', (original) => (...args: unknown[]) => {
    listeners.delete(args[1] as (event: GPUUncapturedErrorEvent) => void);
    return original(...args);
  });

  // Loss: the reason must be what drivers give, while the device really is gone.
  // Once: the specification says that a second call does nothing, but Dawn 0.6.2 for Node has crashed in it.
  const destroyNative = device.destroy.bind(device);
  let isDestroyed = false;
  const destroy = () => {
    if (isDestroyed) return;
    isDestroyed = true;
    destroyNative();
  };
  let announce: (info: GPUDeviceLostInfo) => void = () => {};
  const injected = new Promise<GPUDeviceLostInfo>((resolve) => (announce = resolve));
  Object.defineProperty(device, 'lost', { configurable: true, value: Promise.race([injected, device.lost]) });
  const lose = (reason: 'unknown' | 'destroyed') => {
    if (reason === 'unknown') announce({ reason, message: 'injected loss' } as GPUDeviceLostInfo);
    destroy();
  };
  instrumented.set(device, { lose });
  replace(device, 'destroy', () => () => {
    for (const [object, { device: of }] of held) if (of === device) recorder.live.delete(object);
    destroy();
  });
  const held = new Map<object, { readonly device: GPUDevice }>();

  const track = (object: GPUBuffer | GPUTexture | GPUQuerySet, entry: LiveObject) => {
    recorder.live.set(object, entry);
    held.set(object, { device });
    replace(object, 'destroy', (original) => () => {
      recorder.live.delete(object);
      held.delete(object);
      original();
    });
  };

  /** An invalid object, and no error: the injected one is reported instead. */
  const invalid = (name: string, descriptor: unknown, original: (...args: unknown[]) => unknown) => {
    pushErrorScope('validation');
    try {
      return original((INVALID[name] as (given: unknown) => object)(descriptor));
    } finally {
      popErrorScope().catch(() => {});
    }
  };

  const LABELLED = [
    'createBuffer',
    'createTexture',
    'createQuerySet',
    'createSampler',
    'createBindGroup',
    'createBindGroupLayout',
    'createPipelineLayout',
    'createShaderModule',
    'createCommandEncoder',
    'createComputePipeline',
    'createRenderPipeline',
  ];
  for (const name of LABELLED) {
    replace(device, name, (original) => (...args: unknown[]) => {
      const descriptor = (args[0] ?? {}) as { readonly label?: string };
      const fault = recorder.count(name, descriptor.label ?? '');
      if (fault === 'lost-unknown' || fault === 'lost-destroyed')
        lose(fault === 'lost-unknown' ? 'unknown' : 'destroyed');
      else if (fault === 'out-of-memory' || fault === 'validation' || fault === 'compile') {
        report(fault === 'out-of-memory' ? fault : 'validation', `injected: ${name} failed (${fault})`);
        return invalid(name, descriptor, original);
      }
      const made = original(...args);
      if (name === 'createBuffer') {
        const { size, label = '' } = descriptor as GPUBufferDescriptor;
        track(made as GPUBuffer, { kind: 'buffer', label, bytes: size });
        instrumentBuffer(made as GPUBuffer, label);
      } else if (name === 'createTexture') {
        track(made as GPUTexture, {
          kind: 'texture',
          label: descriptor.label ?? '',
          bytes: textureBytes(descriptor as GPUTextureDescriptor),
        });
      } else if (name === 'createQuerySet') {
        track(made as GPUQuerySet, {
          kind: 'querySet',
          label: descriptor.label ?? '',
          bytes: 8 * (descriptor as GPUQuerySetDescriptor).count,
        });
      }
      return made;
    });
  }
  const answer = (
    target: object,
    name: string,
    labelOf: (args: readonly unknown[]) => string,
    refuse: (message: string) => unknown,
  ) =>
    replace(target, name, (original) => (...args: unknown[]) => {
      const fault = recorder.count(name, labelOf(args));
      if (fault === 'lost-unknown' || fault === 'lost-destroyed')
        lose(fault === 'lost-unknown' ? 'unknown' : 'destroyed');
      else if (fault === 'late') return later().then(() => original(...args));
      else if (fault !== undefined) return Promise.reject(refuse(`injected: ${name} failed (${fault})`));
      return original(...args);
    });
  const pipelineError = (message: string) => {
    const Class = (globalThis as unknown as { GPUPipelineError?: new (text: string, init: object) => Error })
      .GPUPipelineError;
    try {
      if (Class) return new Class(message, { reason: 'internal' });
    } catch {
      // As above.
    }
    return new Error(message);
  };
  const labelOf = (args: readonly unknown[]) => (args[0] as { readonly label?: string }).label ?? '';
  answer(device, 'createComputePipelineAsync', labelOf, pipelineError);
  answer(device, 'createRenderPipelineAsync', labelOf, pipelineError);
  const instrumentBuffer = (buffer: GPUBuffer, label: string) =>
    answer(
      buffer,
      'mapAsync',
      () => label,
      (message) => new DOMException(message, 'OperationError'),
    );
  replace(device, 'pushErrorScope', () => (filter: GPUErrorFilter) => {
    scopes.push({ filter, error: undefined });
    pushErrorScope(filter);
  });
  replace(device, 'popErrorScope', () => () => {
    const scope = scopes.pop();
    const fault = recorder.count('popErrorScope', scope?.filter ?? '');
    const real = popErrorScope();
    if (fault === 'late')
      return later()
        .then(() => real)
        .then((error) => error ?? scope?.error ?? null);
    if (fault !== undefined) lose(fault === 'lost-unknown' ? 'unknown' : 'destroyed');
    return real.then((error) => error ?? scope?.error ?? null);
  });

  const { queue } = own;
  answer(
    queue,
    'onSubmittedWorkDone',
    () => '',
    (message) => new DOMException(message, 'OperationError'),
  );
  const work = (name: string, label: (args: readonly unknown[]) => string) =>
    replace(queue, name, (original) => (...args: unknown[]) => {
      const fault = recorder.count(name, label(args));
      if (fault === 'lost-unknown' || fault === 'lost-destroyed')
        lose(fault === 'lost-unknown' ? 'unknown' : 'destroyed');
      else if (fault !== undefined) return report('validation', `injected: ${name} failed (${fault})`);
      return original(...args);
    });
  work('submit', ([list]) => [...(list as Iterable<GPUCommandBuffer>)].map(({ label }) => label).join());
  work('writeBuffer', ([buffer]) => (buffer as GPUBuffer).label);
  work('writeTexture', ([target]) => (target as GPUTexelCopyTextureInfo).texture.label);
  work('copyExternalImageToTexture', ([, target]) => (target as GPUTexelCopyTextureInfo).texture.label);
  return device;
}

/**
 * Loses an instrumented device.
 * @param reason `unknown`, as a driver does, or `destroyed`.
 */
export function loseDevice(device: GPUDevice, reason: 'unknown' | 'destroyed'): void {
  const found = instrumented.get(device);
  if (!found) throw new Error('loseDevice: this device is not instrumented');
  found.lose(reason);
}
