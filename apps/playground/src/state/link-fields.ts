import { STUDIOS, type SoftBox, type StudioName } from '@glanz/scene/studio';
import { TONE_MAPS } from '@glanz/tonemap';
import '../viewer/moves';
import { LIMITS } from './limits';
import {
  BACKGROUNDS,
  ENVIRONMENT_CHOICES,
  initialState,
  MAX_VIEWS,
  MIN_SCALE,
  SCALES,
  type GroupSettings,
  type Lens,
  type Move,
  type OrbitView,
  type Rgb,
  type State,
} from './state';

/**
 * Reads a field of a link; undefined where the value is of another kind than the field. A number is brought into its
 * range.
 */
type Read<T> = (value: unknown) => T | undefined;

/** Maximum number of entries of a list or a record. */
const MAX_ENTRIES = 100_000;
const MAX_BOXES = 64;

const isRecord = (value: unknown): value is Readonly<Record<string, unknown>> =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

const number =
  (low: number, high: number): Read<number> =>
  (value) =>
    typeof value === 'number' && Number.isFinite(value) ? Math.min(Math.max(value, low), high) : undefined;
const whole =
  (low: number, high: number): Read<number> =>
  (value) => {
    const clamped = number(low, high)(value);
    return clamped === undefined ? undefined : Math.round(clamped);
  };
const one =
  <T extends string>(choices: readonly T[]): Read<T> =>
  (value) =>
    choices.find((choice) => choice === value);
const flag: Read<boolean> = (value) => (typeof value === 'boolean' ? value : undefined);
const text: Read<string> = (value) => (typeof value === 'string' ? value : undefined);
const orNull =
  <T>(read: Read<T>): Read<T | null> =>
  (value) =>
    value === null ? null : read(value);

const rgb =
  (high: number): Read<Rgb> =>
  (value) => {
    if (!Array.isArray(value) || value.length !== 3) return undefined;
    const [r, g, b] = value.map(number(0, high));
    return r === undefined || g === undefined || b === undefined ? undefined : [r, g, b];
  };

const list =
  <T>(read: Read<T>, max = MAX_ENTRIES): Read<readonly T[]> =>
  (value) => {
    if (!Array.isArray(value) || value.length > max) return undefined;
    const entries = value.map(read);
    return entries.some((entry) => entry === undefined) ? undefined : (entries as T[]);
  };

/** Entries that are of another kind are left out. */
const record =
  <T>(read: Read<T>): Read<Readonly<Record<string, T>>> =>
  (value) => {
    if (!isRecord(value)) return undefined;
    const entries = Object.entries(value)
      .slice(0, MAX_ENTRIES)
      .map(([key, entry]) => [key, read(entry)] as const);
    return Object.fromEntries(entries.filter((entry): entry is readonly [string, T & {}] => entry[1] !== undefined));
  };

const point: Read<Rgb> = (value) => {
  if (!Array.isArray(value) || value.length !== 3) return undefined;
  const [x, y, z] = value.map(number(-1e9, 1e9));
  return x === undefined || y === undefined || z === undefined ? undefined : [x, y, z];
};

const orbit: Read<OrbitView> = (value) => {
  if (!isRecord(value)) return undefined;
  const target = point(value['target']);
  const distance = number(1e-9, 1e9)(value['distance']);
  const yaw = number(-1000, 1000)(value['yaw']);
  const pitch = number(-Math.PI / 2, Math.PI / 2)(value['pitch']);
  const zoom = number(1e-3, 1e3)(value['zoom'] ?? 1);
  return target && distance !== undefined && yaw !== undefined && pitch !== undefined && zoom !== undefined
    ? { target, distance, yaw, pitch, zoom }
    : undefined;
};

const move: Read<Move> = (value) => {
  if (!isRecord(value)) return undefined;
  const [translation, rotation, scale] = [point(value['translation']), point(value['rotation']), point(value['scale'])];
  return translation && rotation && scale?.every((factor) => Math.abs(factor) >= MIN_SCALE)
    ? { translation, rotation, scale }
    : undefined;
};

