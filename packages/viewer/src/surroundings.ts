import type { Environment, Scene } from '@glanz/scene';
import { loadEnvironment, type EnvironmentSource } from './load';
import type { Vector } from './orbit';

/** The surroundings that a viewer was given, and how bright and how turned they are. */
export class Surroundings {
  #source: EnvironmentSource;
  #loaded: Environment | undefined;
  /** Factor. */
  intensity: number;
  /** Radians about +Y. */
  rotation: number;

  constructor(source: EnvironmentSource = 'scene', intensity = 1, rotation = 0) {
    this.#source = source;
    this.intensity = intensity;
    this.rotation = rotation;
  }

  /** Others, from now on. @throws for what cannot be read; the former ones stay. */
  async change(source: EnvironmentSource, scene: Scene | undefined, signal: AbortSignal | undefined): Promise<void> {
    const given = await loadEnvironment(source, signal);
    signal?.throwIfAborted();
    this.#source = source;
    this.#loaded = await forScene(source, given, scene);
  }

  /** Fetches what is needed besides the scene, while that is on its way. @returns What makes them the surroundings of the scene. */
  async fetch(signal: AbortSignal): Promise<(scene: Scene) => Promise<{ readonly lit: Environment | undefined; readonly adopt: () => void }>> {
    const source = this.#source;
    const given = await loadEnvironment(source, signal);
    return async (scene) => {
      const environment = await forScene(source, given, scene);
      return { lit: this.#lit(environment), adopt: () => void (source === this.#source && (this.#loaded = environment)) };
    };
  }

  /** As they light the scene now. */
  get lit(): Environment | undefined {
    return this.#lit(this.#loaded);
  }

  #lit(environment: Environment | undefined): Environment | undefined {
    if (!environment) return undefined;
    const { intensity: k, rotation } = this;
    if (environment.type === 'constant') return { ...environment, radiance: environment.radiance.map((value) => value * k) as unknown as Vector };
    return { ...environment, intensity: (environment.intensity ?? 1) * k, rotation: (environment.rotation ?? 0) + rotation };
  }
}

/** `scene` without surroundings of its own is the studio. */
const forScene = async (source: EnvironmentSource, given: Environment | undefined, scene: Scene | undefined): Promise<Environment | undefined> =>
  given ?? (source === 'scene' ? (scene?.environment ?? (await loadEnvironment('studio'))) : undefined);

/** The scene in other surroundings. */
export function withEnvironment(scene: Scene, environment: Environment | undefined): Scene {
  const { environment: _, ...rest } = scene;
  return environment ? { ...rest, environment } : rest;
}
