import { OPENPBR_PRESET_NAMES, openPbrPreset, type OpenPbrPresetName } from '@glanz/openpbr/presets';
import type { Context } from '../context';
import { element } from '../elements';
import { chosenMaterials } from '../../viewer/assigned-material';
import { replaceMaterials } from './edits';

const PRESET_IMAGES: Readonly<Record<string, string>> = import.meta.glob('../../../../docs/public/presets/*.webp', {
  eager: true,
  query: '?url',
  import: 'default',
});
const imageOf = (name: string) => PRESET_IMAGES[`../../../../docs/public/presets/${name}.webp`];

/** Kind of data under which a preset travels by drag and drop. */
export const PRESET_TYPE = 'text/x-glanz-preset';

const title = (name: string) => name.charAt(0).toUpperCase() + name.slice(1).replaceAll('_', ' ');

/** Lengths of the examples are plausible as centimetres. */
const UNIT = 0.01;

/** Puts a preset on materials of the scene. */
export function applyPreset({ store, opened }: Context, indices: readonly number[], name: string): void {
  if (!(OPENPBR_PRESET_NAMES as readonly string[]).includes(name)) return;
  const values = openPbrPreset(name as OpenPbrPresetName, { unit: UNIT });
  replaceMaterials(store, opened().scene.materials, indices, values, title(name));
}

/** All presets as images: a click puts one on the chosen material, a drag on the part where it ends. */
export function presetGrid(context: Context): HTMLElement {
  const search = element('input', {
    type: 'search',
    id: 'preset-search',
    placeholder: 'Search 83 materials',
    'aria-label': 'Search presets',
  });
  const grid = element('div', { class: 'presets', id: 'presets' });
  for (const name of [...OPENPBR_PRESET_NAMES].sort(
    (a, b) => Number(imageOf(b) !== undefined) - Number(imageOf(a) !== undefined) || a.localeCompare(b),
  )) {
    const image = imageOf(name);
    const sphere = image
      ? element('img', { src: image, alt: '', width: 56, height: 56, loading: 'lazy', draggable: 'false' })
      : element('span', { class: 'sphere', 'aria-hidden': 'true' });
    const button = element(
      'button',
      {
        type: 'button',
        class: 'preset',
        'data-preset': name,
        draggable: 'true',
        title: `${title(name)}: click, or drag it to a part`,
      },
      sphere,
      element('span', {}, title(name)),
    );
    button.addEventListener('click', () => {
      const { opened, selection, store } = context;
      applyPreset(context, chosenMaterials(opened().scene, selection.chosen, store.state.variant), name);
    });
    button.addEventListener('dragstart', (event) => event.dataTransfer?.setData(PRESET_TYPE, name));
    grid.append(button);
  }
  search.addEventListener('input', () => {
    const requested = search.value.trim().toLowerCase().replaceAll(' ', '_');
    for (const button of grid.querySelectorAll<HTMLElement>('.preset'))
      button.hidden = !(button.dataset['preset'] ?? '').includes(requested);
  });
  return element('div', {}, search, grid);
}
