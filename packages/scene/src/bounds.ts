import { extentSteps, type ExtentCache } from './extents';
import type { Scene } from './scene';
import { finish, type Steps } from './slices';

const AXES = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
  [-1, 0, 0],
  [0, -1, 0],
  [0, 0, -1],
] as const;

/** An axis-aligned box in the world, metres. Empty: min is +∞ and max −∞. */
export interface SceneBounds {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/**
 * The box around all visible triangles, exact for their transformed vertices. Vertices that no triangle uses, lights
 * and cameras do not count.
 */
export function sceneBounds(scene: Scene): SceneBounds {
  return finish(sceneBoundsSteps(scene));
}

/**
 * The same as {@link sceneBounds} in steps of about a millisecond, for `inSlices`. The scene must not change until the
 * last step.
 */
export function* sceneBoundsSteps(scene: Scene): Generator<void, SceneBounds> {
  return yield* boundsBy(scene, { vertices: new Map() });
}

/** {@link sceneBoundsSteps}, with a cache. */
export function* boundsBy(scene: Scene, cache: ExtentCache): Steps<SceneBounds> {
  const [x1, y1, z1, x0, y0, z0] = (yield* extentSteps(scene, AXES, [0, 0, 0], cache)) as unknown as [
    number,
    number,
    number,
    number,
    number,
    number,
  ];
  return { min: [0 - x0, 0 - y0, 0 - z0], max: [x1, y1, z1] };
}
