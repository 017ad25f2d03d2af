import type { Mesh, Scene } from '@glanz/scene';
import { brush } from './watch';
import { roundedBox } from './shapes/boxes';
import { lathe } from './shapes/lathe';
import type { MeshBuilder } from './shapes/mesh-builder';
import { ALUMINIUM, coated, emitter, glass, matte, metal, plastic } from './stage/materials';
import { at, Stage } from './stage/stage';
import { rotation, type Matrix } from './stage/transform';

/** The tangents of a metal brushed from left to right, along x: across the scratches, where the surface is rougher. */
function brushAlong(mesh: Mesh): void {
  const { normals: n } = mesh;
  const tangents = new Float32Array((n!.length / 3) * 4);
  for (let i = 0, t = 0; t < tangents.length; i += 3, t += 4) {
    const [x, y, z] = [n![i]!, n![i + 1]!, n![i + 2]!];
    const across = Math.abs(y) < 0.9 ? [-x * y, 1 - y * y, -z * y] : [-x * z, -y * z, 1 - z * z];
    const length = Math.hypot(...across);
    for (let k = 0; k < 3; k++) tangents[t + k] = across[k]! / length;
    tangents[t + 3] = 1;
  }
  mesh.tangents = tangents;
}

/** A hi-fi amplifier: a brushed front, turned knobs, two lit meters. */
export function createAmplifier(): Scene {
  const stage = new Stage('Amplifier');
  const [W, H] = [430, 132];
  const y0 = 14;
  const brushed = metal('aluminium brushed', ALUMINIUM, 0.36, { specular_roughness_anisotropy: 0.85 });
  // Parts of the front are built with z towards the user.
  const front: Matrix[] = [at(0, y0 + H / 2, 160), rotation('x', 90)];
  const add = (
    name: string,
    material: Parameters<Stage['add']>[1],
    shape: (b: MeshBuilder) => void,
    ...more: Matrix[]
  ) => stage.scene.meshes[stage.add(name, material, shape, ...front, ...more)]!;
  brushAlong(add('Front', brushed, (b) => roundedBox(b, { at: [0, 0, -9], size: [W, H, 9], corner: 3, edge: 1.1 })));
  stage.add('Case', metal('case', [0.06, 0.06, 0.065], 0.42), (b) =>
    roundedBox(b, { at: [0, 10, y0 + 2], size: [W - 10, 300, H - 6], corner: 5, edge: 2 }),
  );
  const turned = metal('aluminium turned', ALUMINIUM, 0.3, { specular_roughness_anisotropy: 0.8 });
  const rim = metal('rim polished', ALUMINIUM, 0.06);
  const knob = (name: string, x: number, y: number, r: number, height: number, angle: number) => {
    brush(
      add(
        `${name} face`,
        turned,
        (b) =>
          lathe(
            b,
            [
              [0, height - 2],
              [r - 1.2, height - 2],
              [r - 1.2, height, 0.3],
              [0, height - 0.6],
            ],
            160,
          ),
        at(x, 0, -y),
      ),
      'around',
    );
    add(
      `${name} side`,
      rim,
      (b) =>
        lathe(
          b,
          [
            [0, 0],
            [r + 1.6, 0, 0.5],
            [r + 1.6, 1.6, 0.5],
            [r, 2],
            [r, height + 0.2, 0.7],
            [r - 1.2, height + 0.2, 0.2],
            [r - 1.2, height - 1],
            [0, height - 1],
          ],
          160,
        ),
      at(x, 0, -y),
    );
    add(
      `${name} mark`,
      plastic('mark', [0.01, 0.01, 0.01], 0.4),
      (b) => roundedBox(b, { at: [0, r * 0.66, height - 0.5], size: [1.1, r * 0.42, 0.5], corner: 0.4, edge: 0.1 }),
      at(x, 0, -y),
      rotation('y', angle),
    );
  };
  knob('Volume', 118, 4, 33, 26, -40);
  for (const [i, x] of [-176, -134, -92, -50].entries()) knob(`Tone ${i + 1}`, x, -38, 10.5, 17, [-12, 30, 0, -50][i]!);
  for (const [i, x] of [-8, 18, 44].entries())
    add(`Button ${i + 1}`, rim, (b) => roundedBox(b, { at: [x, -38, 0], size: [17, 9, 5], corner: 2, edge: 0.7 }));
  add(
    'Lamp',
    emitter('pilot', 9, [1, 0.28, 0.06]),
    (b) =>
      lathe(
        b,
        [
          [0, 0],
          [2.1, 0],
          [2.1, 1.2, 0.6],
          [0, 1.2],
        ],
        32,
      ),
    at(186, 0, 44),
  );
  const glow = emitter('meter light', 0.75, [0.42, 0.75, 1]);
  const ink = matte('ink', [0.004, 0.006, 0.01]);
  for (const [i, x] of [-142, -38].entries()) {
    const name = i === 0 ? 'Left meter' : 'Right meter';
    const place = at(x, 0, -19);
    add(
      `${name} frame`,
      rim,
      (b) => {
        roundedBox(b, { at: [0, 0, -3], size: [94, 60, 5.4], corner: 4, edge: 0.8 });
      },
      place,
    );
    add(
      `${name} scale`,
      glow,
      (b) => roundedBox(b, { at: [0, 0, 2.3], size: [87, 53, 0.4], corner: 2.4, edge: 0.1 }),
      place,
    );
    add(
      `${name} print`,
      ink,
      (b) => {
        const stroke = (angle: number, from: number, to: number, width: number, z: number) => {
          const first = b.vertexCount;
          roundedBox(b, {
            at: [0, (from + to) / 2, z],
            size: [width, to - from, 0.3],
            corner: width * 0.2,
            edge: 0.05,
          });
          const [c, s] = [Math.cos(angle), Math.sin(angle)];
          b.transformFrom(first, (px, py, pz, w) => [c * px - s * py, s * px + c * py - w * 30, pz]);
        };
        for (let k = -10; k <= 10; k++) stroke(-k * 0.062, k % 5 === 0 ? 40 : 43, 48, k % 5 === 0 ? 1 : 0.5, 2.65);
        for (let k = -40; k < 40; k++) stroke(-(k + 0.5) * 0.0155, 38.2, 38.9, 0.8, 2.65);
        stroke(i === 0 ? 0.34 : 0.22, 6, 46, 0.7, 3.4);
      },
      place,
    );
    add(
      `${name} glass`,
      glass('meter glass', { extra: { geometry_thin_walled: true } }),
      (b) => roundedBox(b, { at: [0, 0, 4.2], size: [90, 56, 1.6], corner: 3, edge: 0.4 }),
      place,
    );
  }
  for (const [i, x] of [-170, 170].entries())
    stage.add(
      `Foot ${i + 1}`,
      plastic('foot', [0.015, 0.015, 0.016], 0.4),
      (b) =>
        lathe(
          b,
          [
            [0, 0],
            [18, 0, 2],
            [20, y0 + 3, 1],
            [0, y0 + 3],
          ],
          64,
        ),
      at(x, 0, 110),
    );
  stage.sweep(coated(plastic('sideboard', [0.14, 0.062, 0.03], 0.45), 0.16), {
    front: 1200,
    back: 700,
    radius: 200,
    height: 1300,
    width: 3600,
  });
  stage.softbox({
    name: 'Window',
    at: [-1250, 700, 620],
    to: [0, 80, 160],
    width: 900,
    height: 620,
    radiance: 3.4,
    gradient: 8,
    color: [1, 0.96, 0.9],
  });
  stage.softbox({
    name: 'Fill',
    at: [460, 470, 1250],
    to: [0, 80, 160],
    width: 1100,
    height: 420,
    radiance: 1.8,
    gradient: 8,
  });
  stage.softbox({
    name: 'Above',
    at: [120, 860, 60],
    to: [0, 60, 100],
    width: 1100,
    height: 420,
    radiance: 3,
    gradient: 6,
  });
  stage.softbox({
    name: 'Right',
    at: [860, 260, 480],
    to: [0, 80, 100],
    width: 160,
    height: 500,
    radiance: 4,
    gradient: 5,
  });
  stage.camera('Front', {
    direction: [-0.34, 0.1, 1],
    around: 'Front',
    margin: 0.16,
    focalLength: 80,
    lensRadius: 3,
    focus: [-20, 80, 165],
  });
  stage.camera('Knob', {
    eye: [-20, 96, 470],
    target: [92, 80, 165],
    focalLength: 80,
    lensRadius: 3,
    focus: [118, 84, 188],
  });
  return stage.scene;
}
