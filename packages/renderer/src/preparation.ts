import { loadPart } from '@glanz/wgsl';
import { checkSceneSteps, inSlices, SceneError, type Camera, type Instance, type Scene } from '@glanz/scene';
import { biasedFlags } from './biased-options';
import { cameraUniforms } from './camera/camera';
import { cameraSteps } from './camera/choose-camera';
import { viewFlags } from './camera/view';
import { inErrorScopes, withErrorScopes } from './device/error-scopes';
import { environmentSteps, type EnvironmentData } from './environment/environment';
import { RenderError } from './errors';
import { aovBuffers, aovFlags } from './film/aovs';
import { Film } from './film/film';
import type { CompactShapes } from './geometry/compact-shapes';
import { chooseCompact } from './geometry/choose-compact';
import { panesOf } from './materials/panes';
import { expectedShapes, shapeBytes, type Geometry } from './geometry/geometry';
import { prepareGeometry } from './geometry/prepare-geometry';
import type { HierarchyOptions } from './geometry/hierarchies';
import { isShown } from './geometry/placement';
import { Integrator } from './integrator/integrator';
import type { KernelCache } from './integrator/kernel-cache';
import type { Kernel, KernelFeatures, KernelName } from './integrator/pipelines';
import { lightGroupTable } from './lights/light-groups';
import { lightSteps, type GatheredLights } from './lights/lights';
import { energyTextures, type EnergyTextures } from './materials/energy-textures';
import { TextureFit } from './scene/texture-fit';
import { parametersOf } from './materials/parameters';
import { checkInteriors, type TracerSettings } from './option-checks';
import { expectedFeatures, texturePlan } from './scene/features';
import { GpuScene } from './scene/gpu-scene';
import { ownScene } from './scene/scene-editor';
import { stageOf, type AnyStage } from './schedule/stages';
import { showFirstLight } from './session/first-light';
import { packFrame } from './session/frame';
import { GpuMemory } from './storage/buffers';
import type { Pages } from './storage/paged/pages';
import { readFloats } from './storage/read-buffer';
import { choosePages } from './storage/choose-pages';

/** What the stages of a preparation make. */
export interface Products {
  /** The scene that belongs to the tracer, validated. */
  readonly scene: Scene;
  readonly camera: Camera;
  /** Light by way of these is guided; none where a guide is trained, which replaces that. */
  readonly panes: readonly Instance[];
  /** Arrays that will probably be too large for buffers. */
  readonly pages: Pages | undefined;
  /** Writes the shapes, if they are to be compact. */
  readonly compact: CompactShapes | undefined;
  /** Textures of the scene that do not fit have lost levels. */
  readonly textures: TextureFit;
  /** What the kernels' text will probably depend on, before the shapes are known. */
  readonly expected: KernelFeatures;
  /** The driver compiles the expected kernels. */
  readonly request: void;
  /** Hierarchies, instances and vertex attributes. */
  readonly geometry: Geometry;
  /** The scene on the GPU, without its lights. */
  readonly shapes: GpuScene;
  /** Frees the first image. */
  readonly firstLight: () => void;
  readonly lights: GatheredLights;
  readonly environment: EnvironmentData;
  readonly energy: EnergyTextures;
  /** The scene on the GPU, with its lights. */
  readonly gpuScene: GpuScene;
  /** A film for the expected features: `film`, if these were right. */
  readonly draft: Film;
  readonly features: KernelFeatures;
  readonly film: Film;
  /** The guide is trained, where one is requested. */
  readonly guide: void;
  /** Has the kernels when the stage `kernels` is done. */
  readonly integrator: Integrator;
  readonly kernels: void;
}

/** What a preparation works on. */
export interface PreparationInput {
  readonly device: GPUDevice;
  readonly memory: GpuMemory;
  readonly cache: KernelCache;
  readonly scene: Scene;
  readonly options: TracerSettings;
  readonly builders: HierarchyOptions;
  /** Whether the first image comes too late. */
  readonly isLate: () => boolean;
}

