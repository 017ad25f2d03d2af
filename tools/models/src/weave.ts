import type { Scene } from '@glanz/scene';
import { surface } from './shapes/surface';
import { noise } from './shapes/noise';
import { BRASS, cloth, COPPER, metal, plastic, SILVER } from './stage/materials';
import { at, Stage } from './stage/stage';
import { rotation } from './stage/transform';

/** Height of folded cloth, millimetres. */
const folds = (x: number, y: number): number =>
  7 * Math.sin(x * 0.075 + y * 0.03 + 0.6) + 4 * Math.sin(y * 0.09 - x * 0.045) + 3 * noise(x / 40, y / 40, 2);

/** Woven cloth seen from near: every yarn is there, in a twill, over two and under two. */
export function createWeave(): Scene {
  const stage = new Stage('Weave');
  const PITCH = 2.1;
  const COUNT = 44;
  const blue = cloth('yarn indigo', [0.018, 0.045, 0.17], [0.5, 0.68, 1], 0.75, 0.5);
  const gold = cloth('yarn ochre', [0.72, 0.33, 0.05], [1, 0.85, 0.55], 0.7, 0.5);
  const half = (COUNT * PITCH) / 2;
  // Twill: the yarn of a column lies above where (row + column) mod 4 is below 2.
  const lift = (phase: number) => {
    const t = ((phase % 4) + 4) % 4;
    return 0.62 * Math.tanh(2.2 * Math.sin(((t - 0.0) * Math.PI) / 2 + Math.PI / 4));
  };
  const yarn = (name: string, material: typeof blue, warp: boolean) =>
    stage.add(name, material, (b) => {
      for (let i = 0; i < COUNT; i++) {
        const across = (i + 0.5) * PITCH - half;
        surface(
          b,
          (u, v) => {
            const t = Math.min(Math.max(v, 0), 1);
            const along = t * 2 * half - half;
            const k = (along + half) / PITCH;
            const height = (warp ? 1 : -1) * lift(k + i);
            const a = 2 * Math.PI * u;
            const end = Math.sqrt(Math.max(1 - Math.abs(2 * t - 1) ** 200, 0));
            // Fibres twisted into a yarn.
            const twist = 1 + 0.055 * Math.cos(3 * a + along * 3.4);
            const [side, up] = [1.06 * end * twist * Math.cos(a), 0.66 * end * twist * Math.sin(a)];
            const [x, y] = warp ? [across + side, along] : [along, across + side];
            return [x, y, height + up + folds(x, y)];
          },
          { nu: 15, nv: COUNT * 4, closeU: true, flip: warp },
        );
      }
    });
  yarn('Warp', blue, true);
  yarn('Weft', gold, false);
  stage.softbox({
    name: 'Window',
    at: [-140, 90, -60],
    to: [0, 0, 0],
    width: 120,
    height: 110,
    radiance: 8.5,
    color: [1, 0.96, 0.9],
  });
  stage.softbox({
    name: 'Fill',
    at: [130, 110, 90],
    to: [0, 0, 0],
    width: 140,
    height: 100,
    radiance: 1.6,
    color: [0.8, 0.9, 1],
  });
  stage.camera('Near', { eye: [22, 66, 92], target: [2, 0, 4], focalLength: 96, lensRadius: 2.2, focus: [0, 2, 6] });
  return stage.scene;
}

/** Mail, four in one: every ring goes through four others, draped over a ball. */
export function createMail(): Scene {
  const stage = new Stage('Mail');
  const R = 4.6;
  const WIRE = 0.78;
  const steel = metal('mail steel', [0.56, 0.57, 0.58], 0.2);
  const brass = metal('mail brass', BRASS, 0.16);
  const ring = (b: Parameters<Parameters<Stage['add']>[2]>[0]) =>
    surface(
      b,
      (u, v) => {
        const [a, p] = [2 * Math.PI * u, 2 * Math.PI * v];
        const r = R + WIRE * Math.cos(p);
        return [r * Math.cos(a), r * Math.sin(a), WIRE * Math.sin(p)];
      },
      { nu: 44, nv: 14, closeU: true, closeV: true },
    );
  // Rings of a row lean one way, those of the next the other way; rows overlap by half.
  const [dx, dy] = [R * 1.42, R * 0.78];
  const [columns, rows] = [30, 44];
  const height = (x: number, y: number) =>
    46 * Math.exp(-((x * x + y * y) / (2 * 38 ** 2))) +
    3 * noise(x / 26, y / 26, 5) +
    4 * Math.sin(x / 21 + y / 33) * Math.min(Math.hypot(x, y) / 80, 1);
  const degrees = (x: number) => (x * 180) / Math.PI;
  let mesh: number | undefined;
  for (let j = 0; j < rows; j++)
    for (let i = 0; i < columns; i++) {
      const x = (i - columns / 2 + (j % 2) * 0.5) * dx;
      const y = (j - rows / 2) * dy;
      const z = height(x, y);
      const [sx, sy] = [height(x + 1, y) - height(x - 1, y), height(x, y + 1) - height(x, y - 1)].map((d) => d / 2) as [
        number,
        number,
      ];
      const lean = j % 2 ? 33 : -33;
      const inlay = Math.abs(Math.hypot(x, y) - 70) < 6;
      const place = [
        at(x, z, -y),
        rotation('x', -degrees(Math.atan(-sy))),
        rotation('z', degrees(Math.atan(sx))),
        rotation('z', lean),
      ];
      const name = `Ring ${j}-${i}`;
      if (mesh === undefined) mesh = stage.add(name, steel, ring, ...place);
      else stage.place(name, inlay ? brass : steel, mesh, ...place);
    }
  const dark = plastic('velvet ground', [0.03, 0.008, 0.012], 0.6);
  stage.add('Ground', dark, (b) =>
    surface(
      b,
      (u, v) => {
        const [x, y] = [(u - 0.5) * 900, (v - 0.5) * 900];
        return [x, y, height(x, y) - 5];
      },
      { nu: 150, nv: 150 },
    ),
  );
  stage.variants(steel, { steel, copper: metal('mail copper', COPPER, 0.2) });
  stage.variants(brass, { steel: brass, copper: metal('mail silver', SILVER, 0.14) });
  stage.softbox({
    name: 'Window',
    at: [-190, 190, -60],
    to: [0, 20, 0],
    width: 260,
    height: 200,
    radiance: 6,
    gradient: 8,
  });
  stage.softbox({
    name: 'Right',
    at: [210, 120, 40],
    to: [0, 20, 0],
    width: 60,
    height: 180,
    radiance: 6,
    color: [1, 0.9, 0.75],
  });
  stage.softbox({
    name: 'Over',
    at: [40, 300, 120],
    to: [0, 20, 0],
    width: 360,
    height: 240,
    radiance: 2.2,
    gradient: 8,
  });
  stage.softbox({
    name: 'Behind',
    at: [0, 130, -240],
    to: [0, 20, 0],
    width: 240,
    height: 60,
    radiance: 5,
  });
  stage.camera('Near', {
    eye: [-20, 120, 200],
    target: [0, 20, 4],
    focalLength: 80,
    lensRadius: 2.6,
    focus: [0, 40, 30],
  });
  return stage.scene;
}
