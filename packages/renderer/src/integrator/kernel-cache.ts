import { bvhClosestHit } from '@glanz/bvh/wgsl';
import { loadPart } from '@glanz/wgsl';
import camera from '../camera/camera.wesl';
import { usesIndirectDispatch } from '../device/software';
import traversal from '../geometry/traversal.wesl';
import {
  kernelSource,
  KERNELS,
  type Kernel,
  type KernelFeatures,
  type KernelName,
  type KernelParts,
} from './pipelines';
import intersect from './intersect.wesl';
import shade from './shade.wesl';

/** The kernels that a scene's main loop needs, compiled for its features. */
export interface KernelSet {
  readonly features: KernelFeatures;
  readonly kernels: Readonly<Partial<Record<KernelName, Kernel>>>;
}

/** Compiled when they are first asked for. */
const ON_DEMAND: ReadonlySet<KernelName> = new Set(['relight', 'noise', 'variance', 'first']);

/** Called with how far the kernels are, 0..1, and the one that was compiled last. */
type ProgressListener = (done: number, name?: KernelName, kernel?: Kernel) => void;

/** Kernels that are compiled or being compiled, and the listeners to their progress. */
interface Compilation {
  readonly set: Promise<KernelSet>;
  readonly count: number;
  readonly ready: Map<KernelName, Kernel>;
  readonly listeners: Set<ProgressListener>;
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
   * All kernels of the main loop, compiled in parallel.
   * @param onProgress Called for each kernel that is ready, also where another caller requested them first; ends at 1.
   */
  async get(features: KernelFeatures, onProgress?: ProgressListener): Promise<KernelSet> {
    const key = JSON.stringify(features);
    let compilation = this.#sets.get(key);
    if (!compilation) {
      this.#sets.set(key, (compilation = this.#compile(features)));
      compilation.set.catch(() => this.#sets.delete(key));
    }
    if (!onProgress) return compilation.set;
    const { ready, count, listeners, set } = compilation;
    if (ready.size === 0) onProgress(0);
    let done = 0;
    for (const [name, kernel] of ready) onProgress(++done / count, name, kernel);
    listeners.add(onProgress);
    try {
      return await set;
    } finally {
      listeners.delete(onProgress);
    }
  }

  #compile(features: KernelFeatures): Compilation {
    const names = KERNELS.filter(
      (name) =>
        !ON_DEMAND.has(name) &&
        (name !== 'connect' || features.flags.NEXT_EVENT === true) &&
        (name !== 'aov' || features.flags.AOVS === true) &&
        (name !== 'aov_ids' || features.flags.AOV_IDS === true) &&
        (!name.startsWith('light_') || features.flags.LIGHT_PATHS === true) &&
        (name !== 'reservoirs' || features.flags.LIGHT_REUSE === true),
    );
    const listeners = new Set<ProgressListener>();
    const ready = new Map<KernelName, Kernel>();
    const compile = async (name: KernelName) => {
      const kernel = await this.kernel(name, features);
      ready.set(name, kernel);
      for (const listener of listeners) listener(ready.size / names.length, name, kernel);
    };
    const set = Promise.all(names.map(compile)).then(() => ({
      features,
      kernels: Object.fromEntries(ready) as KernelSet['kernels'],
    }));
    return { set, count: names.length, ready, listeners };
  }

  /** One kernel. What is not needed for the first image is loaded first. @param parts See {@link kernelSource}. */
  async kernel(name: KernelName, features: KernelFeatures, parts?: KernelParts): Promise<Kernel> {
    if (name === 'noise' || name === 'relight' || name === 'variance' || name === 'aov' || name === 'aov_ids')
      parts = { root: (await loadPart('film-kernels', import('./film-kernels'))).FILM_KERNELS[name] };
    const { GUIDE, LIGHT_PATHS, LIGHT_REUSE, DISPERSION, LIGHT_PROFILES } = features.flags;
    const { OPENPBR_LOBES, OPENPBR_THIN_FILM, DELTA_TRANSMISSION, REFRACTED_LIGHT } = features.flags;
    const refracts = REFRACTED_LIGHT && name === 'intersect';
    const scatters = refracts || /shade|trace|reserv/.test(name);
    if (scatters && GUIDE) parts = (await loadPart('guide-kernels', import('./guide-kernels'))).GUIDED_SHADE;
    if (scatters && (DISPERSION || LIGHT_PROFILES))
      parts = (await loadPart('rare-kernels', import('./rare-kernels'))).rareKernel(name, features.flags, parts);
    if (name === 'shade' && features.flags.SHADOW_SOFTNESS)
      parts = (await loadPart('soft-shadows', import('./soft-shadows'))).softened(parts);
    // The kernels that compose the surface.
    if (
      (OPENPBR_LOBES || OPENPBR_THIN_FILM) &&
      (scatters || name === 'light_start' || (name === 'connect' && DELTA_TRANSMISSION))
    ) {
      const more = await Promise.all([
        OPENPBR_LOBES && loadPart('lobes', import('@glanz/openpbr/lobes')).then((part) => part.openpbrLobes),
        OPENPBR_THIN_FILM && loadPart('thin-film', import('@glanz/openpbr/film')).then((part) => part.openpbrFilm),
      ]);
      parts = { ...parts, host: [...(parts?.host ?? []), ...more] };
    }
    if (LIGHT_PATHS)
      [features, parts] = (await loadPart('light-kernels', import('./light-kernels'))).lightKernel(
        name,
        features,
        parts,
        [shade, camera, traversal, bvhClosestHit],
      );
    if (LIGHT_REUSE)
      [features, parts] = (await loadPart('reuse-kernels', import('./reuse-kernels'))).reuseKernel(
        name,
        features,
        parts,
        shade,
      );
    if (refracts)
      parts = (await loadPart('refracted-light', import('./refracted-light'))).refracted(parts, [shade, intersect]);
    const { compact, pages } = features;
    if (compact) parts = (await loadPart('compact-kernels', import('./compact-kernels'))).compactKernel(parts);
    if (pages)
      parts = (await loadPart('paged-kernels', import('./paged-kernels'))).pagedKernel(this.#device, pages, parts);
    const source = kernelSource(name, features, parts, !usesIndirectDispatch(this.#device));
    return remember(this.#kernels, source.key, () => source.compile(this.#device));
  }
}

/** Failures are not kept: the next call tries again. */
function remember<T>(map: Map<string, Promise<T>>, key: string, make: () => Promise<T>): Promise<T> {
  let found = map.get(key);
  if (!found) {
    found = make();
    map.set(key, found);
    found.catch(() => map.delete(key));
  }
  return found;
}
