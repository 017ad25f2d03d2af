import { createScene, type Mesh, type MeshRig, type MorphTarget, type Scene } from '@glanz/scene';
import { createRig, type Pose } from '@glanz/scene/pose';
import { fromRotation, fromTranslation, multiply } from 'gl-matrix/esm/mat4.js';

/** Joints of the character's spine. */
export const JOINTS = 32;
/** Joints that move a vertex. */
const INFLUENCES = 4;
const HEIGHT = 2;
const RADIUS = 0.12;

type Matrix = number[];
const identity = (): Matrix => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** What poses of the character follow from. */
export interface Character {
  readonly rig: MeshRig;
  readonly scene: Scene;
  /** The pose of a frame; frames that follow each other are a thirtieth of a second apart. */
  pose(frame: number): Pose;
}

/** A smooth tube with normals and tangents, bent by a chain of joints, four of which move each vertex. */
function tube(triangles: number): {
  readonly mesh: Mesh;
  readonly joints: Uint16Array<ArrayBuffer>;
  readonly weights: Float32Array<ArrayBuffer>;
} {
  const columns = Math.max(8, Math.round(Math.sqrt(triangles / 2 / 4)));
  const rows = Math.max(JOINTS, Math.round(triangles / 2 / columns));
  const vertices = (rows + 1) * (columns + 1);
  const positions = new Float32Array(3 * vertices);
  const normals = new Float32Array(3 * vertices);
  const tangents = new Float32Array(4 * vertices);
  const joints = new Uint16Array(INFLUENCES * vertices);
  const weights = new Float32Array(INFLUENCES * vertices);
  const indices = new Uint32Array(6 * rows * columns);
  let corner = 0;
  for (let row = 0, v = 0; row <= rows; row++) {
    const along = (row / rows) * (JOINTS - 1);
    const first = Math.min(Math.max(Math.floor(along) - 1, 0), JOINTS - INFLUENCES);
    const shares = Array.from({ length: INFLUENCES }, (_, k) => Math.exp(-((along - first - k) ** 2)));
    const sum = shares.reduce((a, b) => a + b, 0);
    for (let column = 0; column <= columns; column++, v++) {
      const angle = (2 * Math.PI * column) / columns;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      positions.set([RADIUS * c, (HEIGHT * row) / rows, RADIUS * s], 3 * v);
      normals.set([c, 0, s], 3 * v);
      tangents.set([-s, 0, c, 1], 4 * v);
      shares.forEach((share, k) => {
        joints[INFLUENCES * v + k] = first + k;
        weights[INFLUENCES * v + k] = share / sum;
      });
      if (row === rows || column === columns) continue;
      const above = v + columns + 1;
      indices.set([v, above, v + 1, v + 1, above, above + 1], corner);
      corner += 6;
    }
  }
  return { mesh: { name: 'character', positions, indices, normals, tangents }, joints, weights };
}

/** Rings that swell, one for each target. */
function swellings({ positions, normals }: Mesh, count: number): MorphTarget[] {
  return Array.from({ length: count }, (_, target) => {
    const moved = new Float32Array(positions.length);
    for (let at = 0; at < moved.length; at += 3) {
      const from = (positions[at + 1] as number) - (HEIGHT * (target + 0.5)) / count;
      const by = 0.5 * RADIUS * Math.exp(-40 * from * from);
      for (let k = 0; k < 3; k++) moved[at + k] = by * ((normals as Float32Array)[at + k] as number);
    }
    return { positions: moved };
  });
}

/** Makes a character of about so many triangles on a floor. */
export function makeCharacter(triangles: number, targets: number): Character {
  const { mesh, joints, weights } = tube(triangles);
  const rig = createRig(mesh, { skin: { jointCount: JOINTS, joints, weights }, targets: swellings(mesh, targets) });
  const scene = createScene('skin');
  const floor = Float32Array.of(-4, 0, -4, 4, 0, -4, 4, 0, 4, -4, 0, 4);
  scene.meshes.push(mesh, { name: 'floor', positions: floor, indices: Uint32Array.of(0, 2, 1, 0, 3, 2) });
  scene.materials.push({ name: 'skin', parameters: { base_color: [0.7, 0.45, 0.35], specular_roughness: 0.4 } });
  for (const [index, name] of ['character', 'floor'].entries())
    scene.instances.push({ name, mesh: index, material: 0, transform: identity() });
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  const pose = (frame: number): Pose => {
    const time = frame / 30;
    const matrices: number[] = [];
    let world = identity();
    for (let j = 0; j < JOINTS; j++) {
      const y = (HEIGHT * j) / (JOINTS - 1);
      const turned = identity();
      const bend = fromRotation(identity(), 0.06 * Math.sin(2 * time + 0.2 * j), [Math.sin(time), 0, Math.cos(time)]);
      multiply(turned, fromTranslation(identity(), [0, y, 0]), bend as Matrix);
      multiply(turned, turned, fromTranslation(identity(), [0, -y, 0]));
      world = multiply(identity(), world, turned) as Matrix;
      matrices.push(...world);
    }
    return { joints: matrices, weights: Array.from({ length: targets }, (_, i) => 0.5 + 0.5 * Math.sin(3 * time + i)) };
  };
  return { rig, scene, pose };
}
