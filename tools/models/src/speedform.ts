import type { Scene } from '@glanz/scene';
import { surface } from './shapes/surface';
import { coated, metal, plastic } from './stage/materials';
import { Stage } from './stage/stage';

const LENGTH = 460;
const WIDTH = 96;
const HEIGHT = 92;

const smooth = (a: number, b: number, x: number) => {
  const t = Math.min(Math.max((x - a) / (b - a), 0), 1);
  return t * t * (3 - 2 * t);
};
const powered = (x: number, e: number) => Math.sign(x) * Math.abs(x) ** e;

/** A point of the body at v (0 nose, 1 tail) and the angle u around it: x along, y to the side, z up. */
function body(u: number, v: number, offset = 0): readonly [number, number, number] {
  const s = Math.min(Math.max(v, 0), 1);
  // Round at the nose; cut off short at the tail.
  const q = Math.min(s / 0.36, 1);
  const nose = (q * (2 - q)) ** 0.5;
  const tail = 1 - 0.34 * smooth(0.4, 1.05, s) ** 1.4;
  const end = Math.max(1 - Math.max((s - 0.94) / 0.06, 0) ** 2.6, 0) ** 0.5;
  const e = nose * tail * end;
  const theta = 2 * Math.PI * u;
  const [c, t] = [Math.cos(theta), Math.sin(theta)];
  const side = powered(c, 0.8);
  const up = powered(t, t > 0 ? 0.9 : 0.5);
  const at = (centre: number, width: number, x: number) => Math.exp(-(((x - centre) / width) ** 2));
  const along = smooth(0.1, 0.3, s) * (1 - smooth(0.82, 0.98, s));
  // A crease at the shoulder, a hollow flank below it, arches before and behind.
  const shoulder = at(0.42, 0.1, t) * along;
  const hollow = at(0.05, 0.26, t) * smooth(0.26, 0.44, s) * (1 - smooth(0.6, 0.76, s));
  const arches = (at(0.2, 0.1, s) + 1.25 * at(0.8, 0.115, s)) * at(0.16, 0.34, t);
  const width = WIDTH * e * (1 + 0.045 * shoulder - 0.15 * hollow + 0.1 * arches) * (t > 0 ? 1 - 0.3 * t * t : 1);
  const hips = (at(0.2, 0.09, s) + 1.2 * at(0.8, 0.11, s)) * at(0.62, 0.26, t) * e;
  const canopy = at(0.5, 0.19, s) * Math.max(t, 0) ** 2;
  const z = t > 0 ? HEIGHT * (0.5 * e * up + 0.44 * canopy * Math.sqrt(e) + 0.085 * hips) : 30 * e * up;
  return [LENGTH * (s - 0.5), (width + offset) * side, 37 + z + offset * Math.max(t, 0)];
}

/** The canopy: a leaf of dark glass on the roof, at v along it and u across. */
function canopy(u: number, v: number): readonly [number, number, number] {
  const t = Math.min(Math.max(v, 0), 1);
  const across = 2 * Math.min(Math.max(u, 0), 1) - 1;
  const half = 0.118 * Math.max(1 - Math.abs(2 * t - 1) ** 2.4, 0) ** 0.62;
  const edge = Math.max(1 - across ** 12, 0) * Math.max(1 - Math.abs(2 * t - 1) ** 24, 0);
  return body(0.25 + across * half, 0.3 + 0.5 * t, 1.1 * edge - 0.5);
}

/** A streamlined body, the kind on which paint makers show car paint: metallic base under a clear coat. */
export function createSpeedform(): Scene {
  const stage = new Stage('Speedform');
  const paint = (name: string, color: readonly [number, number, number], roughness = 0.38) =>
    coated(metal(name, color, roughness), 0.015);
  const red = paint('paint red', [0.62, 0.012, 0.018]);
  stage.add('Body', red, (b) => surface(b, (u, v) => body(u, v), { nu: 260, nv: 300, closeU: true, flip: true }));
  stage.add('Canopy', coated(plastic('canopy', [0.004, 0.004, 0.005], 0.1), 0), (b) =>
    surface(b, canopy, { nu: 90, nv: 180, flip: true }),
  );
  stage.variants(red, {
    red,
    blue: paint('paint blue', [0.01, 0.09, 0.45]),
    silver: paint('paint silver', [0.66, 0.67, 0.68], 0.32),
    black: coated(plastic('paint black', [0.008, 0.008, 0.01], 0.3), 0.01),
  });
  stage.sweep(plastic('studio floor', [0.035, 0.036, 0.04], 0.28), {
    front: 1600,
    back: 1100,
    radius: 700,
    height: 1500,
    width: 5200,
  });
  stage.softbox({
    name: 'Overhead',
    at: [0, 560, 60],
    to: [0, 0, 40],
    width: 900,
    height: 260,
    radiance: 4.2,
    gradient: 10,
  });
  stage.softbox({
    name: 'Long strip',
    at: [-60, 250, -520],
    to: [0, 60, 0],
    width: 1300,
    height: 90,
    radiance: 5,
    gradient: 6,
  });
  stage.softbox({
    name: 'Front strip',
    at: [-100, 620, 620],
    to: [0, 60, 0],
    width: 700,
    height: 70,
    radiance: 4,
    gradient: 6,
  });
  stage.softbox({
    name: 'Wall glow',
    at: [0, 900, -500],
    to: [0, 350, -1100],
    width: 900,
    height: 200,
    radiance: 2.5,
    color: [0.9, 0.95, 1],
  });
  stage.camera('Three quarters', { direction: [-0.75, 0.27, 1], margin: 0.1, focalLength: 85 });
  return stage.scene;
}
