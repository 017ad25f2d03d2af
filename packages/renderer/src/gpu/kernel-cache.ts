import { kernelSource, KERNELS, type Kernel, type KernelFeatures, type KernelName } from '../kernels/pipelines';

/** The kernels that a scene's main loop needs, compiled for its features. */
export interface KernelSet {
  readonly features: KernelFeatures;
  readonly kernels: Readonly<Partial<Record<KernelName, Kernel>>>;
}

/** Compiled when they are first asked for. */
const ON_DEMAND: ReadonlySet<KernelName> = new Set(['features', 'position', 'relight', 'noise', 'first']);

/** Kernels that are there or under way, with those who want to hear how far they are. */
interface Compilation {
  readonly set: Promise<KernelSet>;
  /** 0..1. */
  done: number;
  readonly heard: Set<(done: number) => void>;
}

const cachesOf = new WeakMap<GPUDevice, { readonly sets: Map<string, Compilation>; readonly kernels: Map<string, Promise<Kernel>> }>();

/** Compiled kernels, shared by all tracers on one device and keyed by their text: what differs elsewhere costs nothing. */
export class KernelCache {
  readonly #device: GPUDevice;
  readonly #sets: Map<string, Compilation>;
  readonly #kernels: Map<string, Promise<Kernel>>;

  constructor(device: GPUDevice) {
    this.#device = device;
    let caches = cachesOf.get(device);
    if (!caches) cachesOf.set(device, (caches = { sets: new Map(), kernels: new Map() }));
    this.#sets = caches.sets;
    this.#kernels = caches.kernels;
  }

  /**
   * All kernels of the main loop, compiled side by side.
   * @param onProgress Told how far they are, 1 at the end, whoever has asked for them first.
   */
  async get(features: KernelFeatures, onProgress?: (done: number) => void): Promise<KernelSet> {
    const key = JSON.stringify(features);
    let compilation = this.#sets.get(key);
    if (!compilation) {
      this.#sets.set(key, (compilation = this.#compile(features)));
      compilation.set.catch(() => this.#sets.delete(key));
    }
    if (!onProgress) return compilation.set;
    onProgress(compilation.done);
    compilation.heard.add(onProgress);
    try {
      return await compilation.set;
    } finally {
      compilation.heard.delete(onProgress);
    }
  }

  #compile(features: KernelFeatures): Compilation {
    const names = KERNELS.filter((name) => !ON_DEMAND.has(name) && (name !== 'connect' || features.flags.NEXT_EVENT === true));
    const heard = new Set<(done: number) => void>();
    let ready = 0;
    const compile = async (name: KernelName) => {
      const kernel = await this.kernel(name, features);
      compilation.done = ++ready / names.length;
      for (const hear of heard) hear(compilation.done);
      return [name, kernel] as const;
    };
    // Each waits for its driver before it says how far it is, and so for this to be there.
    const compilation: Compilation = { set: Promise.all(names.map(compile)).then((compiled) => ({ features, kernels: Object.fromEntries(compiled) as KernelSet['kernels'] })), done: 0, heard };
    return compilation;
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
