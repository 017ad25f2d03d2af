import type { Mesh } from '@glanz/scene';

type Point = readonly [number, number, number];

const mesh = (name: string, points: readonly Point[], faces: readonly (readonly number[])[]): Mesh => ({
  name,
  positions: Float32Array.from(points.flat()),
  // Fans: faces are convex.
  indices: Uint32Array.from(faces.flatMap((face) => face.slice(2).flatMap((c, i) => [face[0]!, face[i + 1]!, c]))),
});

/** A flat convex polygon, counter-clockwise seen from its front. */
export const polygon = (name: string, points: readonly Point[]): Mesh => mesh(name, points, [points.map((_, i) => i)]);

/** A closed box, its front outside. */
export function box(name: string, low: Point, high: Point): Mesh {
  // Corner i has the high end of axis k where bit k is set.
  const points = Array.from({ length: 8 }, (_, i): Point => {
    const at = (k: 0 | 1 | 2) => ((i >> k) & 1 ? high[k] : low[k]);
    return [at(0), at(1), at(2)];
  });
  return mesh(name, points, [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
  ]);
}

/**
 * A closed body of revolution around the y axis, of flat facets, its front outside.
 *
 * @param profile Radii and heights from axis to axis, with the outside on the right.
 * @param sides Around the axis.
 */
export function lathe(name: string, profile: readonly (readonly [radius: number, y: number])[], sides: number): Mesh {
  const points: Point[] = [];
  const rings = profile.map(([radius, y]) => {
    const count = radius === 0 ? 1 : sides;
    const first = points.length;
    for (let i = 0; i < count; i++) {
      const angle = (2 * Math.PI * i) / sides;
      points.push([radius * Math.cos(angle), y, -radius * Math.sin(angle)]);
    }
    return (i: number) => first + (i % count);
  });
  const faces = rings.slice(1).flatMap((to, ring) =>
    Array.from({ length: sides }, (_, i) => {
      const from = rings[ring]!;
      return [...new Set([from(i), from(i + 1), to(i + 1), to(i)])];
    }),
  );
  return mesh(name, points, faces);
}

/**
 * A stone in a brilliant cut of 8 sides, closed, its front outside: table upwards, radius 1, the girdle at y = 0.
 * Crown and pavilion are inclined by about 34° and 41°.
 */
export function brilliant(name: string): Mesh {
  const ring = (count: number, radius: number, y: number) =>
    Array.from({ length: count }, (_, i): Point => {
      const angle = (2 * Math.PI * i) / count;
      return [radius * Math.cos(angle), y, -radius * Math.sin(angle)];
    });
  const points: Point[] = [...ring(8, 0.55, 0.33), ...ring(16, 1, 0.02), ...ring(16, 1, -0.02), [0, -0.89, 0]];
  const [table, upper, lower] = [(i: number) => i % 8, (i: number) => 8 + (i % 16), (i: number) => 24 + (i % 16)];
  const culet = 40;
  const faces: number[][] = [Array.from({ length: 8 }, (_, i) => i)];
  for (let i = 0; i < 8; i++)
    faces.push(
      [table(i), upper(2 * i), upper(2 * i + 1)],
      [table(i), upper(2 * i + 1), table(i + 1)],
      [table(i + 1), upper(2 * i + 1), upper(2 * i + 2)],
    );
  for (let i = 0; i < 16; i++)
    faces.push([upper(i), lower(i), lower(i + 1), upper(i + 1)], [lower(i), culet, lower(i + 1)]);
  return mesh(name, points, faces);
}
