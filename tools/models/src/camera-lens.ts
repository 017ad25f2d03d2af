import type { Scene } from '@glanz/scene';
import { lathe, latheRing } from './shapes/lathe';
import type { MeshBuilder } from './shapes/mesh-builder';
import { surface } from './shapes/surface';
import { glass, matte, metal, plastic } from './stage/materials';
import { at, Stage } from './stage/stage';
import { rotation, type Matrix } from './stage/transform';

/** A ring with ribs for the fingers: `count` ribs between two heights. */
function ribbed(b: MeshBuilder, radius: number, depth: number, from: number, to: number, count: number): void {
  surface(
    b,
    (u, v) => {
      const a = 2 * Math.PI * u;
      const t = Math.min(Math.max(v, 0), 1);
      const inside = Math.max(1 - Math.abs(2 * t - 1) ** 10, 0);
      const wave = 0.5 + 0.5 * Math.cos(count * a);
      const r = radius - depth * (1 - wave * wave) * inside - 1.4 * (1 - inside) ** 3;
      return [r * Math.cos(a), r * Math.sin(a), from + (to - from) * t];
    },
    { nu: count * 12, nv: 36, closeU: true },
  );
}

/** A cap between two spherical surfaces: heights of the vertices and sags at the rim. */
function element(b: MeshBuilder, radius: number, back: number, front: number, backSag: number, frontSag: number): void {
  const steps = 20;
  const arc = (z: number, sag: number) =>
    Array.from({ length: steps + 1 }, (_, i) => [(radius * i) / steps, z - sag * (i / steps) ** 2] as const);
  lathe(b, [...arc(back, backSag), ...arc(front, frontSag).reverse()], 160, { deviation: 0.05, angle: 0.3 });
}

/** A photographic lens: engraved rings, ribs, and coated glass. Stands on its mount, turned towards the camera. */
export function createCameraLens(): Scene {
  const stage = new Stage('Camera lens');
  const pose: Matrix[] = [at(0, 37.2, 0), rotation('y', 24), rotation('x', 90)];
  const add = (name: string, material: Parameters<Stage['add']>[1], shape: (b: MeshBuilder) => void) =>
    stage.add(name, material, shape, ...pose);
  const black = metal('anodised black', [0.03, 0.03, 0.032], 0.34);
  const rubber = plastic('rubber', [0.014, 0.014, 0.015], 0.52);
  const chrome = metal('mount', [0.72, 0.72, 0.73], 0.2);
  add('Mount', chrome, (b) =>
    latheRing(
      b,
      [
        [22, -38],
        [30, -38, 0.5],
        [30, -33, 0.4],
        [32.5, -33, 0.4],
        [32.5, -30, 0.4],
        [22, -30],
      ],
      160,
    ),
  );
  add('Barrel', black, (b) =>
    latheRing(
      b,
      [
        [23, -31],
        [34, -31, 0.8],
        [34, -14, 0.6],
        [35.5, -13, 0.6],
        [35.5, 10, 0.6],
        [36.6, 11, 0.5],
        [36.6, 44, 1],
        [33.6, 44, 0.7],
        [33.6, 40],
        [31.5, 38.5],
        [29.4, 33],
        [27.4, 26],
        [25.4, 20],
        [23, 14],
      ],
      200,
    ),
  );
  add('Focus ring', rubber, (b) => ribbed(b, 37.2, 0.9, 15, 33, 60));
  add('Aperture ring', black, (b) => ribbed(b, 35.4, 0.7, -27, -17, 44));
  const red = plastic('red', [0.62, 0.012, 0.012], 0.28);
  add('Red line', red, (b) =>
    latheRing(
      b,
      [
        [35.8, 37.6],
        [36.85, 37.6, 0.2],
        [36.85, 38.9, 0.2],
        [35.8, 38.9],
      ],
      200,
    ),
  );
  add('Marks', matte('white print', [0.8, 0.8, 0.8]), (b) => {
    for (let i = 0; i < 36; i++) {
      const first = b.vertexCount;
      const long = i % 3 === 0;
      lathe(
        b,
        [
          [0, 0],
          [0.34, 0],
          [0.34, 0.12],
          [0, 0.12],
        ],
        12,
      );
      const a = (i * Math.PI) / 18;
      // A stroke along the axis on the barrel.
      b.transformFrom(first, (x, y, z, w) => {
        const along = y * (long ? 7 : 4) + w * 2;
        const [r, side] = [z + w * 35.46, x];
        return [r * Math.cos(a) - side * Math.sin(a), r * Math.sin(a) + side * Math.cos(a), along];
      });
    }
  });
  const coating = (name: string, thickness: number) =>
    glass(name, {
      color: [0.98, 1, 0.99],
      depth: 0.1,
      ior: 1.6,
      extra: { thin_film_weight: 1, thin_film_thickness: thickness, thin_film_ior: 1.9 },
    });
  add('Front element', coating('coated glass violet', 0.21), (b) => element(b, 28.6, 22, 37, 1, 7.5));
  add('Second element', coating('coated glass green', 0.3), (b) => element(b, 22.6, 6, 15, 5, 6.6));
  const blade = metal('iris', [0.05, 0.05, 0.055], 0.36);
  add('Iris', blade, (b) =>
    latheRing(
      b,
      [
        [11, 0.4],
        [23.4, -1.4],
        [23.4, 1.6],
        [11, 0.9],
      ],
      9,
    ),
  );
  add('Rear element', coating('coated glass amber', 0.26), (b) => element(b, 20, -16, -7, 4, -3));
  add('Tube', matte('flocked black', [0.01, 0.01, 0.01]), (b) =>
    latheRing(
      b,
      [
        [22.4, -31],
        [24, -31],
        [24, 20],
        [22.4, 20],
      ],
      120,
    ),
  );
  add('Back', matte('flocked black', [0.01, 0.01, 0.01]), (b) =>
    lathe(
      b,
      [
        [0, -32],
        [23, -32],
        [23, -31.4],
        [0, -31.4],
      ],
      96,
    ),
  );
  stage.add('Backdrop', matte('floor', [0.8, 0.8, 0.8]), (b) =>
    surface(b, (u, v) => [(u - 0.5) * 1600, (v - 0.5) * 1600, 0], { nu: 1, nv: 1 }),
  );
  stage.softbox({
    name: 'Key',
    at: [-240, 300, 220],
    to: [0, 35, 0],
    width: 260,
    height: 260,
    radiance: 8,
    gradient: 8,
  });
  stage.softbox({
    name: 'Right',
    at: [300, 120, 150],
    to: [0, 35, 0],
    width: 90,
    height: 300,
    radiance: 6,
    gradient: 6,
  });
  stage.softbox({
    name: 'Above',
    at: [0, 420, -60],
    to: [0, 35, 0],
    width: 500,
    height: 260,
    radiance: 4.5,
    gradient: 6,
  });
  stage.camera('Front', { direction: [0.0, 0.24, 1], margin: 0.14, focalLength: 90 });
  return stage.scene;
}
