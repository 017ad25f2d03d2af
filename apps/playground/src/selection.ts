/** What is chosen: parts, and the material whose values are shown. */
export interface Chosen {
  readonly material: number;
  /** Index of the part that was chosen last, or undefined if the material was chosen by itself. */
  readonly instance?: number | undefined;
  /** Further parts that edits apply to. */
  readonly others?: readonly number[] | undefined;
}

/** All chosen parts, the one that was chosen last first. */
export const chosenParts = ({ instance, others = [] }: Chosen): readonly number[] =>
  instance === undefined ? [] : [instance, ...others];

/** The selection with these parts added; the last one is the part whose values are shown. */
export function withParts(chosen: Chosen, parts: readonly number[], materialOf: (part: number) => number): Chosen {
  const instance = parts.at(-1);
  if (instance === undefined) return chosen;
  const others = [...new Set([...chosenParts(chosen), ...parts])].filter((part) => part !== instance);
  return { material: materialOf(instance), instance, others };
}

/** The selection with a part more, or without it where it was chosen. */
export function toggled(chosen: Chosen, part: number, materialOf: (part: number) => number): Chosen {
  const parts = chosenParts(chosen);
  if (!parts.includes(part)) return withParts(chosen, [part], materialOf);
  const [instance, ...others] = parts.filter((one) => one !== part);
  return instance === undefined ? { material: chosen.material } : { material: materialOf(instance), instance, others };
}

/** The chosen parts and material, and their listeners. */
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
