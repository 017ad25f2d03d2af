import { chosenParts } from '../selection';
import type { PartGroup } from '../input/part-groups';
import { assignedMaterial } from '../viewer/assigned-material';
import type { Context } from './context';
import { element } from './elements';
import { toHex } from './fields';
import { icon } from './icons';
import { currentValue } from './material/edits';
import { flatRows, type Item, type PartRows } from './part-rows';

/** More rows than this in a group are found by searching. */
const MAX_ROWS = 400;
/** Groups are open at first while all rows together are no more than this. */
const MAX_OPEN_ROWS = 60;

type Modifiers = Pick<MouseEvent, 'ctrlKey' | 'metaKey' | 'shiftKey'>;

/**
 * The parts of a scene in the groups of their file, where it has some: a click chooses a part, or all of a group, with
 * Ctrl one more, with Shift all up to it; the eye hides what is chosen, Alt and the eye hide all others. Rows of a group
 * are made when it is opened.
 */
export class SceneTree {
  readonly elements: readonly HTMLElement[];
  readonly #context: Context;
  readonly #search = element('input', {
    type: 'search',
    id: 'part-search',
    placeholder: 'Search',
    'aria-label': 'Search parts',
  });
  readonly #order = element(
    'select',
    { id: 'part-order', 'aria-label': 'Order of parts' },
    element('option', { value: 'file' }, 'File order'),
    element('option', { value: 'material' }, 'By material'),
  );
  readonly #list = element('ul', { class: 'tree', id: 'parts', 'aria-label': 'Parts' });
  readonly #showAll = element('button', { type: 'button', id: 'show-all', class: 'quiet', hidden: true }, 'Show all');
  #tree: PartRows = flatRows([]);
  readonly #rows = new Map<Item, HTMLElement>();
  /** Groups that are open, as long as nothing is searched for. */
  #opened = new Set<Item>();
  /** Groups that are open now. */
  #open = this.#opened;
  /** Where a range begins. */
  #anchor: Item | undefined;
  /** Whether the selection is being changed here: its rows are in sight. */
  #choosing = false;

  constructor(context: Context) {
    this.#context = context;
    const { store, selection, onModel } = context;
    this.elements = [
      element('div', { class: 'tree-bar' }, this.#search, this.#order),
      element('div', { class: 'tree-bar' }, this.#showAll),
      this.#list,
    ];
    this.#search.addEventListener('input', () => this.#fill());
    this.#order.addEventListener('change', () => this.#fill());
    this.#showAll.addEventListener('click', () => store.set({ hidden: [] }, { label: 'Show all' }));
    this.#list.addEventListener('keydown', (event) => this.#key(event));
    store.subscribe((next, before) => {
      if (next.hidden !== before.hidden) this.#mark();
      if (next.materials !== before.materials) this.#colour();
    });
    selection.subscribe(({ instance }) => {
      if (instance !== undefined && !this.#choosing) this.#reveal(instance);
      this.#mark(true);
    });
    const read = () => void this.#read().catch(context.fail);
    onModel(read);
    read();
  }

  /** Takes over the parts of the model that is shown now. */
  async #read(): Promise<void> {
    const { scene, request } = this.#context.opened();
    const { instances, groups } = scene;
    const names = instances.map(({ name }, part) => name || `Part ${part + 1}`);
    const materials = () => instances.map(({ material }) => this.#materialName(material));
    const tree = groups ? new (await import('./part-tree')).PartTree(names, materials(), groups) : flatRows(names);
    if (this.#context.opened().request !== request) return;
    const before = this.#tree.groups;
    this.#tree = tree;
    this.#list.classList.toggle('nested', groups !== undefined);
    // Another pose of a model, in which parts appear or vanish, has the same groups.
    if (String(before.map(({ name }) => name)) !== String(tree.groups.map(({ name }) => name))) {
      this.#anchor = undefined;
      this.#opened = tree.opened(MAX_OPEN_ROWS);
    }
    this.#fill();
  }

  #materialName(index: number): string {
    return this.#context.opened().scene.materials[index]?.name || `Material ${index + 1}`;
  }

  #fill(): void {
    const requested = this.#search.value.trim().toLowerCase();
    const byMaterial = this.#order.value === 'material';
    const tree = this.#tree;
    tree.search(requested);
    this.#open = requested === '' ? this.#opened : tree.opened(MAX_ROWS);
    this.#rows.clear();
    const rows = byMaterial ? this.#byMaterial() : this.#level(tree.children());
    if (rows.length === 0) rows.push(element('li', { class: 'heading' }, 'No part has this name.'));
    this.#list.replaceChildren(...rows);
    this.#mark();
    this.#colour();
  }

  #byMaterial(): HTMLElement[] {
    const { scene } = this.#context.opened();
    const materialOf = (part: number) => scene.instances[part]?.material ?? 0;
    const parts = [...this.#tree.found].sort((a, b) => materialOf(a) - materialOf(b) || a - b);
    const rows: HTMLElement[] = [];
    let heading = -1;
    for (const part of parts.slice(0, MAX_ROWS)) {
      const material = materialOf(part);
      if (material !== heading)
        rows.push(element('li', { class: 'heading' }, this.#materialName((heading = material))));
      rows.push(this.#row(part));
    }
    return [...rows, ...more(parts.length)];
  }

  /** Rows of what lies in one group, with those in the open groups in it. */
  #level(items: readonly Item[]): HTMLElement[] {
    const rows = items.slice(0, MAX_ROWS).map((item) => {
      const row = this.#row(item);
      if (this.#open.has(item)) this.#unfold(item, row);
      return row;
    });
    return [...rows, ...more(items.length)];
  }

  #unfold(item: Item, row: HTMLElement): void {
    row.querySelector('.twisty')?.setAttribute('aria-expanded', 'true');
    row.append(element('ul', {}, ...this.#level(this.#tree.children(item))));
  }

  /** Opens or closes a group. */
  #fold(item: Item, open = !this.#open.has(item)): void {
    const row = this.#rows.get(item);
    if (!row || open === this.#open.has(item)) return;
    if (open) {
      this.#open.add(item);
      this.#unfold(item, row);
      this.#mark();
      this.#colour();
      return;
    }
    this.#open.delete(item);
    row.querySelector('.twisty')?.setAttribute('aria-expanded', 'false');
    const list = row.querySelector('ul');
    for (const inner of list?.querySelectorAll<HTMLElement>('[data-item]') ?? []) this.#rows.delete(itemOf(inner));
    list?.remove();
  }

  /** Opens the groups around a part. */
  #reveal(part: number): void {
    if (this.#rows.has(part) || this.#order.value === 'material') return;
    const around: Item[] = [];
    for (let at = this.#tree.parent(part); at !== undefined; at = this.#tree.parent(at)) around.push(at);
    for (const item of around.reverse()) this.#fold(item, true);
  }

  /** Dots in the colours that materials have now. */
  #colour(): void {
    const { store, opened } = this.#context;
    const { scene } = opened();
    for (const [part, row] of this.#rows) {
      const material = scene.instances[part]?.material ?? 0;
      const surface = scene.materials[material];
      const swatch = row.querySelector<HTMLElement>(':scope > .part > .swatch');
      if (swatch && surface)
        swatch.style.background = toHex(currentValue(store.state, surface, material, 'base_color'));
    }
  }

  #row(item: Item): HTMLElement {
    const group = this.#tree.group(item);
    const row = group ? this.#groupRow(item, group) : this.#partRow(item);
    this.#rows.set(item, row);
    return row;
  }

  #partRow(part: number): HTMLElement {
    const { scene } = this.#context.opened();
    const { labels, names } = this.#tree;
    const name = (this.#order.value === 'material' ? names : labels)[part] as string;
    const title = scene.materials[scene.instances[part]?.material ?? 0]?.name;
    return element(
      'li',
      { 'data-item': part },
      ...this.#buttons(part, name, title, element('i', { class: 'swatch' }), element('span', {}, name)),
    );
  }

  #groupRow(item: Item, { name, from, to }: PartGroup): HTMLElement {
    const [count, all] = [this.#tree.parts(item).length, to - from];
    const twisty = element('button', {
      type: 'button',
      class: 'twisty',
      'aria-expanded': 'false',
      'aria-label': `Parts of ${name}`,
    });
    twisty.addEventListener('click', () => this.#fold(item));
    const figure = element('small', { 'aria-hidden': 'true' }, count < all ? `${count} of ${all}` : String(all));
    return element(
      'li',
      { class: 'branch', 'data-item': item },
      element(
        'div',
        { class: 'row' },
        twisty,
        ...this.#buttons(item, name, `${name}: ${all} parts`, element('span', {}, name), figure),
      ),
    );
  }

  /** The button that chooses what a row stands for, and the eye. */
  #buttons(item: Item, name: string, title: string | undefined, ...contents: HTMLElement[]): HTMLElement[] {
    const choose = element('button', { type: 'button', class: 'part', title }, ...contents);
    choose.addEventListener('click', (event) => this.#choose(item, event));
    const eye = element('button', {
      type: 'button',
      class: 'eye',
      'aria-label': `Show ${name}`,
      title: 'Show or hide; with Alt, show only this part',
    });
    eye.addEventListener('click', (event) => this.#toggle(item, event.altKey));
    return [choose, eye];
  }

  /** All rows, from the top. */
  #inOrder(): HTMLElement[] {
    return [...this.#list.querySelectorAll<HTMLElement>('[data-item]')];
  }

  /** Chooses a part or a group: alone, with Ctrl beside the others, with Shift with all from the last one on. */
  #choose(item: Item, { ctrlKey, metaKey, shiftKey }: Modifiers): void {
    const former = ctrlKey || metaKey ? chosenParts(this.#context.selection.chosen) : [];
    const parts = this.#tree.parts(item);
    const rows = this.#inOrder().map(itemOf);
    const [from, to] = [rows.indexOf(this.#anchor ?? item), rows.indexOf(item)];
    if (shiftKey && from >= 0) {
      const range = rows.slice(Math.min(from, to), Math.max(from, to) + 1);
      // Parts of an open group have rows of their own.
      const between = range.filter((row) => row !== item && !this.#open.has(row));
      this.#select([...parts, ...former, ...between.flatMap((row) => this.#tree.parts(row))]);
      return;
    }
    this.#anchor = item;
    const chosen = new Set(former);
    const own = new Set(parts);
    this.#select(
      parts.every((part) => chosen.has(part)) ? former.filter((part) => !own.has(part)) : [...parts, ...former],
    );
  }

  /** Chooses these parts; the first one is the one whose values are shown. */
  #select(parts: readonly number[]): void {
    const { selection, opened, store } = this.#context;
    const [instance, ...others] = new Set(parts);
    this.#choosing = true;
    try {
      selection.choose(
        instance === undefined
          ? { material: selection.chosen.material }
          : { material: assignedMaterial(opened().scene, instance, store.state.variant), instance, others },
      );
    } finally {
      this.#choosing = false;
    }
  }

  /** Shows or hides a part or a group, and with it all that are chosen where it is among them. */
  #toggle(item: Item, alone: boolean): void {
    const { store, opened, say, selection } = this.#context;
    const hidden = new Set(store.state.hidden);
    const all = [...opened().scene.instances.keys()];
    const own = this.#tree.parts(item);
    const off = own.every((part) => hidden.has(part));
    const chosen = new Set(chosenParts(selection.chosen));
    const parts = own.every((part) => chosen.has(part)) ? chosen : new Set(own);
    const isAlone = hidden.size === all.length - parts.size && [...parts].every((part) => !hidden.has(part));
    const next = alone
      ? isAlone
        ? []
        : all.filter((part) => !parts.has(part))
      : off
        ? [...hidden].filter((part) => !parts.has(part))
        : [...new Set([...hidden, ...parts])];
    if (next.length >= all.length) return say('The last visible part cannot be hidden.');
    store.set(
      { hidden: next },
      {
        label: `${alone ? 'Show only' : off ? 'Show' : 'Hide'} ${parts.size > 1 ? `${parts.size} parts` : alone ? 'one part' : 'part'}`,
      },
    );
  }

  /** @param scroll Whether the chosen one comes into sight. */
  #mark(scroll = false): void {
    const { store, selection } = this.#context;
    const hidden = new Set(store.state.hidden);
    const chosen = new Set(chosenParts(selection.chosen));
    for (const [item, row] of this.#rows) {
      const parts = this.#tree.parts(item);
      const off = shareOf(parts, hidden);
      const on = shareOf(parts, chosen);
      const active = selection.chosen.instance === item;
      const line = lineOf(row);
      line.classList.toggle('off', off === 'true');
      line.classList.toggle('chosen', on === 'true');
      line.classList.toggle('partly', on === 'mixed');
      const [part, eye] = [line.querySelector('.part'), line.querySelector('.eye')];
      part?.setAttribute('aria-pressed', on);
      part?.setAttribute('aria-current', String(active));
      eye?.setAttribute('aria-pressed', off === 'mixed' ? off : String(off === 'false'));
      eye?.replaceChildren(icon(off === 'true' ? 'eyeOff' : 'eye'));
      // Not scrollIntoView, which would scroll the page as well.
      if (active && scroll && !this.#choosing && !row.contains(document.activeElement))
        this.#list.scrollTop +=
          row.getBoundingClientRect().top - this.#list.getBoundingClientRect().top - this.#list.clientHeight / 2;
    }
    this.#showAll.hidden = hidden.size === 0;
    this.#showAll.textContent = `Show all (${hidden.size} hidden)`;
  }

  #key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    const row = target.closest<HTMLElement>('[data-item]');
    if (!row) return;
    const item = itemOf(row);
    const rows = this.#inOrder();
    const at = rows.indexOf(row);
    const steps: Readonly<Record<string, number>> = {
      ArrowDown: at + 1,
      ArrowUp: at - 1,
      Home: 0,
      End: rows.length - 1,
    };
    const step = steps[event.key];
    if (step !== undefined) {
      const next = rows[step];
      const column = ['twisty', 'eye'].find((name) => target.classList.contains(name));
      const line = next && lineOf(next);
      (line?.querySelector<HTMLElement>(`.${column}`) ?? line?.querySelector<HTMLElement>('.part'))?.focus();
      if (next && event.shiftKey) this.#choose(itemOf(next), event);
    } else if (event.key === 'ArrowRight' || event.key === 'ArrowLeft') {
      const opens = event.key === 'ArrowRight';
      const group = this.#tree.group(item);
      // Into a group that is open, or out of one.
      if (group && this.#open.has(item) !== opens) this.#fold(item);
      else {
        const next = opens ? group && rows[at + 1] : this.#rowAround(item);
        if (next) lineOf(next).querySelector<HTMLElement>('.part')?.focus();
      }
    } else if (event.key === 'a' && (event.ctrlKey || event.metaKey)) {
      this.#anchor = rows[0] && itemOf(rows[0]);
      this.#select([...this.#tree.found].reverse());
    } else if (event.key === 'h') this.#toggle(item, event.altKey);
    else return;
    event.preventDefault();
  }

  #rowAround(item: Item): HTMLElement | undefined {
    const around = this.#tree.parent(item);
    return around === undefined ? undefined : this.#rows.get(around);
  }
}

/** What a row stands for. */
const itemOf = (row: HTMLElement): Item => Number(row.dataset['item']);

/** The line of a row, without those of the group that it opens. */
const lineOf = (row: HTMLElement): Element => row.querySelector(':scope > .row') ?? row;

/** Whether all, some or none of the parts are in a set, as `aria-pressed` says it. */
function shareOf(parts: readonly number[], set: ReadonlySet<number>): 'true' | 'mixed' | 'false' {
  if (set.size === 0) return 'false';
  const count = parts.reduce((sum, part) => sum + Number(set.has(part)), 0);
  return count === 0 ? 'false' : count === parts.length ? 'true' : 'mixed';
}

/** A line for rows that are not shown. */
const more = (rows: number): HTMLElement[] =>
  rows > MAX_ROWS ? [element('li', { class: 'heading' }, `${rows - MAX_ROWS} more: use the search`)] : [];
