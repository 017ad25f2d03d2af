import type { Mesh, Scene } from '@glanz/scene';
import { roundedBox } from './shapes/boxes';
import { extrude } from './shapes/extrude';
import { FINE, lathe, latheRing } from './shapes/lathe';
import type { MeshBuilder } from './shapes/mesh-builder';
import { noise } from './shapes/noise';
import { closedOutline } from './shapes/outline';
import { surface } from './shapes/surface';
import { tube } from './shapes/tube';
import { glass, matte, metal, plastic, STEEL } from './stage/materials';
import { at, Stage } from './stage/stage';
import { rotation, type Matrix } from './stage/transform';

/**
 * Gives a mesh the tangents of a metal brushed around its z axis, or outwards from it: they lie across the scratches, as
 * that is where the surface is rougher.
 */
export function brush(mesh: Mesh, direction: 'around' | 'outwards'): void {
  const { positions: p, normals: n } = mesh;
  const tangents = new Float32Array((p.length / 3) * 4);
  for (let i = 0, t = 0; i < p.length; i += 3, t += 4) {
    const r = Math.hypot(p[i]!, p[i + 1]!) || 1;
    const [c, s] = r < 1e-9 ? [1, 0] : [p[i]! / r, p[i + 1]! / r];
    const v = direction === 'around' ? [c, s, 0] : [-s, c, 0];
    const d = v[0]! * n![i]! + v[1]! * n![i + 1]!;
    const along = v.map((x, k) => x - d * n![i + k]!);
    const length = Math.hypot(...along);
    const ok = length > 1e-6;
    for (let k = 0; k < 3; k++) tangents[t + k] = ok ? along[k]! / length : k === 0 ? 1 : 0;
    tangents[t + 3] = 1;
  }
  mesh.tangents = tangents;
}

/** A bar with a roof of rounded edges, from radius `from` to `to` at an angle (0 is 12 o'clock, clockwise). */
function bar(
  b: MeshBuilder,
  angle: number,
  from: number,
  to: number,
  width: number,
  z: number,
  height: number,
  tip = width,
): void {
  const first = b.vertexCount;
  extrude(
    b,
    closedOutline(
      [
        { x: -width / 2, y: from },
        { x: width / 2, y: from },
        { x: tip / 2, y: to },
        { x: -tip / 2, y: to },
      ],
      FINE,
    ),
    [],
    {
      bottom: z,
      top: z + height,
      topRadius: Math.min(height * 0.45, tip * 0.3),
      tessellation: { deviation: 0.01, angle: 0.4 },
    },
  );
  const [c, s] = [Math.cos(-angle), Math.sin(-angle)];
  b.transformFrom(first, (x, y, zz) => [c * x - s * y, s * x + c * y, zz]);
}

const CASE = 20;
const DIAL = 16.6;
const THICKNESS = 9.4;

/** One half of the strap, from the lugs (t = 0) around a wrist to below (t = 1). `side` 1: 12 o'clock. */
function strap(side: 1 | -1): (u: number, v: number) => readonly [number, number, number] {
  return (u, v) => {
    const t = Math.min(Math.max(v, 0), 1);
    const end = Math.min(1, Math.sqrt(Math.max(1 - ((t - 0.5) / 0.5) ** 40, 0)));
    const angle = (51 + 131 * t) * (Math.PI / 180);
    const [ry, rz] = [27.5, 24];
    const [cy, cz] = [0, -20.6];
    const half = (9.9 - 1.6 * t) * end;
    const thick = (2.4 - 1.1 * Math.min(3 * t, 1) + 0.35 * Math.exp(-((t / 0.12) ** 2))) * end;
    const phi = 2 * Math.PI * u;
    const round = (x: number, e: number) => Math.sign(x) * Math.abs(x) ** e;
    const x = half * round(Math.cos(phi), 0.25);
    const outwards = thick * round(Math.sin(phi), 0.6);
    // Grain of the leather.
    const grain = 0.09 * noise(x * 1.5, angle * 38, 3) + 0.05 * noise(x * 3.7, angle * 97, 9);
    const r = outwards + end * grain * Math.max(Math.sin(phi), 0);
    return [x, side * (cy + (ry + r) * Math.sin(angle)), cz + (rz + r) * Math.cos(angle)];
  };
}

