import type { Page } from '@playwright/test';

/** What a test can do to the GPU of a page, by `window.gpuFaults`, after {@link injectFaults}. */
export interface GpuFaults {
  /** Calls so far, by the name of the WebGPU function. */
  readonly count: Readonly<Record<string, number>>;
  /** Devices that were requested successfully. */
  readonly devices: number;
  /** Errors that reached `uncapturederror`. */
  readonly errors: readonly string[];
  /** Faults that were injected. */
  readonly injected: readonly string[];
  /** Loses the device just before the nth call of these functions: counted from 1, over all devices. */
  loseAt: Readonly<Record<string, number>>;
  /** The reason of those losses; default `unknown`. */
  lossReason: 'unknown' | 'destroyed';
  /** Called before each call that is counted, with its number among all of them. */
  onCall: ((n: number, name: string) => void) | undefined;
  /** Makes the nth `createBuffer` or `createTexture` fail for lack of memory; both count as `allocations`. */
  outOfMemoryAt: number | undefined;
  /** Bytes that all buffers and textures may have together; a larger total is out of memory. */
  memory: number | undefined;
  /** Pipelines whose label contains this text fail to compile. */
  failPipelines: string | undefined;
  /** Pipelines whose label contains this text do not finish to compile until this is `undefined` again. */
  holdPipelines: string | undefined;
  /** How many calls of `requestAdapter` still answer `null`. */
  refuseAdapters: number;
  /** How many calls of `mapAsync` still reject. */
  refuseMaps: number;
  /** Milliseconds that each `mapAsync` takes longer. */
  delayMaps: number;
  /** Loses the newest device. `unknown` (default) is what drivers cause; `destroyed` is what `destroy()` causes. */
  lose(reason?: 'unknown' | 'destroyed'): void;
  /** Reports a validation error on the newest device that no error scope captures. */
  complain(message: string): void;
  /** Makes the page believe that its tab is hidden, or visible again. */
  hide(hidden: boolean): void;
  /** Bytes of the buffers and textures that are alive. */
  bytes(): number;
  /**
   * GPU objects that were made and not destroyed on devices that are alive, by their kind; empty where nothing leaks.
   */
  live(): Record<string, number>;
}

declare global {
  interface Window {
    gpuFaults: GpuFaults;
    /** Short for `gpuFaults.lose()`. */
    loseGpu: () => void;
  }
}

/**
 * Wraps WebGPU in a page, so that a test can inject faults through `window.gpuFaults` and count what stays alive. A
 * device that is lost by `destroy()` alone has the reason `destroyed`; drivers give `unknown`, which only a wrapper can
 * simulate. Call it before the page is opened.
 *
 * @param first What to set before the page's own scripts run.
 */
export async function injectFaults(page: Page, first: Partial<Omit<GpuFaults, 'count' | 'live'>> = {}): Promise<void> {
  await page.addInitScript(wrapWebGpu, first);
}

