import type { TriangleMesh } from '@glanz/bvh';
import { createPushButton } from '@glanz/models';

/** What the page about hierarchies can look into. */
export const HIERARCHY_MODELS = {
  'push-button': 'Push-button',
  needles: 'Long thin triangles',
  terrain: 'Terrain',
} as const;

export type HierarchyModel = keyof typeof HIERARCHY_MODELS;

/** All parts of the push-button in one mesh. */
function pushButton(): TriangleMesh {
  const scene = createPushButton({ level: 'low' });
  const positions: number[] = [],
    indices: number[] = [];
  for (const { mesh, transform: m } of scene.instances) {
    const part = scene.meshes[mesh]!;
    const first = positions.length / 3;
    for (let v = 0; v < part.positions.length; v += 3) {
      for (let r = 0; r < 3; r++)
        positions.push(
          m[r]! * part.positions[v]! +
            m[4 + r]! * part.positions[v + 1]! +
            m[8 + r]! * part.positions[v + 2]! +
            m[12 + r]!,
        );
    }
    for (const index of part.indices) indices.push(first + index);
  }
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) };
}

/** Needles in all directions, whose boxes are next to empty: the hardest case for boxes. */
function needles(): TriangleMesh {
  let state = 7;
  const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  const count = 6000;
  const positions = new Float32Array(9 * count);
  for (let i = 0; i < count; i++) {
    const z = 2 * random() - 1,
      phi = 2 * Math.PI * random(),
      r = Math.sqrt(1 - z * z);
    const along = [r * Math.cos(phi), z, r * Math.sin(phi)],
      across = [-Math.sin(phi), 0, Math.cos(phi)];
    for (let k = 0; k < 3; k++) {
      const start = 0.15 * (random() - 0.5);
      positions[9 * i + k] = start + 0.2 * along[k]!;
      positions[9 * i + 3 + k] = start + along[k]!;
      positions[9 * i + 6 + k] = start + along[k]! + 0.012 * across[k]!;
    }
  }
  return { positions };
}

/** A height field. */
function terrain(): TriangleMesh {
  const n = 120;
  const positions: number[] = [],
    indices: number[] = [];
  for (let i = 0; i <= n; i++) {
    for (let j = 0; j <= n; j++) {
      const x = (2 * i) / n - 1,
        z = (2 * j) / n - 1;
      positions.push(
        x,
        0.25 * Math.sin(3 * x) * Math.cos(2.5 * z) + 0.06 * Math.sin(11 * x + 4 * z) + 0.02 * Math.sin(37 * z - 21 * x),
        z,
      );
    }
  }
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n; j++) {
      const a = i * (n + 1) + j,
        b = a + n + 1;
      indices.push(a, a + 1, b, a + 1, b + 1, b);
    }
  }
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) };
}

export const makeModel = (name: HierarchyModel): TriangleMesh =>
  name === 'push-button' ? pushButton() : name === 'needles' ? needles() : terrain();