function stitches(b: MeshBuilder, side: 1 | -1): void {
  const f = strap(side);
  for (const column of [-1, 1])
    for (let i = 3; i < 34; i++) {
      const point = (t: number): [number, number, number] => {
        const u = column > 0 ? 0.085 : 0.415;
        const p = f(u, t);
        const q = f(u, t + 1e-3);
        const n = [0, q[2] - p[2], p[1] - q[1]].map((x) => (x * side) / Math.hypot(q[2] - p[2], q[1] - p[1]));
        return [p[0] * 0.93, p[1] - n[1]! * 0.12, p[2] - n[2]! * 0.12];
      };
      tube(b, (k) => point((i + 0.12 + 0.66 * k) / 46), 0.26, 4, 8);
    }
}

/** A wristwatch: brushed steel, a sunray dial under a domed crystal, a stitched leather strap. */
export function createWatch(): Scene {
  const stage = new Stage('Watch');
  const pose: Matrix[] = [at(0, 34, 0), rotation('y', -16), rotation('x', 64)];
  const part = (
    name: string,
    material: Parameters<Stage['add']>[1],
    shape: (b: MeshBuilder) => void,
    brushed?: 'around' | 'outwards',
  ) => {
    const mesh = stage.add(name, material, shape, ...pose);
    if (brushed) brush(stage.scene.meshes[mesh]!, brushed);
  };
  const polished = metal('steel polished', STEEL, 0.05);
  const brushed = metal('steel brushed', STEEL, 0.34, { specular_roughness_anisotropy: 0.8 });
  part(
    'Case',
    brushed,
    (b) => {
      latheRing(
        b,
        [
          [16, -THICKNESS + 1],
          [17.8, -THICKNESS, 0.5],
          [CASE, -THICKNESS + 2.6, 1],
          [CASE, -2.2, 0.5],
          [18.2, -1.2, 0.4],
          [16, -1.2],
        ],
        160,
      );
    },
    'around',
  );
  part('Case back', polished, (b) =>
    lathe(
      b,
      [
        [0, -THICKNESS],
        [17, -THICKNESS, 0.4],
        [17, -THICKNESS + 2],
        [0, -THICKNESS + 2],
      ],
      96,
    ),
  );
  part('Bezel', polished, (b) =>
    latheRing(
      b,
      [
        [17.1, -1.8],
        [19.3, -1.8, 0.3],
        [18.9, 0.2, 0.8],
        [17.5, 0.9, 0.35],
        [17.1, 0.6],
      ],
      200,
    ),
  );
  part('Lugs', brushed, (b) => {
    for (const sx of [-1, 1])
      for (const sy of [-1, 1])
        surface(
          b,
          (u, v) => {
            const t = Math.min(Math.max(v, 0), 1);
            const end = Math.sqrt(Math.max(1 - Math.abs(2 * t - 1) ** 10, 0));
            const phi = 2 * Math.PI * u;
            const round = (x: number, e: number) => Math.sign(x) * Math.abs(x) ** e;
            const y = 10.5 + 13.2 * t;
            return [
              sx * (11.6 - 0.2 * t) + 1.55 * end * round(Math.cos(phi), 0.35),
              sy * y * 1.0,
              -4.6 - 0.2 * (t * 3.2) ** 2 + (2.5 - 0.7 * t) * end * round(Math.sin(phi), 0.4),
            ];
          },
          { nu: 48, nv: 60, closeU: true, flip: sy > 0 },
        );
  });
  part('Crown', polished, (b) => {
    const first = b.vertexCount;
    surface(
      b,
      (u, v) => {
        const a = 2 * Math.PI * u;
        const t = Math.min(Math.max(v, 0), 1);
        const e = Math.sqrt(Math.max(1 - Math.abs(2 * t - 1) ** 8, 0));
        const r = 3.1 * e * (1 + 0.035 * Math.sign(Math.cos(30 * a)) * Math.abs(Math.cos(30 * a)) ** 0.5);
        return [r * Math.cos(a), r * Math.sin(a), 19.6 + 4 * t];
      },
      { nu: 360, nv: 24, closeU: true },
    );
    b.transformFrom(first, (x, y, z, w) => [z, y, -x - 5 * w]);
  });
  const dial = metal('dial blue', [0.02, 0.07, 0.2], 0.36, { specular_roughness_anisotropy: 0.75 });
  part(
    'Dial',
    dial,
    (b) =>
      lathe(
        b,
        [
          [0, -3],
          [DIAL, -3],
          [DIAL, -2.7],
          [0, -2.7],
        ],
        160,
      ),
    'outwards',
  );
  part('Flange', plastic('flange', [0.012, 0.02, 0.045], 0.4), (b) =>
    latheRing(
      b,
      [
        [15.3, -2.75],
        [17.2, -2.75],
        [17.2, -0.6],
        [16.9, -0.6],
      ],
      160,
    ),
  );
  const marker = metal('markers', [0.9, 0.9, 0.92], 0.08);
  part('Indices', marker, (b) => {
    for (let i = 0; i < 12; i++) {
      const a = (i * Math.PI) / 6;
      if (i === 0) for (const d of [-0.055, 0.055]) bar(b, a + d, 10.6, 14.2, 1.1, -2.75, 0.75);
      else bar(b, a, i % 3 === 0 ? 10.6 : 11.4, 14.2, 1.15, -2.75, 0.75);
    }
  });
  part('Minutes', matte('print white', [0.85, 0.85, 0.85]), (b) => {
    for (let i = 0; i < 60; i++) if (i % 5 !== 0) bar(b, (i * Math.PI) / 30, 13.7, 14.5, 0.16, -2.72, 0.06);
  });
  const [hour, minute, second] = [(10 + 9 / 60) * 30, 9 * 6, 36 * 6].map((d) => (d * Math.PI) / 180) as [
    number,
    number,
    number,
  ];
  part('Hour and minute', marker, (b) => {
    bar(b, hour, -2.6, 8.8, 1.5, -1.9, 0.42, 0.75);
    bar(b, minute, -2.9, 13.2, 1.25, -1.35, 0.38, 0.55);
    lathe(
      b,
      [
        [0, -2.8],
        [1.25, -2.8],
        [1.25, -0.6, 0.2],
        [0, -0.6],
      ],
      48,
    );
  });
  part('Second hand', plastic('orange', [0.85, 0.16, 0.01], 0.3), (b) => {
    bar(b, second, -4.5, 14, 0.34, -0.75, 0.2, 0.2);
    lathe(
      b,
      [
        [0, -0.85],
        [0.75, -0.85],
        [0.75, -0.35, 0.15],
        [0, -0.35],
      ],
      32,
    );
  });
  const dateWindow = plastic('date', [0.8, 0.8, 0.78], 0.4);
  part('Date', dateWindow, (b) =>
    roundedBox(b, { at: [9.2, 0, -2.75], size: [2.2, 1.8, 0.12], corner: 0.2, edge: 0.04 }),
  );
  part('Crystal', glass('crystal, coated', { ior: 1.22, extra: { geometry_thin_walled: true } }), (b) =>
    lathe(
      b,
      [
        [0, -0.4],
        [17.15, -0.4],
        [17.15, 0.75, 0.25],
        [14, 1.05, 8],
        [0, 1.25],
      ],
      160,
    ),
  );
  const leather = plastic('leather brown', [0.17, 0.062, 0.024], 0.48);
  const thread = matte('thread', [0.62, 0.5, 0.36]);
  for (const side of [1, -1] as const) {
    const name = side > 0 ? 'Strap upper' : 'Strap lower';
    part(name, leather, (b) => surface(b, strap(side), { nu: 120, nv: 260, closeU: true, flip: side < 0 }));
    part(`${name} stitches`, thread, (b) => stitches(b, side));
  }
  stage.rest();
  stage.variants(dial, {
    blue: dial,
    black: metal('dial black', [0.014, 0.014, 0.015], 0.34, { specular_roughness_anisotropy: 0.75 }),
    salmon: metal('dial salmon', [0.85, 0.42, 0.27], 0.36, { specular_roughness_anisotropy: 0.75 }),
  });
  stage.variants(leather, {
    blue: leather,
    black: plastic('leather black', [0.014, 0.013, 0.013], 0.46),
    salmon: plastic('leather grey', [0.13, 0.125, 0.12], 0.5),
  });
  stage.sweep(matte('backdrop', [0.34, 0.36, 0.39]), { front: 500, back: 260, radius: 200, height: 700, width: 1600 });
  stage.softbox({
    name: 'Key',
    at: [-215, 225, 112],
    to: [0, 34, 0],
    width: 260,
    height: 220,
    radiance: 3.4,
    gradient: 10,
  });
  stage.softbox({
    name: 'Strip',
    at: [220, 120, 60],
    to: [0, 34, 0],
    width: 50,
    height: 260,
    radiance: 8,
    gradient: 6,
  });
  stage.softbox({
    name: 'Top',
    at: [20, 300, -120],
    to: [0, 34, 0],
    width: 260,
    height: 120,
    radiance: 5,
    gradient: 6,
  });
  stage.camera('Front', {
    direction: [0.12, 0.34, 1],
    margin: 0.06,
    focalLength: 95,
    lensRadius: 1.1,
    focus: [0, 40, 20],
  });
  stage.camera('Dial', {
    direction: [-0.25, 0.55, 1],
    around: 'Bezel',
    margin: -0,
    focalLength: 95,
    lensRadius: 0.7,
    focus: [0, 40, 14],
  });
  return stage.scene;
}
