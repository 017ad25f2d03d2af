import type { Scene } from '@glanz/scene';
import { lathe } from './shapes/lathe';
import { noise } from './shapes/noise';
import { superellipsoid, surface } from './shapes/surface';
import { tube } from './shapes/tube';
import { BRASS, cloth, matte, metal } from './stage/materials';
import { Stage } from './stage/stage';

const DEGREE = Math.PI / 180;
/** Half the angle that the back goes around the seat. */
const REACH = 118 * DEGREE;
const CHANNELS = 19;

/** The back: a padded band around the seat, stitched into upright channels. u around the pad, v along the band. */
function back(u: number, v: number): readonly [number, number, number] {
  const t = Math.min(Math.max(2 * v - 1, -1), 1);
  const angle = t * REACH;
  const end = Math.max(1 - Math.abs(t) ** 14, 0) ** 0.5;
  // Channels: between two seams the padding swells.
  const phase = (v * CHANNELS) % 1;
  const swell = Math.sqrt(Math.sin(Math.PI * phase) ** 2 + 0.004);
  const top = 650 + 110 * Math.cos(angle * 0.75) - 40;
  const bottom = 150;
  const [middle, half] = [(top + bottom) / 2, (top - bottom) / 2];
  const phi = 2 * Math.PI * u;
  const round = (x: number, e: number) => Math.sign(x) * Math.abs(x) ** e;
  const thick = (38 + 24 * swell) * end;
  const across = thick * round(Math.cos(phi), 0.75);
  const height = (half - 14 * (1 - swell)) * (0.9 + 0.1 * end) * round(Math.sin(phi), 0.42) * end;
  const lean = 46 * Math.max((middle + height - bottom) / (top - bottom), 0) ** 1.4;
  const radius = 395 + across + lean;
  return [radius * Math.sin(angle), radius * 0.94 * Math.cos(angle), middle + height];
}

/** A tub chair in velvet, channel-stitched, on brass legs. */
export function createArmchair(): Scene {
  const stage = new Stage('Armchair');
  const velvet = (name: string, base: readonly [number, number, number], fuzz: readonly [number, number, number]) =>
    cloth(name, base, fuzz, 0.9, 0.42);
  const green = velvet('velvet green', [0.006, 0.085, 0.058], [0.5, 0.85, 0.7]);
  stage.add('Back', green, (b) => surface(b, back, { nu: 72, nv: CHANNELS * 18, closeU: true }));
  stage.add('Seat', green, (b) =>
    superellipsoid(b, {
      radii: [345, 345, 96],
      around: 0.85,
      along: 0.55,
      segments: 160,
      shape: ([x, y, z]) => {
        const r = Math.hypot(x, y) / 345;
        const dent = z > 0 ? 26 * Math.exp(-((r / 0.55) ** 2)) : 0;
        const piping = z > 0 ? 5 * Math.exp(-(((r - 0.965) / 0.02) ** 2)) : 0;
        return [x, y - 22, z + 372 - dent + piping + 3 * noise(x / 130, y / 130, z / 130)];
      },
    }),
  );
  stage.add('Base', green, (b) =>
    superellipsoid(b, {
      radii: [372, 366, 90],
      around: 0.92,
      along: 0.35,
      segments: 120,
      shape: ([x, y, z]) => [x, y - 4, z + 228],
    }),
  );
  const brass = metal('brass brushed', BRASS, 0.24);
  for (const [i, [x, y]] of (
    [
      [-230, -200],
      [230, -200],
      [-230, 220],
      [230, 220],
    ] as const
  ).entries())
    stage.add(`Leg ${i + 1}`, brass, (b) => {
      tube(b, (t) => [x * (1 + 0.14 * t), y * (1 + 0.14 * t), 150 - 142 * t], 13, 2, 40);
      lathe(
        b,
        [
          [0, 0],
          [1, 0],
          [1, 1],
          [0, 1],
        ],
        8,
      );
    });
  stage.variants(green, {
    emerald: green,
    petrol: velvet('velvet petrol', [0.008, 0.05, 0.11], [0.45, 0.75, 1]),
    blush: velvet('velvet blush', [0.42, 0.13, 0.12], [1, 0.8, 0.76]),
    saffron: velvet('velvet saffron', [0.5, 0.17, 0.01], [1, 0.85, 0.5]),
  });
  stage.sweep(matte('wall', [0.62, 0.57, 0.5]), { front: 3500, back: 1300, radius: 500, height: 3200, width: 9000 });
  stage.softbox({
    name: 'Window',
    at: [-1900, 1500, 900],
    to: [0, 400, 0],
    width: 1500,
    height: 1800,
    radiance: 7.5,
    color: [1, 0.97, 0.92],
  });
  stage.softbox({ name: 'Rim', at: [1500, 1300, -700], to: [0, 450, 0], width: 500, height: 1300, radiance: 7 });
  stage.softbox({ name: 'Ceiling', at: [0, 2900, 300], width: 2400, height: 1800, radiance: 0.9 });
  stage.camera('Three quarters', { direction: [-0.45, 0.3, 1], margin: 0.14, focalLength: 85 });
  stage.camera('Detail', {
    eye: [-900, 900, 1250],
    target: [60, 520, -80],
    focalLength: 85,
    lensRadius: 12,
    focus: [-40, 450, 250],
  });
  return stage.scene;
}
