import { RENDER_OPTION_TEXTS } from '@glanz/renderer/options';
import { LAYER_TITLES, LAYERS } from '../output/layers';
import type { Scale } from '../state/state';
import { changer, watch, type Context } from './context';
import { checkField, section, selectField, sliderField } from './fields';
import { optionSlider } from './option-slider';
import { Playback } from './playback';
import { StatisticsPanel } from './statistics';

const SCALE_TITLES: Readonly<Record<Scale, string>> = {
  '0.125': 'Eighth',
  '0.25': 'Quarter',
  '0.5': 'Half',
  '1': 'Full',
  device: 'Screen pixels',
};
const SCALE_ORDER: readonly Scale[] = ['0.125', '0.25', '0.5', '1', 'device'];
const NOISES = ['0', '0.1', '0.05', '0.02', '0.01', '0.005'] as const;

/** Sampling options, variants and animations of the model, and statistics. */
export function renderPanel(context: Context): HTMLElement[] {
  const { store, opened, onModel, onStatus, session, pose, fail } = context;
  const change = changer(store);
  const initial = store.state;
  const layer = selectField({
    id: 'layer',
    label: 'Layer',
    value: initial.layer,
    choices: LAYERS.map((name) => [name, LAYER_TITLES[name]] as const),
    onInput: (value) => store.set({ layer: value }),
  });
  const samples = sliderField({ ...optionSlider('samples', 'Samples', initial, change), curve: 3 });
  const noise = selectField({
    id: 'noise',
    label: 'Noise target',
    value: String(initial.noise),
    choices: NOISES.map((n) => [n as string, n === '0' ? 'None' : `${Number(n) * 100} %`] as const),
    hint: RENDER_OPTION_TEXTS.noise.doc,
    onInput: (value) => change('noise', 'Noise target')(Number(value)),
  });
  const maxDepth = sliderField(optionSlider('maxDepth', 'Depth', initial, change));
  const scale = selectField({
    id: 'scale',
    label: 'Resolution',
    value: initial.scale,
    choices: SCALE_ORDER.map((key) => [key, SCALE_TITLES[key]] as const),
    onInput: change('scale', 'Resolution'),
  });
  const denoise = checkField({
    id: 'denoise',
    label: 'Denoise',
    value: initial.denoise,
    onInput: change('denoise', 'Denoise'),
  });
  watch(store, ['layer', 'samples', 'noise', 'maxDepth', 'scale', 'denoise'], (state) => {
    layer.set(state.layer);
    samples.set(state.samples);
    noise.set(String(state.noise));
    maxDepth.set(state.maxDepth);
    scale.set(state.scale);
    denoise.set(state.denoise);
  });

  // Not before the panels.
  watch(store, ['denoise'], () => import('../viewer/denoise').then(({ applyDenoise }) => applyDenoise(context), fail));

  const variant = selectField({
    id: 'variant',
    label: 'Variant',
    value: '' as string,
    choices: [],
    onInput: (value) => store.set({ variant: value === '' ? null : value }, { label: 'Variant' }),
  });
  const clip = selectField({
    id: 'clip',
    label: 'Animation',
    value: '' as string,
    choices: [],
    onInput: (value) => {
      store.set({ clip: value === '' ? null : Number(value), time: 0 }, { label: 'Animation' });
      void pose();
    },
  });
  const playback = new Playback(context);
  const looks = section('Model', variant.element, clip.element, playback.element);
  const fill = () => {
    const { variants = [], animations = [] } = opened().scene;
    variant.setChoices([['', 'Default'], ...variants.map((name) => [name, name] as const)], store.state.variant ?? '');
    clip.setChoices(
      [['', 'Rest pose'], ...animations.map(({ name }, i) => [String(i), name || `Animation ${i + 1}`] as const)],
      store.state.clip === null ? '' : String(store.state.clip),
    );
    variant.element.hidden = variants.length === 0;
    clip.element.hidden = animations.length === 0;
    looks.hidden = variants.length === 0 && animations.length === 0;
    const playing = store.state.clip === null ? undefined : animations[store.state.clip];
    playback.show(playing?.duration);
  };
  onModel(fill);
  watch(store, ['variant', 'clip'], fill);

  const statistics = new StatisticsPanel();
  const showStatistics = () => {
    const { tracer } = session;
    if (tracer)
      statistics.show(
        opened().scene,
        tracer.statistics,
        session.film,
        session.adapterName,
        session.sampleMs,
        session.raysPerSecond,
      );
  };
  let lastShown = 0;
  onStatus(({ state }) => {
    if ((state === 'rendering' || state === 'moving') && performance.now() - lastShown < 500) return;
    lastShown = performance.now();
    showStatistics();
  });
  onModel(showStatistics);
  showStatistics();
  return [
    section(
      'Sampling',
      samples.element,
      noise.element,
      maxDepth.element,
      scale.element,
      layer.element,
      denoise.element,
    ),
    looks,
    section('Statistics', statistics.element),
  ];
}
