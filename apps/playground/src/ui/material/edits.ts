import { OPENPBR_PARAMETER_SPECS, type OpenPbrParameterName } from '@glanz/openpbr/parameters';
import type { Material, TexturedParameter } from '@glanz/scene';
import { slotKey, type Slot, type State, type Values } from '../../state/state';
import type { Store } from '../../state/store';

const same = (a: unknown, b: unknown) => JSON.stringify(a) === JSON.stringify(b);

/** A parameter as the model has it. */
export const loadedValue = <N extends OpenPbrParameterName>(material: Material, name: N) =>
  material.parameters[name] ?? OPENPBR_PARAMETER_SPECS[name].default;

/** A parameter as it is now. */
export const currentValue = <N extends OpenPbrParameterName>(
  state: State,
  material: Material,
  index: number,
  name: N,
) => state.materials[index]?.[name] ?? loadedValue(material, name);

/** An edit without what is as loaded anyway. */
function tidied(material: Material, edit: Values): Values {
  return Object.fromEntries(
    Object.entries(edit).filter(([name, value]) => !same(value, loadedValue(material, name as OpenPbrParameterName))),
  ) as Values;
}

function withEdit(materials: State['materials'], index: number, edit: Values): State['materials'] {
  const { [index]: _, ...others } = materials;
  return Object.keys(edit).length > 0 ? { ...others, [index]: edit } : others;
}

/** Changes parameters of materials as one step of undo. @param indices Of the materials that are changed. */
export function editMaterials(
  store: Store<State>,
  materials: readonly Material[],
  indices: readonly number[],
  values: Values,
  label: string,
): void {
  let edits = store.state.materials;
  for (const index of indices) {
    const material = materials[index];
    if (material) edits = withEdit(edits, index, tidied(material, { ...edits[index], ...values }));
  }
  store.set({ materials: edits }, { label, merge: `material ${indices.join()} ${Object.keys(values).join(' ')}` });
}

/** Puts an image on a parameter of materials, or takes it away, as one step of undo. @param indices Of the materials. */
export function editSlots(
  store: Store<State>,
  materials: readonly Material[],
  indices: readonly number[],
  parameter: TexturedParameter,
  slot: Slot,
): void {
  const slots = { ...store.state.slots };
  for (const index of indices) {
    const key = slotKey(index, parameter);
    // What the model did not have need not be taken away.
    if (slot === null && !materials[index]?.textures?.[parameter]) delete slots[key];
    else slots[key] = slot;
  }
  store.set({ slots }, { label: slot ? 'Texture' : 'Remove texture' });
}

/** The image that drives a parameter: set by the user, or part of the model. */
export function slotState(
  state: State,
  material: Material,
  index: number,
  parameter: OpenPbrParameterName,
): { readonly name: string; readonly own: boolean } | undefined {
  const key = slotKey(index, parameter as TexturedParameter);
  if (Object.hasOwn(state.slots, key)) {
    const slot = state.slots[key];
    return slot ? { name: slot.image.name, own: true } : undefined;
  }
  return material.textures?.[parameter as TexturedParameter] ? { name: 'the model’s', own: false } : undefined;
}

/**
 * Makes materials another one altogether: what it does not say is at the default, and images of the old one go.
 *
 * @param indices Of the materials that are replaced.
 * @param slots Images of the new one, by parameter.
 */
export function replaceMaterials(
  store: Store<State>,
  materials: readonly Material[],
  indices: readonly number[],
  values: Values,
  label: string,
  slots: Readonly<Record<string, Slot>> = {},
): void {
  const { state } = store;
  let edits = state.materials;
  let next = Object.entries(state.slots);
  for (const index of indices) {
    const material = materials[index];
    if (!material) continue;
    const defaults = Object.fromEntries(
      Object.keys(material.parameters).map((name) => [
        name,
        OPENPBR_PARAMETER_SPECS[name as OpenPbrParameterName].default,
      ]),
    ) as Values;
    edits = withEdit(edits, index, tidied(material, { ...defaults, ...values }));
    const gone = Object.keys(material.textures ?? {}).filter((name) => !name.startsWith('geometry_'));
    next = [
      ...next.filter(([key]) => !key.startsWith(`${index}/`)),
      ...gone.map((name): [string, Slot] => [`${index}/${name}`, null]),
      ...Object.entries(slots).map(([name, slot]): [string, Slot] => [`${index}/${name}`, slot]),
    ];
  }
  const changed =
    next.length !== Object.keys(state.slots).length || next.some(([key, slot]) => state.slots[key] !== slot);
  store.set(
    { materials: edits, ...(changed ? { slots: Object.fromEntries(next) } : {}) },
    { label, merge: `material ${indices.join()} ${label}` },
  );
}

/** Back to what the model says. @param indices Of the materials that are reset. */
export function resetMaterials(store: Store<State>, indices: readonly number[]): void {
  const { state } = store;
  const slots = Object.entries(state.slots).filter(([key]) => !indices.some((index) => key.startsWith(`${index}/`)));
  store.set(
    {
      materials: indices.reduce((edits, index) => withEdit(edits, index, {}), state.materials),
      ...(slots.length === Object.keys(state.slots).length ? {} : { slots: Object.fromEntries(slots) }),
    },
    { label: indices.length > 1 ? 'Reset materials' : 'Reset material' },
  );
}
