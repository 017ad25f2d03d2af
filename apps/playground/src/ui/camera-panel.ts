import { TONE_MAPS, type ToneMap } from '@glanz/tonemap';
import { MAX_VIEWS, type Lens } from '../state/state';
import { fieldOfView, focalLength, STANDARD_VIEWS, type StandardView } from '../viewer/lens';
import { changer, watch, type Context } from './context';
import { element } from './elements';
import { section, selectField, sliderField } from './fields';

const TONE_MAP_TITLES: Readonly<Record<ToneMap, string>> = {
  neutral: 'Neutral',
  aces: 'ACES',
  agx: 'AgX',
  reinhard: 'Reinhard',
  linear: 'Linear (clipped)',
};
const STOPS = ['0', '1.4', '2', '2.8', '4', '5.6', '8', '11', '16', '22'] as const;
const BLADES = ['0', '5', '6', '7', '8', '9'] as const;

/** Views, lens, focus, exposure and tone map. */
export function cameraPanel(context: Context): HTMLElement[] {
  const { store, rig, opened, onModel } = context;
  const change = changer(store);
  const lensed = (values: Partial<Lens>, label: string) =>
    store.set({ lens: { ...store.state.lens, ...values } }, { label });
  const initial = store.state;
  const fovNow = () => {
    const camera = rig.camera({ ...store.state, lens: { ...store.state.lens, projection: 'perspective' } });
    return camera.type === 'perspective' ? (camera.yfov * 180) / Math.PI : 35;
  };

  const camera = selectField({
    id: 'camera',
    label: 'Camera',
    value: '-1' as string,
    choices: [['-1', 'Whole model']],
    onInput: (value) => rig.choose(Number(value)),
  });
  const fill = () =>
    camera.setChoices(
      [
        ['-1', 'Whole model'],
        ...opened().scene.cameras.map(({ name }, i) => [String(i), name || `Camera ${i + 1}`] as const),
      ],
      String(store.state.camera),
    );
  const views = element('div', { class: 'chips', id: 'views', role: 'group', 'aria-label': 'Standard views' });
  for (const [name, { title }] of Object.entries(STANDARD_VIEWS)) {
    const button = element('button', { type: 'button', 'data-view': name }, title);
    button.addEventListener('click', () => rig.look(name as StandardView));
    views.append(button);
  }

  const projection = selectField<Lens['projection']>({
    id: 'projection',
    label: 'Projection',
    value: initial.lens.projection,
    choices: [
      ['perspective', 'Perspective'],
      ['orthographic', 'Orthographic'],
    ],
    onInput: (value) => lensed({ projection: value }, 'Projection'),
  });
  const focal = sliderField({
    id: 'focal',
    label: 'Focal length',
    unit: 'mm',
    value: focalLength(fovNow()),
    range: [12, 200],
    hardRange: [4, 2000],
    curve: 2,
    hint: 'Full-frame equivalent',
    onInput: (value) => lensed({ fov: fieldOfView(value) }, 'Focal length'),
  });
  const fov = sliderField({
    id: 'fov',
    label: 'Field of view',
    unit: '°',
    value: fovNow(),
    range: [6, 90],
    hardRange: [0.5, 170],
    hint: 'Vertical',
    onInput: (value) => lensed({ fov: value }, 'Field of view'),
  });
  const stop = selectField({
    id: 'stop',
    label: 'Aperture',
    value: String(initial.lens.stop),
    choices: STOPS.map((n) => [n as string, n === '0' ? 'Pinhole, everything in focus' : `f/${n}`] as const),
    onInput: (value) => lensed({ stop: Number(value) }, 'Aperture'),
  });
  const blades = selectField({
    id: 'blades',
    label: 'Blades',
    value: String(initial.lens.blades),
    choices: BLADES.map((n) => [n as string, n === '0' ? 'Round' : `${n} blades`] as const),
    onInput: (value) => lensed({ blades: Number(value) }, 'Blades'),
  });
  const focus = sliderField({
    id: 'focus-distance',
    label: 'Focus',
    unit: 'm',
    value: 1,
    range: [0.01, 10],
    hardRange: [0.001, 100000],
    curve: 3,
    hint: 'Focus distance. Press D, then click the image to set it.',
    onInput: (value) => lensed({ focus: value }, 'Focus'),
  });
  const auto = element('button', { type: 'button', id: 'focus-auto' }, 'Focus on the orbit target');
  auto.addEventListener('click', () => lensed({ focus: null }, 'Focus'));
  const refresh = () => {
    const { lens } = store.state;
    camera.set(String(store.state.camera));
    projection.set(lens.projection);
    fov.set(fovNow());
    focal.set(focalLength(fovNow()));
    stop.set(String(lens.stop));
    blades.set(String(lens.blades));
    const seen = rig.camera({ ...store.state, lens: { ...lens, projection: 'perspective' } });
    focus.set(seen.type === 'perspective' ? (seen.focus_distance ?? 1) : 1);
    for (const field of [blades, focus]) field.element.hidden = lens.stop === 0;
    auto.hidden = lens.stop === 0 || lens.focus === null;
  };
  watch(store, ['lens', 'camera', 'orbit'], refresh);
  onModel(() => {
    fill();
    refresh();
  });
  fill();

  const exposure = sliderField({
    id: 'exposure',
    label: 'Exposure',
    value: initial.exposure,
    initial: 0,
    range: [-8, 8],
    step: 0.1,
    unit: 'EV',
    onInput: change('exposure', 'Exposure'),
  });
  const toneMap = selectField({
    id: 'tone-map',
    label: 'Tone map',
    value: initial.toneMap,
    choices: TONE_MAPS.map((name) => [name, TONE_MAP_TITLES[name]] as const),
    onInput: change('toneMap', 'Tone map'),
  });
  watch(store, ['exposure', 'toneMap'], (state) => {
    exposure.set(state.exposure);
    toneMap.set(state.toneMap);
  });
  const walkNote = element('p', { class: 'note', id: 'walk-note', role: 'status' });
  const addView = element('button', { type: 'button', id: 'walk-add' }, 'Add this view');
  const clearViews = element('button', { type: 'button', id: 'walk-clear', class: 'quiet' }, 'Clear');
  addView.addEventListener('click', () =>
    store.set(
      { walk: [...store.state.walk, rig.view] },
      { label: 'Add view', merge: `view ${store.state.walk.length}` },
    ),
  );
  clearViews.addEventListener('click', () => store.set({ walk: [] }, { label: 'Clear camera walk' }));
  watch(store, ['walk'], ({ walk }) => {
    const views = `${walk.length} ${walk.length === 1 ? 'view' : 'views'}`;
    walkNote.textContent =
      walk.length === 0
        ? 'Views along which a video moves the camera, see Export.'
        : walk.length === 1
          ? `${views}; a camera walk needs two.`
          : `${views}.`;
    clearViews.hidden = walk.length === 0;
    addView.disabled = walk.length >= MAX_VIEWS;
  });
  return [
    section('View', camera.element, views),
    section('Camera walk', walkNote, element('div', { class: 'chips' }, addView, clearViews)),
    section('Lens', projection.element, focal.element, fov.element, stop.element, blades.element, focus.element, auto),
    section('Tone mapping', exposure.element, toneMap.element),
  ];
}
