import { fromQuat } from 'gl-matrix/esm/mat3.js';
import { fromEuler, multiply, setAxisAngle } from 'gl-matrix/esm/quat.js';
import { add, dot, scaleAndAdd, subtract, transformQuat } from 'gl-matrix/esm/vec3.js';
import type { Scene } from '@glanz/scene';
import { MIN_SCALE, type Move, type Rgb, type State } from '../state/state';
import { NO_MOVE, pivotOf } from './moves';

type Parts = Pick<Scene, 'instances' | 'meshes'>;
type Moves = State['moves'];

const zero = () => [0, 0, 0] as [number, number, number];
const DEGREE = Math.PI / 180;

/** A rotation as a quaternion. */
export const rotationOf = ({ rotation: [x, y, z] }: Move): readonly number[] => fromEuler([0, 0, 0, 1], x, y, z, 'zyx');

/** Moves without those that change nothing. */
export function withMoves(moves: Moves, changed: Readonly<Record<string, Move>>): Moves {
  return Object.fromEntries(
    Object.entries({ ...moves, ...changed }).filter(([, move]) => JSON.stringify(move) !== JSON.stringify(NO_MOVE)),
  );
}

/** Where the middle of a part is now. */
const placeOf = (scene: Parts, moves: Moves, part: number): Rgb =>
  add(zero(), pivotOf(scene, part), (moves[part] ?? NO_MOVE).translation);

/** The middle of several parts, about which they are turned and scaled together. */
export function middleOfParts(scene: Parts, moves: Moves, parts: readonly number[]): Rgb {
  const sum = zero();
  for (const part of parts) scaleAndAdd(sum, sum, placeOf(scene, moves, part), 1 / parts.length);
  return sum;
}

const each = (moves: Moves, parts: readonly number[], change: (move: Move, part: number) => Move): Moves =>
  withMoves(moves, Object.fromEntries(parts.map((part) => [part, change(moves[part] ?? NO_MOVE, part)])));

/** Translates parts, metres. */
export const translated = (moves: Moves, parts: readonly number[], by: Rgb): Moves =>
  each(moves, parts, (move) => ({ ...move, translation: add(zero(), move.translation, by) as Rgb }));

/** Translations of one millionth of a metre and angles of a millionth of a degree are rounding. */
const tidy = (value: number) => Math.round(value * 1e6) / 1e6 || 0;

/** A rotation as degrees about X, then Y, then Z. */
function eulerOf(rotation: readonly number[]): Rgb {
  const m = fromQuat(new Array<number>(9), rotation);
  const [xx = 1, xy = 0, xz = 0, , yy = 1, yz = 0, , zy = 0, zz = 1] = m;
  const y = Math.asin(Math.max(-1, Math.min(1, -xz)));
  // Straight up or down, X and Z turn about the same axis: all of it is said of X.
  const locked = Math.abs(xz) > 1 - 1e-9;
  const x = locked ? Math.atan2(-zy, yy) : Math.atan2(yz, zz);
  const z = locked ? 0 : Math.atan2(xy, xx);
  return [tidy(x / DEGREE), tidy(y / DEGREE), tidy(z / DEGREE)];
}

/** Turns parts about an axis of the world through their common middle, degrees. */
export function rotated(scene: Parts, moves: Moves, parts: readonly number[], axis: Rgb, degrees: number): Moves {
  const middle = middleOfParts(scene, moves, parts);
  const turn = setAxisAngle([0, 0, 0, 1], axis, degrees * DEGREE);
  return each(moves, parts, (move, part) => {
    const place = placeOf(scene, moves, part);
    const arm = transformQuat(zero(), subtract(zero(), place, middle), turn);
    const shift = subtract(zero(), add(zero(), middle, arm), place);
    return {
      ...move,
      translation: add(zero(), move.translation, shift).map(tidy) as unknown as Rgb,
      rotation: eulerOf(multiply([0, 0, 0, 1], turn, rotationOf(move))),
    };
  });
}

/** A factor that leaves a part its extent. */
const extent = (factor: number) => Math.sign(factor || 1) * Math.max(MIN_SCALE, Math.abs(factor));

/**
 * Scales parts from their common middle.
 *
 * @param axis Of the parts' own axes, 0..2; undefined: all alike.
 */
export function scaled(
  scene: Parts,
  moves: Moves,
  parts: readonly number[],
  axis: number | undefined,
  by: number,
): Moves {
  const middle = middleOfParts(scene, moves, parts);
  return each(moves, parts, (move, part) => {
    const arm = subtract(zero(), placeOf(scene, moves, part), middle);
    const shift = zero();
    if (axis === undefined) scaleAndAdd(shift, shift, arm, by - 1);
    else {
      const direction = transformQuat(zero(), AXES[axis] as Rgb, rotationOf(move));
      scaleAndAdd(shift, shift, direction, (by - 1) * dot(arm, direction));
    }
    return {
      ...move,
      translation: add(zero(), move.translation, shift).map(tidy) as unknown as Rgb,
      scale: move.scale.map((factor, k) =>
        axis === undefined || axis === k ? extent(factor * by) : factor,
      ) as unknown as Rgb,
    };
  });
}

export const AXES: readonly Rgb[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

/** Sets one number of a move: translations of all parts change by the same distance, others become the same. */
export function withNumber(
  moves: Moves,
  parts: readonly number[],
  field: keyof Move,
  axis: number,
  value: number,
): Moves {
  const before = (moves[parts[0] as number] ?? NO_MOVE)[field][axis] as number;
  return each(moves, parts, (move) => ({
    ...move,
    [field]: move[field].map((now, k) =>
      k !== axis ? now : field === 'translation' ? now + value - before : field === 'scale' ? extent(value) : value,
    ),
  }));
}