const lens: Read<Lens> = (value) => {
  if (!isRecord(value)) return undefined;
  const initial = initialState('studio').lens;
  return {
    projection: one(['perspective', 'orthographic'] as const)(value['projection']) ?? initial.projection,
    fov: orNull(number(0.5, 170))(value['fov']) ?? null,
    stop: number(0, 128)(value['stop']) ?? initial.stop,
    blades: whole(0, 32)(value['blades']) ?? initial.blades,
    focus: orNull(number(1e-3, 1e5))(value['focus']) ?? null,
  };
};

const softBox: Read<SoftBox> = (value) => {
  if (!isRecord(value)) return undefined;
  const angle = number(-1000, 1000);
  const extent = number(0.01, Math.PI - 0.01);
  const [azimuth, elevation, width, height] = [
    angle(value['azimuth']),
    angle(value['elevation']),
    extent(value['width']),
    extent(value['height']),
  ];
  const radiance = number(0, 1e4)(value['radiance']) ?? rgb(1e4)(value['radiance']);
  if (
    azimuth === undefined ||
    elevation === undefined ||
    width === undefined ||
    height === undefined ||
    radiance === undefined
  )
    return undefined;
  const shape = one(['rectangle', 'disc'] as const)(value['shape']);
  return { azimuth, elevation, width, height, radiance, ...(shape ? { shape } : {}) };
};

const group: Read<GroupSettings> = (value) =>
  isRecord(value)
    ? { intensity: number(0, 1000)(value['intensity']) ?? 1, color: rgb(1000)(value['color']) ?? [1, 1, 1] }
    : undefined;

/**
 * Ranges are those of the page's own controls. Values of materials are checked by their own table, see `linkOfPage`.
 */
const FIELDS: { readonly [Name in keyof State]?: Read<State[Name]> } = {
  samples: whole(...LIMITS.samples),
  noise: number(...LIMITS.noise),
  maxDepth: whole(...LIMITS.maxDepth),
  scale: one(SCALES),
  exposure: number(-8, 8),
  toneMap: one(TONE_MAPS),
  denoise: flag,
  environment: one(ENVIRONMENT_CHOICES),
  studio: one(Object.keys(STUDIOS) as StudioName[]),
  boxes: orNull(list(softBox, MAX_BOXES)),
  constant: rgb(1e4),
  intensity: number(0, 1000),
  rotation: number(-3600, 3600),
  background: one(BACKGROUNDS),
  backgroundColor: rgb(1),
  backgroundBlur: number(2, 45),
  floor: flag,
  relight: flag,
  groups: record(group),
  camera: whole(-1, 1e6),
  orbit: orNull(orbit),
  lens,
  walk: list(orbit, MAX_VIEWS),
  materials: record((value) => (isRecord(value) ? value : undefined)),
  hidden: list((value) => (Number.isInteger(value) && (value as number) >= 0 ? (value as number) : undefined)),
  moves: record(move),
  variant: orNull(text),
  clip: orNull(whole(0, 1e6)),
  time: number(0, 1e6),
};

/** Former names of fields, in links that were made before they changed. */
const FORMER: Readonly<Record<string, keyof State>> = { depth: 'maxDepth' };

/** Only known fields, of their own kinds and within their ranges: an address comes from anywhere. */
export function readFields(given: Readonly<Record<string, unknown>>): Partial<State> {
  const state: Record<string, unknown> = {};
  for (const [key, value] of Object.entries(given)) {
    const name = Object.hasOwn(FORMER, key) ? (FORMER[key] as string) : key;
    const read = Object.hasOwn(FIELDS, name) ? (FIELDS[name as keyof State] as Read<unknown>) : undefined;
    const known = read?.(value);
    if (known !== undefined) state[name] = known;
  }
  return state as Partial<State>;
}
