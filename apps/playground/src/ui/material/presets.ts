import { OPENPBR_PRESET_NAMES, openPbrPreset, type OpenPbrPresetName } from '@glanz/openpbr/presets';
import type { Context } from '../context';
import { element } from '../elements';
import { replaceMaterial } from './edits';

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

/** Puts a preset on a material of the scene. */
export function applyPreset({ store, opened }: Context, index: number, name: string): void {
  const material = opened().scene.materials[index];
  if (material && (OPENPBR_PRESET_NAMES as readonly string[]).includes(name))
    replaceMaterial(store, material, index, openPbrPreset(name as OpenPbrPresetName, { unit: UNIT }), title(name));
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
    button.addEventListener('click', () => applyPreset(context, context.selection.chosen.material, name));
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
