import { inSlices } from '@glanz/scene';
import { STUDIOS, studioEnvironment, type StudioName } from '@glanz/scene/studio';
import { BACKGROUNDS, type Background, type EnvironmentChoice, type State } from '../state/state';
import { changer, watch, type Context } from './context';
import { element } from './elements';
import { checkField, colourField, section, selectField, sliderField } from './fields';
import { lightGroups } from './light-groups';
import { latLongSteps, SkyEditor } from './sky-editor';

const BACKGROUND_TITLES: Readonly<Record<Background, string>> = {
  environment: 'Environment',
  blurred: 'Environment, blurred',
  color: 'Solid colour',
  transparent: 'Transparent',
};
const STUDIO_TITLES: Readonly<Record<StudioName, string>> = {
  neutral: 'Neutral',
  'high-key': 'High key',
  'low-key': 'Low key',
  window: 'Window',
  duotone: 'Duotone',
  overcast: 'Overcast',
  'clear-sky': 'Clear sky',
  sunset: 'Sunset',
};

/** Studios as small images of themselves. */
function studioButtons({ store }: Context): HTMLElement {
  const buttons = (Object.keys(STUDIOS) as StudioName[]).map((name) => {
    const canvas = element('canvas', { width: 64, height: 32, 'aria-hidden': 'true' });
    void inSlices(latLongSteps(canvas, studioEnvironment({ setup: STUDIOS[name], width: 64 })));
    const button = element(
      'button',
      { type: 'button', class: 'studio', 'data-studio': name },
      canvas,
      STUDIO_TITLES[name],
    );
    button.addEventListener('click', () =>
      store.set({ environment: 'studio', studio: name, boxes: null }, { label: STUDIO_TITLES[name] }),
    );
    return button;
  });
  watch(store, ['studio', 'environment'], ({ studio, environment }) => {
    for (const button of buttons)
      button.setAttribute('aria-pressed', String(environment === 'studio' && button.dataset['studio'] === studio));
  });
  return element('div', { class: 'studios' }, ...buttons);
}

/** Environment, background and light groups. */
export function lightPanel(context: Context): HTMLElement[] {
  const { store, environments, opened, onModel, onEnvironmentFile, pickFiles } = context;
  const change = changer(store);
  const initial = store.state;
  const choice = selectField<EnvironmentChoice>({
    id: 'environment',
    label: 'Light from',
    value: initial.environment,
    choices: [],
    onInput: (value) => {
      if (value === 'file' && !environments.hasFile) {
        choice.set(store.state.environment);
        return pickFiles();
      }
      store.set({ environment: value }, { label: 'Environment' });
    },
  });
  const fill = ({ environment }: State) => {
    const choices: (readonly [EnvironmentChoice, string])[] = [
      ['studio', 'Studio or sky'],
      ['constant', 'Uniform colour'],
      [
        'file',
        environments.hasFile
          ? environments.fileName
          : environments.fileName
            ? `${environments.fileName} (not loaded)`
            : 'Image file (.hdr, .exr)…',
      ],
      ['none', 'Model’s lights only'],
    ];
    if (opened().scene.environment || environment === 'model') choices.unshift(['model', 'From the model']);
    choice.setChoices(choices, environment);
    constant.element.hidden = environment !== 'constant';
    studios.hidden = sky.element.hidden = environment !== 'studio';
  };
  const constant = colourField({
    id: 'constant',
    label: 'Colour',
    value: initial.constant,
    initial: [0.5, 0.5, 0.5],
    onInput: change('constant', 'Environment colour'),
  });
  const studios = studioButtons(context);
  const sky = new SkyEditor(context);
  const intensity = sliderField({
    id: 'intensity',
    label: 'Intensity',
    value: initial.intensity,
    initial: 1,
    range: [0, 4],
    hardRange: [0, 1000],
    onInput: change('intensity', 'Environment intensity'),
  });
  const rotation = sliderField({
    id: 'rotation',
    label: 'Rotation',
    value: initial.rotation,
    initial: 0,
    range: [-180, 180],
    step: 1,
    unit: '°',
    hint: 'Keys: L and ;',
    onInput: change('rotation', 'Environment rotation'),
  });
  watch(store, ['intensity'], (state) => intensity.set(state.intensity));
  watch(store, ['rotation'], (state) => rotation.set(state.rotation));
  watch(store, ['constant'], (state) => constant.set(state.constant));

  const background = selectField<Background>({
    id: 'background',
    label: 'Background',
    value: initial.background,
    choices: BACKGROUNDS.map((name) => [name, BACKGROUND_TITLES[name]] as const),
    onInput: change('background', 'Background'),
  });
  const color = colourField({
    id: 'background-color',
    label: 'Colour',
    value: initial.backgroundColor,
    onInput: change('backgroundColor', 'Background colour'),
  });
  const blur = sliderField({
    id: 'background-blur',
    label: 'Blur',
    value: initial.backgroundBlur,
    initial: 12,
    range: [2, 45],
    unit: '°',
    onInput: change('backgroundBlur', 'Background blur'),
  });
  const floor = checkField({
    id: 'floor',
    label: 'Floor shadow',
    value: initial.floor,
    hint: 'An invisible floor that receives shadows and reflected light',
    onInput: change('floor', 'Floor shadow'),
  });
  watch(store, ['background', 'backgroundColor', 'backgroundBlur', 'floor'], (state) => {
    background.set(state.background);
    color.set(state.backgroundColor);
    blur.set(state.backgroundBlur);
    floor.set(state.floor);
    color.element.hidden = state.background !== 'color';
    blur.element.hidden = state.background !== 'blurred';
  });
  watch(store, ['environment'], fill);
  onModel(() => fill(store.state));
  onEnvironmentFile(() => fill(store.state));
  return [
    section('Environment', choice.element, studios, sky.element, constant.element, intensity.element, rotation.element),
    section('Background', background.element, color.element, blur.element, floor.element),
    lightGroups(context),
  ];
}
