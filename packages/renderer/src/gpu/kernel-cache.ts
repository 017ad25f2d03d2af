import { kernelSource, KERNELS, type Kernel, type KernelFeatures, type KernelName } from '../kernels/pipelines';

/** The kernels that a scene's main loop needs, compiled for its features. */
export interface KernelSet {
  readonly features: KernelFeatures;
  readonly kernels: Readonly<Partial<Record<KernelName, Kernel>>>;
}

/** Compiled when they are first asked for. */
const ON_DEMAND: ReadonlySet<KernelName> = new Set(['features', 'position', 'relight', 'noise', 'first']);

const cachesOf = new WeakMap<GPUDevice, { readonly sets: Map<string, Promise<KernelSet>>; readonly kernels: Map<string, Promise<Kernel>> }>();

/** Compiled kernels, shared by all tracers on one device and keyed by their text: what differs elsewhere costs nothing. */
export class KernelCache {
  readonly #device: GPUDevice;
  readonly #sets: Map<string, Promise<KernelSet>>;
  readonly #kernels: Map<string, Promise<Kernel>>;

  constructor(device: GPUDevice) {
    this.#device = device;
    let caches = cachesOf.get(device);
    if (!caches) cachesOf.set(device, (caches = { sets: new Map(), kernels: new Map() }));
    this.#sets = caches.sets;
    this.#kernels = caches.kernels;
  }

  /** All kernels of the main loop, compiled side by side. */
  get(features: KernelFeatures, onProgress?: (done: number) => void): Promise<KernelSet> {
    const key = JSON.stringify(features);
    return remember(this.#sets, key, async () => {
      const names = KERNELS.filter((name) => !ON_DEMAND.has(name) && (name !== 'connect' || features.flags.NEXT_EVENT === true));
      let done = 0;
      const compiled = await Promise.all(
        names.map(async (name) => {
          const kernel = await this.kernel(name, features);
          onProgress?.(++done / names.length);
          return [name, kernel] as const;
        }),
      );
      return { features, kernels: Object.fromEntries(compiled) as KernelSet['kernels'] };
    });
  }

  /** One kernel. */
  kernel(name: KernelName, features: KernelFeatures): Promise<Kernel> {
    const source = kernelSource(name, features);
    return remember(this.#kernels, source.key, () => source.compile(this.#device));
  }
}

/** A failed attempt is forgotten, so that it can be made again. */
function remember<T>(map: Map<string, Promise<T>>, key: string, make: () => Promise<T>): Promise<T> {
  let found = map.get(key);
  if (!found) {
    found = make();
    map.set(key, found);
    found.catch(() => map.delete(key));
  }
  return found;
}
