import { decodeEnvironment } from '@glanz/image/environment';
import type { Environment, LatLongEnvironment, Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import type { Settings } from '../settings';

/** Pictures of surroundings that have been loaded or made. */
export class Environments {
  #studio: LatLongEnvironment | undefined;
  #file: LatLongEnvironment | undefined;
  #fileName = '';

  /** Name of the file that was loaded, or empty. */
  get fileName(): string {
    return this.#fileName;
  }

  /**
   * Reads a picture for the choice `file`.
   *
   * @throws {ImageError} if it is no Radiance HDR or OpenEXR; the former picture stays.
   */
  async load(file: File): Promise<void> {
    const { width, height, data } = decodeEnvironment(new Uint8Array(await file.arrayBuffer()));
    this.#file = { type: 'latlong', width, height, data };
    this.#fileName = file.name;
  }

  /** The surroundings that the settings ask for. `model` without surroundings of the model's own is the studio. */
  choose(settings: Settings, scene: Pick<Scene, 'environment'> | undefined): Environment | undefined {
    const { environment: choice, intensity, constant } = settings;
    if (choice === 'none') return undefined;
    if (choice === 'constant') return { type: 'constant', radiance: [constant[0] * intensity, constant[1] * intensity, constant[2] * intensity] };
    const rotation = (settings.rotation * Math.PI) / 180;
    const own = choice === 'model' ? scene?.environment : choice === 'file' ? this.#file : undefined;
    const source = own ?? (this.#studio ??= studioEnvironment());
    if (source.type === 'constant') return { ...source, radiance: [source.radiance[0] * intensity, source.radiance[1] * intensity, source.radiance[2] * intensity] };
    return { ...source, intensity: (source.intensity ?? 1) * intensity, rotation: (source.rotation ?? 0) + rotation };
  }
}
