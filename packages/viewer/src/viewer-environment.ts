import type { PathTracer } from '@glanz/renderer';
import { checkSceneSteps, createScene, inSlices, untilAborted, type Environment, type Scene } from '@glanz/scene';
import type { Engine } from './engine';
import { isLoss } from './aborts';
import { ViewerError } from './errors';
import { LatestTask } from './latest-task';
import { loadEnvironment, type EnvironmentSource } from './load';
import type { ViewerOptions } from './options';
import type { Vector } from './orbit-state';

interface Setting {
  readonly source: EnvironmentSource;
  readonly loaded: Environment | undefined;
  /** Factor. */
  readonly intensity: number;
  /** Radians about +Y. */
  readonly rotation: number;
}

/** An environment for one scene. */
interface Prepared {
  readonly lit: Environment | undefined;
  readonly warning: ViewerError | undefined;
  readonly adopt: () => void;
}

/** The environment of a viewer, its intensity and its rotation. Values that a tracer refuses are not kept. */
export class ViewerEnvironment {
  readonly #engine: Engine;
  readonly #changing = new LatestTask();
  #now: Setting;
  /** The last one that a tracer accepted. */
  #accepted: Setting;
  /** Of the requests for environments. */
  credentials: RequestCredentials | undefined;

  constructor(engine: Engine, options: ViewerOptions) {
    this.#engine = engine;
    this.credentials = options.credentials;
    this.#now = this.#accepted = {
      source: options.environment ?? 'scene',
      loaded: undefined,
      intensity: options.environmentIntensity ?? 1,
      rotation: options.environmentRotation ?? 0,
    };
  }

  get intensity(): number {
    return this.#now.intensity;
  }

  get rotation(): number {
    return this.#now.rotation;
  }

  /** Sets intensity, rotation or another environment. Resolves when the image shows it. */
  async set(change: Partial<Setting>): Promise<void> {
    const hasScene = this.#engine.tracer !== undefined;
    this.#keep(change, hasScene);
    if (hasScene) await this.#engine.edit('environment', (tracer) => this.#light(tracer));
  }

  /**
   * Loads another environment. A later call aborts an earlier one. Resolves when the image shows it.
   *
   * @param scene The scene as it was loaded.
   * @throws for what cannot be read, or is no environment; the former one stays.
   */
  async change(source: EnvironmentSource, scene: Scene | undefined, signal: AbortSignal | undefined): Promise<void> {
    const reason = 'another environment was requested';
    const loaded = await this.#changing.run(reason, signal, (either) =>
      untilAborted(loadFor(scene, source, either, this.credentials), either),
    );
    await this.set({ source, loaded });
  }

  /** Aborts a change. */
  destroy(): void {
    this.#changing.abort();
  }

  /**
   * Fetches what is needed besides the scene, while that is on its way: the studio where the environment cannot be had.
   * @returns What makes it the environment of the scene; `warning`: why the studio replaces the environment.
   */
  async fetch(signal: AbortSignal): Promise<(scene: Scene) => Promise<Prepared>> {
    const { source } = this.#now;
    let warning: ViewerError | undefined;
    const given = await loadEnvironment(source, signal, this.credentials).catch((cause: unknown) => {
      signal.throwIfAborted();
      const [why] = (cause instanceof Error ? cause.message : String(cause)).split('\n');
      warning = new ViewerError('viewer/environment', `${why} The studio lights the model instead.`, { cause });
      return loadEnvironment('studio', signal);
    });
    return async (scene) => {
      const loaded = await forScene(source, given, scene);
      return {
        lit: lit({ ...this.#now, loaded }),
        warning,
        adopt: () => source === this.#now.source && this.#keep({ loaded }, false),
      };
    };
  }

  /**
   * Lights a tracer's scene. @throws {SceneError} {DeviceError} of the tracer; the last environment that worked is set
   * again then.
   */
  async #light(tracer: PathTracer): Promise<void> {
    const tried = this.#now;
    try {
      await tracer.setEnvironment(lit(tried));
      this.#accepted = tried;
    } catch (error) {
      if (this.#now === tried && !isLoss(error)) this.#now = this.#accepted;
      throw error;
    }
  }

  #keep(change: Partial<Setting>, tried: boolean): void {
    this.#now = { ...this.#now, ...change };
    if (!tried) this.#accepted = this.#now;
  }
}

/** An environment as it lights the scene. */
function lit({ loaded, intensity: k, rotation }: Setting): Environment | undefined {
  if (!loaded) return undefined;
  if (loaded.type === 'constant')
    return { ...loaded, radiance: loaded.radiance.map((value) => value * k) as unknown as Vector };
  return { ...loaded, intensity: (loaded.intensity ?? 1) * k, rotation: (loaded.rotation ?? 0) + rotation };
}

/** `scene` is the studio where the scene has no environment. */
const forScene = async (
  source: EnvironmentSource,
  given: Environment | undefined,
  scene: Scene | undefined,
): Promise<Environment | undefined> =>
  given ?? (source === 'scene' ? (scene?.environment ?? (await loadEnvironment('studio'))) : undefined);

/** Reads an environment for a scene. */
async function loadFor(
  scene: Scene | undefined,
  source: EnvironmentSource,
  signal: AbortSignal,
  credentials: RequestCredentials | undefined,
): Promise<Environment | undefined> {
  const given = await loadEnvironment(source, signal, credentials);
  signal.throwIfAborted();
  const loaded = await forScene(source, given, scene);
  // Without a tracer nothing else validates it.
  if (!scene && loaded) await inSlices(checkSceneSteps({ ...createScene(), environment: loaded }), { signal });
  signal.throwIfAborted();
  return loaded;
}

/** The scene with another environment. */
export function withEnvironment(scene: Scene, environment: Environment | undefined): Scene {
  const { environment: _, ...rest } = scene;
  return environment ? { ...rest, environment } : rest;
}
