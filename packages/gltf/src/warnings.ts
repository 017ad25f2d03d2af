import type { SceneWarning } from '@glanz/scene';

/** Max warnings that are kept: a file may be wrong in millions of places. */
export const MAX_WARNINGS = 1000;

/** An array that keeps {@link MAX_WARNINGS} warnings and counts the rest. */
export class WarningList extends Array<SceneWarning> {
  #dropped = 0;

  /** `map`, `filter` and the like return plain arrays. */
  static override get [Symbol.species](): ArrayConstructor {
    return Array;
  }

  override push(...warnings: SceneWarning[]): number {
    for (const warning of warnings) {
      if (this.length < MAX_WARNINGS) super.push(warning);
      else this.#dropped++;
    }
    return this.length;
  }

  /** A plain array; its last entry says how many warnings were dropped. */
  finished(file: string, text: (message: string) => string): SceneWarning[] {
    const all = Array.from(this, (warning) => ({ ...warning, message: text(warning.message) }));
    if (this.#dropped > 0)
      all.push({ code: 'gltf/more-warnings', message: text(`${file}: there are ${this.#dropped} more warnings.`) });
    return all;
  }
}
