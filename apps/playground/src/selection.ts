/** What is chosen: a part, and the material whose values are shown. */
export interface Chosen {
  readonly material: number;
  /** Index of the part, or undefined if the material was chosen by itself. */
  readonly instance?: number | undefined;
}

/** The chosen part and material, and their listeners. */
export class Selection {
  #chosen: Chosen = { material: 0 };
  readonly #listeners = new Set<(chosen: Chosen) => void>();

  get chosen(): Chosen {
    return this.#chosen;
  }

  subscribe(listener: (chosen: Chosen) => void): void {
    this.#listeners.add(listener);
  }

  choose(chosen: Chosen): void {
    this.#chosen = chosen;
    for (const listener of this.#listeners) listener(chosen);
  }
}
