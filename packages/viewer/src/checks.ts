import {
  optionValues,
  RENDER_OPTIONS,
  shownValue,
  takesOption,
  type RenderOptionName,
  type RenderSettings,
} from '@glanz/renderer/options';
import { cross, dot } from 'gl-matrix/esm/vec3.js';
import type { Camera, Scene } from '@glanz/scene';
import type { Engine } from './engine';
import { previewOptions } from './engine-settings';
import { destroyed, ViewerError } from './errors';
import type { GroundOptions } from './ground';
import type { ViewerOptions } from './options';
import { column, type Orbit, type OrbitLimits, type Vector } from './orbit-state';
import type { PreviewMode } from './preview';
import type { Stage } from './stage';

/** Metres: beyond, single precision, in which the GPU computes, has no digits left for a model. */
const FAR = 1e12;
/** Radians of a turn. */
const MAX_TURN = 1e6;

/** Lowest and highest value of each setting that is a number; those of the renderer's options are in its table. */
const RANGES = {
  pixelRatio: [1e-3, 16],
  maxPixels: [1, 2 ** 28],
  width: [1, 65_536],
  height: [1, 65_536],
  quality: [0, 1],
  environmentIntensity: [0, 1e9],
  environmentRotation: [-MAX_TURN, MAX_TURN],
  exposure: [-64, 64],
  damping: [0, 60],
  autoRotate: [-1000, 1000],
  autoRotateDelay: [0, 1e6],
  'preview.budgetMs': [0.1, 10_000],
  'preview.settleMs': [0, 1e6],
} as const;

const MODES: readonly PreviewMode[] = ['auto', 'raw', 'filtered'];

/** Settings that are whole numbers. */
const WHOLE: ReadonlySet<string> = new Set(['maxPixels', 'width', 'height']);

type Code = 'viewer/option' | 'viewer/camera';

/** @throws {ViewerError} unless the value is a number from `low` to `high`, both finite or infinite, but not NaN. */
function number(value: unknown, what: string, low: number, high: number, code: Code = 'viewer/camera'): number {
  if (typeof value !== 'number' || !(value >= low && value <= high)) {
    const range = low === -high ? `of at most ${high} in either direction` : `from ${low} to ${high}`;
    throw wrong(what, value, `a number ${range}`, code);
  }
  return value;
}

const wrong = (what: string, value: unknown, needs: string, code: Code = 'viewer/camera') =>
  new ViewerError(code, `${what} is ${shownValue(value)}; it must be ${needs}.`);
const cameraError = (message: string) => new ViewerError('viewer/camera', message);
const isObject = (value: unknown): boolean => typeof value === 'object' && value !== null;

/**
 * A setting's value.
 * @throws {ViewerError} `viewer/option` for NaN, an infinity, another type, or a number outside of the setting's range.
 */
export function checkedSetting(name: keyof typeof RANGES, value: unknown): number {
  const [low, high] = RANGES[name];
  const checked = number(value, name, low, high, 'viewer/option');
  if (WHOLE.has(name) && !Number.isInteger(checked)) throw wrong(name, value, 'a whole number', 'viewer/option');
  return checked;
}

/**
 * The value of an option of the renderer.
 * @param as Its name in the viewer.
 * @throws {ViewerError} `viewer/option`
 */
export function checkedOption<Name extends RenderOptionName>(
  name: Name,
  value: unknown,
  as: string = name,
): NonNullable<RenderSettings[Name]> {
  if (!takesOption(name, value)) throw wrong(as, value, optionValues(name), 'viewer/option');
  return value as NonNullable<RenderSettings[Name]>;
}

/** @throws {ViewerError} `viewer/option` */
export function checkedMode(mode: unknown): PreviewMode {
  if (!MODES.includes(mode as PreviewMode)) throw wrong('preview', mode, MODES.join(', '), 'viewer/option');
  return mode as PreviewMode;
}

/**
 * Checks all settings that are given; those of the preview lie in an object of their own.
 * @throws {ViewerError} `viewer/option`; `viewer/camera` for the limits of the orbit.
 */
