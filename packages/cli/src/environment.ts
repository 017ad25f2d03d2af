import { decodeEnvironment } from '@glanz/image/environment';
import type { Environment, Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import { readInput } from './input';

/** What lights the scene, and where it is from. */
export interface ChosenEnvironment {
  readonly environment: Environment | undefined;
  /** `studio`, `none`, `scene`, or the file as given. */
  readonly source: string;
  readonly warnings: readonly string[];
}

/** Whether a value of `--env` names a file. */
export const isEnvironmentFile = (choice: string | undefined): choice is string =>
  choice !== undefined && choice !== 'studio' && choice !== 'none';

/**
 * The environment that `--env` requests; by default the model's own, or the studio.
 *
 * @param signal Stops reading the file.
 * @throws {CliError} `cli/input` if the file cannot be read
 * @throws {ImageError} if it is not an image
 */
export async function chooseEnvironment(
  scene: Scene,
  choice: string | undefined,
  settings: { readonly rotation: number; readonly intensity: number },
  cwd: string,
  signal?: AbortSignal,
): Promise<ChosenEnvironment> {
  const { rotation, intensity } = settings;
  if (choice === 'none') return { environment: undefined, source: 'none', warnings: [] };
  if (choice === undefined && scene.environment)
    return { environment: adjusted(scene.environment, rotation, intensity), source: 'scene', warnings: [] };
  if (choice === undefined || choice === 'studio')
    return { environment: studioEnvironment({ rotation, intensity }), source: 'studio', warnings: [] };
  const bytes = await readInput(choice, cwd, 'the environment', signal ? { signal } : {});
  const { width, height, data, warnings } = decodeEnvironment(bytes);
  return {
    environment: { type: 'latlong', width, height, data, rotation, intensity },
    source: choice,
    warnings: warnings.map(({ message }) => message),
  };
}

function adjusted(environment: Environment, rotation: number, intensity: number): Environment {
  if (environment.type === 'latlong')
    return {
      ...environment,
      rotation: (environment.rotation ?? 0) + rotation,
      intensity: (environment.intensity ?? 1) * intensity,
    };
  const [r, g, b] = environment.radiance;
  return { ...environment, radiance: [r * intensity, g * intensity, b * intensity] };
}
