import type { Scene } from '@glanz/scene';
import { roundedBox } from './shapes/boxes';
import { lathe, type ProfilePoint } from './shapes/lathe';
import type { MeshBuilder } from './shapes/mesh-builder';
import { sphere } from './shapes/surface';
import { coated, glass, matte, plastic } from './stage/materials';
import { at, Stage } from './stage/stage';

const FOOT: readonly ProfilePoint[] = [
  [0, 0],
  [15, 0, 1],
  [15, 4, 1.6],
  [12.4, 6.5, 1],
  [13, 8.5, 0.9],
  [11.6, 11, 2],
];

/** Profiles of the pieces, millimetres, without what stands on top of them. */
const PIECES: Readonly<Record<string, (b: MeshBuilder) => void>> = {
  pawn: (b) => {
    lathe(b, [...FOOT, [7.2, 18, 8], [5, 33, 6], [9.4, 34.5, 0.7], [9.4, 36.4, 0.7], [5, 38], [0, 38]]);
    sphere(b, [0, 0, 44.5], 8.6, 64);
  },
  bishop: (b) => {
    lathe(b, [
      ...FOOT,
      [7.6, 20, 10],
      [5.6, 46, 8],
      [10.2, 48, 0.7],
      [10.2, 50, 0.7],
      [6.4, 52, 1],
      [8.6, 59, 5],
      [6.2, 68, 6],
      [2.6, 72.4, 1],
      [0, 72.4],
    ]);
    sphere(b, [0, 0, 74.4], 3, 40);
  },
  queen: (b) => {
    lathe(b, [
      ...FOOT,
      [8.2, 22, 12],
      [6.2, 56, 9],
      [11.4, 58.5, 0.8],
      [11.4, 61, 0.8],
      [7.6, 63, 1],
      [11.6, 79, 2],
      [9.6, 79.6, 0.6],
      [7, 76, 2],
      [5, 82, 2],
      [0, 83.6],
    ]);
    sphere(b, [0, 0, 85.4], 3.4, 40);
    for (let i = 0; i < 9; i++)
      sphere(b, [10.4 * Math.cos((i * 2 * Math.PI) / 9), 10.4 * Math.sin((i * 2 * Math.PI) / 9), 79.8], 1.9, 28);
  },
  king: (b) => {
    lathe(b, [
      ...FOOT,
      [8.6, 23, 12],
      [6.6, 61, 9],
      [12, 63.5, 0.8],
      [12, 66, 0.8],
      [8, 68, 1],
      [11, 85, 1.4],
      [6.4, 88, 2],
      [3, 89.4, 0.8],
      [0, 89.4],
    ]);
    roundedBox(b, { at: [0, 0, 88.4], size: [3.6, 3.4, 13], corner: 1, edge: 0.8 });
    roundedBox(b, { at: [0, 0, 93.4], size: [10.4, 3.3, 3.6], corner: 1, edge: 0.8 });
  },
  rook: (b) => {
    lathe(b, [
      ...FOOT,
      [8.6, 19, 9],
      [7.6, 38, 9],
      [11.6, 41, 1],
      [11.6, 52, 0.8],
      [8.6, 52, 0.6],
      [8.6, 47, 0.6],
      [0, 47],
    ]);
  },
};

/** A chess set in clear glass and in black, on a lacquered board. */
export function createChess(): Scene {
  const stage = new Stage('Chess');
  const clear = glass('clear glass', { color: [0.93, 0.975, 0.96], depth: 0.05 });
  const black = coated(plastic('black', [0.012, 0.012, 0.014], 0.35), 0.02);
  const frosted = glass('frosted glass', { color: [0.9, 0.96, 1], depth: 0.05, roughness: 0.32 });
  const meshes = new Map<string, number>();
  const SQUARE = 42;
  const put = (piece: string, file: number, rank: number, material: typeof clear) => {
    const place = at((file - 3.5) * SQUARE, 0, (3.5 - rank) * SQUARE);
    const name = `${material.name} ${piece} ${'abcdefgh'[file]}${rank + 1}`;
    const mesh = meshes.get(piece);
    if (mesh === undefined) meshes.set(piece, stage.add(name, material, PIECES[piece]!, place));
    else stage.place(name, material, mesh, place);
  };
  for (const [piece, file, rank] of [
    ['king', 3, 2],
    ['queen', 4, 3],
    ['pawn', 2, 1],
    ['pawn', 5, 2],
    ['bishop', 1, 3],
    ['rook', 6, 1],
    ['pawn', 6, 3],
  ] as const)
    put(piece, file, rank, clear);
  for (const [piece, file, rank] of [
    ['king', 4, 6],
    ['queen', 2, 5],
    ['pawn', 3, 4],
    ['pawn', 5, 5],
    ['bishop', 6, 5],
    ['pawn', 1, 6],
    ['rook', 0, 5],
  ] as const)
    put(piece, file, rank, black);
  const light = coated(plastic('board light', [0.55, 0.4, 0.25], 0.4), 0.12);
  const dark = coated(plastic('board dark', [0.055, 0.024, 0.012], 0.4), 0.12);
  let square: number | undefined;
  for (let i = 0; i < 64; i++) {
    const [file, rank] = [i % 8, Math.floor(i / 8)];
    const place = at((file - 3.5) * SQUARE, -8, (3.5 - rank) * SQUARE);
    const material = (file + rank) % 2 ? light : dark;
    const name = `Square ${'abcdefgh'[file]}${rank + 1}`;
    if (square === undefined)
      square = stage.add(
        name,
        material,
        (b) => roundedBox(b, { size: [SQUARE - 0.3, SQUARE - 0.3, 8], corner: 0.5, edge: 0.4 }),
        place,
      );
    else stage.place(name, material, square, place);
  }
  stage.add('Frame', coated(plastic('frame', [0.03, 0.014, 0.008], 0.4), 0.1), (b) =>
    roundedBox(b, { at: [0, 0, -20], size: [SQUARE * 8 + 44, SQUARE * 8 + 44, 14], corner: 4, edge: 3 }),
  );
  stage.variants(clear, { clear, frosted });
  stage.sweep(matte('backdrop', [0.5, 0.5, 0.52]), {
    front: 1200,
    back: 900,
    radius: 500,
    height: 1400,
    width: 4000,
    y: -20,
  });
  stage.softbox({
    name: 'Behind',
    at: [-120, 460, -620],
    to: [0, 20, 0],
    width: 700,
    height: 300,
    radiance: 8,
    gradient: 8,
  });
  stage.softbox({
    name: 'Left',
    at: [-560, 330, 120],
    to: [0, 30, 0],
    width: 260,
    height: 420,
    radiance: 5,
    gradient: 6,
    color: [1, 0.95, 0.88],
  });
  stage.softbox({
    name: 'Right',
    at: [560, 240, 60],
    to: [0, 40, 0],
    width: 120,
    height: 400,
    radiance: 4,
    gradient: 5,
  });
  stage.camera('Low', {
    eye: [-70, 130, 430],
    target: [4, 38, 10],
    focalLength: 62,
    lensRadius: 3.2,
    focus: [-21, 50, 63],
  });
  return stage.scene;
}
