import type { Scene } from '@glanz/scene';
import { latheRing, lathe, type ProfilePoint } from './shapes/lathe';
import { fractalNoise, randomSequence } from './shapes/noise';
import { superellipsoid } from './shapes/surface';
import { glass, matte } from './stage/materials';
import { at, Stage } from './stage/stage';
import { rotation } from './stage/transform';

const RADIUS = 40;
const WALL = 3.2;
const FLOOR = 14;
const HEIGHT = 92;
const LEVEL = 62;

/** A heavy tumbler with a drink and ice. The drink overlaps glass and the ice floats in it, as nested dielectrics. */
export function createTumbler(): Scene {
  const stage = new Stage('Tumbler');
  const clear = glass('tumbler glass', { color: [0.96, 0.985, 0.975], depth: 0.06, ior: 1.52 });
  const inside = RADIUS - WALL;
  stage.add('Tumbler', clear, (b) =>
    lathe(
      b,
      [
        [0, 2.5],
        [RADIUS - 9, 1.2, 6],
        [RADIUS - 6, 0, 1.4],
        [RADIUS, 0, 4],
        [RADIUS + 0.8, HEIGHT, 1.5],
        [inside + 0.8, HEIGHT, 1.5],
        [inside - 0.4, FLOOR, 9],
        [0, FLOOR - 2],
      ],
      160,
    ),
  );
  const whisky = glass('whisky', { color: [0.9, 0.42, 0.08], depth: 0.05, ior: 1.36 });
  const water = glass('water', { color: [0.9, 0.97, 0.98], depth: 0.15, ior: 1.333 });
  const overlap = 0.25;
  const drink: ProfilePoint[] = [
    [0, FLOOR - 2 - overlap],
    [inside - 0.4 + overlap, FLOOR - overlap, 9],
    [inside + 0.2 + overlap, LEVEL + 0.7],
    [inside - 0.8, LEVEL + 0.1, 0.8],
    [inside - 3, LEVEL],
    [0, LEVEL],
  ];
  stage.add('Drink', whisky, (b) => lathe(b, drink, 160));
  const ice = glass('ice', { color: [0.97, 0.99, 1], depth: 0.08, ior: 1.31, roughness: 0.03 });
  const random = randomSequence(5);
  for (const [i, [x, y, z, a, c, e]] of (
    [
      [-12, 54, 8, 18, 12, -8],
      [15, 57, -4, 62, -16, 20],
      [-4, 33, -12, 34, 40, 12],
    ] as const
  ).entries()) {
    const offset = 20 * random();
    stage.add(
      `Ice ${i + 1}`,
      ice,
      (b) =>
        superellipsoid(b, {
          radii: [14, 14, 13.4],
          around: 0.34,
          along: 0.34,
          segments: 128,
          shape: (p) => {
            const bump = 1 + 0.035 * fractalNoise(p[0] / 9 + offset, p[1] / 9, p[2] / 9, 3);
            return [p[0] * bump, p[1] * bump, p[2] * bump];
          },
        }),
      at(x, y, z),
      rotation('y', a),
      rotation('x', c),
      rotation('z', e),
    );
  }
  // Drops on the outside are not closed off from the glass: small domes that overlap it.
  stage.variants(whisky, { whisky, water });
  stage.add('Coaster', matte('cork', [0.32, 0.2, 0.11], { specular_weight: 0.2 }), (b) =>
    latheRing(
      b,
      [
        [0.5, -4],
        [52, -4, 0.8],
        [52, -0.05, 0.8],
        [0.5, -0.05],
      ],
      128,
    ),
  );
  stage.sweep(matte('backdrop', [0.5, 0.5, 0.5]), {
    front: 900,
    back: 420,
    radius: 300,
    height: 1100,
    width: 2600,
    y: -4,
  });
  stage.softbox({
    name: 'Behind',
    at: [20, 330, -360],
    to: [0, 40, -60],
    width: 420,
    height: 240,
    radiance: 7,
    color: [1, 0.96, 0.9],
  });
  stage.softbox({
    name: 'Left',
    at: [-330, 190, 100],
    to: [0, 45, 0],
    width: 160,
    height: 380,
    radiance: 5,
    gradient: 8,
  });
  stage.softbox({
    name: 'Right',
    at: [330, 160, 20],
    to: [0, 45, 0],
    width: 70,
    height: 380,
    radiance: 6,
    gradient: 6,
  });
  stage.camera('Front', {
    direction: [0.06, 0.3, 1],
    around: 'Tumbler',
    margin: 0.24,
    lift: 0.01,
    focalLength: 88,
    lensRadius: 1.8,
    focus: [0, 50, 38],
  });
  return stage.scene;
}
