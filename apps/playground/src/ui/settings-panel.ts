import type { Camera } from '@glanz/scene';
import { TONE_MAPS, type ToneMap } from '@glanz/tonemap';
import { LAYER_TITLES, LAYERS } from '../output/layers';
import type { EnvironmentChoice, Scale, Settings } from '../settings';
import { element } from './elements';
import { colourField, selectField, sliderField } from './fields';

export interface SettingsPanelEvents {
  readonly onChange: (change: Partial<Settings>) => void;
  /** Index into the scene's cameras; −1 frames the scene. */
  readonly onCamera: (index: number) => void;
  /** A file of surroundings is wanted and there is none yet. */
  readonly onPickFile: () => void;
}

const TONE_MAP_TITLES: Readonly<Record<ToneMap, string>> = { neutral: 'Neutral', aces: 'ACES', agx: 'AgX', reinhard: 'Reinhard', linear: 'Linear (clipped)' };
const SCALE_TITLES: Readonly<Record<Scale, string>> = { '0.125': 'Eighth', '0.25': 'Quarter', '0.5': 'Half', '1': 'Full', device: 'Screen pixels' };

/** Controls of the picture and of its surroundings. */
export class SettingsPanel {
  readonly picture = element('div', {});
  readonly environment = element('div', {});
  readonly #events: SettingsPanelEvents;
  readonly #camera;
  readonly #choice;
  readonly #constant;
  #ownEnvironment = false;
  #fileName = '';
  #environment: EnvironmentChoice;

  constructor(settings: Settings, events: SettingsPanelEvents) {
    this.#events = events;
    this.#environment = settings.environment;
    const change = events.onChange;
    const layer = selectField({ id: 'layer', label: 'Show', value: settings.layer, choices: LAYERS.map((name) => [name, LAYER_TITLES[name]] as const), onInput: (value) => change({ layer: value }) });
    this.#camera = selectField({ id: 'camera', label: 'Camera', value: '-1' as string, choices: [['-1', 'Whole model']], onInput: (value) => events.onCamera(Number(value)) });
    const exposure = sliderField({ id: 'exposure', label: 'Exposure', value: settings.exposure, range: [-8, 8], step: 0.1, unit: 'EV', onInput: (value) => change({ exposure: value }) });
    const toneMap = selectField({ id: 'tone-map', label: 'Tone map', value: settings.toneMap, choices: TONE_MAPS.map((name) => [name, TONE_MAP_TITLES[name]] as const), onInput: (value) => change({ toneMap: value }) });
    const samples = sliderField({ id: 'samples', label: 'Samples', value: settings.samples, range: [1, 4096], hardRange: [1, 65536], curve: 3, whole: true, hint: 'Samples per pixel to reach. The noise halves with four times as many.', onInput: (value) => change({ samples: Math.round(value) }) });
    const depth = sliderField({ id: 'depth', label: 'Depth', value: settings.depth, range: [1, 16], hardRange: [1, 64], whole: true, hint: 'Most edges of a path from the camera to a light: 2 is direct light only.', onInput: (value) => change({ depth: value }) });
    const scale = selectField({ id: 'scale', label: 'Resolution', value: settings.scale, choices: (Object.keys(SCALE_TITLES) as Scale[]).sort((a, b) => (a === 'device' ? 1 : b === 'device' ? -1 : Number(a) - Number(b))).map((key) => [key, SCALE_TITLES[key]] as const), onInput: (value) => change({ scale: value }) });
    const background = selectField({ id: 'background', label: 'Background', value: settings.background, choices: [['environment', 'Surroundings'], ['transparent', 'Transparent']] as const, onInput: (value) => change({ background: value }) });
    this.picture.append(...[layer, this.#camera, exposure, toneMap, samples, depth, scale, background].map((field) => field.element));

    this.#choice = selectField<EnvironmentChoice>({ id: 'environment', label: 'Light from', value: 'studio', choices: [], onInput: (value) => this.#choose(value) });
    this.#constant = colourField({ id: 'constant', label: 'Colour', value: settings.constant, onInput: (value) => change({ constant: value }) });
    const intensity = sliderField({ id: 'intensity', label: 'Intensity', value: settings.intensity, range: [0, 4], hardRange: [0, 1000], onInput: (value) => change({ intensity: value }) });
    const rotation = sliderField({ id: 'rotation', label: 'Rotation', value: settings.rotation, range: [-180, 180], step: 1, unit: '°', onInput: (value) => change({ rotation: value }) });
    this.environment.append(...[this.#choice, this.#constant, intensity, rotation].map((field) => field.element));
    this.#fill();
  }

  /** Shows what the settings say where the page itself has changed them. */
  set(settings: Settings): void {
    this.#environment = settings.environment;
    this.#fill();
  }

  setCameras(cameras: readonly Camera[], index: number): void {
    this.#camera.setChoices([['-1', 'Whole model'], ...cameras.map(({ name }, i) => [String(i), name || `Camera ${i + 1}`] as const)], String(index));
  }

  setHasOwnEnvironment(has: boolean): void {
    this.#ownEnvironment = has;
    this.#fill();
  }

  /** The picture of surroundings that is there now. */
  setEnvironmentFile(name: string): void {
    this.#fileName = name;
    this.#fill();
  }

  #fill(): void {
    const choices: (readonly [EnvironmentChoice, string])[] = [
      ['studio', 'Neutral studio'],
      ['constant', 'One colour'],
      ['file', this.#fileName || 'Picture file (.hdr, .exr)…'],
      ['none', 'Model’s lights only'],
    ];
    if (this.#ownEnvironment || this.#environment === 'model') choices.unshift(['model', 'The model’s own']);
    this.#choice.setChoices(choices, this.#environment);
    this.#constant.element.hidden = this.#environment !== 'constant';
  }

  #choose(value: EnvironmentChoice): void {
    if (value === 'file' && this.#fileName === '') {
      this.#choice.set(this.#environment);
      this.#events.onPickFile();
      return;
    }
    this.#environment = value;
    this.#fill();
    this.#events.onChange({ environment: value });
  }
}
