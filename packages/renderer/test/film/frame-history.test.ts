import type { Camera } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { FrameHistory, type FrameView } from '../../src/film/frame-history';

const camera = (x: number): Camera => ({
  type: 'perspective',
  name: 'c',
  transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 3, 1],
  yfov: 0.6,
});
const view = (x: number, width = 40): FrameView => ({ camera: camera(x), width, height: 24 });
const at = (x: number) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1];
const move = (index: number, from: number, to: number) => ({ index, before: at(from), after: at(to) });

/** Indices of instances with the step along x that takes them back. */
function moved(history: FrameHistory): (readonly [number, number])[] {
  const { uniforms, moves } = history.pack(camera(9), 40, 24);
  const count = new Uint32Array(uniforms)[3] as number;
  return Array.from({ length: count }, (_, i) => [
    moves[16 * i + 12] as number,
    new Float32Array(moves.buffer, 64 * i, 12)[3] as number,
  ]);
}

/** A history whose film shows view 0, with samples. */
function started(): FrameHistory {
  const history = new FrameHistory();
  history.restart('invalidates', 0, view(0));
  return history;
}

describe('FrameHistory', () => {
  it('has the frame that was seen last, over restarts of films without samples', () => {
    const history = started();
    expect(history.previous).toBeUndefined();
    history.restart('reprojects', 4, view(1));
    expect(history.previous).toEqual({ ...view(0), samples: 4 });
    history.restart('reprojects', 0, view(2));
    expect(history.previous).toEqual({ ...view(0), samples: 4 });
    history.restart('reprojects', 1, view(3));
    expect(history.previous).toEqual({ ...view(2), samples: 1 });
  });

  it('has none after edits that invalidate, nor for a camera of another kind', () => {
    const history = started();
    history.restart('reprojects', 4, view(1));
    history.restart('invalidates', 4, view(1));
    expect(history.previous).toBeUndefined();
    history.restart('reprojects', 4, view(1));
    expect(history.previous).toBeDefined();
    const panorama: Camera = { type: 'panorama', name: 'p', transform: at(0) };
    history.restart('reprojects', 4, { ...view(1), camera: panorama });
    expect(history.previous).toBeUndefined();
  });

  it('knows a smaller frame of another render scale', () => {
    const history = started();
    history.restart('reprojects', 4, view(0, 20));
    history.restart('reprojects', 2, view(0));
    expect(history.previous).toEqual({ ...view(0, 20), samples: 2 });
  });

  it('adds up moves since the frame before, and forgets them with it', () => {
    const history = started();
    history.restart('reprojects', 4, view(0), [move(7, 1, 3), move(2, 0, 1)]);
    expect(moved(history)).toEqual([
      [2, -1],
      [7, -2],
    ]);
    history.restart('reprojects', 0, view(0), [move(7, 3, 6)]);
    expect(moved(history)).toEqual([
      [2, -1],
      [7, -5],
    ]);
    history.restart('reprojects', 1, view(0), [move(7, 6, 7)]);
    expect(moved(history)).toEqual([[7, -1]]);
    history.restart('invalidates', 1, view(0), [move(7, 7, 8)]);
    expect(moved(history)).toEqual([]);
  });

  it('takes places through rotations, scales and mirrors to where they were', () => {
    const history = started();
    const before = [0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1];
    const after = [1, 0.5, 0, 0, 0, -2, 0, 0, 0.25, 0, 4, 0, -1, 2, 3, 1];
    history.restart('reprojects', 1, view(0), [{ index: 0, before, after }]);
    const { moves } = history.pack(camera(0), 40, 24);
    const rows = new Float32Array(moves.buffer, 0, 12);
    const through = (m: readonly number[], p: readonly number[]) =>
      [0, 1, 2].map((r) => m[r]! * p[0]! + m[4 + r]! * p[1]! + m[8 + r]! * p[2]! + m[12 + r]!);
    const local = [0.3, -0.7, 1.1];
    const now = through(after, local);
    const found = [0, 1, 2].map(
      (r) => rows[4 * r]! * now[0]! + rows[4 * r + 1]! * now[1]! + rows[4 * r + 2]! * now[2]! + rows[4 * r + 3]!,
    );
    through(before, local).forEach((value, r) => expect(found[r]).toBeCloseTo(value, 4));
  });

  it('leaves out what has no inverse', () => {
    const history = started();
    history.restart('reprojects', 1, view(0), [{ index: 0, before: at(0), after: new Array<number>(16).fill(0) }]);
    expect(moved(history)).toEqual([]);
  });
});
