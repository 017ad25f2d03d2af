import type { Scene } from '@glanz/scene';
import { lathe } from './shapes/lathe';
import { panel, roundedBox } from './shapes/boxes';
import { randomSequence } from './shapes/noise';
import { sphere, surface } from './shapes/surface';
import { BRASS, coated, matte, metal, plastic } from './stage/materials';
import { at, Stage } from './stage/stage';
import { rotation, scaling, type Matrix } from './stage/transform';

/** Glass that glows all over and reflects the room a little. */
const opal = (name: string, emission_color: readonly [number, number, number], emission_luminance: number) =>
  plastic(name, [0.7, 0.66, 0.6], 0.12, { emission_color, emission_luminance });

/** A dark room with a polished floor under hanging globes of opal glass. Millimetres; four metres high. */
export function createLamps(): Scene {
  const stage = new Stage('Room of lamps');
  const random = randomSequence(23);
  const [W, D, H] = [9000, 9000, 3400];
  const wall = plastic('wall', [0.2, 0.3, 0.42], 0.5);
  const floor = coated(plastic('floor', [0.075, 0.06, 0.05], 0.3), 0.05);
  stage.add('Floor', floor, (b) => surface(b, (u, v) => [(u - 0.5) * W, (v - 0.5) * D, 0], { nu: 1, nv: 1 }));
  stage.add('Ceiling', matte('ceiling', [0.16, 0.17, 0.2]), (b) => panel(b, W, D), at(0, H, 0), rotation('x', 180));
  stage.add('Back wall', wall, (b) => panel(b, W, H), at(0, H / 2, -D / 2), rotation('x', 90));
  stage.add('Left wall', wall, (b) => panel(b, D, H), at(-W / 2, H / 2, 0), rotation('y', 90), rotation('x', 90));
  stage.add('Right wall', wall, (b) => panel(b, D, H), at(W / 2, H / 2, 0), rotation('y', -90), rotation('x', 90));
  const globes = [
    opal('opal warm', [1, 0.6, 0.27], 2.4),
    opal('opal amber', [1, 0.44, 0.13], 2.1),
    opal('opal white', [1, 0.78, 0.54], 2.2),
  ];
  const brass = metal('socket brass', BRASS, 0.25);
  const cord = matte('cord', [0.02, 0.02, 0.02]);
  const parts = new Map<string, number>();
  const put = (
    key: string,
    name: string,
    material: typeof wall,
    shape: Parameters<Stage['add']>[2],
    ...place: Matrix[]
  ) => {
    const mesh = parts.get(key);
    if (mesh === undefined) parts.set(key, stage.add(name, material, shape, ...place));
    else stage.place(name, material, mesh, ...place);
  };
  const placed: (readonly [x: number, y: number, z: number, radius: number])[] = [];
  for (let i = 0; placed.length < 74 && i < 8000; i++) {
    const [x, z] = [(random() - 0.5) * 7600, (random() - 0.5) * 7600 - 700];
    const radius = 70 + 110 * random() ** 1.6;
    const y = 620 + 2150 * random() ** 0.8;
    const path = Math.abs(x) < 620 && z > -2300;
    if (path || placed.some(([a, b, c, r]) => Math.hypot(a - x, (b - y) * 0.8, c - z) < 2.2 * (radius + r))) continue;
    placed.push([x, y, z, radius]);
  }
  for (const [i, [x, y, z, radius]] of placed.entries()) {
    const [n, k] = [i + 1, radius / 100];
    put('globe', `Globe ${n}`, globes[i % 3]!, (b) => sphere(b, [0, 0, 0], 100, 40), at(x, y, z), scaling(k));
    put(
      'socket',
      `Socket ${n}`,
      brass,
      (b) =>
        lathe(
          b,
          [
            [0, 94],
            [30, 94, 3],
            [30, 124, 8],
            [9, 136, 2],
            [0, 136],
          ],
          40,
        ),
      at(x, y, z),
      scaling(k),
    );
    put(
      'cord',
      `Cord ${n}`,
      cord,
      (b) =>
        lathe(
          b,
          [
            [0, 0],
            [3.5, 0],
            [3.5, 3400],
            [0, 3400],
          ],
          8,
        ),
      at(x, y + 130 * k, z),
    );
  }
  // A bench at the end of the path, for scale.
  stage.add('Bench', coated(plastic('walnut', [0.2, 0.09, 0.04], 0.4), 0.2), (b) => {
    roundedBox(b, { at: [0, 2600, 420], size: [1700, 420, 60], corner: 30, edge: 14 });
    for (const x of [-700, 700]) roundedBox(b, { at: [x, 2600, 0], size: [60, 360, 425], corner: 16, edge: 8 });
  });
  stage.camera('Room', {
    eye: [330, 1240, 4150],
    target: [-40, 1240, 0],
    focalLength: 32,
    lensRadius: 5,
    focus: [0, 1240, 400],
  });
  return stage.scene;
}
