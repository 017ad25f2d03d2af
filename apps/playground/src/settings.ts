import { TONE_MAPS, type ToneMap } from '@glanz/tonemap';
import { LAYERS, type Layer } from './output/layers';
import { SAMPLES, type SampleName } from './input/samples';

/** Where the light of the surroundings comes from. */
export const ENVIRONMENT_CHOICES = ['model', 'studio', 'constant', 'file', 'none'] as const;
export type EnvironmentChoice = (typeof ENVIRONMENT_CHOICES)[number];

/** Film pixels per CSS pixel of the stage; `device` takes the screen's own pixels. */
export const SCALES = ['0.125', '0.25', '0.5', '1', 'device'] as const;
export type Scale = (typeof SCALES)[number];

/** What the controls of the page say. */
export interface Settings {
  model: SampleName;
  /** Samples per pixel to reach, 1..65536. */
  samples: number;
  /** Most edges of a path, 1..64. */
  depth: number;
  scale: Scale;
  environment: EnvironmentChoice;
  /** Radiance of the constant surroundings, linear. */
  constant: readonly [number, number, number];
  /** Factor on the surroundings. */
  intensity: number;
  /** Turn of the surroundings about +Y, degrees. */
  rotation: number;
  background: 'environment' | 'transparent';
  /** EV. */
  exposure: number;
  toneMap: ToneMap;
  layer: Layer;
}

const number = (text: string | null, low: number, high: number, initial: number, whole = false): number => {
  const value = text === null || text === '' ? Number.NaN : Number(text);
  if (!Number.isFinite(value)) return initial;
  const clamped = Math.min(Math.max(value, low), high);
  return whole ? Math.round(clamped) : clamped;
};

const one = <T extends string>(text: string | null, choices: readonly T[], initial: T): T => choices.find((choice) => choice === text) ?? initial;

/** The first settings: defaults, changed by the page's address, e.g. `?model=cornell-box&samples=64&scale=0.5`. */
export function settingsFromAddress(search: string): Settings {
  const query = new URLSearchParams(search);
  const model = one(query.get('model'), Object.keys(SAMPLES) as SampleName[], 'push-button');
  return {
    model,
    samples: number(query.get('samples'), 1, 65536, 256, true),
    depth: number(query.get('depth'), 1, 64, 6, true),
    scale: one(query.get('scale'), SCALES, '1'),
    environment: one(query.get('environment'), ENVIRONMENT_CHOICES, SAMPLES[model].environment),
    constant: [0.5, 0.5, 0.5],
    intensity: number(query.get('intensity'), 0, 10, 1),
    rotation: number(query.get('rotation'), -180, 180, 0),
    background: one(query.get('background'), ['environment', 'transparent'] as const, 'environment'),
    exposure: number(query.get('exposure'), -8, 8, 0),
    toneMap: one(query.get('tonemap'), TONE_MAPS, 'neutral'),
    layer: one(query.get('layer'), LAYERS, 'beauty'),
  };
}
