import type { SceneWarning } from '@glanz/scene';

/** Warnings that are kept; a file may be wrong in millions of places. */
export const MOST_WARNINGS = 1000;

/** Takes warnings up to a number, and counts the rest. Indistinguishable from an array to those who push. */
export class WarningList extends Array<SceneWarning> {
  #dropped = 0;

  /** Arrays that are made of it are plain ones. */
  static override get [Symbol.species](): ArrayConstructor {
    return Array;
  }

  override push(...warnings: SceneWarning[]): number {
    for (const warning of warnings) {
      if (this.length < MOST_WARNINGS) super.push(warning);
      else this.#dropped++;
    }
    return this.length;
  }

  /** A plain array, the last entry saying how many there were beyond. */
  finished(file: string, text: (message: string) => string): SceneWarning[] {
    const all = Array.from(this, (warning) => ({ ...warning, message: text(warning.message) }));
    if (this.#dropped > 0)
      all.push({ code: 'gltf/more-warnings', message: text(`${file}: there are ${this.#dropped} more warnings.`) });
    return all;
  }
}
