import { describe, expect, it } from 'vitest';
import { fitCamera } from '../src/fit-camera';
import { project } from '../src/project';

const camera = {
  type: 'perspective',
  name: 'c',
  transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 8, 1],
  yfov: Math.PI / 2,
} as const;

describe('project', () => {
  it('puts what lies ahead in the middle, and the edges of the field of view on the edges', () => {
    expect(project(camera, 2, [1, 2, 3])).toEqual({ x: 0.5, y: 0.5, distance: 5, inside: true });
    // 45° up is the upper edge; with twice the width, the right edge is twice as far.
    expect(project(camera, 2, [1, 7, 3]).x).toBe(0.5);
    expect(project(camera, 2, [1, 7, 3]).y).toBeCloseTo(0, 12);
    expect(project(camera, 2, [11, 2, 3]).x).toBeCloseTo(1, 12);
    expect(project(camera, 2, [11, 2, 3]).y).toBe(0.5);
    expect(project(camera, 2, [1, 2, 9]).inside).toBe(false);
    expect(project(camera, 2, [1, 9, 3]).inside).toBe(false);
  });

  it('serves parallel projections', () => {
    const flat = { type: 'orthographic', name: 'o', transform: camera.transform, xmag: 4, ymag: 2 } as const;
    expect(project(flat, 2, [3, 3, 0])).toMatchObject({ x: 0.75, y: 0.25, inside: true });
  });
});

describe('fitCamera', () => {
  it('cuts nothing off: what a camera for wide images sees is seen in a narrow one', () => {
    const wide = { ...camera, aspect: 2 };
    const fitted = fitCamera(wide, 0.5);
    // The right edge for the author's shape.
    expect(project(fitted, 0.5, [11, 2, 3]).x).toBeCloseTo(1, 10);
    expect(fitCamera(wide, 3)).toBe(wide);
    expect(
      fitCamera({ type: 'orthographic', name: 'o', transform: camera.transform, xmag: 4, ymag: 2 }, 1),
    ).toMatchObject({ xmag: 4, ymag: 4 });
  });
});
