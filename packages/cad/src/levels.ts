import type { MeshoptSimplifier } from 'meshoptimizer/simplifier';
import type { Mesh, Scene } from '@glanz/scene';
import { CadError } from './error';
import { withSoundNormals } from './sound-normals';
import { withUsedVertices } from './scene';

/** Options for {@link levelsOfDetail}. */
export interface LevelOptions {
  /** Number of scenes returned, of which the first is the one given; default 3. */
  readonly levels?: number;
  /** Triangles of a level over those of the level before; default 1/4. */
  readonly ratio?: number;
  /**
   * How far the coarsest level may lie from the finest, of each part's size; default 0.05. What cannot keep to it has
   * more triangles.
   */
  readonly error?: number;
}

/**
 * A ladder of scenes from fine to coarse, simplified by meshoptimizer (quadric errors; M. Garland and P. Heckbert,
 * "Surface Simplification Using Quadric Error Metrics", 1997), normals taken into account. Materials, names and places
 * are shared.
 *
 * @throws {CadError} `cad/option` for numbers out of range.
 */
export async function levelsOfDetail(
  scene: Scene,
  { levels = 3, ratio = 0.25, error = 0.05 }: LevelOptions = {},
): Promise<Scene[]> {
  if (!(Number.isInteger(levels) && levels >= 1 && levels <= 16 && ratio > 0 && ratio < 1 && error > 0))
    throw new CadError(
      'cad/option',
      `${levels} levels of ratio ${ratio} are not possible: 1 to 16 levels, a ratio between 0 and 1.`,
    );
  // Loaded here, since importing it is no way to do nothing.
  const { MeshoptSimplifier: simplifier } = await import('meshoptimizer/simplifier');
  await simplifier.ready;
  const scenes = [scene];
  for (let level = 1; level < levels; level++) {
    const bound = (error * level) / (levels - 1);
    scenes.push({ ...scene, meshes: scene.meshes.map((mesh) => simplified(simplifier, mesh, ratio ** level, bound)) });
  }
  return scenes;
}

function simplified(simplifier: typeof MeshoptSimplifier, mesh: Mesh, share: number, error: number): Mesh {
  const target = Math.max(3, 3 * Math.round((mesh.indices.length / 3) * share));
  // Some simplifiers of bodies can fold a small one up altogether: such a part stays as it is.
  const [indices] = mesh.normals
    ? simplifier.simplifyWithAttributes(
        mesh.indices,
        mesh.positions,
        3,
        mesh.normals,
        3,
        [0.3, 0.3, 0.3],
        null,
        target,
        error,
      )
    : simplifier.simplify(mesh.indices, mesh.positions, 3, target, error);
  return indices.length < 3 ? mesh : withSoundNormals(withUsedVertices({ ...mesh, indices: new Uint32Array(indices) }));
}
