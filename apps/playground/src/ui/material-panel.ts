import { OPENPBR_PARAMETERS, type OpenPbrParameterInfo, type OpenPbrParameterName, type OpenPbrParameters } from '@glanz/openpbr';
import type { Material } from '@glanz/scene';
import { actingParameters } from './acting-parameters';
import { element } from './elements';
import { checkField, colourField, sliderField } from './fields';

type Values = Partial<OpenPbrParameters>;

const GROUP_TITLES: Readonly<Record<string, string>> = { thin_film: 'Thin film' };
const title = (name: string) => GROUP_TITLES[name] ?? name.charAt(0).toUpperCase() + name.slice(1).replaceAll('_', ' ');

/** A parameter's name without its group: `specular_roughness` under Specular is "Roughness". */
const shortTitle = ({ name, group }: OpenPbrParameterInfo) => title(name.startsWith(`${group}_`) ? name.slice(group.length + 1) : name);

interface Entry {
  readonly name: string;
  /** As the model says. */
  readonly loaded: Values;
  current: Values;
  readonly textures: NonNullable<Material['textures']>;
}

export interface MaterialPanelEvents {
  readonly onChange: (index: number, change: Values) => void;
}

/** The materials of a scene, and controls for the parameters of one. */
export class MaterialPanel {
  readonly element: HTMLElement;
  readonly #select = element('select', { id: 'material' });
  readonly #part = element('p', { class: 'note', id: 'material-part', 'aria-live': 'polite' });
  readonly #fields = element('div', { id: 'material-fields' });
  readonly #reset = element('button', { type: 'button', id: 'material-reset' }, 'Reset this material');
  readonly #events: MaterialPanelEvents;
  readonly #parameters = actingParameters();
  #materials: Entry[] = [];

  constructor(events: MaterialPanelEvents) {
    this.#events = events;
    this.#select.addEventListener('change', () => this.select(Number(this.#select.value)));
    this.#reset.addEventListener('click', () => this.#restore());
    this.element = element('div', {}, element('div', { class: 'field' }, element('label', { for: 'material' }, 'Material'), this.#select), this.#part, this.#fields, this.#reset);
    this.setMaterials([]);
  }

  /** Takes the materials of another scene. */
  setMaterials(materials: readonly Material[]): void {
    this.#materials = materials.map(({ name, parameters, textures }, index) => ({ name: name || `Material ${index + 1}`, loaded: parameters, current: { ...parameters }, textures: textures ?? {} }));
    this.#select.replaceChildren(...this.#materials.map(({ name }, index) => element('option', { value: index }, name)));
    this.#select.disabled = this.#reset.disabled = this.#materials.length === 0;
    this.select(0);
    this.#part.textContent = this.#materials.length === 0 ? 'There is no model yet.' : 'Click a part of the picture to choose its material.';
  }

  /** Shows the parameters of a material, and of which part it was picked. */
  select(index: number, part?: string): void {
    const material = this.#materials[index];
    if (!material) return this.#fields.replaceChildren();
    this.#select.value = String(index);
    this.#part.textContent = part === undefined ? '' : `Picked: ${part}`;
    const groups = new Map<string, HTMLElement[]>();
    for (const info of this.#parameters) {
      const field = this.#field(info, index);
      if (Object.hasOwn(material.textures, info.name)) field.append(element('span', { class: 'tag', title: 'A texture is multiplied by this value.' }, '× texture'));
      groups.set(info.group, [...(groups.get(info.group) ?? []), field]);
    }
    this.#fields.replaceChildren(...[...groups].map(([group, fields]) => element('fieldset', {}, element('legend', {}, title(group)), ...fields)));
  }

  #field(info: OpenPbrParameterInfo, index: number): HTMLElement {
    const material = this.#materials[index] as Entry;
    const change = (value: unknown) => {
      const values = { [info.name]: value } as Values;
      material.current = { ...material.current, ...values };
      this.#events.onChange(index, values);
    };
    const common = { id: `parameter-${info.name}`, label: shortTitle(info), hint: `${info.name}: ${info.doc}` };
    const value = material.current[info.name] ?? info.default;
    if (info.type === 'boolean') return checkField({ ...common, value: value as boolean, onInput: change }).element;
    if (info.type === 'color3') return colourField({ ...common, value: value as readonly [number, number, number], onInput: change }).element;
    const range = info.softRange ?? [0, 1];
    // A range of three orders of magnitude: most of it for the lower end.
    const curve = range[1] - range[0] >= 100 ? 3 : 1;
    const unit = info.unit === '1' ? undefined : info.unit;
    return sliderField({ ...common, value: value as number, range, hardRange: info.range, curve, unit, onInput: change }).element;
  }

  /** Back to what the model's file says; what it does not say is at OpenPBR's defaults. */
  #restore(): void {
    const index = Number(this.#select.value);
    const material = this.#materials[index];
    if (!material) return;
    const names = Object.keys(material.current) as OpenPbrParameterName[];
    const defaults = Object.fromEntries(names.map((name) => [name, OPENPBR_PARAMETERS[name].default]));
    material.current = { ...material.loaded };
    this.#events.onChange(index, { ...defaults, ...material.loaded } as Values);
    this.select(index);
  }
}