/** Runs in the page: it may use nothing from outside. */
function wrapWebGpu(first: object): void {
  type Any = (...given: never[]) => unknown;
  interface Device {
    readonly lose: (reason: 'unknown' | 'destroyed') => void;
    readonly scopes: { readonly filter: string; error: GPUError | null }[];
    readonly objects: Map<object, { readonly kind: string; readonly bytes: number }>;
    alive: boolean;
  }
  const count: Record<string, number> = {};
  const state = new Map<GPUDevice, Device>();
  const ownerOf = new WeakMap<object, GPUDevice>();
  const held: { readonly label: string; readonly go: () => void }[] = [];
  let hold: string | undefined;
  const faults = {
    count,
    devices: 0,
    errors: [] as string[],
    injected: [] as string[],
    loseAt: {} as Record<string, number>,
    lossReason: 'unknown' as 'unknown' | 'destroyed',
    onCall: undefined as ((n: number, name: string) => void) | undefined,
    outOfMemoryAt: undefined as number | undefined,
    memory: undefined as number | undefined,
    failPipelines: undefined as string | undefined,
    refuseAdapters: 0,
    refuseMaps: 0,
    delayMaps: 0,
    get holdPipelines() {
      return hold;
    },
    set holdPipelines(label: string | undefined) {
      hold = label;
      if (label === undefined) for (const { go } of held.splice(0)) go();
    },
    lose: (reason: 'unknown' | 'destroyed' = 'unknown') => [...state.values()].at(-1)?.lose(reason),
    complain: (message: string) => {
      const device = [...state.keys()].at(-1);
      device?.dispatchEvent(
        new GPUUncapturedErrorEvent('uncapturederror', { cancelable: true, error: new GPUValidationError(message) }),
      );
    },
    hide: (hidden: boolean) => {
      Object.defineProperty(document, 'hidden', { configurable: true, value: hidden });
      Object.defineProperty(document, 'visibilityState', { configurable: true, value: hidden ? 'hidden' : 'visible' });
      document.dispatchEvent(new Event('visibilitychange'));
    },
    bytes: () =>
      [...state.values()]
        .flatMap(({ alive, objects }) => (alive ? [...objects.values()] : []))
        .reduce((sum, { bytes }) => sum + bytes, 0),
    live: () => {
      const live: Record<string, number> = {};
      for (const { alive, objects } of state.values()) {
        if (!alive) continue;
        live['device'] = (live['device'] ?? 0) + 1;
        for (const { kind } of objects.values()) live[kind] = (live[kind] ?? 0) + 1;
      }
      return live;
    },
  };
  Object.assign(window, { gpuFaults: faults, loseGpu: () => faults.lose(), ownDevices: true });
  Object.assign(faults, first);
  if (!('GPU' in window)) return;

  const wrap = (
    prototype: object,
    name: string,
    around: (self: never, call: Any, given: readonly unknown[]) => unknown,
  ) => {
    const original = (prototype as Record<string, Any>)[name];
    if (!original) return;
    Object.defineProperty(prototype, name, {
      configurable: true,
      value(this: object, ...given: never[]) {
        return around(
          this as never,
          (...changed) => original.apply(this, (changed.length > 0 ? changed : given) as never),
          given,
        );
      },
    });
  };
  let calls = 0;
  const visit = (device: GPUDevice | undefined, name: string) => {
    count[name] = (count[name] ?? 0) + 1;
    faults.onCall?.(++calls, name);
    if (device && faults.loseAt[name] === count[name]) {
      faults.injected.push(`lost before ${name} ${count[name]}`);
      state.get(device)?.lose(faults.lossReason);
    }
  };

  wrap(GPU.prototype, 'requestAdapter', async (_self, call) => {
    count['requestAdapter'] = (count['requestAdapter'] ?? 0) + 1;
    if (faults.refuseAdapters > 0) {
      faults.refuseAdapters--;
      return null;
    }
    return call();
  });
  wrap(GPUAdapter.prototype, 'requestDevice', async (_self, call) => {
    const device = (await call()) as GPUDevice;
    const real = device.lost;
    let resolveLost: (info: GPUDeviceLostInfo) => void = () => undefined;
    const injected = new Promise<GPUDeviceLostInfo>((resolve) => (resolveLost = resolve));
    const own: Device = {
      lose: (reason) => {
        if (reason === 'unknown') resolveLost({ reason, message: 'injected loss' } as GPUDeviceLostInfo);
        device.destroy();
      },
      scopes: [],
      objects: new Map(),
      alive: true,
    };
    state.set(device, own);
    ownerOf.set(device.queue, device);
    Object.defineProperty(device, 'lost', { value: Promise.race([injected, real]) });
    void real.then(() => (own.alive = false));
    device.addEventListener('uncapturederror', ({ error }) =>
      faults.errors.push(error.message.split('\n')[0] as string),
    );
    faults.devices++;
    return device;
  });
  wrap(GPUDevice.prototype, 'destroy', (self: GPUDevice, call) => {
    const own = state.get(self);
    if (own) own.alive = false;
    return call();
  });
  wrap(GPUDevice.prototype, 'pushErrorScope', (self: GPUDevice, call, [filter]) => {
    state.get(self)?.scopes.push({ filter: filter as string, error: null });
    return call();
  });
  wrap(GPUDevice.prototype, 'popErrorScope', (self: GPUDevice, call) => {
    const scope = state.get(self)?.scopes.pop();
    return (call() as Promise<GPUError | null>).then((error) => error ?? scope?.error ?? null);
  });

  const outOfMemory = (device: GPUDevice, what: string) => {
    faults.injected.push(`out of memory: ${what}`);
    const error = new GPUOutOfMemoryError(`injected: no memory for ${what}`);
    const scope = [...(state.get(device)?.scopes ?? [])].reverse().find(({ filter }) => filter === 'out-of-memory');
    if (scope) scope.error ??= error;
    else device.dispatchEvent(new GPUUncapturedErrorEvent('uncapturederror', { cancelable: true, error }));
  };
  const allocate = <T extends GPUBuffer | GPUTexture>(
    device: GPUDevice,
    kind: string,
    label: string,
    bytes: number,
    make: () => T,
    makeSmall: () => T,
  ): T => {
    const own = state.get(device);
    const n = (count['allocations'] = (count['allocations'] ?? 0) + 1);
    const used = [...(own?.objects.values() ?? [])].reduce((sum, object) => sum + object.bytes, 0);
    if (n === faults.outOfMemoryAt || (faults.memory !== undefined && used + bytes > faults.memory)) {
      // What cannot be used, as the specification wants it.
      const unusable = makeSmall();
      unusable.destroy();
      outOfMemory(device, `${kind} "${label}" of ${bytes} bytes`);
      return unusable;
    }
    const made = make();
    own?.objects.set(made, { kind, bytes });
    ownerOf.set(made, device);
    return made;
  };
  wrap(GPUDevice.prototype, 'createBuffer', (self: GPUDevice, call, [given]) => {
    visit(self, 'createBuffer');
    const descriptor = given as GPUBufferDescriptor;
    return allocate(
      self,
      'buffer',
      descriptor.label ?? '',
      descriptor.size,
      () => call() as GPUBuffer,
      () => call({ ...descriptor, size: 16, mappedAtCreation: false } as never) as GPUBuffer,
    );
  });
  wrap(GPUDevice.prototype, 'createTexture', (self: GPUDevice, call, [given]) => {
    visit(self, 'createTexture');
    const descriptor = given as GPUTextureDescriptor;
    const [width, height = 1, layers = 1] =
      Symbol.iterator in descriptor.size
        ? [...descriptor.size]
        : [descriptor.size.width, descriptor.size.height, descriptor.size.depthOrArrayLayers];
    return allocate(
      self,
      'texture',
      descriptor.label ?? '',
      (width as number) * height * layers * 4,
      () => call() as GPUTexture,
      () => call({ ...descriptor, size: [4, 4, layers], mipLevelCount: 1 } as never) as GPUTexture,
    );
  });
  for (const constructor of [GPUBuffer, GPUTexture]) {
    wrap(constructor.prototype, 'destroy', (self: object, call) => {
      const owner = ownerOf.get(self);
      if (owner) state.get(owner)?.objects.delete(self);
      return call();
    });
  }
  for (const name of ['createBindGroup', 'createShaderModule', 'createCommandEncoder', 'createQuerySet']) {
    wrap(GPUDevice.prototype, name, (self: GPUDevice, call) => {
      visit(self, name);
      return call();
    });
  }
  for (const name of ['createComputePipelineAsync', 'createRenderPipelineAsync']) {
    wrap(GPUDevice.prototype, name, async (self: GPUDevice, call, [given]) => {
      visit(self, name);
      const { label = '' } = given as GPUObjectDescriptorBase;
      if (faults.failPipelines !== undefined && label.includes(faults.failPipelines)) {
        faults.injected.push(`pipeline "${label}" fails`);
        throw new GPUPipelineError(`injected: "${label}" does not compile`, { reason: 'internal' });
      }
      const made = await call();
      if (hold !== undefined && label.includes(hold)) await new Promise<void>((go) => held.push({ label, go }));
      return made;
    });
  }
  wrap(GPUQueue.prototype, 'submit', (self: GPUQueue, call) => {
    visit(ownerOf.get(self), 'submit');
    return call();
  });
  wrap(GPUBuffer.prototype, 'mapAsync', async (self: GPUBuffer, call) => {
    visit(ownerOf.get(self), 'mapAsync');
    if (faults.refuseMaps > 0) {
      faults.refuseMaps--;
      faults.injected.push('mapAsync rejects');
      throw new DOMException('injected: the buffer cannot be mapped', 'OperationError');
    }
    await call();
    if (faults.delayMaps > 0) await new Promise((resolve) => setTimeout(resolve, faults.delayMaps));
  });
  wrap(GPUCanvasContext.prototype, 'getCurrentTexture', (_self, call) => {
    visit([...state.keys()].at(-1), 'getCurrentTexture');
    return call();
  });
}
