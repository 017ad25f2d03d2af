import { frameCamera, type Camera, type Scene } from '@glanz/scene';
import { cross, distance, subtract } from 'gl-matrix/esm/vec3.js';
import { CliError } from './errors';
import { MAX_SETTINGS_BYTES, readInput } from './input';

type Vector = readonly [number, number, number];

const wrong = (message: string) => new CliError('cli/camera', message);

function vector(value: unknown, name: string): Vector {
  if (!Array.isArray(value) || value.length !== 3 || !value.every((v) => typeof v === 'number' && Number.isFinite(v))) {
    throw wrong(`--camera: "${name}" must be three numbers, like [0, 1, 3].`);
  }
  return value as unknown as Vector;
}

function optionalNumber(object: Record<string, unknown>, name: string, min: number, max: number): number | undefined {
  const value = object[name];
  if (value === undefined) return undefined;
  if (typeof value !== 'number' || !(value >= min && value <= max))
    throw wrong(`--camera: "${name}" must be a number from ${min} to ${max}.`);
  return value;
}

function unit(a: Vector): Vector | undefined {
  const length = Math.hypot(...a);
  return length > 1e-12 && Number.isFinite(length) ? [a[0] / length, a[1] / length, a[2] / length] : undefined;
}

/** Camera-to-world matrix, column-major, that looks from one point to another along −Z. */
export function lookAt(position: Vector, target: Vector, up: Vector): number[] {
  const back = unit(subtract([0, 0, 0], position, target));
  if (!back) throw wrong('--camera: "position" and "target" are the same point.');
  const right = [up, [0, 0, -1], [1, 0, 0]].map((side) => unit(cross([0, 0, 0], side, back))).find((axis) => axis);
  if (!right) throw wrong('--camera: no direction is up.');
  const above = cross([0, 0, 0], back, right);
  return [...right, 0, ...above, 0, ...back, 0, ...position, 1];
}

const FIELDS = [
  'name',
  'projection',
  'position',
  'target',
  'up',
  'fov',
  'height',
  'lens_radius',
  'lens_blades',
  'lens_rotation',
  'focus_distance',
];
const PROJECTIONS = ['perspective', 'orthographic', 'panorama'] as const;
/** Fields that only one projection has a use for. */
const PERSPECTIVE_ONLY = ['fov', 'lens_radius', 'lens_blades', 'lens_rotation', 'focus_distance'];

/**
 * A camera from JSON: `position`, `target` (default the origin), `up` (default +Y) and `projection`:
 *
 * - `perspective` (default): `fov` (vertical, degrees, default 35), `lens_radius` and `focus_distance` (metres; default
 *   focus: the target), `lens_blades`, `lens_rotation` (degrees);
 * - `orthographic`: `height` of the view in metres;
 * - `panorama`: the whole sphere.
 *
 * @param aspect Width over height of the image; default 1.
 * @throws {CliError} `cli/camera`
 */
export function cameraFromJson(text: string, aspect = 1): Camera {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (cause) {
    throw new CliError('cli/camera', `--camera: not valid JSON: ${(cause as Error).message.split('\n')[0]}.`, {
      cause,
    });
  }
  if (typeof value !== 'object' || value === null || Array.isArray(value))
    throw wrong('--camera: the JSON must be an object with "position" and "target".');
  const object = value as Record<string, unknown>;
  const unknown = Object.keys(object).find((key) => !FIELDS.includes(key));
  if (unknown !== undefined) throw wrong(`--camera: unknown field "${unknown}". Known: ${FIELDS.join(', ')}.`);
  if (object.position === undefined) throw wrong('--camera: "position" is missing.');
  const type = PROJECTIONS.find((known) => known === (object.projection ?? 'perspective'));
  if (!type) throw wrong(`--camera: "projection" must be one of ${PROJECTIONS.join(', ')}.`);
  const stray = [
    ...(type === 'perspective' ? [] : PERSPECTIVE_ONLY),
    ...(type === 'orthographic' ? [] : ['height']),
  ].find((key) => object[key] !== undefined);
  if (stray !== undefined) throw wrong(`--camera: a camera of projection "${type}" has no "${stray}".`);
  const position = vector(object.position, 'position');
  const target = vector(object.target ?? [0, 0, 0], 'target');
  const base = {
    name: typeof object.name === 'string' ? object.name : 'camera',
    transform: lookAt(position, target, vector(object.up ?? [0, 1, 0], 'up')),
  };
  if (type === 'panorama') return { type, ...base };
  if (type === 'orthographic') {
    const height = optionalNumber(object, 'height', 1e-9, 1e9);
    if (height === undefined)
      throw wrong('--camera: an orthographic camera needs "height", the height of its view in metres.');
    return { type, ...base, xmag: (height * aspect) / 2, ymag: height / 2 };
  }
  const lens = optionalNumber(object, 'lens_radius', 0, 1e6);
  const focus = optionalNumber(object, 'focus_distance', 1e-6, 1e9) ?? distance(position, target);
  const blades = optionalNumber(object, 'lens_blades', 0, 64);
  const rotation = optionalNumber(object, 'lens_rotation', -36000, 36000);
  return {
    type,
    ...base,
    yfov: ((optionalNumber(object, 'fov', 0.1, 175) ?? 35) * Math.PI) / 180,
    ...(lens === undefined ? {} : { lens_radius: lens, focus_distance: focus }),
    ...(blades === undefined ? {} : { lens_blades: blades }),
    ...(rotation === undefined ? {} : { lens_rotation: (rotation * Math.PI) / 180 }),
  };
}

/**
 * The camera that `--camera` names: one of the scene's by name or number, JSON, or a .json file. By default: the
 * scene's first, or one that frames the scene.
 *
 * @throws {CliError} `cli/camera`, `cli/input`
 */
export async function chooseCamera(
  scene: Scene,
  choice: string | undefined,
  aspect: number,
  cwd: string,
): Promise<Camera> {
  if (choice === undefined) return scene.cameras[0] ?? frameCamera(scene, { aspect });
  if (choice.trimStart().startsWith('{')) return cameraFromJson(choice, aspect);
  const named =
    scene.cameras.find(({ name }) => name === choice) ??
    (/^\d+$/.test(choice) ? scene.cameras[Number(choice)] : undefined);
  if (named) return named;
  if (/\.json$/i.test(choice)) {
    return cameraFromJson(
      new TextDecoder().decode(await readInput(choice, cwd, 'the camera', { maxBytes: MAX_SETTINGS_BYTES })),
      aspect,
    );
  }
  const names = scene.cameras.map(({ name }, i) => `${i} "${name}"`).join(', ');
  throw wrong(`The model has no camera "${choice}"; ${names ? `it has ${names}` : 'it has none'}.`);
}
