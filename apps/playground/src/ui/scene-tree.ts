import { chosenParts, toggled, withParts } from '../selection';
import { assignedMaterial } from '../viewer/assigned-material';
import type { Context } from './context';
import { element } from './elements';
import { toHex } from './fields';
import { icon } from './icons';
import { currentValue } from './material/edits';

/** More rows than this are found by searching. */
const MAX_ROWS = 400;

type Modifiers = Pick<MouseEvent, 'ctrlKey' | 'metaKey' | 'shiftKey'>;

/**
 * The parts of a scene: a click chooses one, with Ctrl one more, with Shift all up to it; the eye hides what is chosen,
 * Alt and the eye hide all others.
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
  #rows = new Map<number, HTMLElement>();
  /** Where a range begins. */
  #anchor: number | undefined;

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
    selection.subscribe(() => this.#mark(true));
    onModel(() => this.#fill());
    this.#fill();
  }

  #fill(): void {
    const { scene } = this.#context.opened();
    const requested = this.#search.value.trim().toLowerCase();
    const name = (index: number) => scene.instances[index]?.name || `Part ${index + 1}`;
    const indices = scene.instances
      .map((_, index) => index)
      .filter((index) => name(index).toLowerCase().includes(requested));
    const byMaterial = this.#order.value === 'material';
    if (byMaterial)
      indices.sort((a, b) => (scene.instances[a]?.material ?? 0) - (scene.instances[b]?.material ?? 0) || a - b);
    this.#rows = new Map();
    const rows: HTMLElement[] = [];
    let heading = -1;
    for (const index of indices.slice(0, MAX_ROWS)) {
      const material = scene.instances[index]?.material ?? 0;
      if (byMaterial && material !== heading)
        rows.push(
          element(
            'li',
            { class: 'heading' },
            scene.materials[(heading = material)]?.name || `Material ${material + 1}`,
          ),
        );
      const row = this.#row(index, name(index), material);
      this.#rows.set(index, row);
      rows.push(row);
    }
    if (indices.length > MAX_ROWS)
      rows.push(element('li', { class: 'heading' }, `${indices.length - MAX_ROWS} more parts: use the search`));
    if (indices.length === 0) rows.push(element('li', { class: 'heading' }, 'No part has this name.'));
    this.#list.replaceChildren(...rows);
    this.#mark();
    this.#colour();
  }

  /** Dots in the colours that materials have now. */
  #colour(): void {
    const { store, opened } = this.#context;
    const { scene } = opened();
    for (const [index, row] of this.#rows) {
      const material = scene.instances[index]?.material ?? 0;
      const surface = scene.materials[material];
      const swatch = row.querySelector<HTMLElement>('.swatch');
      if (swatch && surface)
        swatch.style.background = toHex(currentValue(store.state, surface, material, 'base_color'));
    }
  }

  #row(index: number, name: string, material: number): HTMLElement {
    const { scene } = this.#context.opened();
    const part = element(
      'button',
      { type: 'button', class: 'part', title: scene.materials[material]?.name },
      element('i', { class: 'swatch' }),
      element('span', {}, name),
    );
    part.addEventListener('click', (event) => this.#choose(index, event));
    const eye = element('button', {
      type: 'button',
      class: 'eye',
      'aria-label': `Show ${name}`,
      title: 'Show or hide; with Alt, show only this part',
    });
    eye.addEventListener('click', (event) => this.#toggle(index, event.altKey));
    return element('li', { 'data-part': index }, part, eye);
  }

  /** Chooses a part: alone, with Ctrl beside the others, with Shift with all from the last one on. */
  #choose(index: number, { ctrlKey, metaKey, shiftKey }: Modifiers): void {
    const { selection, opened, store } = this.#context;
    const materialOf = (part: number) => assignedMaterial(opened().scene, part, store.state.variant);
    const rows = [...this.#rows.keys()];
    const [from, to] = [rows.indexOf(this.#anchor ?? index), rows.indexOf(index)];
    const adds = ctrlKey || metaKey;
    const former = adds ? selection.chosen : { material: 0 };
    if (shiftKey && from >= 0) {
      const range = rows.slice(Math.min(from, to), Math.max(from, to) + 1);
      selection.choose(withParts(former, [...range.filter((part) => part !== index), index], materialOf));
      return;
    }
    this.#anchor = index;
    selection.choose(adds ? toggled(former, index, materialOf) : withParts(former, [index], materialOf));
  }

  /** Shows or hides a part, and with it all that are chosen where it is one of them. */
  #toggle(index: number, alone: boolean): void {
    const { store, opened, say, selection } = this.#context;
    const { hidden } = store.state;
    const all = opened().scene.instances.map((_, i) => i);
    const off = hidden.includes(index);
    const chosen = chosenParts(selection.chosen);
    const parts = new Set(chosen.includes(index) ? chosen : [index]);
    const next = alone
      ? hidden.length === all.length - parts.size && !off
        ? []
        : all.filter((i) => !parts.has(i))
      : off
        ? hidden.filter((i) => !parts.has(i))
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
    const parts = new Set(chosenParts(selection.chosen));
    for (const [index, row] of this.#rows) {
      const off = hidden.has(index);
      const chosen = parts.has(index);
      const active = selection.chosen.instance === index;
      row.classList.toggle('off', off);
      row.classList.toggle('chosen', chosen);
      const [part, eye] = row.children as unknown as [HTMLElement, HTMLElement];
      part.setAttribute('aria-pressed', String(chosen));
      part.setAttribute('aria-current', String(active));
      eye.setAttribute('aria-pressed', String(!off));
      eye.replaceChildren(icon(off ? 'eyeOff' : 'eye'));
      // Not scrollIntoView, which would scroll the page as well.
      if (active && scroll && !row.contains(document.activeElement))
        this.#list.scrollTop +=
          row.getBoundingClientRect().top - this.#list.getBoundingClientRect().top - this.#list.clientHeight / 2;
    }
    this.#showAll.hidden = hidden.size === 0;
    this.#showAll.textContent = `Show all (${hidden.size} hidden)`;
  }

  #key(event: KeyboardEvent): void {
    const row = (event.target as HTMLElement).closest('li');
    const step = event.key === 'ArrowDown' ? 1 : event.key === 'ArrowUp' ? -1 : 0;
    if (row && step !== 0) {
      const rows = [...this.#rows.values()];
      const next = rows[rows.indexOf(row) + step];
      const at = [...row.children].indexOf(event.target as Element);
      (next?.children[Math.max(0, at)] as HTMLElement | undefined)?.focus();
      if (next && event.shiftKey) this.#choose(Number(next.dataset['part']), event);
      event.preventDefault();
    }
    if (row && event.key === 'a' && (event.ctrlKey || event.metaKey)) {
      const [first] = this.#rows.keys();
      this.#anchor = first;
      this.#choose([...this.#rows.keys()].at(-1) as number, { shiftKey: true, ctrlKey: false, metaKey: false });
      event.preventDefault();
    }
    if (row && event.key === 'h') {
      this.#toggle(Number(row.dataset['part']), event.altKey);
      event.preventDefault();
    }
  }
}
