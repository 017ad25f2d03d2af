/** Called after each change; `source` says what made it. */
export type Listener<S> = (next: S, before: S, source: 'change' | 'undo' | 'redo' | 'load') => void;

export interface ChangeOptions {
  /** What the change is called, e.g. "Roughness"; a change without a name is no step of undo. */
  readonly label?: string;
  /** Changes in a row of one key are one step, e.g. those of a slider that is dragged. Default: the label. */
  readonly merge?: string;
  /** Whether it joins a former step of this key however long ago that was: a drag is one step. */
  readonly held?: boolean;
}

interface Step<S> {
  readonly label: string;
  readonly before: S;
  readonly key: string;
  at: number;
}

/** Changes of one key further apart than this are steps of their own. */
const MERGE_MS = 1200;
const MAX_STEPS = 200;

/**
 * The one place where the state is, with its history. Steps hold former states whole, which is cheap: states share what
 * they have in common.
 */
export class Store<S extends object> {
  #state: S;
  #undo: Step<S>[] = [];
  #redo: { readonly label: string; readonly state: S }[] = [];
  readonly #listeners = new Set<Listener<S>>();
  readonly #outside: readonly (keyof S)[];
  readonly #now: () => number;

  /** @param outside Fields that undo leaves alone, such as where one looks from. */
  constructor(state: S, outside: readonly (keyof S)[] = [], now: () => number = () => performance.now()) {
    this.#state = state;
    this.#outside = outside;
    this.#now = now;
  }

  get state(): S {
    return this.#state;
  }

  /** Name of the step that undo would take back. */
  get undoLabel(): string | undefined {
    return this.#undo.at(-1)?.label;
  }

  get redoLabel(): string | undefined {
    return this.#redo.at(-1)?.label;
  }

  subscribe(listener: Listener<S>): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  set(change: Partial<S>, { label, merge, held = false }: ChangeOptions = {}): void {
    const keys = Object.keys(change) as (keyof S)[];
    if (keys.every((key) => Object.is(change[key], this.#state[key]))) return;
    if (label !== undefined) {
      const key = merge ?? label;
      const last = this.#undo.at(-1);
      if (last?.key === key && (held || this.#now() - last.at < MERGE_MS)) last.at = this.#now();
      else {
        this.#undo.push({ label, key, before: this.#state, at: this.#now() });
        if (this.#undo.length > MAX_STEPS) this.#undo.shift();
      }
      this.#redo = [];
    }
    this.#replace({ ...this.#state, ...change }, 'change');
  }

  /** @returns The name of what was taken back. */
  undo(): string | undefined {
    const step = this.#undo.pop();
    if (!step) return undefined;
    this.#redo.push({ label: step.label, state: this.#state });
    this.#replace(this.#keeping(step.before), 'undo');
    return step.label;
  }

  /** @returns The name of what was done again. */
  redo(): string | undefined {
    const step = this.#redo.pop();
    if (!step) return undefined;
    this.#undo.push({ label: step.label, key: '', before: this.#state, at: -Infinity });
    this.#replace(this.#keeping(step.state), 'redo');
    return step.label;
  }

  /** Another state without a past. */
  load(state: S): void {
    this.#undo = [];
    this.#redo = [];
    this.#replace(state, 'load');
  }

  #keeping(state: S): S {
    const kept = { ...state };
    for (const key of this.#outside) kept[key] = this.#state[key];
    return kept;
  }

  #replace(state: S, source: Parameters<Listener<S>>[2]): void {
    const before = this.#state;
    this.#state = state;
    for (const listener of this.#listeners) listener(state, before, source);
  }
}
