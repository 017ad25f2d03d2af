import type { PartGroup } from '../input/part-groups';
import type { Item, PartRows } from './part-rows';

const groupOf = (item: Item): number => -1 - item;
/** The row of a group. */
export const itemOf = (group: number): Item => -1 - group;
const isGroup = (item: Item): boolean => item < 0;

/** The parts of a scene in their groups. */
export class PartTree implements PartRows {
  /** The parts of one node go by their materials. */
  readonly labels: readonly string[];
  readonly names: readonly string[];
  readonly groups: readonly PartGroup[];
  /** Innermost group around each part; −1: none. */
  readonly #around: Int32Array;
  /** Group around each group; −1: none. */
  readonly #above: Int32Array;
  readonly #below: number[][];
  readonly #roots: number[] = [];
  /** Parts that a search has found; undefined without one. */
  #found: Uint8Array | undefined;
  /** Whether groups hold what a search has found by its own name. */
  #inside = new Uint8Array();

  /**
   * @param names Of the parts.
   * @param materials Names of the parts' materials.
   * @param groups Each before those in it.
   */
  constructor(names: readonly string[], materials: readonly string[], groups: readonly PartGroup[]) {
    this.names = names;
    this.groups = groups;
    this.#around = new Int32Array(names.length).fill(-1);
    this.#above = new Int32Array(groups.length).fill(-1);
    this.#below = groups.map(() => []);
    const open: number[] = [];
    groups.forEach(({ from, to }, index) => {
      while (open.length > 0 && (groups[open.at(-1) as number] as PartGroup).to <= from) open.pop();
      const above = open.at(-1);
      if (above === undefined) this.#roots.push(index);
      else {
        this.#above[index] = above;
        this.#below[above]?.push(index);
      }
      open.push(index);
      this.#around.fill(index, from, to);
    });
    this.labels = this.#labelled(materials);
  }

  group(item: Item): PartGroup | undefined {
    return this.groups[groupOf(item)];
  }

  search(text: string): void {
    this.#found = undefined;
    if (text === '') return;
    const found = new Uint8Array(this.labels.length);
    const inside = new Uint8Array(this.groups.length);
    const mark = (group: number) => {
      for (let at = group; at >= 0 && inside[at] === 0; at = this.#above[at] as number) inside[at] = 1;
    };
    this.labels.forEach((label, part) => {
      if (!label.toLowerCase().includes(text)) return;
      found[part] = 1;
      mark(this.#around[part] as number);
    });
    this.groups.forEach(({ name, from, to }, group) => {
      if (!name.toLowerCase().includes(text)) return;
      found.fill(1, from, to);
      mark(this.#above[group] as number);
    });
    this.#found = found;
    this.#inside = inside;
  }

  get found(): number[] {
    return [...this.labels.keys()].filter((part) => this.#found?.[part] !== 0);
  }

  parts(item: Item): number[] {
    if (!isGroup(item)) return [item];
    const { from, to } = this.groups[groupOf(item)] as PartGroup;
    const parts: number[] = [];
    for (let part = from; part < to; part++) if (this.#found?.[part] !== 0) parts.push(part);
    return parts;
  }

  children(item?: Item): Item[] {
    const group = item === undefined ? undefined : (this.groups[groupOf(item)] as PartGroup);
    const below = item === undefined ? this.#roots : (this.#below[groupOf(item)] ?? []);
    const children: Item[] = [];
    let next = 0;
    for (let part = group?.from ?? 0; part < (group?.to ?? this.labels.length);) {
      const index = below[next];
      const nested = index === undefined ? undefined : this.groups[index];
      if (index !== undefined && nested?.from === part) {
        if (this.#holds(nested)) children.push(itemOf(index));
        part = nested.to;
        next++;
      } else {
        if (this.#found?.[part] !== 0) children.push(part);
        part++;
      }
    }
    return children;
  }

  parent(item: Item): Item | undefined {
    const group = (isGroup(item) ? this.#above[groupOf(item)] : this.#around[item]) ?? -1;
    return group < 0 ? undefined : itemOf(group);
  }

  opened(maxRows: number): Set<Item> {
    const open = new Set<Item>();
    let level = this.children();
    let rows = level.length;
    while (level.length > 0) {
      const next: Item[] = [];
      for (const item of level) {
        if (!isGroup(item) || (this.#found && this.#inside[groupOf(item)] === 0)) continue;
        const children = this.children(item);
        if (rows + children.length > maxRows) continue;
        rows += children.length;
        open.add(item);
        next.push(...children.filter(isGroup));
      }
      level = next;
    }
    return open;
  }

  #holds({ from, to }: PartGroup): boolean {
    const found = this.#found;
    return !found || found.subarray(from, to).includes(1);
  }

  /** Of one node with several materials, all parts have the node's name. */
  #labelled(materials: readonly string[]): string[] {
    const { groups, names } = this;
    const used = groups.map(() => new Set<string>());
    const own = names.map((name, part) => {
      const group = this.#around[part] as number;
      return groups[group]?.name.split(' / ').at(-1) === name ? used[group] : undefined;
    });
    own.forEach((set, part) => set?.add(materials[part] as string));
    return names.map((name, part) => ((own[part]?.size ?? 0) > 1 ? (materials[part] as string) : name));
  }
}
