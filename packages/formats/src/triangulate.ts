/**
 * Triangles of a polygon that may have hollows, by cutting off ears. A polygon that crosses itself gives a fan where no
 * ear is left.
 *
 * @param points xyz of the corners, stride 3.
 * @returns Corners of the triangles, as numbers of the polygon's corners.
 */
export function triangulate(points: readonly number[]): number[] {
  const count = points.length / 3;
  if (count < 3) return [];
  if (count === 3) return [0, 1, 2];
  // Newell's normal says in which plane to look at it.
  const normal = [0, 0, 0];
  for (let i = 0; i < count; i++) {
    const j = (i + 1) % count;
    for (let k = 0; k < 3; k++) {
      const [u, v] = [(k + 1) % 3, (k + 2) % 3];
      normal[k] =
        (normal[k] as number) +
        ((points[3 * i + u] as number) - (points[3 * j + u] as number)) *
          ((points[3 * i + v] as number) + (points[3 * j + v] as number));
    }
  }
  const sizes = normal.map(Math.abs);
  const axis = sizes.indexOf(Math.max(...sizes));
  const [u, v] = (normal[axis] as number) >= 0 ? [(axis + 1) % 3, (axis + 2) % 3] : [(axis + 2) % 3, (axis + 1) % 3];
  const x = (i: number) => points[3 * i + u] as number,
    y = (i: number) => points[3 * i + v] as number;
  const area = (a: number, b: number, c: number) => (x(b) - x(a)) * (y(c) - y(a)) - (y(b) - y(a)) * (x(c) - x(a));
  const left = Array.from({ length: count }, (_, i) => i);
  const triangles: number[] = [];
  // The number of looks is bounded: each round cuts an ear, or the rest is a fan. Large polygons are not worth the
  // search.
  while (left.length > 3 && count <= 512) {
    const ear = left.findIndex((b, i) => {
      const a = left[(i + left.length - 1) % left.length] as number,
        c = left[(i + 1) % left.length] as number;
      if (!(area(a, b, c) > 0)) return false;
      return left.every(
        (p) => p === a || p === b || p === c || !(area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0),
      );
    });
    if (ear < 0) break;
    triangles.push(
      left[(ear + left.length - 1) % left.length] as number,
      left[ear] as number,
      left[(ear + 1) % left.length] as number,
    );
    left.splice(ear, 1);
  }
  for (let i = 1; i + 1 < left.length; i++) triangles.push(left[0] as number, left[i] as number, left[i + 1] as number);
  return triangles;
}
