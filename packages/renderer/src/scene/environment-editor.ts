import { checkScene, checkSceneSteps, createScene, inSlices, type Environment, type Scene } from '@glanz/scene';
import { environmentSteps, hasSameTexels, type EnvironmentData } from '../environment/environment';
import { RenderError } from '../errors';
import type { GpuScene } from './gpu-scene';
import type { SceneChange } from './scene-change';

/** What an environment may change and keep its texels. */
export interface EnvironmentAdjustment {
  readonly rotation?: number;
  readonly intensity?: number;
  readonly visible?: boolean;
}

/** Edits of the environment of a scene that is on the GPU, see `SceneEditor`. */
export class EnvironmentEditor {
  readonly #scene: Scene;
  readonly #gpu: GpuScene;
  /** Settles when the edits so far are prepared. */
  #lighting: Promise<void> | undefined;

  constructor(scene: Scene, gpu: GpuScene) {
    this.#scene = scene;
    this.#gpu = gpu;
  }

  /** Takes another environment, or none. */
  set(environment: Environment | undefined): SceneChange | Promise<SceneChange> {
    return this.#afterImages(() => {
      // Texels that are on the GPU have been validated: of an image at another rotation only the numbers beside it are,
      // with a black texel.
      if (environment?.type === 'latlong' && !hasSameTexels(this.#gpu.environment, environment))
        return this.#prepareImage(environment);
      const checked =
        environment?.type === 'latlong'
          ? { ...environment, width: 1, height: 1, data: new Float32Array(3) }
          : environment;
      if (checked) checkScene({ ...createScene(), environment: checked });
      return this.#changeEnvironment(environment);
    });
  }

  /** Changes the environment that there is. */
  adjust(change: EnvironmentAdjustment): SceneChange | Promise<SceneChange> {
    for (const name of ['rotation', 'intensity'] as const) {
      const value = change[name];
      if (value !== undefined && !Number.isFinite(value))
        throw new RenderError(
          'renderer/environment',
          `The environment's ${name} must be finite, not ${String(value)}.`,
        );
    }
    if (change.intensity !== undefined && change.intensity < 0)
      throw new RenderError(
        'renderer/environment',
        `The environment's intensity must be at least 0, not ${change.intensity}.`,
      );
    return this.#afterImages(() => {
      const { environment } = this.#scene;
      if (!environment) throw new RenderError('renderer/environment', 'The scene has no environment: set one first.');
      if (environment.type === 'constant' && change.intensity !== undefined)
        throw new RenderError('renderer/environment', 'A constant environment has no intensity: set its radiance.');
      const { visible = environment.visible ?? true } = change;
      // The pixels were validated when they were set.
      return this.#changeEnvironment(
        environment.type === 'latlong' ? { ...environment, ...change, visible } : { ...environment, visible },
      );
    });
  }

  /** At once, or after the images that are being prepared, so that edits of the environment stay in their order. */
  #afterImages(prepare: () => SceneChange | Promise<SceneChange>): SceneChange | Promise<SceneChange> {
    const change = this.#lighting ? this.#lighting.then(prepare) : prepare();
    if (change instanceof Promise) {
      const settle = () => {
        if (this.#lighting === lighting) this.#lighting = undefined;
      };
      const lighting: Promise<void> = (this.#lighting = change.then(settle, settle));
    }
    return change;
  }

  /** Validates an image and computes what the GPU needs of it, a slice at a time. */
  async #prepareImage(environment: Environment): Promise<SceneChange> {
    await inSlices(checkSceneSteps({ ...createScene(), environment }));
    return this.#changeEnvironment(environment, await inSlices(environmentSteps(environment)));
  }

  #changeEnvironment(environment: Environment | undefined, prepared?: EnvironmentData): SceneChange {
    const before = this.#scene.environment;
    const set = (value: Environment | undefined) => {
      if (value) this.#scene.environment = value;
      else delete this.#scene.environment;
    };
    return {
      isStale: () => this.#scene.environment !== before,
      apply: () => {
        set(environment);
        return this.#gpu.updateEnvironment(environment, prepared);
      },
      undo: () => set(before),
    };
  }
}
