import type { Camera } from '@glanz/scene';
import { cameraUniforms } from '../camera/camera';
import { determinant3 } from '../geometry/matrix';
import type { HistoryFrame } from '../options';
import { historyStruct } from '../storage/layout';
import type { EditEffect, Move } from './edit-effect';

/** 32-bit words of an instance that has moved, see motion.wesl. */
const MOVE_WORDS = 16;

/** What the film shows from a restart on. */
export type FrameView = Omit<HistoryFrame, 'samples'>;

/**
 * The frame that a film has shown before the present one, of the same surfaces: its camera and size, and how instances
 * have moved since.
 */
export class FrameHistory {
  #shown: FrameView | undefined;
  #previous: HistoryFrame | undefined;
  /** By index of the instance: its transform in the frame before, and now. */
  readonly #moved = new Map<number, Move>();

  /** See `PathTracer.history`. */
  get previous(): HistoryFrame | undefined {
    return this.#previous;
  }

  /**
   * The film begins again.
   *
   * @param samples Those that it had. A frame without any has not been seen: the one before it stays.
   * @param view What it shows from now on.
   * @param moves Instances that the edit has moved.
   */
  restart(effect: EditEffect, samples: number, view: FrameView, moves: readonly Move[] = []): void {
    // Cameras of another kind project by another formula, which the kernels do not have then.
    const lost = effect === 'invalidates' || this.#shown?.camera.type !== view.camera.type;
    if (lost) this.#previous = undefined;
    else if (samples > 0 && this.#shown) this.#previous = { ...this.#shown, samples };
    if (lost || samples > 0) this.#moved.clear();
    if (this.#previous)
      for (const move of moves)
        this.#moved.set(move.index, { ...move, before: this.#moved.get(move.index)?.before ?? move.before });
    this.#shown = view;
  }

  /** What motion.wesl reads: the uniforms, and the instances that have moved. */
  pack(
    camera: Camera,
    width: number,
    height: number,
  ): { readonly uniforms: ArrayBuffer; readonly moves: Uint32Array<ArrayBuffer> } {
    const moved = [...this.#moved.values()]
      .map(({ index, before, after }) => ({ index, rows: rowsBetween(after, before) }))
      .filter((move): move is { index: number; rows: number[] } => move.rows !== undefined)
      .sort((a, b) => a.index - b.index);
    const moves = new Uint32Array(MOVE_WORDS * Math.max(1, moved.length));
    moved.forEach(({ index, rows }, i) => {
      new Float32Array(moves.buffer, 4 * MOVE_WORDS * i, 12).set(rows);
      moves[MOVE_WORDS * i + 12] = index;
    });
    const view = cameraUniforms(this.#previous?.camera ?? camera, width, height);
    const uniforms = historyStruct.allocate();
    historyStruct.write(uniforms, 0, {
      origin: view.camera_origin,
      moved: moved.length,
      known: this.#previous ? 1 : 0,
      right: view.camera_right,
      up: view.camera_up,
      forward: view.camera_forward,
      half_extent: view.half_extent,
    });
    return { uniforms, moves };
  }
}

/** The rows of `to · from⁻¹`, for affine matrices; `undefined` where `from` has no inverse. */
function rowsBetween(from: ArrayLike<number>, to: ArrayLike<number>): number[] | undefined {
  const determinant = determinant3(from);
  if (!(Math.abs(determinant) > 0)) return undefined;
  const f = (row: number, column: number) => from[4 * column + row] as number;
  const t = (row: number, column: number) => to[4 * column + row] as number;
  // Cofactors over the determinant.
  const inverse = (row: number, column: number) => {
    const [a, b] = [(column + 1) % 3, (column + 2) % 3];
    const [c, d] = [(row + 1) % 3, (row + 2) % 3];
    return (f(a, c) * f(b, d) - f(a, d) * f(b, c)) / determinant;
  };
  return [0, 1, 2].flatMap((row) => {
    const linear = [0, 1, 2].map((column) => [0, 1, 2].reduce((sum, k) => sum + t(row, k) * inverse(k, column), 0));
    return [...linear, t(row, 3) - linear.reduce((sum, value, column) => sum + value * f(column, 3), 0)];
  });
}
