import {
  breathe,
  inSlices,
  SceneError,
  untilAborted,
  validationSteps,
  type Camera,
  type Instance,
  type Scene,
} from '@glanz/scene';
import { deviceLost, RenderError } from './errors';
import { Film } from './film/film';
import { showFirstLight } from './session/first-light';
import { GpuMemory } from './storage/buffers';
import { lossInfo } from './device/device-loss';
import { energyTextures } from './materials/energy-textures';
import { withErrorScopes } from './device/error-scopes';
import { GpuScene } from './scene/gpu-scene';
import { KernelCache } from './integrator/kernel-cache';
import { Integrator } from './integrator/integrator';
import type { Kernel, KernelFeatures, KernelName } from './integrator/pipelines';
import { biasedFlags } from './biased-options';
import { checkInteriors, checkSize, resolveOptions, type TracerSettings } from './option-checks';
import type { PathTracerOptions, RenderStatistics } from './options';
import { cameraUniforms } from './camera/camera';
import { cameraSteps } from './camera/choose-camera';
import { environmentSteps } from './environment/environment';
import { expectedFeatures, type SceneChoices } from './scene/features';
import { prepareGeometry } from './geometry/geometry';
import { lightGroupTable } from './lights/light-groups';
import { lightSteps } from './lights/lights';
import { isShown } from './geometry/placement';
import { ownScene, SceneEditor } from './scene/scene-editor';
import { viewFlags } from './camera/view';

/** What `PathTracer.create` has put together. */
export interface Prepared {
  readonly device: GPUDevice;
  readonly memory: GpuMemory;
  readonly editor: SceneEditor;
  readonly gpuScene: GpuScene;
  readonly cache: KernelCache;
  readonly integrator: Integrator;
  readonly film: Film;
  readonly camera: Camera;
  readonly options: TracerSettings;
  /** Times of the preparation. */
  readonly times: Pick<RenderStatistics, 'checkMs' | 'textMs' | 'bvhMs' | 'uploadMs' | 'lightMs' | 'compileMs'>;
}

