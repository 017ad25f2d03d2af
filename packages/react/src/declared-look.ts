import type { GlanzViewerElement } from '@glanz/element';

type Viewer = NonNullable<GlanzViewerElement['viewer']>;

/** Parameters of a material, as `Viewer.setMaterial` takes them. */
export type MaterialEdit = Parameters<Viewer['setMaterial']>[1];

/** Changes of a model relative to its file. */
export interface DeclaredLook {
  /** Parameters by the names of materials. */
  readonly materials?: Readonly<Record<string, MaterialEdit>> | undefined;
  /** Whether parts are shown, by their names. */
  readonly parts?: Readonly<Record<string, boolean>> | undefined;
}

type Values = Readonly<Record<string, unknown>>;

const same = (a: unknown, b: unknown) => a === b || JSON.stringify(a) === JSON.stringify(b);

/**
 * Keeps one loaded model as its look is declared: sets what has changed since the last time, and returns to the file's
 * own values what is declared no more.
 */
export class LookKeeper {
  readonly #viewer: Viewer;
  readonly #report: (error: unknown) => void;
  #applied: DeclaredLook = {};
  /** Values of the file, by material and parameter; `undefined`: it has none, and the default counts. */
  readonly #parameters = new Map<string, Record<string, unknown>>();
  /** When all edits so far have begun: one that waits for defaults holds up those that follow. */
  #begun: Promise<void> = Promise.resolve();
  /** Whether the file shows its parts, by index. */
  readonly #shown: readonly boolean[];

  /**
   * @param viewer With a model that has just been loaded.
   * @param report Called with each error of an edit.
   */
  constructor(viewer: Viewer, report: (error: unknown) => void) {
    this.#viewer = viewer;
    this.#report = report;
    this.#shown = (viewer.scene?.instances ?? []).map(({ visible }) => visible !== false);
  }

  /** Makes the model look as declared. Edits begin in the order of their calls. */
  apply({ materials = {}, parts = {} }: DeclaredLook): void {
    const before = this.#applied;
    this.#applied = { materials, parts };
    for (const name of new Set([...Object.keys(before.materials ?? {}), ...Object.keys(materials)]))
      this.#setMaterial(name, (before.materials?.[name] ?? {}) as Values, (materials[name] ?? {}) as Values);
    for (const name of new Set([...Object.keys(before.parts ?? {}), ...Object.keys(parts)]))
      if (before.parts?.[name] !== parts[name]) this.#setPart(name, parts[name]);
  }

  #setMaterial(name: string, before: Values, now: Values): void {
    const names = new Set([...Object.keys(before), ...Object.keys(now)]);
    const changed = [...names].filter((parameter) => !same(before[parameter], now[parameter]));
    if (changed.length === 0) return;
    const own = this.#viewer.scene?.materials.find((material) => material.name === name)?.parameters as
      | Values
      | undefined;
    const kept = this.#parameters.get(name) ?? {};
    this.#parameters.set(name, kept);
    for (const parameter of changed) if (!(parameter in kept)) kept[parameter] = own?.[parameter];
    const edit = Object.fromEntries(changed.map((parameter) => [parameter, now[parameter] ?? kept[parameter]]));
    const missing = changed.filter((parameter) => edit[parameter] === undefined);
    const whole = missing.length === 0 ? edit : withDefaults(edit, missing);
    this.#begun = Promise.all([whole, this.#begun])
      .then(([all]) => void this.#viewer.setMaterial(name, all as MaterialEdit).catch(this.#report))
      .catch(this.#report);
  }

  #setPart(name: string, shown: boolean | undefined): void {
    const viewer = this.#viewer;
    if (shown !== undefined) {
      viewer.setVisibility(name, shown).catch(this.#report);
      return;
    }
    for (const [index, part] of (viewer.scene?.instances ?? []).entries())
      if (part.name === name) viewer.setVisibility(index, this.#shown[index] ?? true).catch(this.#report);
  }
}

/** The defaults of OpenPBR for parameters that the file does not have. */
async function withDefaults(edit: Values, missing: readonly string[]): Promise<Values> {
  const { OPENPBR_PARAMETER_SPECS } = await import('@glanz/openpbr/parameters');
  const specs = OPENPBR_PARAMETER_SPECS as Readonly<Record<string, { readonly default: unknown } | undefined>>;
  return { ...edit, ...Object.fromEntries(missing.map((name) => [name, specs[name]?.default])) };
}
