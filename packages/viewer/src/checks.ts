import {
  optionValues,
  RENDER_OPTIONS,
  shownValue,
  takesOption,
  type RenderOptionName,
  type RenderSettings,
} from '@glanz/renderer/options';
import type { Camera } from '@glanz/scene';
import { ViewerError } from './errors';
import type { ViewerOptions } from './options';
import type { Orbit, OrbitLimits, Vector } from './orbit-state';

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

/** Settings that are whole numbers. */
const WHOLE: ReadonlySet<string> = new Set(['maxPixels', 'width', 'height']);

type Code = 'viewer/option' | 'viewer/camera';

/** @throws {ViewerError} unless the value is a number from `low` to `high`, both finite or infinite, but not NaN. */
function number(value: unknown, what: string, low: number, high: number, code: Code): number {
  if (typeof value !== 'number' || !(value >= low && value <= high)) {
    const range = low === -high ? `of at most ${high} in either direction` : `from ${low} to ${high}`;
    throw new ViewerError(code, `${what} is ${shownValue(value)}; it must be a number ${range}.`);
  }
  return value;
}

/**
 * A setting's value.
 * @throws {ViewerError} `viewer/option` for NaN, an infinity, another type, or a number outside of the setting's range.
 */
export function checkedSetting(name: keyof typeof RANGES, value: unknown): number {
  const [low, high] = RANGES[name];
  const checked = number(value, name, low, high, 'viewer/option');
  if (WHOLE.has(name) && !Number.isInteger(checked))
    throw new ViewerError('viewer/option', `${name} is ${checked}; it must be a whole number.`);
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
  if (!takesOption(name, value))
    throw new ViewerError('viewer/option', `${as} is ${shownValue(value)}; it must be ${optionValues(name)}.`);
  return value as NonNullable<RenderSettings[Name]>;
}

/**
 * Checks all settings that are given; those of the preview lie in an object of their own. @throws {ViewerError}
 * `viewer/option`
 */
export function checkSettings(options: ViewerOptions): void {
  for (const name of Object.keys(RENDER_OPTIONS) as RenderOptionName[]) {
    const value = (options as RenderSettings)[name];
    if (value !== undefined) checkedOption(name, value);
  }
  const depth = options.preview?.maxDepth;
  if (depth !== undefined) checkedOption('maxDepth', depth, 'preview.maxDepth');
  for (const name of Object.keys(RANGES) as (keyof typeof RANGES)[]) {
    const [group, inner] = name.split('.') as [keyof ViewerOptions, string?];
    const value =
      inner === undefined
        ? options[group]
        : (options.preview as Readonly<Record<string, unknown>> | undefined)?.[inner];
    if (value !== undefined) checkedSetting(name, value);
  }
}

/**
 * A number that moves the camera: of radians, heights of the image, or CSS pixels. @throws {ViewerError}
 * `viewer/camera`
 */
export const checkedAmount = (value: unknown, what: string): number =>
  number(value, what, -MAX_TURN, MAX_TURN, 'viewer/camera');

/** @throws {ViewerError} `viewer/camera` unless the value is three finite numbers of metres. */
export function checkedPoint(value: unknown, what: string): Vector {
  const point = value as Vector;
  if (typeof value !== 'object' || value === null || point.length !== 3)
    throw new ViewerError('viewer/camera', `${what} is ${shownValue(value)}; it must be three numbers.`);
  return [0, 1, 2].map((k) => number(point[k as 0], `${what}[${k}]`, -FAR, FAR, 'viewer/camera')) as unknown as Vector;
}

/** @throws {ViewerError} `viewer/camera` unless the value is three finite numbers that are not all 0. */
export function checkedDirection(value: unknown, what: string): Vector {
  const direction = checkedPoint(value, what);
  if (!(Math.hypot(...direction) > 1e-12))
    throw new ViewerError('viewer/camera', `${what} has no length, so it gives no direction.`);
  return direction;
}

/** A magnification. @throws {ViewerError} `viewer/camera` */
export const checkedZoom = (value: unknown): number => number(value, 'zoom', 1e-6, 1e6, 'viewer/camera');

/** A vertical field of view, radians. @throws {ViewerError} `viewer/camera` unless it lies between 0 and π. */
export function checkedFieldOfView(value: unknown): number {
  if (typeof value !== 'number' || !(value > 1e-6 && value < Math.PI - 1e-6))
    throw new ViewerError(
      'viewer/camera',
      `The vertical field of view is ${shownValue(value)}; it must be a number of radians between 0 and π.`,
    );
  return value;
}