/** Builds, uploads and compiles what a tracer needs, see `PathTracer.create`. */
export async function prepareTracer(device: GPUDevice, scene: Scene, given: PathTracerOptions): Promise<Prepared> {
  const begun = performance.now();
  // A device that is lost says yes to everything: whether it was is looked at in the end.
  lossInfo(device);
  checkSize(given.width, given.height);
  const options = resolveOptions(given);
  // Each of the next goes through all vertices or pixels: the thread is handed back in between.
  await breathe();
  const { hierarchies, signal, onProgress, onFirstLight } = options;
  await inSlices(validationSteps(scene), { signal });
  const own = ownScene(scene);
  checkInteriors(own);
  await breathe();
  signal?.throwIfAborted();
  // A quarter of what the renderer weighs, and nobody needs it before there is a scene: a chunk of its own, loaded
  // meanwhile.
  const loading = import('@glanz/openpbr/tables');
  loading.catch(() => {});
  const choices: SceneChoices = options;
  const camera = await inSlices(cameraSteps(own, options.camera, options.width / options.height), { signal }).catch(
    (cause: unknown) => {
      // What cannot be framed cannot be rendered, and that is what was asked for.
      throw cause instanceof SceneError && cause.code === 'scene/empty'
        ? new RenderError('renderer/no-triangles', 'The scene has no visible triangles: nothing to render.', { cause })
        : cause;
    },
  );
  cameraUniforms(camera, options.width, options.height);
  const expected = kernelFeatures(expectedFeatures(device, own, choices), camera, options);
  const checked = performance.now();
  let asked = checked;
  const build = () => {
    asked = performance.now();
    onProgress?.({ stage: 'bvh', done: 0 });
    return prepareGeometry(own, { hierarchies, signal, onProgress: (done) => onProgress?.({ stage: 'bvh', done }) });
  };
  // Other threads begin at once, and this one does meanwhile what needs no shapes. Alone, it has the drivers begin
  // first.
  const building = hierarchies && build();
  building?.catch(() => {});
  if (building) await breathe();
  const cache = new KernelCache(device);
  const compiling = new CompileClock();
  // The kernels' text hangs on what the scene has, not on its shapes: the driver compiles while this thread or others
  // build hierarchies. A guess that is wrong, or fails, has cost nothing: the right ones are asked for below.
  if (onFirstLight) cache.kernel('first', expected).catch(() => {});
  compiling.watch(cache.get(expected)).catch(() => {});
  const textMs = compiling.elapsed;
  await breathe();
  // All that lights and lit surfaces need and that does not hang on shapes: done while others build those.
  const surroundings = async () => {
    const groups = lightGroupTable(own, choices.lightGroups);
    const lights = await inSlices(
      lightSteps(own, (index) => isShown(own, own.instances[index] as Instance), groups, choices.lightSampling),
      { signal },
    );
    await breathe();
    return [
      await inSlices(environmentSteps(own.environment), { signal }),
      energyTextures((await loading).OPENPBR_TABLES),
      lights,
    ] as const;
  };
  const memory = new GpuMemory(device);
  const makeFilm = (planes: number) =>
    withErrorScopes(
      device,
      `an image of ${options.width} × ${options.height} pixels`,
      () => new Film(memory, options.width, options.height, planes),
    );
  let late = false;
  let forget: (() => void) | undefined;
  try {
    const early = building && ([surroundings(), makeFilm(expected.planes)] as const);
    for (const work of early ?? []) work.catch(() => {});
    const geometry = await (building ?? build());
    const t1 = performance.now();
    await breathe();
    onProgress?.({ stage: 'upload', done: 0 });
    const gpuScene = await withErrorScopes(
      device,
      'the shapes and textures of this scene',
      () => new GpuScene(device, memory, own, geometry, choices),
    );
    await gpuScene.fill(signal);
    if (onFirstLight) {
      forget = showFirstLight(
        { device, scene: gpuScene, geometry, camera, cache, features: expected, options },
        onFirstLight,
        () => late || signal?.aborted === true,
      );
      await breathe();
    }
    const shaped = performance.now();
    await gpuScene.light(...(await (early?.[0] ?? surroundings())));
    signal?.throwIfAborted();
    const t2 = performance.now();
    onProgress?.({ stage: 'upload', done: 1 });
    const features = kernelFeatures(gpuScene.features(), camera, options);
    const ahead = await early?.[1];
    const fits = ahead?.planes === features.planes;
    if (!fits) ahead?.destroy();
    const film = fits ? ahead : await makeFilm(features.planes);
    const integrator = await withErrorScopes(
      device,
      'the paths',
      () =>
        new Integrator(device, memory, gpuScene, features, film, options.pathsInFlight, {
          maxDepth: options.maxDepth,
          maxVolumeDepth: options.maxVolumeDepth,
        }),
    );
    const rehearsals: Promise<void>[] = [];
    const hear = (done: number, name?: KernelName, kernel?: Kernel) => {
      if (signal?.aborted) return;
      onProgress?.({ stage: 'compile', done });
      if (!name || !kernel) return;
      const rehearsal = withErrorScopes(device, `the kernel "${name}"`, () => integrator.rehearse(name, kernel));
      rehearsal.catch(() => {});
      rehearsals.push(rehearsal);
    };
    // The driver goes on compiling, for a later tracer; this one need not wait for it.
    integrator.begin(await untilAborted(compiling.watch(cache.get(features, hear)), signal));
    await untilAborted(Promise.all(rehearsals), signal);
    signal?.throwIfAborted();
    const lost = lossInfo(device);
    if (lost) throw deviceLost(lost);
    late = true;
    const times = {
      checkMs: checked - begun,
      textMs,
      bvhMs: t1 - asked,
      uploadMs: t2 - t1,
      lightMs: t2 - shaped,
      compileMs: compiling.milliseconds,
    };
    return {
      device,
      memory,
      editor: new SceneEditor(own, geometry, gpuScene, hierarchies),
      gpuScene,
      cache,
      integrator,
      film,
      camera,
      options,
      times,
    };
  } catch (error) {
    memory.destroy();
    throw error;
  } finally {
    late = true;
    forget?.();
  }
}

/** From the first request for kernels to when the last of them were there. */
class CompileClock {
  readonly #from = performance.now();
  #to = this.#from;

  get milliseconds(): number {
    return this.#to - this.#from;
  }

  get elapsed(): number {
    return performance.now() - this.#from;
  }

  /** Of what never comes, it knows nothing. */
  watch<T>(kernels: Promise<T>): Promise<T> {
    kernels.then(
      () => (this.#to = performance.now()),
      () => {},
    );
    return kernels;
  }
}

/** What decides the kernels' text: the scene's features, the camera and the options. */
export function kernelFeatures(features: KernelFeatures, camera: Camera, options: TracerSettings): KernelFeatures {
  return { ...features, flags: { ...features.flags, ...viewFlags(camera, options.filter), ...biasedFlags(options) } };
}
