import { inSlices, type Environment, type LatLongEnvironment, type Scene } from '@glanz/scene';
import {
  STUDIOS,
  studioEnvironment,
  studioSteps,
  type SoftBox,
  type StudioName,
  type StudioSetup,
} from '@glanz/scene/studio';
import type { State } from '../state/state';

function setupOf({ studio, boxes }: State): StudioSetup {
  const setup = STUDIOS[studio] ?? STUDIOS.neutral;
  return boxes ? { ...setup, boxes } : setup;
}

/** Environments that have been loaded or made. */
export class Environments {
  #file: LatLongEnvironment | undefined;
  #fileName = '';
  /** The last one made: turning and dimming it makes no other. */
  #made:
    | {
        readonly studio: StudioName;
        readonly boxes: readonly SoftBox[] | null;
        readonly environment: LatLongEnvironment;
      }
    | undefined;

  /** Name of the file that lights the scene: loaded, or named by a link that does not hold it; or empty. */
  get fileName(): string {
    return this.#fileName;
  }

  /** Whether the file is there. */
  get hasFile(): boolean {
    return this.#file !== undefined;
  }

  /** The file that a link was made with. It is named until a file is loaded. */
  expect(name: string): void {
    if (!this.#file) this.#fileName = name;
  }

  /**
   * Reads an image for the choice `file`.
   *
   * @throws {ImageError} if it is no Radiance HDR or OpenEXR; the former image stays.
   */
  async load(file: File): Promise<void> {
    const { decodeEnvironment } = await import('@glanz/image/environment');
    const { width, height, data } = decodeEnvironment(new Uint8Array(await file.arrayBuffer()));
    this.#file = { type: 'latlong', width, height, data };
    this.#fileName = file.name;
  }

  /**
   * The environment that the state asks for. `model` without one of the model's own is the studio, as is `file` without
   * a file.
   */
  choose(state: State, scene: Pick<Scene, 'environment'> | undefined): Environment | undefined {
    const { environment: choice, intensity, constant } = state;
    if (choice === 'none') return undefined;
    if (choice === 'constant')
      return {
        type: 'constant',
        radiance: [constant[0] * intensity, constant[1] * intensity, constant[2] * intensity],
      };
    const rotation = (state.rotation * Math.PI) / 180;
    const own = choice === 'model' ? scene?.environment : choice === 'file' ? this.#file : undefined;
    const source = own ?? this.#studio(state);
    if (source.type === 'constant')
      return {
        ...source,
        radiance: [source.radiance[0] * intensity, source.radiance[1] * intensity, source.radiance[2] * intensity],
      };
    return { ...source, intensity: (source.intensity ?? 1) * intensity, rotation: (source.rotation ?? 0) + rotation };
  }

  /** Makes what {@link choose} will ask for, in slices. */
  async prepare(state: State, scene: Pick<Scene, 'environment'> | undefined): Promise<void> {
    const { environment: choice, studio, boxes } = state;
    const own =
      choice === 'none' ||
      choice === 'constant' ||
      (choice === 'model' && scene?.environment) ||
      (choice === 'file' && this.#file);
    if (own || this.#isMade(state)) return;
    this.#made = { studio, boxes, environment: await inSlices(studioSteps({ setup: setupOf(state) })) };
  }

  #isMade({ studio, boxes }: State): boolean {
    return this.#made?.studio === studio && this.#made.boxes === boxes;
  }

  #studio(state: State): LatLongEnvironment {
    const { studio, boxes } = state;
    if (!this.#made || !this.#isMade(state))
      this.#made = { studio, boxes, environment: studioEnvironment({ setup: setupOf(state) }) };
    return this.#made.environment;
  }
}
