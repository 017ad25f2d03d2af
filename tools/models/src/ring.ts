import type { Scene } from '@glanz/scene';
import type { MeshBuilder } from './shapes/mesh-builder';
import { surface } from './shapes/surface';
import { spline, tube } from './shapes/tube';
import { glass, GOLD, metal, plastic, ROSE_GOLD } from './stage/materials';
import { at, Stage } from './stage/stage';
import { rotation } from './stage/transform';

type Point = readonly [number, number, number];

/** A flat facet with corners counter-clockwise from outside; any number of them, in one plane. */
function facet(b: MeshBuilder, corners: readonly Point[]): void {
  const [p, q, r] = corners as [Point, Point, Point];
  const [u, v] = [q.map((x, k) => x - p[k]!), r.map((x, k) => x - p[k]!)] as [number[], number[]];
  const n = [u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!, u[0]! * v[1]! - u[1]! * v[0]!] as const;
  const ids = corners.map((c) => b.vertex(...c, ...n));
  for (let i = 2; i < ids.length; i++) b.triangle(ids[0]!, ids[i - 1]!, ids[i]!);
}

/**
 * A round brilliant (Tolkowsky 1919): table, 8 stars, 8 kites, 16 upper and 16 lower girdle facets, 8 mains. The girdle
 * lies at z = 0, the table above.
 */
export function brilliant(b: MeshBuilder, radius: number): void {
  const at = (r: number, z: number, eighths: number): Point => [
    radius * r * Math.cos((eighths * Math.PI) / 4),
    radius * r * Math.sin((eighths * Math.PI) / 4),
    radius * z,
  ];
  const [crown, pavilion] = [Math.tan((34.5 * Math.PI) / 180), Math.tan((40.75 * Math.PI) / 180)];
  const [table, star, lower, girdle] = [0.53, 0.75, 0.2, 0.03];
  const half = Math.cos(Math.PI / 8);
  // Stars and lower girdle facets meet kites and mains where these meet each other.
  const [zt, zs, zl] = [(1 - table) * crown, (1 - star * half) * crown, -girdle - (1 - lower * half) * pavilion];
  const T = (i: number) => at(table, zt, i);
  const S = (i: number) => at(star, zs, i + 0.5);
  const G = (i: number) => at(1, 0, i);
  const H = (i: number) => at(1, -girdle, i);
  const L = (i: number) => at(lower, zl, i + 0.5);
  const culet: Point = [0, 0, radius * (-girdle - pavilion)];
  facet(b, [0, 1, 2, 3, 4, 5, 6, 7].map(T));
  for (let i = 0; i < 8; i++) {
    const [before, after] = [(i + 7) % 8, (i + 1) % 8];
    facet(b, [T(i), S(i), T(after)]);
    facet(b, [T(i), S(before), G(i), S(i)]);
    facet(b, [S(i), G(i), at(1, 0, i + 0.5)]);
    facet(b, [S(i), at(1, 0, i + 0.5), G(after)]);
    facet(b, [G(i), H(i), at(1, -girdle, i + 0.5), at(1, 0, i + 0.5)]);
    facet(b, [at(1, 0, i + 0.5), at(1, -girdle, i + 0.5), H(after), G(after)]);
    facet(b, [L(i), at(1, -girdle, i + 0.5), H(i)]);
    facet(b, [L(i), H(after), at(1, -girdle, i + 0.5)]);
    facet(b, [culet, L(i), H(i), L(before)]);
  }
}

