import { describe, expect, it } from 'vitest';
import { fitCamera } from '../src/fit-camera';

const camera = {
  type: 'perspective',
  name: 'front',
  transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1],
  yfov: 0.6,
} as const;

describe('fitCamera', () => {
  it('keeps the width of the view in an image narrower than the author’s, and its height in a wider one', () => {
    const fitted = fitCamera({ ...camera, aspect: 2 }, 1);
    // Half the width of the view at a distance of one: tan(yfov / 2) × aspect.
    expect(fitted.type === 'perspective' && Math.tan(fitted.yfov / 2)).toBeCloseTo(2 * Math.tan(0.3), 9);
    expect(fitCamera({ ...camera, aspect: 1 }, 2)).toMatchObject({ yfov: 0.6 });
  });

  it('grows a parallel projection in one direction only', () => {
    const box = { type: 'orthographic', name: 'box', transform: camera.transform, xmag: 2, ymag: 1 } as const;
    expect(fitCamera(box, 4)).toMatchObject({ xmag: 4, ymag: 1 });
    expect(fitCamera(box, 1)).toMatchObject({ xmag: 2, ymag: 2 });
  });
});