/** What decides the kernels' text: the scene's features, the camera and the options. */
export function kernelFeatures(features: KernelFeatures, camera: Camera, options: TracerSettings): KernelFeatures {
  const flags: Readonly<Record<string, boolean>> = {
    ...features.flags,
    ...viewFlags(camera, options.filter),
    ...biasedFlags(options),
    ...aovFlags(options.aovs),
  };
  const { NEXT_EVENT, CATCHER, CULLING_ALL, PATH_STATE, CLAMP_INDIRECT, OPACITY, REFRACTED_LIGHT } = flags;
  // Light paths know nothing of these.
  const LIGHT_PATHS =
    options.lightPaths > 0 &&
    NEXT_EVENT === true &&
    !(CATCHER || CULLING_ALL || PATH_STATE || CLAMP_INDIRECT) &&
    camera.type === 'perspective';
  const GUIDE = options.guiding > 0 || flags.PANES === true;
  // Whether such a sample is found must depend on nothing but its two ends.
  const refracts = REFRACTED_LIGHT === true && NEXT_EVENT === true && !(OPACITY || PATH_STATE || LIGHT_PATHS || GUIDE);
  return {
    ...features,
    flags: {
      ...flags,
      LIGHT_PATHS,
      LIGHT_CANDIDATES: options.lightCandidates > 1,
      LIGHT_REUSE: options.lightReuse === true && NEXT_EVENT === true && !CATCHER && !features.pages,
      GUIDE,
      REFRACTED_LIGHT: refracts,
      AREA_LIGHT_WEIGHTS: LIGHT_PATHS || refracts,
      SHADOW_SOFTNESS: features.flags.CATCHER === true && options.shadowSoftness > 0,
    },
  };
}

const stage = stageOf<Products>();

/** The stages that validate the scene, choose the camera and ask the driver for the kernels. */
const inspection = ({ device, cache, scene: given, options }: PreparationInput) => [
  stage({
    name: 'scene',
    needs: [],
    place: 'foreground',
    async run(_, { signal }) {
      await inSlices(checkSceneSteps(given), { signal });
      const scene = ownScene(given);
      checkInteriors(scene);
      return scene;
    },
  }),
  stage({
    name: 'panes',
    needs: ['scene'],
    place: 'foreground',
    run: ({ scene }) => (options.guiding > 0 ? [] : panesOf(scene)),
  }),
  stage({
    name: 'compact',
    needs: ['scene'],
    place: 'foreground',
    run: ({ scene }) => chooseCompact(scene, options.memory),
  }),
  stage({
    name: 'pages',
    needs: ['scene', 'compact'],
    place: 'foreground',
    // What cannot fit is refused here, before anything is built.
    run: ({ scene, compact }) => choosePages(device, shapeBytes(scene, expectedShapes(scene, compact))),
  }),
  stage({
    name: 'camera',
    needs: ['scene'],
    place: 'foreground',
    async run({ scene }, { signal }) {
      const steps = cameraSteps(scene, options.camera, options.width / options.height);
      const camera = await inSlices(steps, { signal }).catch((cause: unknown) => {
        // What cannot be framed cannot be rendered, and rendering is what the caller asked for.
        throw cause instanceof SceneError && cause.code === 'scene/empty'
          ? new RenderError('renderer/no-triangles', 'The scene has no visible triangles.', {
              cause,
            })
          : cause;
      });
      cameraUniforms(camera, options.width, options.height);
      return camera;
    },
  }),
  stage({
    name: 'textures',
    needs: ['scene', 'panes', 'camera', 'pages'],
    place: 'foreground',
    async run({ scene, panes, camera, pages }, { signal }) {
      const layout = (of: Scene) => texturePlan(device, of, { ...options, pages, panes });
      const textures = new TextureFit({ device, scene, camera, options, layout, signal });
      await textures.fit();
      return textures;
    },
  }),
  stage({
    name: 'expected',
    needs: ['scene', 'panes', 'camera', 'compact', 'pages', 'textures'],
    place: 'foreground',
    run: ({ scene, panes, camera, compact, pages }) =>
      kernelFeatures(expectedFeatures(device, scene, { ...options, compact, pages, panes }), camera, options),
  }),
  stage({
    name: 'request',
    needs: ['expected'],
    place: 'foreground',
    // The kernels' text depends on what the scene has, not on its shapes: the driver compiles while this thread or
    // others build hierarchies. A wrong guess costs nothing: the stage `kernels` asks for the right ones.
    run({ expected }) {
      if (options.onFirstLight) cache.kernel('first', expected).catch(() => {});
      cache.get(expected).catch(() => {});
    },
  }),
];

