import { fromTranslation, multiply, rotateX, rotateY, rotateZ, scale, translate } from 'gl-matrix/esm/mat4.js';
import { add, subtract, transformMat4 } from 'gl-matrix/esm/vec3.js';
import type { Mesh, Scene } from '@glanz/scene';
import type { Move, Rgb } from '../state/state';
import { usePlacement } from './placement';

const DEGREE = Math.PI / 180;

export const NO_MOVE: Move = { translation: [0, 0, 0], rotation: [0, 0, 0], scale: [1, 1, 1] };

/** Middles of the boxes around meshes, in their own space: finding one reads all of its vertices. */
const middles = new WeakMap<Mesh, Rgb>();

function middleOf(mesh: Mesh): Rgb {
  const known = middles.get(mesh);
  if (known) return known;
  const [min, max] = [
    [Infinity, Infinity, Infinity],
    [-Infinity, -Infinity, -Infinity],
  ] as [number[], number[]];
  const { positions } = mesh;
  for (let i = 0; i < positions.length; i++) {
    const [k, value] = [i % 3, positions[i] as number];
    if (value < (min[k] as number)) min[k] = value;
    if (value > (max[k] as number)) max[k] = value;
  }
  const middle = [0, 1, 2].map((k) => ((min[k] as number) + (max[k] as number)) / 2) as unknown as Rgb;
  middles.set(mesh, middle);
  return middle;
}

/** The point of the world that a part is turned and scaled about: the middle of its mesh's box, where the pose has it. */
export function pivotOf({ instances, meshes }: Pick<Scene, 'instances' | 'meshes'>, index: number): Rgb {
  const part = instances[index];
  const mesh = part && meshes[part.mesh];
  if (!mesh) return [0, 0, 0];
  return transformMat4([0, 0, 0], middleOf(mesh), part.transform);
}

usePlacement((scene, index, { translation, rotation, scale: factors }) => {
  const pivot = pivotOf(scene, index);
  const matrix = fromTranslation(new Array<number>(16), add([0, 0, 0], pivot, translation));
  rotateZ(matrix, matrix, rotation[2] * DEGREE);
  rotateY(matrix, matrix, rotation[1] * DEGREE);
  rotateX(matrix, matrix, rotation[0] * DEGREE);
  scale(matrix, matrix, factors);
  translate(matrix, matrix, subtract([0, 0, 0], [0, 0, 0], pivot));
  return multiply(matrix, matrix, scene.instances[index]?.transform ?? []);
});