/** The given parts of an orbit. @throws {ViewerError} `viewer/camera` */
export function checkedOrbit(orbit: Partial<Orbit>): Partial<Orbit> {
  if (typeof orbit !== 'object' || orbit === null)
    throw new ViewerError(
      'viewer/camera',
      `An orbit is an object with theta, phi, radius or target, not ${shownValue(orbit)}.`,
    );
  const { theta, phi, radius, target, zoom } = orbit;
  return {
    ...(theta === undefined ? {} : { theta: number(theta, 'theta', -MAX_TURN, MAX_TURN, 'viewer/camera') }),
    ...(phi === undefined ? {} : { phi: number(phi, 'phi', -MAX_TURN, MAX_TURN, 'viewer/camera') }),
    ...(radius === undefined ? {} : { radius: number(radius, 'radius', 1 / FAR, FAR, 'viewer/camera') }),
    ...(target === undefined ? {} : { target: checkedPoint(target, 'target') }),
    ...(zoom === undefined ? {} : { zoom: checkedZoom(zoom) }),
  };
}

/** Limits of an orbit; infinite ones limit nothing. @throws {ViewerError} `viewer/camera` */
export function checkedLimits(limits: OrbitLimits): OrbitLimits {
  if (typeof limits !== 'object' || limits === null)
    throw new ViewerError(
      'viewer/camera',
      `Limits of an orbit are an object with theta, phi or radius, not ${shownValue(limits)}.`,
    );
  const range = (name: keyof OrbitLimits): readonly [number, number] | undefined => {
    const pair = limits[name];
    if (pair === undefined) return undefined;
    if (!Array.isArray(pair) || pair.length !== 2)
      throw new ViewerError(
        'viewer/camera',
        `The limit of ${name} is ${shownValue(pair)}; it must be two numbers, the lowest and the highest.`,
      );
    const [low, high] = pair.map((value, k) =>
      number(value, `The limit of ${name}[${k}]`, -Infinity, Infinity, 'viewer/camera'),
    ) as [number, number];
    if (low > high || (name === 'radius' && !(high > 0)) || low === Infinity || high === -Infinity)
      throw new ViewerError(
        'viewer/camera',
        `The limits of ${name} are ${low} and ${high}, which leave nothing between them.`,
      );
    return [low, high];
  };
  const [theta, phi, radius] = [range('theta'), range('phi'), range('radius')];
  return { ...(theta ? { theta } : {}), ...(phi ? { phi } : {}), ...(radius ? { radius } : {}) };
}

/** A camera that can be rendered with. @throws {ViewerError} `viewer/camera` */
export function checkedCamera(camera: Camera): Camera {
  if (typeof camera !== 'object' || camera === null)
    throw new ViewerError('viewer/camera', `A camera is an object with type and transform, not ${shownValue(camera)}.`);
  const what = `Camera ${shownValue(camera.name)}`;
  const { type, transform } = camera;
  if (type !== 'perspective' && type !== 'orthographic' && type !== 'panorama')
    throw new ViewerError(
      'viewer/camera',
      `${what} has the type ${shownValue(type)}; it must be perspective, orthographic or panorama.`,
    );
  if (typeof transform !== 'object' || transform === null || transform.length !== 16)
    throw new ViewerError('viewer/camera', `${what} has no transform of 16 numbers.`);
  const m = Array.from(transform, (value, k) => number(value, `${what}: transform[${k}]`, -FAR, FAR, 'viewer/camera'));
  const [x, y, z] = [0, 4, 8].map((k) => [m[k], m[k + 1], m[k + 2]]) as unknown as [Vector, Vector, Vector];
  const volume = Math.abs(
    x[0] * (y[1] * z[2] - y[2] * z[1]) - y[0] * (x[1] * z[2] - x[2] * z[1]) + z[0] * (x[1] * y[2] - x[2] * y[1]),
  );
  if (!(volume > 1e-6 * Math.hypot(...x) * Math.hypot(...y) * Math.hypot(...z)))
    throw new ViewerError('viewer/camera', `${what}: the axes of its transform have no length or lie in one plane.`);
  if (type === 'orthographic') {
    for (const name of ['xmag', 'ymag'] as const)
      number(camera[name], `${what}: ${name}`, 1 / FAR, FAR, 'viewer/camera');
  } else if (type === 'perspective') {
    checkedFieldOfView(camera.yfov);
    for (const [name, low] of [
      ['aspect', 1 / FAR],
      ['lens_radius', 0],
      ['lens_blades', 0],
      ['lens_rotation', -FAR],
      ['focus_distance', 1 / FAR],
    ] as const) {
      if (camera[name] !== undefined) number(camera[name], `${what}: ${name}`, low, FAR, 'viewer/camera');
    }
  }
  return camera;
}