export function checkSettings(options: ViewerOptions): void {
  for (const name of Object.keys(RENDER_OPTIONS) as RenderOptionName[]) {
    const value = (options as RenderSettings)[name];
    if (value !== undefined) checkedOption(name, value);
  }
  if (options.orbitLimits !== undefined) checkedLimits(options.orbitLimits);
  const { denoise } = options;
  if (denoise !== undefined && typeof denoise !== 'function')
    throw wrong('denoise', denoise, 'made by denoising()', 'viewer/option');
  const preview = previewOptions(options);
  if (preview.mode !== undefined) checkedMode(preview.mode);
  const depth = preview.maxDepth;
  if (depth !== undefined) checkedOption('maxDepth', depth, 'preview.maxDepth');
  for (const name of Object.keys(RANGES) as (keyof typeof RANGES)[]) {
    const [group, inner] = name.split('.') as [keyof ViewerOptions, string?];
    const value = inner === undefined ? options[group] : (preview as Readonly<Record<string, unknown>>)[inner];
    if (value !== undefined) checkedSetting(name, value);
  }
}

/** @throws {ViewerError} `viewer/option` for what is no place of a model, or no ground. */
export function checkedStage({ modelTransform, ground }: Pick<ViewerOptions, 'modelTransform' | 'ground'>): Stage {
  const stage: { transform?: readonly number[]; ground?: GroundOptions } = {};
  if (modelTransform !== undefined) {
    const m = (stage.transform = Array.from(modelTransform));
    const volume = dot(cross([0, 0, 0], m.slice(0, 3), m.slice(4, 7)), m.slice(8, 11));
    if (m.length !== 16 || !m.every(Number.isFinite) || !volume)
      throw wrong('modelTransform', m.join(), '16 finite numbers, of a matrix that has an inverse', 'viewer/option');
  }
  if (ground !== undefined) {
    number(ground.shadow ?? 1, 'ground.shadow', 0, 1, 'viewer/option');
    number(ground.reflection ?? 0, 'ground.reflection', 0, 1, 'viewer/option');
    stage.ground = ground;
  }
  return stage;
}

/**
 * A number that moves the camera: of radians, heights of the image, or CSS pixels. @throws {ViewerError}
 * `viewer/camera`
 */
export const checkedAmount = (value: unknown, what: string): number => number(value, what, -MAX_TURN, MAX_TURN);

/** @throws {ViewerError} `viewer/camera` unless the value is three finite numbers of metres. */
export function checkedPoint(value: unknown, what: string): Vector {
  const point = value as Vector;
  if (!isObject(value) || point.length !== 3) throw wrong(what, value, 'three numbers');
  return [0, 1, 2].map((k) => number(point[k as 0], `${what}[${k}]`, -FAR, FAR)) as unknown as Vector;
}

/** @throws {ViewerError} `viewer/camera` unless the value is three finite numbers that are not all 0. */
export function checkedDirection(value: unknown, what: string): Vector {
  const direction = checkedPoint(value, what);
  if (!(Math.hypot(...direction) > 1e-12)) throw cameraError(`${what} has no length, so it gives no direction.`);
  return direction;
}

/** A magnification. @throws {ViewerError} `viewer/camera` */
export const checkedZoom = (value: unknown): number => number(value, 'zoom', 1e-6, 1e6);

/** A vertical field of view, radians. @throws {ViewerError} `viewer/camera` unless it lies between 0 and π. */
export function checkedFieldOfView(value: unknown): number {
  if (typeof value !== 'number' || !(value > 1e-6 && value < Math.PI - 1e-6))
    throw wrong('The vertical field of view', value, 'a number of radians between 0 and π');
  return value;
}

