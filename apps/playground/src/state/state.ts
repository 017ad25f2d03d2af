import type { OpenPbrParameters } from '@glanz/openpbr/parameters';
import { RENDER_OPTIONS } from '@glanz/renderer/options';
import type { Image, TextureBinding, TexturedParameter } from '@glanz/scene';
import type { SoftBox, StudioName } from '@glanz/scene/studio';
import type { ToneMap } from '@glanz/tonemap';
import type { Layer } from '../output/layers';

/** Where the light of the environment comes from. */
export const ENVIRONMENT_CHOICES = ['model', 'studio', 'constant', 'file', 'none'] as const;
export type EnvironmentChoice = (typeof ENVIRONMENT_CHOICES)[number];

/** What is behind the model. */
export const BACKGROUNDS = ['environment', 'blurred', 'color', 'transparent'] as const;
export type Background = (typeof BACKGROUNDS)[number];

/** Film pixels per CSS pixel of the stage; `device` takes the screen's own pixels. */
export const SCALES = ['0.125', '0.25', '0.5', '1', 'device'] as const;
export type Scale = (typeof SCALES)[number];

export type Rgb = readonly [number, number, number];
export type Values = Partial<OpenPbrParameters>;

/** An image that the user put on a parameter of a material; null takes away the one that the model brought. */
export type Slot = {
  readonly image: Image;
  readonly color_space: 'srgb' | 'linear';
  readonly binding: Omit<TextureBinding, 'texture'>;
} | null;

/** Smallest factor of a part that is scaled: without an extent it would have no normals. */
export const MIN_SCALE = 1e-3;

/** How a part is moved from where the model has it: scaled, then turned, about its own middle, then translated. */
export interface Move {
  /** Metres, along the world's axes. */
  readonly translation: Rgb;
  /** Degrees about the world's X, then Y, then Z axis. */
  readonly rotation: Rgb;
  /** Factors along the world's axes, before it is turned. */
  readonly scale: Rgb;
}

/** Where an orbiting camera is. */
export interface OrbitView {
  readonly target: Rgb;
  /** Metres from the target. */
  readonly distance: number;
  /** Radians. */
  readonly yaw: number;
  readonly pitch: number;
  /** Magnification of a parallel projection. */
  readonly zoom: number;
}

/** So many views a camera walk has at most. */
export const MAX_VIEWS = 64;

/** What the user says of the lens; null leaves it to the camera. */
export interface Lens {
  readonly projection: 'perspective' | 'orthographic';
  /** Vertical field of view, degrees. */
  readonly fov: number | null;
  /** f-number; 0 is a pinhole. */
  readonly stop: number;
  /** Sides of the aperture; 0 is round. */
  readonly blades: number;
  /** Distance in focus, metres; null: the point that the camera orbits. */
  readonly focus: number | null;
}

export interface GroupSettings {
  readonly intensity: number;
  readonly color: Rgb;
}

/**
 * Everything that makes the image, apart from the model. Plain data, never changed in place: a step of undo is a
 * former one.
 */
export interface State {
  /** Samples per pixel to reach. */
  readonly samples: number;
  /** Noise to reach; 0 takes all samples everywhere. */
  readonly noise: number;
  /** Maximum number of edges of a path. */
  readonly maxDepth: number;
  readonly scale: Scale;
  readonly layer: Layer;
  /** EV. */
  readonly exposure: number;
  readonly toneMap: ToneMap;
  /** Whether images of few samples are shown and saved denoised. */
  readonly denoise: boolean;

  readonly environment: EnvironmentChoice;
  readonly studio: StudioName;
  /** Lights that replace those of the studio. */
  readonly boxes: readonly SoftBox[] | null;
  /** Radiance of the constant environment, linear. */
  readonly constant: Rgb;
  /** Factor on the environment. */
  readonly intensity: number;
  /** Turn of the environment about +Y, degrees. */
  readonly rotation: number;
  readonly background: Background;
  readonly backgroundColor: Rgb;
  /** Standard deviation of the blur, degrees. */
  readonly backgroundBlur: number;
  /** An invisible floor that catches shadows. */
  readonly floor: boolean;
  /** Whether the film keeps the lights apart, and how each is set. */
  readonly relight: boolean;
  readonly groups: Readonly<Record<string, GroupSettings>>;

  /** Index into the scene's cameras; −1 frames the whole scene. */
  readonly camera: number;
  /** Where the user has moved it. */
  readonly orbit: OrbitView | null;
  readonly lens: Lens;
  /** Views that a camera walk goes through, in this order. */
  readonly walk: readonly OrbitView[];

  /** Parameters that differ from the model's, by the index of the material. */
  readonly materials: Readonly<Record<string, Values>>;
  /** By `<material>/<parameter>`. */
  readonly slots: Readonly<Record<string, Slot>>;
  /** Indices of hidden instances. */
  readonly hidden: readonly number[];
  /** Of parts that the user has moved, by their indices. */
  readonly moves: Readonly<Record<string, Move>>;
  readonly variant: string | null;
  /** Index of an animation, and seconds from its beginning. */
  readonly clip: number | null;
  readonly time: number;
}

export const slotKey = (material: number, parameter: TexturedParameter): string => `${material}/${parameter}`;

/** What an image begins with. */
export function initialState(environment: EnvironmentChoice): State {
  return {
    samples: RENDER_OPTIONS.samples.default,
    noise: 0,
    maxDepth: RENDER_OPTIONS.maxDepth.default,
    scale: '1',
    layer: 'beauty',
    exposure: 0,
    toneMap: 'neutral',
    denoise: true,
    environment,
    studio: 'neutral',
    boxes: null,
    constant: [0.5, 0.5, 0.5],
    intensity: 1,
    rotation: 0,
    background: 'environment',
    backgroundColor: [0.78, 0.77, 0.75],
    backgroundBlur: 12,
    floor: false,
    relight: false,
    groups: {},
    camera: 0,
    orbit: null,
    lens: { projection: 'perspective', fov: null, stop: 0, blades: 0, focus: null },
    walk: [],
    materials: {},
    slots: {},
    hidden: [],
    moves: {},
    variant: null,
    clip: null,
    time: 0,
  };
}

/** Of another model only what was not said of the former one. */
export const forAnotherModel = (state: State): State => ({
  ...state,
  orbit: null,
  lens: { ...state.lens, focus: null },
  walk: [],
  materials: {},
  slots: {},
  hidden: [],
  moves: {},
  variant: null,
  clip: null,
  time: 0,
  groups: {},
});
