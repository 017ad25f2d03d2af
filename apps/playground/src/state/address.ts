import { TONE_MAPS } from '@glanz/tonemap';
import { SAMPLES, type SampleName } from '../input/samples';
import { LAYERS } from '../output/layers';
import { LIMITS } from './limits';
import { BACKGROUNDS, ENVIRONMENT_CHOICES, initialState, SCALES, type State } from './state';

const number = (text: string | null, low: number, high: number, initial: number, whole = false): number => {
  const value = text === null || text === '' ? Number.NaN : Number(text);
  if (!Number.isFinite(value)) return initial;
  const clamped = Math.min(Math.max(value, low), high);
  return whole ? Math.round(clamped) : clamped;
};

const one = <T extends string>(text: string | null, choices: readonly T[], initial: T): T =>
  choices.find((choice) => choice === text) ?? initial;

/** A value of the query, under its present name or the former one. */
const renamed = (query: URLSearchParams, name: string, former: string): string | null => {
  const value = query.get(former);
  // oxlint-disable-next-line no-console
  if (value !== null) console.warn(`"?${former}=" is deprecated; it is called "?${name}=".`);
  return query.get(name) ?? value;
};

/** The first state by the page's query, e.g. `?model=cornell-box&samples=64&scale=0.5`: what a person would type. */
export function stateFromQuery(search: string): { readonly model: SampleName; readonly state: State } {
  const query = new URLSearchParams(search);
  const model = one(query.get('model'), Object.keys(SAMPLES) as SampleName[], 'push-button');
  const initial = initialState(SAMPLES[model].environment);
  // A file of another address may bring a ground.
  const stands = SAMPLES[model].floor && (query.get('model') ?? model) === model;
  const state: State = {
    ...initial,
    samples: number(query.get('samples'), ...LIMITS.samples, initial.samples, true),
    noise: number(query.get('noise'), ...LIMITS.noise, initial.noise),
    maxDepth: number(renamed(query, 'max-depth', 'depth'), ...LIMITS.maxDepth, initial.maxDepth, true),
    scale: one(query.get('scale'), SCALES, initial.scale),
    environment: one(query.get('environment'), ENVIRONMENT_CHOICES, initial.environment),
    intensity: number(query.get('intensity'), 0, 10, 1),
    rotation: number(query.get('rotation'), -180, 180, 0),
    background: one(query.get('background'), BACKGROUNDS, 'environment'),
    floor: one(query.get('floor'), ['on', 'off'], stands ? 'on' : 'off') === 'on',
    exposure: number(query.get('exposure'), -8, 8, 0),
    toneMap: one(renamed(query, 'tone-map', 'tonemap'), TONE_MAPS, 'neutral'),
    denoise: query.get('denoise') !== 'off',
    layer: one(query.get('layer'), LAYERS, 'beauty'),
  };
  return { model, state };
}
