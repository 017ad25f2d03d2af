import { frameCamera, sceneBounds, type Camera, type PerspectiveCamera, type Scene } from '@glanz/scene';
import { dot, lerp, scaleAndAdd, subtract } from 'gl-matrix/esm/vec3.js';
import { chooseCamera, lookAt } from './camera';

/** Where an image is taken from. */
export type View =
  /** A camera as `--camera` takes it; undefined: the model's first, or one that frames it. */
  | { readonly kind: 'camera'; readonly name: string; readonly camera: string | undefined }
  /**
   * All of the scene from a direction: degrees, 0 from the front (+Z), growing towards the right (+X); elevation from
   * the horizon.
   */
  | { readonly kind: 'direction'; readonly name: string; readonly azimuth: number; readonly elevation: number }
  /** One of `count` steps around the scene, always from the same distance. */
  | {
      readonly kind: 'turntable';
      readonly name: string;
      /** From 0; may lie between two whole numbers. */
      readonly step: number;
      readonly count: number;
      readonly elevation: number;
      /** Degrees that all steps go around. Default 360. */
      readonly degrees?: number;
    };

/** Views with names: azimuth and elevation in degrees. */
const NAMED: Readonly<Record<string, readonly [azimuth: number, elevation: number]>> = {
  front: [0, 0],
  right: [90, 0],
  back: [180, 0],
  left: [-90, 0],
  top: [0, 90],
  bottom: [0, -90],
  'front-right': [30.96, 21.1],
  'front-left': [-30.96, 21.1],
  'back-right': [149.04, 21.1],
  'back-left': [-149.04, 21.1],
  iso: [45, 35.264],
};

/** Names that `--view` knows. */
export const VIEW_NAMES = Object.keys(NAMED);

/** Text that can be part of a file's name. */
export const fileNamePart = (text: string): string =>
  text.replace(/[^\p{L}\p{N}._+-]+/gu, '_').replace(/^[._]+|_+$/g, '') || '_';

/** A view from what `--view` says: a name, `AZIMUTH,ELEVATION` in degrees, or whatever `--camera` takes. */
export function parseView(text: string): View {
  const named = Object.hasOwn(NAMED, text) ? NAMED[text] : undefined;
  const degrees = named ?? /^\s*(-?\d*\.?\d+)\s*,\s*(-?\d*\.?\d+)\s*$/.exec(text)?.slice(1).map(Number);
  if (degrees)
    return {
      kind: 'direction',
      name: named ? text : fileNamePart(text.replace(/\s/g, '').replace(',', '_')),
      azimuth: degrees[0] as number,
      elevation: degrees[1] as number,
    };
  return {
    kind: 'camera',
    name: text.trimStart().startsWith('{')
      ? 'camera'
      : fileNamePart((text.split(/[\\/]/).pop() as string).replace(/\.json$/i, '')),
    camera: text,
  };
}

/** The steps of a turntable. */
export const turntable = (count: number, elevation: number): View[] =>
  Array.from({ length: count }, (_, step) => ({
    kind: 'turntable',
    name: `turntable-${String(step).padStart(Math.max(3, String(count - 1).length), '0')}`,
    step,
    count,
    elevation,
  }));

type Vector = [number, number, number];

/** From the scene towards the camera. Straight up has no upright image: a hair beside it, −Z is up in it. */
function directionOf(azimuth: number, elevation: number): Vector {
  const a = (azimuth * Math.PI) / 180,
    e = (Math.min(Math.max(elevation, -89.99), 89.99) * Math.PI) / 180;
  return [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)];
}

/** The camera of a view. @throws {CliError} `cli/camera`, `cli/input` */
export async function cameraOf(view: View, scene: Scene, aspect: number, cwd: string): Promise<Camera> {
  if (view.kind === 'camera') return chooseCamera(scene, view.camera, aspect, cwd);
  if (view.kind === 'direction')
    return { ...frameCamera(scene, { aspect, direction: directionOf(view.azimuth, view.elevation) }), name: view.name };
  return turntableCamera(view, scene, aspect);
}

type Turntable = View & { readonly kind: 'turntable' };

/** A camera as it is framed, and how far away it stands. */
interface Stand {
  readonly framed: PerspectiveCamera;
  readonly center: Vector;
  readonly distance: number;
}

/** What the steps of a turntable share, which each scene's vertices are read for. */
const stands = new WeakMap<Scene, Map<string, Stand>>();

const azimuthOf = (step: number, { count, degrees = 360 }: Turntable) => (degrees * step) / count;

/** The largest distance from the middle of the scene that any step needs. */
function standOf(view: Turntable, scene: Scene, aspect: number): Stand {
  const { count, elevation, degrees } = view;
  const known = stands.get(scene) ?? new Map<string, Stand>();
  stands.set(scene, known);
  const key = [count, elevation, degrees, aspect].join();
  const found = known.get(key);
  if (found) return found;
  const { min, max } = sceneBounds(scene);
  const center: Vector = lerp([0, 0, 0], min, max, 0.5);
  let distance = 0;
  let framed: PerspectiveCamera | undefined;
  for (let i = 0; i < count; i++) {
    framed = frameCamera(scene, { aspect, direction: directionOf(azimuthOf(i, view), elevation) });
    const { transform, yfov } = framed;
    const m = Array.from(transform);
    const from = subtract([0, 0, 0], m.slice(12), center);
    const along = (column: number) => dot(m.slice(4 * column), from);
    // Framed cameras stand aside of the middle; standing in front of it asks for the same angle from further away.
    const ty = Math.tan(yfov / 2) * (1 - 0.06);
    distance = Math.max(distance, along(2) + Math.max(Math.abs(along(0)) / (ty * aspect), Math.abs(along(1)) / ty));
  }
  const stand = { framed: framed as PerspectiveCamera, center, distance };
  known.set(key, stand);
  return stand;
}

/**
 * The camera of a step: it looks at the middle of the scene from the largest distance that any step needs, so that
 * nothing grows or shrinks between steps.
 */
function turntableCamera(view: Turntable, scene: Scene, aspect: number): PerspectiveCamera {
  const { framed, center, distance } = standOf(view, scene, aspect);
  const direction = directionOf(azimuthOf(view.step, view), view.elevation);
  const eye = scaleAndAdd([0, 0, 0], center, direction, distance);
  return {
    ...framed,
    name: view.name,
    transform: lookAt(eye, center, [0, 1, 0]),
    focus_distance: distance,
  };
}
