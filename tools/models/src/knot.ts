import type { Scene } from '@glanz/scene';
import { surface } from './shapes/surface';
import { coated, GOLD, matte, metal, plastic, translucent } from './stage/materials';
import { at, Stage } from './stage/stage';
import { rotation } from './stage/transform';

type Vector = readonly [number, number, number];

/** Centre line of a trefoil knot, millimetres. */
function trefoil(t: number): Vector {
  const a = 2 * Math.PI * t;
  const r = 30 + 13 * Math.cos(3 * a);
  return [r * Math.cos(2 * a), r * Math.sin(2 * a), 16 * Math.sin(3 * a)];
}

const sub = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const unit = (a: Vector): Vector => {
  const l = Math.hypot(...a);
  return [a[0] / l, a[1] / l, a[2] / l];
};

/** A point on the skin: the section is a rounded triangle that turns along the knot. */
function skin(u: number, v: number): Vector {
  const p = trefoil(v);
  const t = unit(sub(trefoil(v + 1e-4), trefoil(v - 1e-4)));
  // A frame that needs no transport: the knot lies around the z axis.
  const side = unit(cross(t, unit([p[0], p[1], p[2] * 0.2])));
  const up = cross(side, t);
  const a = 2 * Math.PI * u;
  const r = 9.6 * (1 + 0.075 * Math.cos(3 * (a + 2 * Math.PI * v)));
  const [c, s] = [r * Math.cos(a), r * Math.sin(a)];
  return [p[0] + c * side[0] + s * up[0], p[1] + c * side[1] + s * up[1], p[2] + c * side[2] + s * up[2]];
}

/** A trefoil knot as a sculpture, in materials that show what light does inside of them. */
export function createKnot(): Scene {
  const stage = new Stage('Knot');
  const jade = translucent('jade', { color: [0.32, 0.68, 0.4], radius: 0.004, scale: [0.6, 1, 0.65], roughness: 0.16 });
  stage.add(
    'Knot',
    jade,
    (b) => surface(b, skin, { nu: 72, nv: 420, closeU: true, closeV: true, flip: true }),
    at(0, 53.5, 0),
    rotation('y', -18),
    rotation('x', 82),
  );
  stage.add('Plinth', plastic('plinth', [0.03, 0.03, 0.032], 0.3), (b) =>
    surface(
      b,
      (u, v) => {
        const a = 2 * Math.PI * u;
        const t = Math.min(Math.max(v, 0), 1);
        const e = Math.sqrt(Math.max(1 - Math.abs(2 * t - 1) ** 12, 0));
        return [34 * e * Math.cos(a), 34 * e * Math.sin(a), 8 * t];
      },
      { nu: 160, nv: 40, closeU: true },
    ),
  );
  stage.variants(jade, {
    jade,
    wax: translucent('wax', { color: [0.86, 0.5, 0.34], radius: 0.007, scale: [1, 0.45, 0.25], roughness: 0.38 }),
    alabaster: translucent('alabaster', {
      color: [0.9, 0.84, 0.76],
      radius: 0.005,
      scale: [1, 0.86, 0.7],
      roughness: 0.24,
    }),
    gold: metal('gold', GOLD, 0.12),
    titanium: metal('titanium, anodised', [0.62, 0.58, 0.55], 0.16, {
      thin_film_weight: 1,
      thin_film_thickness: 0.36,
      thin_film_ior: 1.9,
    }),
    lacquer: coated(plastic('lacquer', [0.5, 0.012, 0.014], 0.4), 0.02),
  });
  stage.sweep(matte('backdrop', [0.2, 0.21, 0.23]), { front: 700, back: 380, radius: 300, height: 900, width: 2400 });
  stage.softbox({
    name: 'Behind',
    at: [120, 190, -170],
    to: [0, 50, 0],
    width: 130,
    height: 130,
    radiance: 17,
    color: [1, 0.92, 0.82],
  });
  stage.softbox({
    name: 'Key',
    at: [-230, 190, 110],
    to: [0, 50, 0],
    width: 200,
    height: 260,
    radiance: 4.5,
    gradient: 8,
  });
  stage.softbox({
    name: 'Right',
    at: [280, 90, 120],
    to: [0, 50, 0],
    width: 70,
    height: 260,
    radiance: 3.2,
    gradient: 5,
    color: [0.85, 0.93, 1],
  });
  stage.camera('Front', {
    direction: [0.1, 0.22, 1],
    margin: 0.14,
    focalLength: 90,
    lensRadius: 1.4,
    focus: [0, 55, 20],
  });
  return stage.scene;
}
