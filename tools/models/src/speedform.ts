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

/** Cross-section of the body at v (0 nose, 1 tail), by the angle u: y to the side, z up. */
function body(u: number, v: number): readonly [number, number, number] {
  const s = Math.min(Math.max(v, 0), 1);
  // Round at the nose, drawn out at the tail.
  const nose = Math.sqrt(Math.min(s / 0.42, 1) * (2 - Math.min(s / 0.42, 1)));
  const tail = 1 - smooth(0.3, 1, s) ** 1.6 * 0.86;
  const end = Math.sqrt(Math.max(1 - Math.max((s - 0.93) / 0.07, 0) ** 2, 0));
  const e = nose * tail * end;
  const theta = 2 * Math.PI * u;
  const [c, t] = [Math.cos(theta), Math.sin(theta)];
  // The roof is rounder than the flanks.
  const side = powered(c, 0.86);
  const up = powered(t, t > 0 ? 0.94 : 0.6);
  const shoulder = Math.exp(-(((t - 0.36) / 0.13) ** 2)) * smooth(0.1, 0.4, s) * (1 - smooth(0.8, 0.98, s));
  const hollow = Math.exp(-(((t + 0.02) / 0.24) ** 2)) * smooth(0.2, 0.5, s) * (1 - smooth(0.72, 0.97, s));
  const width = WIDTH * e * (1 + 0.07 * shoulder - 0.13 * hollow) * (t > 0 ? 1 - 0.3 * t * t : 1);
  const canopy = Math.exp(-(((s - 0.46) / 0.2) ** 2)) * Math.max(t, 0) ** 2.2;
  const z = t > 0 ? HEIGHT * (0.62 * e * up + 0.42 * canopy * Math.sqrt(e)) : 34 * e * up;
  const rise = 20 * smooth(0.45, 1, s);
  return [LENGTH * (s - 0.5), width * side, 38 + z + rise];
}

/** A streamlined body, the kind on which paint makers show car paint: metallic base under a clear coat. */
export function createSpeedform(): Scene {
  const stage = new Stage('Speedform');
  const paint = (name: string, color: readonly [number, number, number], roughness = 0.38) =>
    coated(metal(name, color, roughness), 0.015);
  const red = paint('paint red', [0.62, 0.012, 0.018]);
  stage.add('Body', red, (b) => surface(b, (u, v) => body(u, v), { nu: 260, nv: 300, closeU: true, flip: true }));
  stage.variants(red, {
    red,
    blue: paint('paint blue', [0.01, 0.09, 0.45]),
    silver: paint('paint silver', [0.66, 0.67, 0.68], 0.32),
    black: coated(plastic('paint black', [0.008, 0.008, 0.01], 0.3), 0.01),
    yellow: coated(plastic('paint yellow', [0.85, 0.42, 0.005], 0.3), 0.01),
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
  stage.camera('Side', { direction: [0.05, 0.12, 1], margin: 0.1, focalLength: 85 });
  return stage.scene;
}
