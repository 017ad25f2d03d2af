import type { StudioName } from '@glanz/scene/studio';
import type { Rgb, State } from '../../state/state';
import { fieldOfView, type StandardView } from '../../viewer/lens';

/** What a look sets; everything else stays as it is. */
const FIELDS = [
  'environment',
  'studio',
  'boxes',
  'intensity',
  'rotation',
  'background',
  'backgroundColor',
  'backgroundBlur',
  'floor',
  'exposure',
  'toneMap',
  'lens',
] as const satisfies readonly (keyof State)[];
/** The part of the state that a look is. */
export type LookState = Pick<State, (typeof FIELDS)[number]>;

/** Studio, light and camera together. */
export interface Look {
  readonly title: string;
  /** From where the model is seen. */
  readonly view: StandardView;
  readonly state: LookState;
}

interface Choice {
  readonly studio: StudioName;
  readonly view?: StandardView;
  /** Focal length, millimetres of a full-frame camera. */
  readonly focal?: number;
  /** Linear; without it the studio itself is seen, blurred. */
  readonly color?: Rgb;
  readonly change?: Partial<LookState>;
}

const look = (title: string, { studio, view = 'corner', focal = 50, color, change }: Choice): Look => ({
  title,
  view,
  state: {
    environment: 'studio',
    studio,
    boxes: null,
    intensity: 1,
    rotation: 0,
    background: color ? 'color' : 'blurred',
    backgroundColor: color ?? [0.78, 0.77, 0.75],
    backgroundBlur: 12,
    floor: true,
    exposure: 0,
    toneMap: 'neutral',
    lens: { projection: 'perspective', fov: fieldOfView(focal), stop: 0, blades: 0, focus: null },
    ...change,
  },
});

/** By their names. */
export const LOOKS = {
  catalogue: look('Catalogue', { studio: 'high-key', focal: 85, color: [0.9, 0.9, 0.9] }),
  studio: look('Grey studio', { studio: 'neutral', focal: 50, color: [0.3, 0.3, 0.31] }),
  dark: look('Dark', { studio: 'low-key', focal: 85, color: [0.012, 0.012, 0.014], change: { exposure: 0.5 } }),
  window: look('By the window', { studio: 'window', focal: 50, change: { backgroundBlur: 20 } }),
  duotone: look('Duotone', { studio: 'duotone', focal: 35, color: [0.02, 0.015, 0.03] }),
  overcast: look('Overcast', { studio: 'overcast', focal: 35, change: { backgroundBlur: 8 } }),
  sunset: look('Sunset', { studio: 'sunset', focal: 50, change: { toneMap: 'agx', exposure: 0.5, backgroundBlur: 8 } }),
  drawing: look('Orthographic', {
    studio: 'high-key',
    color: [1, 1, 1],
    change: { lens: { projection: 'orthographic', fov: fieldOfView(50), stop: 0, blades: 0, focus: null } },
  }),
} as const satisfies Readonly<Record<string, Look>>;

/** Name of a look. */
export type LookName = keyof typeof LOOKS;

/** Whether the state is as the look sets it; from where the model is seen does not count. */
export const hasLook = (state: State, { state: wanted }: Look): boolean =>
  FIELDS.every((field) => JSON.stringify(state[field]) === JSON.stringify(wanted[field]));