/** The stages that bring the scene to the GPU. */
function transfer({ device, memory, cache, options, builders, isLate }: PreparationInput) {
  const { onProgress, onFirstLight } = options;
  return [
    stage({
      name: 'geometry',
      needs: ['scene', 'compact', 'pages'],
      place: builders.hierarchies || builders.gpu ? 'elsewhere' : 'foreground',
      run({ scene, compact }, { signal }) {
        onProgress?.({ stage: 'bvh', done: 0 });
        const report = (done: number) => onProgress?.({ stage: 'bvh', done });
        return prepareGeometry(scene, { ...builders, compact, signal, onProgress: report });
      },
    }),
    stage({
      name: 'shapes',
      needs: ['scene', 'panes', 'geometry', 'textures'],
      place: 'foreground',
      async run({ scene, panes, geometry, textures }, { signal }) {
        onProgress?.({ stage: 'upload', done: 0 });
        const pages = await choosePages(device, shapeBytes(scene, geometry));
        const choices = { ...options, pages, compact: geometry.compact, panes };
        const make = () => memory.track(() => new GpuScene(device, memory, scene, geometry, choices));
        let shapes: GpuScene | undefined;
        while (!shapes) {
          const { result, verified } = inErrorScopes(device, 'the shapes and textures of this scene', make);
          await verified.then(
            () => ([shapes] = result),
            (error: unknown) => {
              for (const resource of result[1]) memory.release(resource);
              return textures.fit(error);
            },
          );
        }
        if (textures.warning) options.onWarning?.(textures.warning);
        await shapes.fill(signal);
        return shapes;
      },
    }),
    stage({
      name: 'firstLight',
      needs: ['shapes', 'geometry', 'camera', 'expected'],
      place: 'foreground',
      run({ shapes, geometry, camera, expected }, { signal }) {
        if (!onFirstLight) return () => {};
        const source = { device, scene: shapes, geometry, camera, cache, features: expected, options };
        return showFirstLight(source, onFirstLight, () => isLate() || signal.aborted);
      },
      release: (free) => free(),
    }),
    stage({
      name: 'lights',
      needs: ['scene', 'textures'],
      place: 'background',
      run({ scene }, { signal }) {
        const groups = lightGroupTable(scene, options.lightGroups);
        const shown = (index: number) => isShown(scene, scene.instances[index] as Instance);
        return inSlices(lightSteps(scene, shown, groups, options.lightSampling), { signal });
      },
    }),
    stage({
      name: 'environment',
      needs: ['scene'],
      place: 'background',
      run: ({ scene }, { signal }) => inSlices(environmentSteps(scene.environment), { signal }),
    }),
    stage({
      name: 'energy',
      needs: ['scene'],
      place: 'elsewhere',
      // A quarter of what the renderer weighs, and needed by no earlier stage: a chunk of its own.
      run: async () => energyTextures((await loadPart('tables', import('@glanz/openpbr/tables'))).OPENPBR_TABLES),
    }),
    stage({
      name: 'gpuScene',
      // The first image comes before the lights.
      needs: ['shapes', 'firstLight', 'lights', 'environment', 'energy'],
      place: 'foreground',
      async run({ shapes, lights, environment, energy }) {
        await shapes.light(environment, energy, lights);
        onProgress?.({ stage: 'upload', done: 1 });
        return shapes;
      },
    }),
  ];
}

