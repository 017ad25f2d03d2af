import type { Scene } from '@glanz/scene';
import { roundedBox } from './shapes/boxes';
import { lathe, latheRing } from './shapes/lathe';
import { tube } from './shapes/tube';
import { glass, GOLD, matte, metal, SILVER } from './stage/materials';
import { at, Stage } from './stage/stage';
import { rotation } from './stage/transform';

const WALL = 5;
const FLOOR = 13;
const [WIDTH, DEPTH, HEIGHT] = [60, 34, 76];
/** Height of the liquid's surface. */
const LEVEL = 62;

const liquid = (name: string, color: readonly [number, number, number], depth: number) =>
  glass(name, { color, depth, ior: 1.36 });

/**
 * A perfume bottle of thick glass with liquid in it, a dip tube and a metal cap. The liquid overlaps the glass by a
 * fifth of a millimetre, as nested dielectrics should.
 */
export function createPerfume(): Scene {
  const stage = new Stage('Perfume');
  const turn = rotation('y', -24);
  const clear = glass('bottle glass', { color: [0.94, 0.975, 0.965], depth: 0.06, ior: 1.52 });
  stage.add(
    'Bottle',
    clear,
    (b) => {
      roundedBox(b, { size: [WIDTH, DEPTH, HEIGHT], corner: 7, edge: 3.2 });
      b.inverted(() =>
        roundedBox(b, {
          at: [0, 0, FLOOR],
          size: [WIDTH - 2 * WALL, DEPTH - 2 * WALL, HEIGHT - FLOOR - 6],
          corner: 5,
          edge: 2.5,
        }),
      );
    },
    turn,
  );
  const amber = liquid('liquid amber', [0.93, 0.5, 0.13], 0.032);
  stage.add(
    'Liquid',
    amber,
    (b) =>
      roundedBox(b, {
        at: [0, 0, FLOOR - 0.2],
        size: [WIDTH - 2 * WALL + 0.4, DEPTH - 2 * WALL + 0.4, LEVEL - FLOOR + 0.2],
        corner: 5.2,
        edge: 2.6,
      }),
    turn,
  );
  const gold = metal('cap gold', GOLD, 0.16);
  const tubeGlass = glass('tube', { ior: 1.4 });
  stage.add(
    'Dip tube',
    tubeGlass,
    (b) => tube(b, (t) => [3 * t * t, 0, HEIGHT - 1 - t * (HEIGHT - 3 - FLOOR)], 1.1, 24, 20),
    turn,
  );
  stage.add(
    'Collar',
    gold,
    (b) =>
      lathe(b, [
        [0, HEIGHT - 0.5],
        [11.5, HEIGHT - 0.5, 0.5],
        [11.5, HEIGHT + 2.2, 0.7],
        [9, HEIGHT + 2.2, 0.4],
        [9, HEIGHT + 4],
        [0, HEIGHT + 4],
      ]),
    turn,
  );
  stage.add(
    'Cap',
    gold,
    (b) =>
      lathe(
        b,
        [
          [0, HEIGHT + 3.2],
          [13, HEIGHT + 3.2, 0.6],
          [13, HEIGHT + 26, 0.9],
          [11.6, HEIGHT + 27, 0.2],
          [10.8, HEIGHT + 26.2, 0.2],
          [0, HEIGHT + 26.2],
        ],
        160,
      ),
    turn,
  );
  // The label on the front: paper, with a ring and two lines pressed in gold.
  const front = [turn, at(0, 35, DEPTH / 2), rotation('x', 90)] as const;
  stage.add(
    'Label',
    matte('label paper', [0.82, 0.78, 0.7], { specular_weight: 0.6, specular_roughness: 0.55 }),
    (b) => roundedBox(b, { at: [0, 0, -0.1], size: [27, 33, 0.5], corner: 0.8, edge: 0.12 }),
    ...front,
  );
  stage.add(
    'Label print',
    gold,
    (b) => {
      latheRing(
        b,
        [
          [4.6, 0.3],
          [5.3, 0.3],
          [5.3, 0.62, 0.12],
          [4.6, 0.62, 0.12],
        ],
        96,
      );
      lathe(
        b,
        [
          [0, 0.3],
          [1.7, 0.3],
          [1.7, 0.66, 0.16],
          [0, 0.66],
        ],
        48,
      );
      b.transformFrom(0, (x, y, z, w) => [x, y + 5 * w, z]);
      for (const [y, width] of [
        [-6, 15],
        [-8.6, 10],
      ] as const)
        roundedBox(b, { at: [0, y, 0.3], size: [width, 0.8, 0.28], corner: 0.2, edge: 0.08 });
      for (const side of [-1, 1]) {
        roundedBox(b, { at: [12 * side, 0, 0.3], size: [0.35, 30, 0.22], corner: 0.1, edge: 0.05 });
        roundedBox(b, { at: [0, 15 * side, 0.3], size: [24.35, 0.35, 0.22], corner: 0.1, edge: 0.05 });
      }
    },
    ...front,
  );
  stage.variants(amber, {
    amber,
    rose: liquid('liquid rose', [0.95, 0.42, 0.5], 0.03),
    'deep blue': liquid('liquid blue', [0.12, 0.3, 0.85], 0.03),
  });
  stage.variants(gold, {
    amber: gold,
    rose: metal('cap rose gold', [0.95, 0.64, 0.52], 0.16),
    'deep blue': metal('cap silver', SILVER, 0.14),
  });
  stage.sweep(matte('backdrop', [0.46, 0.37, 0.3]), { front: 900, back: 420, radius: 320, height: 1200, width: 2600 });
  stage.softbox({
    name: 'Key',
    at: [-330, 300, 180],
    to: [0, 50, 0],
    width: 300,
    height: 420,
    radiance: 6,
    gradient: 8,
  });
  stage.softbox({
    name: 'Strip',
    at: [330, 180, 40],
    to: [0, 50, 0],
    width: 90,
    height: 420,
    radiance: 7,
    gradient: 6,
  });
  stage.softbox({
    name: 'Glow behind',
    at: [60, 420, -330],
    to: [0, 30, 0],
    width: 340,
    height: 240,
    radiance: 6,
    color: [1, 0.93, 0.84],
  });
  stage.camera('Front', {
    direction: [0.07, 0.2, 1],
    margin: 0.14,
    focalLength: 92,
    lensRadius: 2,
    focus: [0, 45, 17],
  });
  stage.camera('Detail', {
    eye: [-140, 130, 260],
    target: [0, 70, 0],
    focalLength: 85,
    lensRadius: 2,
    focus: [0, 70, 17],
  });
  return stage.scene;
}
