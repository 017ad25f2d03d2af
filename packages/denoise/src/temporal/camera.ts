import type { FilterableCamera, Point } from './options';

/** How far away an orthographic camera's eye is, metres. */
const FAR = 1e6;

/** Where a camera's rays come from. */
export function eyeOf({ type, transform: m }: FilterableCamera): Point {
  const back = type === 'orthographic' ? FAR : 0;
  return [12, 13, 14].map((i) => m[i]! + back * m[i - 4]!) as unknown as Point;
}

/**
 * From the world to clip space, whose depth is 0: column-major 4 × 4.
 *
 * @param aspect Width over height of the image.
 * @returns `undefined` for a camera without a perspective.
 */
export function projectionOf({ type, transform: m, yfov }: FilterableCamera, aspect: number): number[] | undefined {
  if (type !== 'perspective' || yfov === undefined) return undefined;
  const focal = 1 / Math.tan(yfov / 2);
  const row = (column: number, scale: number) => {
    const axis = [0, 1, 2].map((i) => m[4 * column + i]!);
    const length = Math.hypot(...axis) / scale;
    const unit = axis.map((x) => x / length);
    return [...unit, -unit.reduce((sum, x, i) => sum + x * m[12 + i]!, 0)];
  };
  const rows = [row(0, focal / aspect), row(1, focal), [0, 0, 0, 0], row(2, -1)];
  return [0, 1, 2, 3].flatMap((column) => rows.map((one) => one[column]!));
}
