import { checkSceneSteps, determinant } from './check-scene';
import type { Material } from './material';
import type { Mesh } from './mesh';
import type { Instance, Scene, SceneWarning } from './scene';
import { finish, STEP, type Steps } from './slices';

/** Whether three vertices (offsets into the positions) are exactly collinear. */
function isFlat(p: Float32Array, a: number, b: number, c: number): boolean {
  const ax = p[a] as number,
    ay = p[a + 1] as number,
    az = p[a + 2] as number;
  const ux = (p[b] as number) - ax,
    uy = (p[b + 1] as number) - ay,
    uz = (p[b + 2] as number) - az;
  const vx = (p[c] as number) - ax,
    vy = (p[c + 1] as number) - ay,
    vz = (p[c + 2] as number) - az;
  return uy * vz === uz * vy && uz * vx === ux * vz && ux * vy === uy * vx;
}

/** Counts the triangles without area among the indices from `from` up to `end`. */
function countFlat({ positions, indices }: Mesh, from: number, end: number): number {
  let flat = 0;
  for (let i = from; i < end; i += 3) {
    const a = indices[i] as number,
      b = indices[i + 1] as number,
      c = indices[i + 2] as number;
    if (a === b || b === c || a === c || isFlat(positions, 3 * a, 3 * b, 3 * c)) flat++;
  }
  return flat;
}

function* flatSteps(mesh: Mesh, index: number, warnings: SceneWarning[]): Steps<void> {
  const { length } = mesh.indices;
  let flat = 0;
  for (let from = 0; from < length; from += 3 * STEP) {
    flat += countFlat(mesh, from, Math.min(length, from + 3 * STEP));
    yield;
  }
  if (flat > 0)
    warnings.push({
      code: 'scene/degenerate',
      message: `Mesh ${index} ("${mesh.name}") has ${flat} triangle${flat === 1 ? '' : 's'} without area; nothing hits ${flat === 1 ? 'it' : 'them'}.`,
      path: `/meshes/${index}`,
    });
}

/** Warnings about an instance. */
function inspectInstance(scene: Scene, index: number, warnings: SceneWarning[]): void {
  const instance = scene.instances[index] as Instance;
  const what = () => `Instance ${index} ("${instance.name}")`;
  // glTF files hide parts with a scale of 0, so this is only a warning; the BVH leaves such instances out.
  if (determinant(instance.transform) === 0)
    warnings.push({
      code: 'scene/flattened',
      message: `${what()} is flattened by its transform; it does not appear.`,
      path: `/instances/${index}`,
    });
  const { textures } = scene.materials[instance.material] as Material;
  if (!textures) return;
  const sets = (scene.meshes[instance.mesh] as Mesh).uvs?.length ?? 0;
  for (const [name, binding] of Object.entries(textures)) {
    const set = binding?.uv ?? 0;
    if (binding && set >= sets)
      warnings.push({
        code: 'scene/missing-uv',
        message: `${what()} has no UV set ${set}, which the texture of ${name} uses; the texture is read at (0, 0).`,
        path: `/instances/${index}`,
      });
  }
}

/**
 * Checks a scene as `checkScene` does, and looks for suspicious parts: another pass over the data, 10 milliseconds
 * in all for a million triangles. Renderers check their scenes themselves.
 *
 * @returns Warnings: `scene/degenerate` (triangles without area), `scene/flattened` (an instance whose
 *   transform cannot be inverted), `scene/missing-uv` (a texture on a mesh without its UV set).
 * @throws {SceneError} at the first fault, with its place.
 */
export function validateScene(scene: Scene): SceneWarning[] {
  return finish(validationSteps(scene));
}

/**
 * The same as {@link validateScene} in steps of about a millisecond, for `inSlices`. The scene must not change until the
 * last step.
 *
 * @throws {SceneError} as {@link validateScene}, at the first step or a later one.
 * @example
 * const warnings = await inSlices(validationSteps(scene));
 */
export function* validationSteps(scene: Scene): Steps<SceneWarning[]> {
  yield* checkSceneSteps(scene);
  const warnings: SceneWarning[] = [];
  for (const [index, mesh] of scene.meshes.entries()) yield* flatSteps(mesh, index, warnings);
  for (let index = 0; index < scene.instances.length; index++) {
    if (index % 4096 === 4095) yield;
    inspectInstance(scene, index, warnings);
  }
  return warnings;
}
