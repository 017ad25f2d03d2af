import { sceneBounds, type PerspectiveCamera, type Scene } from '@glanz/scene';
import { withoutGround, type Orbit, type OrbitLimits } from '@glanz/viewer';
import { DEFAULT_ORBIT, readFieldOfView, readLimit, readOrbit, readPoint, type OrbitBasis } from './units';

/** What the attributes say about the view. */
export interface ViewAttributes {
  readonly orbit: string | null;
  readonly target: string | null;
  readonly fieldOfView: string | null;
  readonly min: string | null;
  readonly max: string | null;
}

type Point = readonly [number, number, number];

interface Frame {
  readonly center: Point;
  readonly basis: OrbitBasis;
  readonly yfov: number;
}

/**
 * What `auto` and percentages mean for a scene: its middle, and for 100 % the distance from which the ball around it
 * fits the smaller of the image's sides.
 */
function frameOf(scene: Scene, aspect: number, attributes: ViewAttributes): Frame {
  const { min, max } = sceneBounds(withoutGround(scene));
  const finite = min[0] <= max[0];
  const center = finite
    ? ([0, 1, 2].map((k) => ((min[k] as number) + (max[k] as number)) / 2) as unknown as Point)
    : ([0, 0, 0] as const);
  const radius = finite ? Math.max(1e-6, 0.5 * Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2])) : 1;
  const yfov = readFieldOfView(attributes.fieldOfView);
  // In an image that is higher than wide the viewer widens the field of view itself.
  const half = aspect >= 1 ? yfov / 2 : Math.atan(Math.tan(yfov / 2));
  return { center, yfov, basis: { ...DEFAULT_ORBIT, radius: radius / Math.sin(half) } };
}

/** The orbit that the attributes ask for. */
export function orbitOf(scene: Scene, aspect: number, attributes: ViewAttributes): Orbit {
  const { center, basis } = frameOf(scene, aspect, attributes);
  return { ...readOrbit(attributes.orbit, basis), target: readPoint(attributes.target, center) };
}

/** The limits that the attributes set. */
export function limitsOf(scene: Scene, aspect: number, attributes: ViewAttributes): OrbitLimits {
  const { basis } = frameOf(scene, aspect, attributes);
  const [low, high] = [readLimit(attributes.min, basis), readLimit(attributes.max, basis)];
  const range = (from: number | undefined, to: number | undefined) =>
    from === undefined && to === undefined
      ? undefined
      : ([from ?? -Infinity, Math.max(from ?? -Infinity, to ?? Infinity)] as const);
  const [theta, phi, radius] = [range(low.theta, high.theta), range(low.phi, high.phi), range(low.radius, high.radius)];
  return { ...(theta ? { theta } : {}), ...(phi ? { phi } : {}), ...(radius ? { radius } : {}) };
}

/** The camera that the attributes ask for. */
export function cameraOf(scene: Scene, aspect: number, attributes: ViewAttributes): PerspectiveCamera {
  const { yfov } = frameOf(scene, aspect, attributes);
  const { theta, phi, radius, target } = orbitOf(scene, aspect, attributes);
  // Straight above and below, "up" has no meaning.
  const steep = Math.min(Math.max(phi, 1e-3), Math.PI - 1e-3);
  const [st, ct, sp, cp] = [Math.sin(theta), Math.cos(theta), Math.sin(steep), Math.cos(steep)];
  const back = [sp * st, cp, sp * ct];
  const eye = back.map((value, k) => (target[k] as number) + value * radius);
  const transform = [ct, 0, -st, 0, -cp * st, sp, -cp * ct, 0, ...back, 0, ...eye, 1];
  return { type: 'perspective', name: 'camera-orbit', transform, yfov, aspect: 1, focus_distance: radius };
}

/** Where a view is from, in words: "from the front right, above". */
export function describeView({ theta, phi }: Pick<Orbit, 'theta' | 'phi'>): string {
  const turn = ((Math.round((theta / (2 * Math.PI)) * 8) % 8) + 8) % 8;
  const side = [
    'the front',
    'the front right',
    'the right',
    'the back right',
    'the back',
    'the back left',
    'the left',
    'the front left',
  ][turn] as string;
  const height =
    phi < Math.PI / 8
      ? ', straight above'
      : phi < (3 * Math.PI) / 8
        ? ', above'
        : phi > (7 * Math.PI) / 8
          ? ', straight below'
          : phi > (5 * Math.PI) / 8
            ? ', below'
            : '';
  return `from ${side}${height}`;
}
