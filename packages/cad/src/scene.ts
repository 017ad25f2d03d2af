import { createScene, type Mesh, type Scene } from '@glanz/scene';
import { materialOf, type CadMaterialMap } from './materials';
import type { CadColor, CadModel, CadPart } from './read';

/** Options for {@link cadToScene}. */
export interface CadSceneOptions {
  readonly materials?: CadMaterialMap;
  /** Leaves out the names of parts, assemblies and the file. Default false. */
  readonly strip?: boolean;
  /** Which axis of the file points up; default `z`. */
  readonly up?: 'y' | 'z';
}

/** From the file's axes to +Y up. */
const Z_UP = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1];
const Y_UP = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** Makes a scene of a CAD model: a mesh and an instance for each part and material. */
export function cadToScene(model: CadModel, { materials: map, strip = false, up = 'z' }: CadSceneOptions = {}): Scene {
  const scene = createScene(strip ? undefined : model.name);
  const indices = new Map<string, number>();
  const material = (part: CadPart, color: CadColor | undefined): number => {
    const made = materialOf(map, part.name, part.path, color);
    const key = JSON.stringify(made);
    const known = indices.get(key);
    if (known !== undefined) return known;
    const index = scene.materials.push(strip ? { ...made, name: `material ${scene.materials.length + 1}` } : made) - 1;
    indices.set(key, index);
    return index;
  };
  for (const part of model.parts) {
    const byMaterial = new Map<number, { from: number; to: number }[]>();
    for (const { from, to, color } of part.ranges) {
      const index = material(part, color);
      byMaterial.set(index, [...(byMaterial.get(index) ?? []), { from, to }]);
    }
    for (const [index, ranges] of byMaterial) {
      const name = strip ? `part ${scene.instances.length + 1}` : [...part.path, part.name].join('/');
      const mesh = extract(part, ranges, name);
      scene.instances.push({
        name,
        mesh: scene.meshes.push(mesh) - 1,
        material: index,
        transform: up === 'z' ? Z_UP : Y_UP,
      });
    }
  }
  return scene;
}

/** Some triangles of a part, with the vertices that they use. */
function extract(part: CadPart, ranges: readonly { readonly from: number; readonly to: number }[], name: string): Mesh {
  const corners = ranges.flatMap(({ from, to }) => Array.from(part.indices.subarray(3 * from, 3 * to)));
  return {
    ...withUsedVertices({
      name,
      positions: part.positions,
      indices: Uint32Array.from(corners),
      ...(part.normals ? { normals: part.normals } : {}),
    }),
  };
}

/** A mesh of positions and normals without the vertices that no triangle uses. */
export function withUsedVertices(mesh: Mesh): Mesh {
  const place = new Map<number, number>();
  const indices = mesh.indices.map((vertex) => {
    const known = place.get(vertex) ?? place.size;
    if (known === place.size) place.set(vertex, known);
    return known;
  });
  const gather = (values: Float32Array) => {
    const kept = new Float32Array(3 * place.size);
    for (const [from, to] of place) kept.set(values.subarray(3 * from, 3 * from + 3), 3 * to);
    return kept;
  };
  return {
    name: mesh.name,
    positions: gather(mesh.positions),
    indices,
    ...(mesh.normals ? { normals: gather(mesh.normals) } : {}),
  };
}