/** The given parts of an orbit. @throws {ViewerError} `viewer/camera` */
export function checkedOrbit(orbit: Partial<Orbit>): { readonly [Name in keyof Orbit]: Orbit[Name] | undefined } {
  if (!isObject(orbit))
    throw cameraError(`An orbit is an object with theta, phi, radius or target, not ${shownValue(orbit)}.`);
  const given = <T>(name: keyof Orbit, check: (value: unknown, what: string) => T) =>
    orbit[name] === undefined ? undefined : check(orbit[name], name);
  return {
    theta: given('theta', checkedAmount),
    phi: given('phi', checkedAmount),
    radius: given('radius', (value, what) => number(value, what, 1 / FAR, FAR)),
    target: given('target', checkedPoint),
    zoom: given('zoom', checkedZoom),
  };
}

/** Limits of an orbit; infinite ones limit nothing. @throws {ViewerError} `viewer/camera` */
export function checkedLimits(limits: OrbitLimits): OrbitLimits {
  if (!isObject(limits))
    throw cameraError(`Limits of an orbit are an object with theta, phi or radius, not ${shownValue(limits)}.`);
  const checked: { -readonly [Name in keyof OrbitLimits]: OrbitLimits[Name] } = {};
  for (const name of ['theta', 'phi', 'radius'] as const) {
    const pair = limits[name];
    if (pair === undefined) continue;
    if (!Array.isArray(pair) || pair.length !== 2)
      throw wrong(`The limit of ${name}`, pair, 'two numbers, the lowest and the highest');
    const [low, high] = pair.map((value, k) => number(value, `The limit of ${name}[${k}]`, -Infinity, Infinity)) as [
      number,
      number,
    ];
    if (low > high || (name === 'radius' && !(high > 0)) || low === Infinity || high === -Infinity)
      throw cameraError(`The limits of ${name} are ${low} and ${high}, which leave nothing between them.`);
    checked[name] = [low, high];
  }
  return checked;
}

/** A camera that can be rendered with. @throws {ViewerError} `viewer/camera` */
export function checkedCamera(camera: Camera): Camera {
  if (!isObject(camera)) throw cameraError(`A camera is an object with type and transform, not ${shownValue(camera)}.`);
  const what = `Camera ${shownValue(camera.name)}`;
  const { type, transform } = camera;
  if (type !== 'perspective' && type !== 'orthographic' && type !== 'panorama')
    throw cameraError(`${what} has the type ${shownValue(type)}; it must be perspective, orthographic or panorama.`);
  if (!isObject(transform) || transform.length !== 16) throw cameraError(`${what} has no transform of 16 numbers.`);
  const m = Array.from(transform, (value, k) => number(value, `${what}: transform[${k}]`, -FAR, FAR));
  const [x, y, z] = [0, 4, 8].map((k) => column(m, k)) as [Vector, Vector, Vector];
  const volume = Math.abs(dot(x, cross([0, 0, 0], y, z)));
  if (!(volume > 1e-6 * Math.hypot(...x) * Math.hypot(...y) * Math.hypot(...z)))
    throw cameraError(`${what}: the axes of its transform have no length or lie in one plane.`);
  if (type === 'orthographic') {
    for (const name of ['xmag', 'ymag'] as const) number(camera[name], `${what}: ${name}`, 1 / FAR, FAR);
  } else if (type === 'perspective') {
    checkedFieldOfView(camera.yfov);
    for (const [name, low] of [
      ['aspect', 1 / FAR],
      ['lens_radius', 0],
      ['lens_blades', 0],
      ['lens_rotation', -FAR],
      ['focus_distance', 1 / FAR],
    ] as const) {
      if (camera[name] !== undefined) number(camera[name], `${what}: ${name}`, low, FAR);
    }
  }
  return camera;
}

/** @throws {ViewerError} `viewer/destroyed` */
export function checkAlive(engine: Engine): void {
  if (engine.state === 'destroyed') throw destroyed();
}

/** The scene that an engine shows. @throws {ViewerError} `viewer/destroyed`, `viewer/no-scene` */
export function sceneOf(engine: Engine): Scene {
  checkAlive(engine);
  if (!engine.tracer) throw new ViewerError('viewer/no-scene', 'There is no scene yet: await load() first.');
  return engine.tracer.scene;
}
