import { RenderError } from '../errors';
import type { LightGroup } from '../options';
import type { GroupWeights } from './layers';

/** How the light groups of an image are set, see `PathTracer.setLightGroup`. */
export class GroupSettings {
  readonly #names: () => readonly string[];
  /** By name; groups that were never set are not in it. */
  readonly #set = new Map<string, LightGroup>();

  /** @param names Of the groups that there are now, in the order of the film's light passes. */
  constructor(names: () => readonly string[]) {
    this.#names = names;
  }

  get list(): readonly LightGroup[] {
    return this.#names().map((name) => this.#set.get(name) ?? { name, intensity: 1, color: [1, 1, 1] });
  }

  get weights(): GroupWeights {
    return this.list.map(({ intensity, color }) => [intensity * color[0], intensity * color[1], intensity * color[2]]);
  }

  /** The light pass of a group. @throws {RenderError} `renderer/light-groups` if there is none of this name. */
  lightPass(name: string): number {
    const pass = this.#names().indexOf(name);
    if (pass < 0)
      throw new RenderError(
        'renderer/light-groups',
        `The scene has no light group "${name}"; it has: ${this.#names().join(', ')}.`,
      );
    return pass;
  }

  /**
   * @returns Sets the group back to what it was.
   * @throws {RenderError} `renderer/light-groups` for an unknown group or a value out of range
   */
  set(name: string, settings: Partial<Pick<LightGroup, 'intensity' | 'color'>>): () => void {
    const before = this.#set.get(name);
    const next = { ...(this.list[this.lightPass(name)] as LightGroup), ...settings, name };
    if (![next.intensity, ...next.color].every((value) => value >= 0 && value < Infinity)) {
      throw new RenderError(
        'renderer/light-groups',
        `Light group "${name}": intensity and colour must be finite and not negative.`,
      );
    }
    this.#set.set(name, next);
    return () => {
      if (this.#set.get(name) !== next) return;
      if (before) this.#set.set(name, before);
      else this.#set.delete(name);
    };
  }
}