/** The stages that make the film and the paths, and wait for the kernels. */
function assembly({ device, memory, cache, options }: PreparationInput) {
  const { width, height, signal: outer, onProgress } = options;
  const aovs = aovBuffers(aovFlags(options.aovs));
  const makeFilm = (lightPasses: number) =>
    withErrorScopes(
      device,
      `an image of ${width} × ${height} pixels`,
      () => new Film(memory, width, height, lightPasses, aovs),
    );
  return [
    stage({
      name: 'guide',
      needs: ['scene', 'panes', 'geometry', 'gpuScene', 'features', 'camera'],
      place: 'elsewhere',
      async run(products, { signal }) {
        const { scene, panes, gpuScene } = products;
        if (!options.guiding && panes.length === 0) return;
        const { paneTableSteps, trainGuide } = await loadPart('guide-training', import('./session/guide-training'));
        if (panes.length > 0) {
          const steps = paneTableSteps(scene, panes, gpuScene.environment);
          const { table, width } = await inSlices(steps, { signal });
          await withErrorScopes(device, 'the guide', () => gpuScene.setGuide(table, width));
          return;
        }
        const source = { ...products, device, cache, options, signal };
        const tools = [Integrator, GpuMemory, isShown, packFrame, parametersOf, readFloats, withErrorScopes] as const;
        await trainGuide(source, tools);
      },
    }),
    stage({
      name: 'draft',
      needs: ['expected'],
      place: 'background',
      run: ({ expected }) => makeFilm(expected.lightPasses),
    }),
    stage({
      name: 'features',
      needs: ['gpuScene', 'camera'],
      place: 'foreground',
      run: ({ gpuScene, camera }) => kernelFeatures(gpuScene.features(), camera, options),
    }),
    stage({
      name: 'film',
      needs: ['draft', 'features'],
      place: 'foreground',
      run({ draft, features: { lightPasses } }) {
        if (draft.lightPasses === lightPasses) return draft;
        draft.destroy();
        return makeFilm(lightPasses);
      },
    }),
    stage({
      name: 'integrator',
      needs: ['gpuScene', 'features', 'film'],
      place: 'foreground',
      run: ({ gpuScene, features, film }) =>
        withErrorScopes(
          device,
          'the paths',
          () =>
            new Integrator(device, memory, gpuScene, features, film, options.pathsInFlight, {
              maxDepth: options.maxDepth,
              maxVolumeDepth: options.maxVolumeDepth,
            }),
        ),
    }),
    stage({
      name: 'kernels',
      needs: ['scene', 'gpuScene', 'features', 'integrator', 'guide'],
      // The driver goes on compiling after an abort, for a later tracer.
      place: 'elsewhere',
      async run({ scene, gpuScene, features, integrator }, { signal }) {
        if (options.lightPaths > 0) {
          const { lightTracing } = await loadPart('light-paths', import('./session/light-paths'));
          const source = { device, memory, scene, gpuScene, integrator, options };
          integrator.lights = lightTracing(source, [Integrator, isShown, parametersOf]);
        }
        const prewarmed: Promise<void>[] = [];
        const onKernel = (done: number, name?: KernelName, kernel?: Kernel) => {
          if (signal.aborted || outer?.aborted) return;
          onProgress?.({ stage: 'compile', done });
          if (!name || !kernel) return;
          const prewarm = withErrorScopes(device, `the kernel "${name}"`, () => integrator.prewarm(name, kernel));
          prewarm.catch(() => {});
          prewarmed.push(prewarm);
        };
        integrator.begin(await cache.get(features, onKernel));
        await Promise.all(prewarmed);
      },
    }),
  ];
}

/**
 * The stages of a preparation, in order of urgency: the shortest way to a first image is in the foreground; what only
 * lights and lit surfaces need is done in the background, while hierarchies are built elsewhere.
 */
export function preparationStages(input: PreparationInput): readonly AnyStage<Products>[] {
  return [...inspection(input), ...transfer(input), ...assembly(input)];
}
