import type { Scene } from '@glanz/scene';
import { lathe } from './shapes/lathe';
import { fractalNoise } from './shapes/noise';
import { surface } from './shapes/surface';
import { softSpline, spline, tube } from './shapes/tube';
import { BRASS, emitter, matte, metal, plastic, translucent } from './stage/materials';
import { at, Stage } from './stage/stage';

/** Burning candles: wax that glows around the flames, in small brass dishes. */
export function createCandles(): Scene {
  const stage = new Stage('Candles');
  const wax = translucent('beeswax', {
    color: [0.9, 0.66, 0.4],
    radius: 0.009,
    scale: [1, 0.5, 0.22],
    roughness: 0.42,
  });
  const ivory = translucent('ivory wax', {
    color: [0.9, 0.82, 0.7],
    radius: 0.008,
    scale: [1, 0.66, 0.42],
    roughness: 0.4,
  });
  const brass = metal('brass', BRASS, 0.22);
  const flame = emitter('flame', 70, [1, 0.5, 0.14]);
  for (const [i, [x, z, radius, height, material]] of (
    [
      [-46, -14, 23, 98, ivory],
      [14, 18, 27, 66, wax],
      [60, -20, 20, 122, wax],
    ] as const
  ).entries()) {
    const n = i + 1;
    const place = at(x, 6, z);
    stage.add(
      `Candle ${n}`,
      material,
      (b) => {
        // The rim stands a little above the pool, uneven; wax has run down.
        surface(
          b,
          (u, v) => {
            const a = 2 * Math.PI * u;
            const t = Math.min(Math.max(v, 0), 1);
            const rim = height + 2.2 * fractalNoise(3 * Math.cos(a) + i * 9, 3 * Math.sin(a), 1, 2);
            const drip =
              1 +
              0.05 *
                Math.max(fractalNoise(4 * Math.cos(a) + 5 * i, 4 * Math.sin(a), t * 1.4, 2), 0) *
                Math.min(t * 2, 1);
            // Below the middle, the outside, over the rim, and into the pool.
            const path: [number, number][] = [
              [0, 0],
              [0.6, 0],
              [1, 0],
              [1, rim * 0.1],
              [drip, rim * 0.5],
              [drip, rim - 3],
              [0.96, rim],
              [0.87, rim - 0.8],
              [0.74, rim - 5.5],
              [0.4, rim - 8.5],
              [0, height - 9],
            ];
            const f = softSpline(path.map(([r, y]) => [r * radius, y, 0] as const));
            const [r, y] = f(t);
            return [r * Math.cos(a), r * Math.sin(a), y];
          },
          { nu: 128, nv: 120, closeU: true },
        );
      },
      place,
    );
    stage.add(
      `Wick ${n}`,
      matte('wick', [0.02, 0.015, 0.012]),
      (b) =>
        tube(
          b,
          spline([
            [0, 0, height - 14],
            [0, 0, height - 3],
            [0.8, 0.3, height + 3],
            [2, 0.4, height + 6],
          ]),
          0.8,
          20,
          12,
        ),
      place,
    );
    stage.add(
      `Flame ${n}`,
      flame,
      (b) =>
        surface(
          b,
          (u, v) => {
            const a = 2 * Math.PI * u;
            const t = Math.min(Math.max(v, 0), 1);
            const r = 4.6 * Math.sin(Math.PI * t ** 0.62) ** 0.9 * (1 - 0.35 * t);
            return [1.2 + r * Math.cos(a) + 0.8 * t * t, r * Math.sin(a), height + 2 + 25 * t];
          },
          { nu: 20, nv: 24, closeU: true },
        ),
      place,
    );
    stage.add(
      `Dish ${n}`,
      brass,
      (b) =>
        lathe(
          b,
          [
            [0, 0],
            [radius + 9, 0, 1],
            [radius + 12, 6, 1.2],
            [radius + 10.6, 6, 0.6],
            [radius + 8, 1.6, 1],
            [0, 1.6],
          ],
          128,
        ),
      at(x, 4, z),
    );
  }
  stage.sweep(plastic('table', [0.06, 0.045, 0.038], 0.3), {
    front: 800,
    back: 420,
    radius: 300,
    height: 1100,
    width: 2600,
    y: 4,
  });
  stage.softbox({
    name: 'Dusk',
    at: [-420, 330, -120],
    to: [0, 60, 0],
    width: 240,
    height: 300,
    radiance: 1.3,
    color: [0.45, 0.62, 1],
  });
  stage.softbox({
    name: 'Fill',
    at: [350, 260, 300],
    to: [0, 60, 0],
    width: 240,
    height: 240,
    radiance: 0.6,
    color: [1, 0.8, 0.6],
  });
  stage.camera('Front', {
    direction: [0.02, 0.17, 1],
    margin: 0.3,
    focalLength: 85,
    lensRadius: 2.6,
    focus: [14, 60, 40],
  });
  return stage.scene;
}
