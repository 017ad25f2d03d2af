import { OPENPBR_PARAMETERS, type OpenPbrParameterInfo, type OpenPbrParameterName } from '@glanz/openpbr/parameters';
import type { Material } from '@glanz/scene';
import type { Values } from '../../state/state';
import type { Context } from '../context';
import { element } from '../elements';
import { checkField, colourField, sliderField, type Field } from '../fields';
import { actingParameters } from './acting-parameters';
import { chosenMaterials } from '../../viewer/assigned-material';
import { chosenParts, type Chosen } from '../../selection';
import { currentValue, editMaterials, loadedValue, resetMaterials } from './edits';
import { textureSlot } from './texture-slot';

const GROUP_TITLES: Readonly<Record<string, string>> = { thin_film: 'Thin film' };
const capital = (name: string) =>
  (name === 'ior' ? 'IOR' : undefined) ??
  GROUP_TITLES[name] ??
  name.charAt(0).toUpperCase() + name.slice(1).replaceAll('_', ' ');

/** A parameter's name without its group: `specular_roughness` under Specular is "Roughness". */
const shortTitle = ({ name, group }: OpenPbrParameterInfo) =>
  capital(name.startsWith(`${group}_`) ? name.slice(group.length + 1) : name);

/** Groups that are open without being asked. */
const FIRST_GROUPS = new Set(['base', 'specular']);

interface Row {
  readonly name: OpenPbrParameterName;
  readonly group: string;
  readonly field: Field<never> | undefined;
  readonly refreshSlot: () => void;
}

/** The materials of a scene, and every parameter of one in the groups of the specification. */
export class MaterialInspector {
  readonly element: HTMLElement;
  readonly #context: Context;
  readonly #select = element('select', { id: 'material' });
  readonly #part = element('p', { class: 'note', id: 'material-part', 'aria-live': 'polite' });
  readonly #fields = element('div', { id: 'material-fields' });
  readonly #reset = element('button', { type: 'button', id: 'material-reset' }, 'Reset this material');
  readonly #acting = actingParameters();
  readonly #open = new Set(FIRST_GROUPS);
  readonly #dots = new Map<string, HTMLElement>();
  #rows: Row[] = [];
  #index = 0;

  /** @param extras Presets and files, between the list of materials and its values. */
  constructor(context: Context, ...extras: HTMLElement[]) {
    this.#context = context;
    const { selection, store, onModel } = context;
    this.#select.addEventListener('change', () => selection.choose({ material: Number(this.#select.value) }));
    this.#reset.addEventListener('click', () => resetMaterials(store, this.#targets()));
    this.element = element(
      'div',
      {},
      element(
        'div',
        { class: 'field material-choice' },
        element('label', { for: 'material' }, 'Material'),
        this.#select,
      ),
      this.#part,
      ...extras,
      this.#fields,
      element('div', { class: 'section' }, this.#reset),
    );
    selection.subscribe((chosen) => this.#show(chosen));
    onModel(() => this.#fill());
    store.subscribe((next, before) => {
      if (next.materials !== before.materials || next.slots !== before.slots) this.#refresh();
    });
    this.#fill();
  }

  #fill(): void {
    const { scene } = this.#context.opened();
    this.#select.replaceChildren(
      ...scene.materials.map(({ name }, index) => element('option', { value: index }, name || `Material ${index + 1}`)),
    );
    this.#show({ material: 0 });
    this.#part.textContent = 'Click a part in the image to select its material.';
  }

  /** Materials that edits apply to. */
  #targets(): readonly number[] {
    const { selection, opened, store } = this.#context;
    const materials = chosenMaterials(opened().scene, selection.chosen, store.state.variant);
    return materials.includes(this.#index) ? materials : [this.#index];
  }

  /** What is chosen, in words. */
  #picked(chosen: Chosen): string {
    const { scene } = this.#context.opened();
    const [part, ...others] = chosenParts(chosen);
    if (part === undefined) return '';
    const name = scene.instances[part]?.name || `part ${part + 1}`;
    if (others.length === 0) return `Selected: ${name}`;
    const materials = this.#targets().length;
    return `Selected: ${name} and ${others.length} more, ${materials === 1 ? 'one material' : `${materials} materials`}; edits apply to all.`;
  }

