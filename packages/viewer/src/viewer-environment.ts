import type { PathTracer } from '@glanz/renderer';
import { createScene, inSlices, validationSteps, type Environment, type Scene } from '@glanz/scene';
import { ViewerError } from './errors';
import { loadEnvironment, type EnvironmentSource } from './load';
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

/** A viewer's environment with its intensity and rotation. What a tracer refuses is not kept. */
export class ViewerEnvironment {
  #now: Setting;
  /** The last one that a tracer accepted. */
  #accepted: Setting;

  constructor(source: EnvironmentSource = 'scene', intensity = 1, rotation = 0) {
    this.#now = this.#accepted = { source, loaded: undefined, intensity, rotation };
  }

  get intensity(): number {
    return this.#now.intensity;
  }

  get rotation(): number {
    return this.#now.rotation;
  }

  /** Sets intensity or rotation. With a scene, {@link apply} has to follow. */
  adjust(change: Partial<Pick<Setting, 'intensity' | 'rotation'>>, hasScene: boolean): void {
    this.#set(change, hasScene);
  }

  /**
   * Sets another environment. With a scene, {@link apply} has to follow.
   * @throws for what cannot be read, or is no environment; the former one stays.
   */
  async change(source: EnvironmentSource, scene: Scene | undefined, signal: AbortSignal): Promise<void> {
    const given = await loadEnvironment(source, signal);
    signal.throwIfAborted();
    const loaded = await forScene(source, given, scene);
    // Without a tracer nothing else validates it.
    if (!scene && loaded) await inSlices(validationSteps({ ...createScene(), environment: loaded }), { signal });
    signal.throwIfAborted();
    this.#set({ source, loaded }, scene !== undefined);
  }

  /**
   * Lights a tracer's scene. @throws {SceneError} {DeviceError} of the tracer; the last environment that worked is set
   * again then.
   */
  async apply(tracer: PathTracer): Promise<void> {
    const tried = this.#now;
    try {
      await tracer.setEnvironment(lit(tried));
      this.#accepted = tried;
    } catch (error) {
      const lost = (error as { code?: unknown }).code === 'renderer/device-lost';
      if (this.#now === tried && !lost) this.#now = this.#accepted;
      throw error;
    }
  }

  /**
   * Fetches what is needed besides the scene, while that is on its way: the studio where the environment cannot be had.
   * @returns What makes it the environment of the scene; `warning`: why the studio replaces the environment.
   */
  async fetch(signal: AbortSignal): Promise<(scene: Scene) => Promise<Prepared>> {
    const { source } = this.#now;
    let warning: ViewerError | undefined;
    const given = await loadEnvironment(source, signal).catch((cause: unknown) => {
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
        adopt: () => source === this.#now.source && this.#set({ loaded }, false),
      };
    };
  }

  #set(change: Partial<Setting>, tried: boolean): void {
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

/** The scene with another environment. */
export function withEnvironment(scene: Scene, environment: Environment | undefined): Scene {
  const { environment: _, ...rest } = scene;
  return environment ? { ...rest, environment } : rest;
}
