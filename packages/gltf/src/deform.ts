import type { Material, Mesh, SceneWarning } from '@glanz/scene';
import { applySkin, blendTargets, unitNormals } from '@glanz/scene/pose';
import { withoutUnusedVertices } from './attributes';
import type { Matrix } from './matrix';
import { jointNumbers, skinOf, targetsOf, type Influences } from './pose';
import type { PrimitiveData } from './primitive';
import { tangentSet, withTangents } from './tangents';

/** How a mesh is deformed. */
export interface Deformation {
  /** Of the morph targets; none: no weights. */
  readonly weights: readonly number[];
  /** Matrices of the joints and which vertices they move; undefined: no skin. */
  readonly skin:
    | { readonly matrices: readonly (Matrix | undefined)[]; readonly influences: readonly Influences[] }
    | undefined;
}

/**
 * A mesh as `readPrimitive` has read it, with its morph targets blended in and its skin applied, without the vertices
 * that no triangle uses, and with the tangents that its materials need. The given mesh is not changed.
 *
 * @param materials Those that the mesh is shown with.
 */
export function deformed(
  base: Mesh,
  primitive: PrimitiveData,
  { weights, skin }: Deformation,
  materials: readonly (Material | undefined)[],
  path: string,
  warnings: SceneWarning[],
): Mesh {
  const blended = weights.some((weight) => weight !== 0);
  const isUsed = (target: number) => (weights[target] ?? 0) !== 0;
  let made = blended ? blendTargets(base, targetsOf(primitive, isUsed), weights) : base;
  if (skin) made = applySkin(made, skinOf(skin.influences, skin.matrices), jointNumbers(skin.matrices));
  // Blended normals are shorter than 1 and may cancel out.
  if ((skin || blended) && made.normals)
    unitNormals(made.normals, made.positions, made.indices, (message) =>
      warnings.push({ code: 'gltf/primitive', message: `${base.name}: ${message}`, path }),
    );
  made = withoutUnusedVertices(made);
  const set = materials.map(tangentSet).find((uvSet) => uvSet !== undefined);
  return set === undefined ? made : withTangents(made, set);
}
