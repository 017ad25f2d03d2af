import type { GroupSettings } from '../state/state';
import { watch, type Context } from './context';
import { element } from './elements';
import { checkField, colourField, section, sliderField } from './fields';

const UNSET: GroupSettings = { intensity: 1, color: [1, 1, 1] };

/** Intensity and colour of every light group, applied to the finished image. */
export function lightGroups({ store, session, onStatus }: Context): HTMLElement {
  const list = element('div', { id: 'light-groups' });
  const note = element('p', { class: 'note' });
  const box = checkField({
    id: 'relight',
    label: 'Relight',
    value: store.state.relight,
    hint: 'Stores the light of each source separately, so that its intensity and colour can change without new samples. Needs 32 bytes per pixel and light source.',
    onInput: (relight) => store.set({ relight }, { label: 'Relight' }),
  });
  let shown = '';
  const set = (name: string, change: Partial<GroupSettings>) =>
    store.set(
      { groups: { ...store.state.groups, [name]: { ...UNSET, ...store.state.groups[name], ...change } } },
      { label: `Light ${name}`, merge: `light ${name} ${Object.keys(change).join('')}` },
    );
  const fill = () => {
    const names = store.state.relight ? (session.tracer?.lightGroups ?? []).map(({ name }) => name) : [];
    note.textContent = store.state.relight
      ? names.length > 0
        ? 'Changes apply at once, without new samples.'
        : ''
      : 'Change the intensity and colour of each light after rendering.';
    if (names.join('\n') === shown) return;
    shown = names.join('\n');
    list.replaceChildren(
      ...names.map((name, i) => {
        const now = store.state.groups[name] ?? UNSET;
        const intensity = sliderField({
          id: `light-${i}`,
          label: name,
          value: now.intensity,
          initial: 1,
          range: [0, 4],
          hardRange: [0, 1000],
          onInput: (value) => set(name, { intensity: value }),
        });
        const color = colourField({
          id: `light-color-${i}`,
          label: 'Filter',
          value: now.color,
          initial: [1, 1, 1],
          onInput: (value) => set(name, { color: value }),
        });
        watch(store, ['groups'], ({ groups }) => {
          intensity.set((groups[name] ?? UNSET).intensity);
          color.set((groups[name] ?? UNSET).color);
        });
        return element('div', { class: 'light' }, intensity.element, color.element);
      }),
    );
  };
  watch(store, ['relight'], ({ relight }) => {
    box.set(relight);
    fill();
  });
  onStatus(({ state }) => {
    if (state === 'rendering' || state === 'done') fill();
  });
  return section('Light groups', box.element, note, list);
}
