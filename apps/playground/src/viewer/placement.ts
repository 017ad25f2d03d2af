import type { Scene } from '@glanz/scene';
import type { Move, State } from '../state/state';

type Place = (scene: Pick<Scene, 'instances' | 'meshes'>, index: number, move: Move) => ArrayLike<number>;

let place: Place | undefined;

/** Called by `moves.ts`, which is fetched with what makes moves: the tools, and links. */
export function usePlacement(by: Place): void {
  place = by;
}

/** The transform of a part with its move. */
export function placedTransform(
  scene: Pick<Scene, 'instances' | 'meshes'>,
  index: number,
  moves: State['moves'],
): ArrayLike<number> {
  const move = moves[index];
  return move && place ? place(scene, index, move) : (scene.instances[index]?.transform ?? []);
}
