import type { Scene } from '@glanz/scene';
import { lathe } from './shapes/lathe';
import { panel, roundedBox } from './shapes/boxes';
import { randomSequence } from './shapes/noise';
import { sphere, surface } from './shapes/surface';
import { BRASS, coated, emitter, glass, matte, metal, plastic } from './stage/materials';
import { at, Stage } from './stage/stage';
import { rotation } from './stage/transform';

/** A dark room with a polished floor under a hundred and twenty hanging lights. Millimetres; four metres high. */
export function createLamps(): Scene {
  const stage = new Stage('Room of lamps');
  const random = randomSequence(23);
  const [W, D, H] = [9000, 9000, 3400];
  const wall = plastic('wall', [0.06, 0.075, 0.1], 0.45);
  const floor = coated(plastic('floor', [0.018, 0.017, 0.017], 0.3), 0.06);
  stage.add('Floor', floor, (b) => surface(b, (u, v) => [(u - 0.5) * W, (v - 0.5) * D, 0], { nu: 1, nv: 1 }));
  stage.add('Ceiling', matte('ceiling', [0.05, 0.05, 0.055]), (b) => panel(b, W, D), at(0, H, 0), rotation('x', 180));
  stage.add('Back wall', wall, (b) => panel(b, W, H), at(0, H / 2, -D / 2), rotation('x', 90));
  stage.add('Left wall', wall, (b) => panel(b, D, H), at(-W / 2, H / 2, 0), rotation('y', 90), rotation('x', 90));
  stage.add('Right wall', wall, (b) => panel(b, D, H), at(W / 2, H / 2, 0), rotation('y', -90), rotation('x', 90));
  const warm = emitter('bulb warm', 30, [1, 0.55, 0.2]);
  const amber = emitter('bulb amber', 24, [1, 0.4, 0.1]);
  const white = emitter('bulb white', 26, [1, 0.74, 0.48]);
  const shade = glass('shade glass', { color: [1, 1, 1], ior: 1.4, extra: { geometry_thin_walled: true } });
  const brass = metal('socket brass', BRASS, 0.25);
  const cord = matte('cord', [0.02, 0.02, 0.02]);
  const parts: Record<string, number | undefined> = {};
  const put = (
    key: string,
    name: string,
    material: typeof wall,
    shape: Parameters<Stage['add']>[2],
    x: number,
    y: number,
    z: number,
  ) => {
    const mesh = parts[key];
    if (mesh === undefined) parts[key] = stage.add(name, material, shape, at(x, y, z));
    else stage.place(name, material, mesh, at(x, y, z));
  };
  const placed: [number, number, number][] = [];
  for (let i = 0; placed.length < 120 && i < 6000; i++) {
    const [x, z] = [(random() - 0.5) * 7600, (random() - 0.5) * 8000 - 200];
    const path = Math.abs(x) < 500 && z > -1000;
    const y = 900 + 1900 * random() ** 0.9;
    if (path || placed.some(([a, b, c]) => Math.hypot(a - x, (b - y) * 0.7, c - z) < 380)) continue;
    placed.push([x, y, z]);
  }
  for (const [i, [x, y, z]] of placed.entries()) {
    const n = i + 1;
    put('bulb', `Bulb ${n}`, [warm, amber, white, warm][i % 4]!, (b) => sphere(b, [0, 0, 0], 34, 24), x, y, z);
    put('shade', `Shade ${n}`, shade, (b) => sphere(b, [0, 0, 0], 92, 64), x, y, z);
    put(
      'socket',
      `Socket ${n}`,
      brass,
      (b) =>
        lathe(
          b,
          [
            [0, 62],
            [24, 62, 3],
            [24, 112, 6],
            [8, 124, 2],
            [0, 124],
          ],
          40,
        ),
      x,
      y,
      z,
    );
    put(
      'cord',
      `Cord ${n}`,
      cord,
      (b) =>
        lathe(
          b,
          [
            [0, 122],
            [4, 122],
            [4, 3400],
            [0, 3400],
          ],
          8,
        ),
      x,
      y,
      z,
    );
  }
  // A bench at the end of the path, for scale.
  stage.add('Bench', coated(plastic('walnut', [0.09, 0.04, 0.02], 0.4), 0.2), (b) => {
    roundedBox(b, { at: [0, 2600, 420], size: [1700, 420, 60], corner: 30, edge: 14 });
    for (const x of [-700, 700]) roundedBox(b, { at: [x, 2600, 0], size: [60, 360, 425], corner: 16, edge: 8 });
  });
  stage.camera('Room', {
    eye: [420, 1380, 4300],
    target: [-60, 1330, 0],
    focalLength: 30,
    lensRadius: 3,
    focus: [0, 1300, 800],
  });
  return stage.scene;
}
