import { resolve } from 'node:path';
import type { CompressedFormat, Scene } from '@glanz/scene';
import type { Backend } from '../backend';
import { chooseEnvironment } from '../environment';
import { CliError } from '../errors';
import type { RenderCommandOptions } from '../options';

/** A model with its environment, ready for a tracer. */
export interface PreparedScene {
  readonly scene: Scene;
  readonly environment: string;
  readonly warnings: readonly string[];
}

type Timed = <T>(run: () => Promise<T>) => Promise<T>;

/** What decides a prepared scene, as text. */
export const sceneKey = ({ model, pose, env, envRotation, envIntensity, catchers }: RenderCommandOptions): string =>
  JSON.stringify([model, pose, env, envRotation, envIntensity, catchers]);

/** Loads models; the last one is kept, since the next image is mostly of the same. */
export class SceneLoader {
  readonly #backend: Backend;
  readonly #cwd: string;
  #key = '';
  #last: Promise<PreparedScene> | undefined;

  constructor(backend: Backend, cwd: string) {
    this.#backend = backend;
    this.#cwd = cwd;
  }

  /**
   * @param formats Compressed formats of the device that asks first; another one unpacks what it cannot read.
   * @param timeEnvironment Runs and measures what makes the environment.
   */
  load(
    options: RenderCommandOptions,
    signal: AbortSignal,
    formats?: () => Promise<readonly CompressedFormat[]>,
    timeEnvironment: Timed = (run) => run(),
  ): Promise<PreparedScene> {
    const key = sceneKey(options);
    if (this.#last && key === this.#key) return this.#last;
    this.#key = key;
    this.#last = this.#prepare(options, signal, formats, timeEnvironment);
    this.#last.catch(() => (this.#last = undefined));
    return this.#last;
  }

  async #prepare(
    options: RenderCommandOptions,
    signal: AbortSignal,
    formats: (() => Promise<readonly CompressedFormat[]>) | undefined,
    timeEnvironment: Timed,
  ): Promise<PreparedScene> {
    const model = await this.#backend.loadModel(resolve(this.#cwd, options.model), signal, options.pose, formats);
    const { environment, source, warnings } = await timeEnvironment(() =>
      chooseEnvironment(
        model,
        options.env,
        { rotation: options.envRotation, intensity: options.envIntensity },
        this.#cwd,
        signal,
      ),
    );
    const { environment: _replaced, ...rest } = model;
    const instances = markCatchers(model.instances, options.catchers);
    return {
      scene: environment ? { ...rest, instances, environment } : { ...rest, instances },
      environment: source,
      warnings: [...model.warnings.map(({ message, path }) => (path ? `${message} (${path})` : message)), ...warnings],
    };
  }
}

/**
 * The number of a variant by its name or number. @throws {CliError} `cli/usage` for one that the model does not have.
 */
export function variantIndex(scene: Scene, variant: string | undefined): number | undefined {
  if (variant === undefined) return undefined;
  const names = scene.variants ?? [];
  const index = names.includes(variant) ? names.indexOf(variant) : /^\d+$/.test(variant) ? Number(variant) : -1;
  if (names[index] === undefined)
    throw new CliError(
      'cli/usage',
      `--variant: the model has no variant "${variant}"; it has ${names.length === 0 ? 'none' : names.map((name) => `"${name}"`).join(', ')}.`,
    );
  return index;
}

/** @throws {CliError} `cli/usage` for a name that no part has. */
function markCatchers(instances: Scene['instances'], names: readonly string[]): Scene['instances'] {
  for (const name of names) {
    if (!instances.some((instance) => instance.name === name))
      throw new CliError(
        'cli/usage',
        `--catcher: the model has no part "${name}"; it has ${[...new Set(instances.map((instance) => `"${instance.name}"`))].join(', ')}.`,
      );
  }
  return instances.map((instance) => (names.includes(instance.name) ? { ...instance, catcher: true } : instance));
}
