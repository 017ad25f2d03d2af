import { aovBuffers } from '../film/aovs';
import type { EditEffect, Move } from '../film/edit-effect';
import { Film } from '../film/film';
import type { FilmSession } from './film-session';
import type { GpuMemory } from '../storage/buffers';
import { inErrorScopes } from '../device/error-scopes';
import type { GpuScene } from '../scene/gpu-scene';
import type { KernelCache, KernelSet } from '../integrator/kernel-cache';
import type { Integrator } from '../integrator/integrator';
import { serves, type KernelFeatures } from '../integrator/pipelines';
import type { SceneChange } from '../scene/scene-change';

/** What an {@link EditSession} works on. */
export interface EditHost {
  readonly device: GPUDevice;
  readonly memory: GpuMemory;
  readonly gpuScene: GpuScene;
  readonly cache: KernelCache;
  readonly integrator: Integrator;
  readonly film: FilmSession;
  /** What the scene, the camera and the options ask of the kernels. */
  readonly features: () => KernelFeatures;
  /** An edit has been made: starts the film again, unless it accumulates. */
  readonly edited: (effect: EditEffect, moves?: readonly Move[]) => void;
  /** Starts the film again, without history. */
  readonly restart: () => void;
}

/** An edit that has been made, and can be taken back until it is settled. */
interface Made {
  readonly effect: EditEffect;
  readonly settle: () => void;
  readonly takeBack: () => void;
}

/**
 * Makes edits so that each holds as a whole or not at all. An edit goes through two stages:
 *
 * 1. It is applied to the scene and the GPU's copy. If that took memory, batches and further edits wait until the GPU
 * has
 *    granted it (some milliseconds); else the edit is taken back, and the film goes on as if nothing had happened.
 * 2. If it needs other kernels, they compile while the old ones go on rendering, but where they could not bind the
 *    scene any more. Should they fail, this edit and all that were made since are taken back.
 */
export class EditSession {
  readonly #host: EditHost;
  /** Settles, and never rejects, when the GPU has looked at what is being changed. */
  #verifying: Promise<void> | undefined;
  /** Settles when an edit is made whose bindings the kernels before cannot take. */
  #switching: Promise<void> | undefined;
  /** Edits that wait for kernels, oldest first. */
  #made: Made[] = [];
  /** The kernels that the newest of them need. */
  #bringing: Promise<void> | undefined;
  #requests = 0;
  #edits = 0;
  #resizes = 0;

  constructor(host: EditHost) {
    this.#host = host;
  }

  /** Settles when batches may be submitted again; `undefined`: now. */
  get verifying(): Promise<void> | undefined {
    return this.#switching ?? this.#verifying;
  }