  #show(chosen: Chosen): void {
    const index = chosen.material;
    const { scene } = this.#context.opened();
    const material = scene.materials[index];
    this.#index = index;
    this.#rows = [];
    this.#dots.clear();
    if (!material) return this.#fields.replaceChildren();
    this.#select.value = String(index);
    this.#part.textContent = this.#picked(chosen);
    this.#reset.textContent = this.#targets().length > 1 ? 'Reset these materials' : 'Reset this material';
    const groups = new Map<string, HTMLElement[]>();
    for (const info of Object.values(OPENPBR_PARAMETERS) as OpenPbrParameterInfo[]) {
      groups.set(info.group, [...(groups.get(info.group) ?? []), this.#row(info, material)]);
    }
    this.#fields.replaceChildren(...[...groups].map(([group, rows]) => this.#group(group, rows)));
    this.#refresh();
  }

  #group(group: string, rows: HTMLElement[]): HTMLElement {
    const dot = element('span', { class: 'dot', title: 'Changed from the model', hidden: true });
    this.#dots.set(group, dot);
    const details = element(
      'details',
      { class: 'group', 'data-group': group, open: this.#open.has(group) },
      element('summary', {}, capital(group), dot),
      element('div', { class: 'fields' }, ...rows),
    );
    details.addEventListener('toggle', () => (details.open ? this.#open.add(group) : this.#open.delete(group)));
    return details;
  }

  #row(info: OpenPbrParameterInfo, material: Material): HTMLElement {
    const { name, group, doc, type } = info;
    const title = shortTitle(info);
    const field = this.#field(info, title, material);
    const row =
      field?.element ??
      element(
        'div',
        { class: 'field', title: `${name}: ${doc}` },
        element('span', { class: 'label' }, title),
        element('span', { class: 'note wide' }, type === 'vector3' ? 'set by a texture' : ''),
      );
    const refreshSlot = info.texturable
      ? textureSlot(this.#context, this.#index, name, `${capital(group)} ${title}`, row, () => this.#targets())
      : () => undefined;
    if (!this.#acting.has(name)) {
      row.classList.add('idle');
      row.title = `${name}: ${doc} Saved in files, but not used by the renderer yet.`;
    }
    this.#rows.push({ name, group, field: field as Field<never> | undefined, refreshSlot });
    return row;
  }

  #field(info: OpenPbrParameterInfo, title: string, material: Material): Field<never> | undefined {
    const { name, type, doc } = info;
    if (type === 'vector3') return undefined;
    const { store } = this.#context;
    const index = this.#index;
    const { materials } = this.#context.opened().scene;
    const onInput = (value: unknown) =>
      editMaterials(store, materials, this.#targets(), { [name]: value } as Values, title);
    const common = { id: `parameter-${name}`, label: title, hint: `${name}: ${doc}`, onInput };
    const value = currentValue(store.state, material, index, name) as unknown;
    const initial = loadedValue(material, name) as unknown;
    if (type === 'boolean')
      return checkField({ ...common, value: value as boolean, initial: initial as boolean }) as unknown as Field<never>;
    if (type === 'color3')
      return colourField({
        ...common,
        value: value as readonly [number, number, number],
        initial: initial as readonly [number, number, number],
      }) as unknown as Field<never>;
    const range = info.softRange ?? [0, 1];
    // A range of three orders of magnitude: most of it for the lower end.
    const curve = range[1] - range[0] >= 100 ? 3 : 1;
    return sliderField({
      ...common,
      value: value as number,
      initial: initial as number,
      range,
      hardRange: info.range,
      curve,
      unit: info.unit === '1' ? undefined : info.unit === 'length' ? 'm' : info.unit,
    }) as unknown as Field<never>;
  }

  /** Values as the state says now, for undo and links change them too. */
  #refresh(): void {
    const { store, opened } = this.#context;
    const material = opened().scene.materials[this.#index];
    if (!material) return;
    const edit = store.state.materials[this.#index] ?? {};
    const changed = new Set<string>();
    for (const { name, group, field, refreshSlot } of this.#rows) {
      // The control that the user is moving already shows its value.
      if (field && !field.element.contains(document.activeElement))
        field.set(currentValue(store.state, material, this.#index, name) as never);
      else if (field && !Object.hasOwn(edit, name)) field.set(loadedValue(material, name) as never);
      refreshSlot();
      if (Object.hasOwn(edit, name) || Object.hasOwn(store.state.slots, `${this.#index}/${name}`)) changed.add(group);
    }
    for (const [group, dot] of this.#dots) dot.hidden = !changed.has(group);
    this.#reset.disabled = !this.#targets().some(
      (index) =>
        Object.hasOwn(store.state.materials, index) ||
        Object.keys(store.state.slots).some((key) => key.startsWith(`${index}/`)),
    );
  }
}
