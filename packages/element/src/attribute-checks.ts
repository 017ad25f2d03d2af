import { optionValues, RENDER_OPTIONS, takesOption, type RenderOptionName } from '@glanz/renderer/options';
import { TONE_MAPS } from '@glanz/tonemap';
import { ATTRIBUTES, camel, type AttributeName } from './attributes';
import { readOrientation, readScale } from './placement';
import { angle, length } from './units';

type Range = readonly [low: number, high: number];

/** The option of the renderer whose values an attribute takes. */
function optionOf(name: AttributeName): RenderOptionName | undefined {
  const option = name === 'poster-samples' ? 'samples' : camel(name);
  return Object.hasOwn(RENDER_OPTIONS, option) ? (option as RenderOptionName) : undefined;
}

/** Ranges of the other attributes that are numbers. */
const NUMBERS: Readonly<Partial<Record<AttributeName, Range>>> = {
  'exposure-ev': [-64, 64],
  exposure: [0, 1e9],
  'pixel-ratio': [1e-3, 16],
  'environment-intensity': [0, 1e9],
  'interpolation-decay': [0, 60_000],
  'auto-rotate-delay': [0, 1e9],
  'orbit-sensitivity': [1e-3, 1e3],
  'pan-sensitivity': [1e-3, 1e3],
  'zoom-sensitivity': [1e-3, 1e3],
  'interaction-prompt-threshold': [0, 1e9],
  'shadow-intensity': [0, 1],
  'ground-reflection': [0, 1],
};

/** Names that model-viewer has for tone maps. */
export const TONE_MAP_NAMES: Readonly<Record<string, (typeof TONE_MAPS)[number]>> = {
  commerce: 'neutral',
  auto: 'neutral',
  none: 'linear',
};

/** The number that a text says, or `null`. */
export function numberOf(text: string | null): number | null {
  const value = text === null || text.trim() === '' ? Number.NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}

const partsOf = (text: string) => text.trim().split(/\s+/).filter(Boolean);
const isAuto = (part: string) => part === 'auto';
const isAngle = (part: string) => isAuto(part) || angle(part) !== undefined;
const isLength = (part: string) => isAuto(part) || length(part) !== undefined;
const isEndless = (part: string) => /^[+-]?infinity(deg|rad)?$/i.test(part);
const isOrbit = (text: string) => {
  const [theta = 'auto', phi = 'auto', radius = 'auto', ...more] = partsOf(text);
  return isAngle(theta) && isAngle(phi) && isLength(radius) && more.length === 0;
};
const isLimit = (text: string) => {
  const [theta = 'auto', phi = 'auto', radius = 'auto', ...more] = partsOf(text);
  return (
    (isAngle(theta) || isEndless(theta)) &&
    (isAngle(phi) || isEndless(phi)) &&
    (isLength(radius) || isEndless(radius)) &&
    more.length === 0
  );
};
const isFieldOfView = (text: string) => {
  const value = angle(text.trim());
  return isAuto(text.trim()) || (value !== undefined && value > 0.01 && value < Math.PI - 0.01);
};

/** What the attributes that are texts accept, in words, and how to check it. */
const TEXTS: Readonly<Partial<Record<AttributeName, readonly [takes: string, test: (text: string) => boolean]>>> = {
  'camera-orbit': ['an angle, an angle and a distance, such as "45deg 75deg 2m", each or "auto"', isOrbit],
  'min-camera-orbit': ['an angle, an angle and a distance, each or "auto"', isLimit],
  'max-camera-orbit': ['an angle, an angle and a distance, each or "auto"', isLimit],
  'camera-target': [
    'three lengths, such as "0m 1m 0m", each or "auto"',
    (text) => partsOf(text).length <= 3 && partsOf(text).every((part) => isLength(part) && !part.endsWith('%')),
  ],
  'field-of-view': ['an angle between 0 and 180 degrees, or "auto"', isFieldOfView],
  'environment-rotation': ['an angle', (text) => angle(text.trim()) !== undefined],
  'interaction-prompt': ['auto or none', (text) => text === 'auto' || text === 'none'],
  'interaction-prompt-style': ['wiggle or basic', (text) => text === 'wiggle' || text === 'basic'],
  orientation: ['three angles: roll, pitch and yaw', (text) => readOrientation(text) !== undefined],
  scale: ['one or three numbers that are not 0', (text) => readScale(text) !== undefined],
  'rotation-per-second': ['an angle', (text) => angle(text.trim()) !== undefined],
  'tone-mapping': [
    `one of ${[...TONE_MAPS, ...Object.keys(TONE_MAP_NAMES)].join(', ')}`,
    (text) => Object.hasOwn(TONE_MAP_NAMES, text) || (TONE_MAPS as readonly string[]).includes(text),
  ],
};

/** The number that an attribute says, or `undefined` where it is missing or says none that the attribute takes. */
export function numberIn(name: AttributeName, text: string | null): number | undefined {
  const value = numberOf(text);
  const [low, high] = NUMBERS[name] ?? [-Infinity, Infinity];
  const option = optionOf(name);
  return value !== null && (option ? takesOption(option, value) : value >= low && value <= high) ? value : undefined;
}

/** Whether a number is one that an attribute takes. */
export const takesNumber = (name: AttributeName, value: number): boolean => numberIn(name, String(value)) !== undefined;

/** What an attribute takes, in words, where its text is something else; an empty text counts as missing. */
export function attributeFault(name: AttributeName, text: string): string | undefined {
  if (text.trim() === '') return undefined;
  const option = optionOf(name);
  if (option && ATTRIBUTES[name] === 'text') return takesOption(option, text) ? undefined : optionValues(option);
  if (option || NUMBERS[name]) return numberIn(name, text) === undefined ? takenNumbers(name) : undefined;
  const [takes, test] = TEXTS[name] ?? [];
  return takes !== undefined && !test?.(text) ? takes : undefined;
}

/** The numbers that an attribute takes, in words. */
export function takenNumbers(name: AttributeName): string {
  const [low, high] = NUMBERS[name] ?? [-Infinity, Infinity];
  const option = optionOf(name);
  return option ? optionValues(option) : `a number from ${low} to ${high}`;
}
