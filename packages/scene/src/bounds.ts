import type { Instance, Scene } from './scene';
import type { Mesh } from './mesh';
import { finish, STEP, type Steps } from './slices';
import { usedVertices } from './used-vertices';

/** An axis-aligned box in the world, metres. Empty: min is +∞ and max −∞. */
export interface SceneBounds {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/**
 * The box around all visible triangles, exact to their vertices under their transforms. Vertices that no triangle uses do
 * not count, nor do lights and cameras.
 */
export function sceneBounds(scene: Scene): SceneBounds {
  return finish(sceneBoundsSteps(scene));
}

/**
 * The same as {@link sceneBounds} in steps of a millisecond or so, for `inSlices`. The scene must stay as it is until the
 * last step.
 */
export function* sceneBoundsSteps(scene: Scene): Generator<void, SceneBounds> {
  return yield* boundsBy(scene, new Map());
}

/** The vertices of a mesh that triangles use, found once. */
export function* usedOf(mesh: Mesh, found: Map<Mesh, Uint8Array>): Steps<Uint8Array> {
  let used = found.get(mesh);
  if (!used) found.set(mesh, (used = yield* usedVertices(mesh)));
  return used;
}

/** {@link sceneBoundsSteps}, with a memory for the vertices in use. */
export function* boundsBy(scene: Scene, found: Map<Mesh, Uint8Array>): Steps<SceneBounds> {
  const box = Float64Array.of(Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity);
  for (const instance of scene.instances) {
    const mesh = scene.meshes[instance.mesh];
    if (instance.visible === false || !mesh) continue;
    const used = yield* usedOf(mesh, found);
    for (let from = 0; from < used.length; from += STEP) {
      growByMesh(mesh, used, from, Math.min(used.length, from + STEP), instance, box);
      yield;
    }
  }
  const [x0, y0, z0, x1, y1, z1] = box as unknown as [number, number, number, number, number, number];
  return { min: [x0, y0, z0], max: [x1, y1, z1] };
}

function growByMesh({ positions }: Mesh, used: Uint8Array, from: number, to: number, { transform: m }: Instance, box: Float64Array): void {
  const [a, b, c, , d, e, f, , g, h, i, , tx, ty, tz] = Array.from(m) as [number, number, number, number, number, number, number, number, number, number, number, number, number, number, number];
  let [x0, y0, z0, x1, y1, z1] = box as unknown as [number, number, number, number, number, number];
  for (let n = from, v = 3 * from; n < to; n++, v += 3) {
    if (used[n] === 0) continue;
    const px = positions[v] as number, py = positions[v + 1] as number, pz = positions[v + 2] as number;
    const x = a * px + d * py + g * pz + tx, y = b * px + e * py + h * pz + ty, z = c * px + f * py + i * pz + tz;
    if (x < x0) x0 = x;
    if (y < y0) y0 = y;
    if (z < z0) z0 = z;
    if (x > x1) x1 = x;
    if (y > y1) y1 = y;
    if (z > z1) z1 = z;
  }
  box.set([x0, y0, z0, x1, y1, z1]);
}
