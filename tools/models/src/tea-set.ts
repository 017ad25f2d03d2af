import type { Scene } from '@glanz/scene';
import { lathe, smoothProfile, type ProfilePoint } from './shapes/lathe';
import type { MeshBuilder } from './shapes/mesh-builder';
import { noise } from './shapes/noise';
import { surface } from './shapes/surface';
import { spline, tube } from './shapes/tube';
import { coated, glass, matte } from './stage/materials';
import { at, Stage } from './stage/stage';
import { rotation } from './stage/transform';

/** A thrown pot: a smooth profile with the faint rings that fingers leave. */
function thrown(
  b: MeshBuilder,
  outside: readonly (readonly [number, number])[],
  inside: readonly (readonly [number, number])[],
  rings = 0.16,
): void {
  const first = b.vertexCount;
  const points: ProfilePoint[] = [...smoothProfile(outside, 14), ...smoothProfile(inside, 12)];
  lathe(b, points, 128, { deviation: 0.05, angle: 0.3 });
  b.transformFrom(first, (x, y, z, w) => {
    const r = Math.hypot(x, y);
    if (w === 0 || r < 1e-6) return [x, y, z];
    const wobble =
      1 +
      (rings * Math.sin(z * 1.35 + 0.6 * Math.atan2(y, x)) * Math.min(r / 20, 1)) / r +
      0.006 * noise(x / 30, y / 30, z / 30);
    return [x * wobble, y * wobble, z];
  });
}

