import type { PartGroup } from '../input/part-groups';

/** A row of the list of parts: the index of a part, or −1 − the index of a group. */
export type Item = number;

/** What the list of parts shows: a scene's parts, in groups or without, and what a search leaves of them. */
export interface PartRows {
  /** What parts are called by themselves. */
  readonly names: readonly string[];
  /** What they are called where the groups around them are seen. */
  readonly labels: readonly string[];
  readonly groups: readonly PartGroup[];
  /** All parts that are not filtered out, in the order of the file. */
  readonly found: readonly number[];
  /** Shows only parts and groups whose names contain a text in lower case; with an empty one, all. */
  search(text: string): void;
  /** The group that a row stands for; undefined for a part. */
  group(item: Item): PartGroup | undefined;
  /** Parts that a row stands for and that are not filtered out, in the order of the file. */
  parts(item: Item): readonly number[];
  /** Rows in a group, or those that are in none. */
  children(item?: Item): readonly Item[];
  /** The group around a row. */
  parent(item: Item): Item | undefined;
  /**
   * Groups to show open at first: level by level, those in which a search has found something, or all, while there are
   * at most so many rows.
   */
  opened(maxRows: number): Set<Item>;
}

/** The parts of a scene without groups. */
export function flatRows(names: readonly string[]): PartRows {
  let found: readonly number[] = [...names.keys()];
  return {
    names,
    labels: names,
    groups: [],
    get found() {
      return found;
    },
    search: (text) => (found = [...names.keys()].filter((part) => names[part]?.toLowerCase().includes(text))),
    group: () => undefined,
    parts: (part) => [part],
    children: () => found,
    parent: () => undefined,
    opened: () => new Set(),
  };
}
