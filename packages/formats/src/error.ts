import { GlanzError, type SceneWarning } from '@glanz/scene';

/**
 * Thrown for files that cannot be read. Codes: `formats/malformed` (not valid in its format), `formats/truncated` (the
 * file ends too early), `formats/no-triangles` (nothing to show), `formats/missing-resource` (a file that cannot be
 * read), `formats/missing-decoder` (an optional package is needed), `formats/unsupported` (valid, but not supported),
 * `formats/unknown` (an unknown file extension).
 */
export class FormatError extends GlanzError {}

/** Warnings of one kind are counted instead of reported one by one. */
export class Tally {
  readonly #counts = new Map<string, { count: number; first: number; message: string }>();

  /** @param line Where in the file, from 1 on. */
  add(code: string, message: string, line: number): void {
    const known = this.#counts.get(code + message);
    if (known) known.count++;
    else this.#counts.set(code + message, { count: 1, first: line, message });
  }

  warnings(file: string): SceneWarning[] {
    return [...this.#counts].map(([key, { count, first, message }]) => ({
      code: key.slice(0, -message.length),
      message: `${file}: ${message} (line ${first}${count > 1 ? ` and ${count - 1} more` : ''}).`,
    }));
  }
}
