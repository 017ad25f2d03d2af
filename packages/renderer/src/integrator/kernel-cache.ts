import { kernelSource, KERNELS, type Kernel, type KernelFeatures, type KernelName } from './pipelines';

/** The kernels that a scene's main loop needs, compiled for its features. */
export interface KernelSet {
  readonly features: KernelFeatures;
  readonly kernels: Readonly<Partial<Record<KernelName, Kernel>>>;
}

/** Compiled when they are first asked for. */
const ON_DEMAND: ReadonlySet<KernelName> = new Set(['relight', 'noise', 'first']);

/** Told how far kernels are, 0..1, and which of them has come last. */
type Hear = (done: number, name?: KernelName, kernel?: Kernel) => void;

/** Kernels that are there or under way, with those who want to hear how far they are. */
interface Compilation {
  readonly set: Promise<KernelSet>;
  readonly count: number;
  readonly ready: Map<KernelName, Kernel>;
  readonly heard: Set<Hear>;
}

const cachesOf = new WeakMap<
  GPUDevice,
  { readonly sets: Map<string, Compilation>; readonly kernels: Map<string, Promise<Kernel>> }
>();

/**
 * Compiled kernels, shared by all tracers on one device and keyed by their text: what differs elsewhere costs nothing.
 */
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
   * @param hear Told how far they are, 1 at the end, and each one as it comes, also where another caller asked for them first.
   */
  async get(features: KernelFeatures, hear?: Hear): Promise<KernelSet> {
    const key = JSON.stringify(features);
    let compilation = this.#sets.get(key);
    if (!compilation) {
      this.#sets.set(key, (compilation = this.#compile(features)));
      compilation.set.catch(() => this.#sets.delete(key));
    }
    if (!hear) return compilation.set;
    const { ready, count, heard, set } = compilation;
    if (ready.size === 0) hear(0);
    let done = 0;
    for (const [name, kernel] of ready) hear(++done / count, name, kernel);
    heard.add(hear);
    try {
      return await set;
    } finally {
      heard.delete(hear);
    }
  }

  #compile(features: KernelFeatures): Compilation {
    const names = KERNELS.filter(
      (name) =>
        !ON_DEMAND.has(name) &&
        (name !== 'connect' || features.flags.NEXT_EVENT === true) &&
        (name !== 'aov' || features.flags.AOVS === true) &&
        (name !== 'aov_ids' || features.flags.AOV_IDS === true),
    );
    const heard = new Set<Hear>();
    const ready = new Map<KernelName, Kernel>();
    const compile = async (name: KernelName) => {
      const kernel = await this.kernel(name, features);
      ready.set(name, kernel);
      for (const hear of heard) hear(ready.size / names.length, name, kernel);
    };
    const set = Promise.all(names.map(compile)).then(() => ({
      features,
      kernels: Object.fromEntries(ready) as KernelSet['kernels'],
    }));
    return { set, count: names.length, ready, heard };
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