/** A ring: a band with comfortable edges, six claws and a brilliant. */
export function createRing(): Scene {
  const stage = new Stage('Ring');
  const gold = metal('gold', GOLD, 0.06);
  const RADIUS = 9;
  const STONE = 3.6;
  const seat = RADIUS + 5.6;
  const pose = [at(0, RADIUS + 1.1, 0), rotation('y', 32)] as const;
  // The band lies in the plane of x and z; the stone is at +z.
  stage.add(
    'Band',
    gold,
    (b) =>
      surface(
        b,
        (u, v) => {
          const [a, phi] = [2 * Math.PI * u, 2 * Math.PI * v];
          const top = 0.5 + 0.5 * Math.cos(a);
          const half = 1.05 - 0.25 * top ** 2;
          const round = (x: number, e: number) => Math.sign(x) * Math.abs(x) ** e;
          const r = RADIUS + 0.85 * round(Math.cos(phi), 0.8);
          return [r * Math.sin(a), half * round(Math.sin(phi), 0.75), r * Math.cos(a)];
        },
        { nu: 200, nv: 48, closeU: true, closeV: true },
      ),
    ...pose,
  );
  stage.add(
    'Setting',
    gold,
    (b) => {
      for (let i = 0; i < 6; i++) {
        const a = ((i + 0.5) * Math.PI) / 3;
        const [c, s] = [Math.cos(a), Math.sin(a)];
        const curve = spline([
          [0.7 * c, 0.7 * s, RADIUS + 0.2],
          [1.9 * c, 1.9 * s, RADIUS + 2],
          [3.15 * c, 3.15 * s, RADIUS + 4],
          [(STONE + 0.12) * c, (STONE + 0.12) * s, seat - 0.3],
          [(STONE + 0.02) * c, (STONE + 0.02) * s, seat + 0.35],
          [(STONE - 0.5) * c, (STONE - 0.5) * s, seat + 0.72],
        ]);
        tube(b, curve, 0.36, 40, 20);
      }
      surface(
        b,
        (u, v) => {
          const [a, phi] = [2 * Math.PI * u, 2 * Math.PI * v];
          const r = 2.05 + 0.3 * Math.cos(phi);
          return [r * Math.cos(a), r * Math.sin(a), RADIUS + 2.3 + 0.3 * Math.sin(phi)];
        },
        { nu: 96, nv: 20, closeU: true, closeV: true },
      );
    },
    ...pose,
  );
  const gem = (name: string, color: readonly [number, number, number], ior: number, abbe: number) =>
    glass(name, {
      color,
      depth: 0.006,
      ior,
      extra: { transmission_dispersion_scale: 20 / abbe },
    });
  const diamond = gem('diamond', [0.99, 0.99, 0.985], 2.417, 33);
  stage.add(
    'Stone',
    diamond,
    (b) => {
      brilliant(b, STONE);
      b.transformFrom(0, (x, y, z, w) => [x, y, z + w * seat]);
    },
    ...pose,
  );
  const rose = metal('rose gold', ROSE_GOLD, 0.06);
  const platinum = metal('platinum', [0.75, 0.74, 0.72], 0.06);
  stage.variants(diamond, {
    diamond,
    sapphire: gem('sapphire', [0.05, 0.16, 0.85], 1.77, 50),
    emerald: gem('emerald', [0.03, 0.62, 0.26], 1.58, 50),
  });
  stage.variants(gold, { diamond: gold, sapphire: platinum, emerald: rose });
  stage.sweep(plastic('table', [0.055, 0.052, 0.055], 0.16), {
    front: 260,
    back: 180,
    radius: 120,
    height: 320,
    width: 900,
  });
  stage.softbox({ name: 'Key', at: [-60, 80, 40], to: [0, 12, 0], width: 80, height: 90, radiance: 5, gradient: 8 });
  stage.softbox({
    name: 'Front',
    at: [30, 70, 150],
    to: [0, 10, 0],
    width: 140,
    height: 40,
    radiance: 1.6,
    gradient: 6,
  });
  stage.softbox({ name: 'Right', at: [75, 45, 10], to: [0, 12, 0], width: 26, height: 80, radiance: 7, gradient: 5 });
  stage.softbox({ name: 'Behind', at: [10, 70, -80], to: [0, 12, 0], width: 90, height: 30, radiance: 6 });
  for (const [i, [x, y, z]] of (
    [
      [-22, 85, -12],
      [30, 80, 35],
      [4, 95, 20],
      [-40, 60, 70],
    ] as const
  ).entries())
    stage.softbox({ name: `Spark ${i + 1}`, at: [x, y, z], to: [0, 14, 0], width: 5, height: 5, radiance: 70 });
  stage.camera('Front', {
    direction: [0.25, 0.36, 1],
    margin: 0.2,
    focalLength: 95,
    lensRadius: 0.5,
    focus: [0, 20, 4],
  });
  stage.camera('Stone', { direction: [0.3, 0.75, 1], around: 'Stone', margin: 0.3, focalLength: 100, lensRadius: 0.3 });
  return stage.scene;
}