/** A teapot, two bowls and a vase of glazed stoneware. */
export function createTeaSet(): Scene {
  const stage = new Stage('Tea set');
  const glaze = (name: string, color: readonly [number, number, number], roughness = 0.08) =>
    coated(matte(name, color, { specular_weight: 1, specular_roughness: 0.5 }), roughness);
  const celadon = glaze('glaze celadon', [0.36, 0.52, 0.44]);
  const cobalt = glaze('glaze cobalt', [0.018, 0.06, 0.25]);
  const white = glaze('glaze white', [0.76, 0.73, 0.67], 0.14);
  const clay = matte('raw clay', [0.33, 0.17, 0.1], { specular_weight: 0.3 });
  stage.add(
    'Teapot',
    celadon,
    (b) =>
      thrown(
        b,
        [
          [0, 0],
          [34, 0],
          [38, 3],
          [60, 30],
          [62, 52],
          [44, 80],
          [27, 88],
          [26, 91],
        ],
        [
          [24, 91],
          [24, 86],
          [20, 82],
          [0, 82],
        ],
      ),
    at(-30, 0, -6),
  );
  stage.add(
    'Lid',
    celadon,
    (b) => {
      lathe(
        b,
        smoothProfile(
          [
            [0, 86],
            [24, 88],
            [27, 91],
            [22, 95],
            [12, 98],
            [6, 100],
            [5, 104],
            [9, 110],
            [7, 114],
            [0, 115],
          ],
          10,
        ),
        128,
        { deviation: 0.05, angle: 0.3 },
      );
    },
    at(-30, 0, -6),
  );
  stage.add(
    'Spout',
    celadon,
    (b) => {
      const curve = spline([
        [54, 0, 36],
        [72, 0, 48],
        [80, 0, 66],
        [92, 0, 82],
      ]);
      surface(
        b,
        (u, v) => {
          const t = Math.min(Math.max(v, 0), 1);
          const a = 2 * Math.PI * u;
          const [p, q] = [curve(t), curve(Math.min(t + 1e-3, 1))];
          const p0 = t > 0.99 ? curve(t - 1e-3) : p;
          const d = Math.hypot(q[0] - p0[0], q[2] - p0[2]);
          const [nx, nz] = [-(q[2] - p0[2]) / d, (q[0] - p0[0]) / d];
          const r = (13.5 - 8 * t) * Math.sqrt(Math.max(1 - Math.abs(2 * t - 1) ** 30, 0));
          return [p[0] + r * Math.cos(a) * nx, r * Math.sin(a), p[2] + r * Math.cos(a) * nz];
        },
        { nu: 48, nv: 90, closeU: true },
      );
    },
    at(-30, 0, -6),
    rotation('y', -18),
  );
  stage.add(
    'Handle',
    matte('bamboo', [0.42, 0.25, 0.1], { specular_weight: 0.7, specular_roughness: 0.45 }),
    (b) =>
      tube(
        b,
        spline([
          [-42, 0, 76],
          [-46, 0, 100],
          [-34, 0, 134],
          [0, 0, 150],
          [34, 0, 134],
          [46, 0, 100],
          [42, 0, 76],
        ]),
        3.6,
        90,
        28,
      ),
    at(-30, 0, -6),
    rotation('y', -18),
  );
  const bowl = (name: string, material: typeof clay, x: number, z: number, scale: number) => {
    stage.add(
      name,
      material,
      (b) => {
        thrown(
          b,
          [
            [0, 0],
            [14, 0],
            [15, 5],
            [24, 10],
            [35, 26],
            [38, 44],
          ].map(([r, y]) => [r! * scale, y! * scale] as const),
          [
            [36, 44],
            [33, 26],
            [21, 12],
            [0, 9],
          ].map(([r, y]) => [r! * scale, y! * scale] as const),
        );
      },
      at(x, 0, z),
    );
    stage.add(
      `${name} tea`,
      glass(`tea`, { color: [0.62, 0.32, 0.06], depth: 0.014, ior: 1.34 }),
      (b) =>
        lathe(
          b,
          [
            [0, 8.6 * scale],
            [21.4 * scale, 11.4 * scale],
            [35.2 * scale, 33 * scale],
            [0, 33 * scale],
          ],
          96,
        ),
      at(x, 0, z),
    );
  };
  bowl('Bowl', white, 54, 38, 0.86);
  bowl('Second bowl', cobalt, -12, 78, 0.8);
  stage.add(
    'Vase',
    cobalt,
    (b) =>
      thrown(
        b,
        [
          [0, 0],
          [26, 0],
          [36, 30],
          [42, 80],
          [28, 128],
          [12, 152],
          [11, 176],
          [18, 188],
        ],
        [
          [16, 188],
          [9, 176],
          [10, 150],
          [0, 130],
        ],
      ),
    at(84, 0, -60),
  );
  stage.add(
    'Plate',
    clay,
    (b) =>
      thrown(
        b,
        [
          [0, -0.5],
          [60, 0],
          [76, 5],
        ],
        [
          [75, 7],
          [58, 3],
          [0, 2.4],
        ],
      ),
    at(54, -2.4, 38),
  );
  stage.variants(celadon, {
    celadon,
    tenmoku: glaze('glaze tenmoku', [0.045, 0.018, 0.01]),
    rose: glaze('glaze rose', [0.62, 0.3, 0.27]),
  });
  stage.sweep(matte('linen', [0.56, 0.52, 0.46]), {
    front: 900,
    back: 460,
    radius: 340,
    height: 1100,
    width: 2600,
    y: -3.2,
  });
  stage.softbox({
    name: 'Window',
    at: [-380, 330, 120],
    to: [0, 60, 0],
    width: 300,
    height: 380,
    radiance: 6,
    gradient: 8,
    color: [1, 0.97, 0.93],
  });
  stage.softbox({
    name: 'Right',
    at: [430, 200, 120],
    to: [0, 60, 0],
    width: 90,
    height: 340,
    radiance: 2.6,
    gradient: 5,
  });
  stage.softbox({ name: 'Behind', at: [120, 420, -260], to: [0, 50, 0], width: 300, height: 160, radiance: 3.4 });
  stage.camera('Front', {
    direction: [0.08, 0.32, 1],
    margin: 0.12,
    focalLength: 80,
    lensRadius: 2.2,
    focus: [-20, 60, 60],
  });
  return stage.scene;
}