  /**
   * Makes an edit: at once, if it is prepared at once and no other is being verified.
   *
   * @param prepare Called again if another edit was made meanwhile which the change does not take into account.
   * @returns When the film shows the edit.
   */
  async run(prepare: () => SceneChange | Promise<SceneChange>): Promise<void> {
    for (;;) {
      const prepared = prepare();
      const change = prepared instanceof Promise ? await prepared : prepared;
      while (this.verifying) await this.verifying;
      if (this.#host.memory.destroyed) return;
      if (change.isStale()) continue;
      const { gpuScene } = this.#host;
      const { pages } = gpuScene;
      const made = this.#make(change);
      // Arrays lie in textures from now on: no batch until there are kernels that read them.
      const end = () => (this.#switching = undefined);
      if (gpuScene.pages !== pages) this.#switching = made.then(end, end);
      return made;
    }
  }

  async #make(change: SceneChange): Promise<void> {
    const { device, edited, gpuScene, integrator, memory, restart } = this.#host;
    const { result: edit, verified } = inErrorScopes(device, 'this edit', () =>
      gpuScene.record(change.apply, change.undo),
    );
    const number = ++this.#edits;
    const takeBack = () => {
      edit.undo();
      change.rewrite?.();
      if (edit.result) integrator.rebind('scene');
    };
    if (edit.allocated) {
      await this.#hold(verified, takeBack);
      if (memory.destroyed) return;
    }
    if (edit.result) integrator.rebind('scene');
    const { effect = 'invalidates' } = change;
    if (effect !== 'keeps') edited(effect, change.moves);
    const made: Made = { effect, settle: edit.settle, takeBack };
    this.#made.push(made);
    const kernels = this.#bringKernels();
    kernels.catch(() => {});
    await verified.catch((error: unknown) => {
      // Nothing was allocated, so it can be taken back at any time: unless other edits have built on it.
      if (memory.destroyed) throw error;
      if (number === this.#edits) {
        this.#made = this.#made.filter((other) => other !== made);
        takeBack();
        this.#bringKernels().catch(() => {});
      } else gpuScene.rewrite();
      if (effect !== 'keeps') restart();
      throw error;
    });
    await kernels;
  }

  /** See `PathTracer.resize`. The last of several that overlap counts. */
  async resize(width: number, height: number): Promise<void> {
    const { device, film, integrator, memory, restart } = this.#host;
    const number = ++this.#resizes;
    while (film.film.fullWidth !== width || film.film.fullHeight !== height) {
      const { lightPasses, flags } = integrator.kernels.features;
      const aovs = aovBuffers(flags);
      const { result: next, verified } = inErrorScopes(
        device,
        `an image of ${width} × ${height} pixels`,
        () => new Film(memory, width, height, lightPasses, aovs),
      );
      await verified.catch((error: unknown) => {
        next.destroy();
        throw error;
      });
      if (memory.destroyed) return;
      // Kernels that keep another number of sums apart have come meanwhile.
      const now = integrator.kernels.features;
      if (number !== this.#resizes || lightPasses !== now.lightPasses || aovs.join() !== aovBuffers(now.flags).join()) {
        next.destroy();
        if (number !== this.#resizes) return;
        continue;
      }
      film.replace(next);
      restart();
    }
  }

  /** Brings the kernels for the scene, the camera and the options as they are now, if those there will not do. */
  async #bringKernels(): Promise<void> {
    const { features, integrator } = this.#host;
    const requested = features();
    const request = ++this.#requests;
    if (serves(integrator.kernels.features, requested)) {
      this.#bringing = undefined;
      return this.#settle();
    }
    this.#bringing = this.#compile(requested, request);
    await this.#bringing;
  }

  async #compile(requested: KernelFeatures, request: number): Promise<void> {
    const { cache, memory, restart } = this.#host;
    try {
      const kernels = await cache.get(requested);
      while (this.#verifying) await this.#verifying;
      if (memory.destroyed) return;
      if (request === this.#requests && (await this.#use(kernels, () => request === this.#requests))) {
        const keeps = this.#keepsFilm;
        this.#settle();
        if (keeps) this.#host.film.restartAovs();
        else restart();
        return;
      }
    } catch (error) {
      if (memory.destroyed) throw error;
      if (request === this.#requests) {
        const keeps = this.#keepsFilm;
        for (const { takeBack } of this.#made.splice(0).reverse()) takeBack();
        if (!keeps) restart();
        throw error;
      }
    }
    // A later edit has asked for other kernels: whether those come decides about this edit too.
    await this.#bringing;
  }

  /** Puts kernels in place, with the buffers that they need. @returns Whether they are still wanted. */
  async #use(kernels: KernelSet, requested: () => boolean): Promise<boolean> {
    const { device, film, integrator, memory } = this.#host;
    const before = film.film;
    const { fullWidth: width, fullHeight: height, lightPasses } = before;
    const aovs = aovBuffers(kernels.features.flags);
    const made: (() => void)[] = [];
    const discard = () => made.forEach((free) => free());
    const { result, verified } = inErrorScopes(device, 'the paths and the film of this edit', () => {
      try {
        const paths = integrator.prepare(kernels);
        made.push(paths.discard);
        const next =
          kernels.features.lightPasses === lightPasses
            ? undefined
            : new Film(memory, width, height, kernels.features.lightPasses, aovs);
        if (next) made.push(() => next.destroy());
        else {
          const added = aovs.filter((name) => !before.aovs.includes(name));
          made.push(() => before.release(...added));
          before.keepAovs([...before.aovs, ...added]);
        }
        return { paths, next };
      } catch (error) {
        discard();
        throw error;
      }
    });
    await this.#hold(verified, discard);
    const resized = film.film !== before;
    if (memory.destroyed || !requested() || resized) {
      discard();
      return !memory.destroyed && requested() ? this.#use(kernels, requested) : false;
    }
    result.paths.use();
    if (result.next) {
      const { scale } = film.film;
      film.replace(result.next);
      if (scale !== 1) film.renderScale = scale;
    } else {
      before.keepAovs(aovs);
      integrator.rebind('film');
    }
    return true;
  }

  /**
   * Lets batches and further edits wait until the GPU has looked at what was allocated. Takes it back if the GPU
   * refuses it.
   */
  async #hold(verified: Promise<void>, takeBack: () => void): Promise<void> {
    const outcome = verified.catch((error: unknown) => {
      if (!this.#host.memory.destroyed) takeBack();
      throw error;
    });
    const settled = outcome.catch(() => {});
    this.#verifying = settled;
    try {
      await outcome;
    } finally {
      if (this.#verifying === settled) this.#verifying = undefined;
    }
  }

  /** Whether all edits that wait for kernels leave the film as it is. */
  get #keepsFilm(): boolean {
    return this.#made.length > 0 && this.#made.every(({ effect }) => effect === 'keeps');
  }

  #settle(): void {
    for (const { settle } of this.#made.splice(0)) settle();
  }
}
