import type { Instance, Material, Mesh, Scene } from '@glanz/scene';
import type { parametersOf } from '../materials/parameters';
import { GUIDE_POINTS } from './guide_constants.wesl';

/** Points on surfaces, sorted into the leaves of a k-d tree. */
export interface GuidePoints {
  /** A power of 2. */
  readonly leaves: number;
  /** The number of leaves at 0; axis and place of the split of node i at 2i and 2i + 1, its children are 2i and 2i + 1. */
  readonly nodes: Float32Array;
  /** Position, 0, normal, 0 of each point: stride 8, {@link GUIDE_POINTS} points a leaf. */
  readonly points: Float32Array<ArrayBuffer>;
}

type Vector = readonly [number, number, number];

const less = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const middle = (a: Vector, b: Vector): Vector => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2];

/** Numbers in [0, 1), always the same ones (mulberry32). */
function numbers(): () => number {
  let state = 1;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** A triangle, and the sum of the weights up to it. */
interface Piece {
  readonly corners: readonly [Vector, Vector, Vector];
  readonly sum: number;
}

/** What share of a node's points may come to be on the wrong side of its split, where another axis parts them better. */
const MIXED = 0.125;

/** Halvings of a triangle at most. */
const HALVINGS = 14;

/**
 * Points over the surfaces that a guide serves: neither transmissive nor metals. Their density falls with the square of
 * the distance to the camera, and the tree's leaves hold equally many.
 *
 * @param shown Whether an instance is visible.
 * @param parameters Those of a material, with defaults.
 * @param eye The camera's position.
 * @returns `undefined` where there are no such surfaces.
 */
export function guidePoints(
  scene: Scene,
  shown: (instance: Instance) => boolean,
  parameters: typeof parametersOf,
  eye: Vector,
  leaves: number,
): GuidePoints | undefined {
  const pieces: Piece[] = [];
  let sum = 0;
  const add = (a: Vector, b: Vector, c: Vector, halvings: number): void => {
    const edges = [Math.hypot(...less(b, a)), Math.hypot(...less(c, b)), Math.hypot(...less(a, c))] as const;
    const longest = Math.max(...edges);
    const distance = Math.hypot(...less(middle(a, middle(b, c)), eye));
    if (longest > 0.5 * distance && halvings < HALVINGS) {
      // The longest edge is halved.
      const [p, q, r] = longest === edges[0] ? [a, b, c] : longest === edges[1] ? [b, c, a] : [c, a, b];
      const m = middle(p, q);
      add(p, m, r, halvings + 1);
      add(m, q, r, halvings + 1);
      return;
    }
    const weight = Math.hypot(...cross(less(b, a), less(c, a))) / Math.max(distance, longest) ** 2;
    if (weight > 0 && weight < Infinity) pieces.push({ corners: [a, b, c], sum: (sum += weight) });
  };
  for (const instance of scene.instances) {
    const { transmission_weight, base_metalness } = parameters(scene.materials[instance.material] as Material);
    if (!shown(instance) || transmission_weight > 0 || base_metalness === 1) continue;
    const { positions, indices } = scene.meshes[instance.mesh] as Mesh;
    const m = instance.transform as ArrayLike<number> as readonly number[];
    const corner = (k: number): Vector => {
      const i = 3 * (indices[k] as number);
      const row = (r: number) =>
        m[r]! * positions[i]! + m[4 + r]! * positions[i + 1]! + m[8 + r]! * positions[i + 2]! + m[12 + r]!;
      return [row(0), row(1), row(2)];
    };
    for (let t = 0; t + 2 < indices.length; t += 3) add(corner(t), corner(t + 1), corner(t + 2), 0);
  }
  if (pieces.length === 0) return undefined;

  const random = numbers();
  const chosen = Array.from({ length: leaves * GUIDE_POINTS }, (_, i) => {
    const at = ((i + random()) / (leaves * GUIDE_POINTS)) * sum;
    let [low, high] = [0, pieces.length - 1];
    while (low < high) {
      const half = (low + high) >> 1;
      if ((pieces[half] as Piece).sum > at) high = half;
      else low = half + 1;
    }
    const [a, b, c] = (pieces[low] as Piece).corners;
    const root = Math.sqrt(random());
    const v = random() * root;
    const place = (r: 0 | 1 | 2) => (1 - root) * a[r] + (root - v) * b[r] + v * c[r];
    const normal = cross(less(b, a), less(c, a));
    const length = Math.hypot(...normal);
    return [place(0), place(1), place(2), 0, normal[0] / length, normal[1] / length, normal[2] / length, 0];
  });

  const nodes = new Float32Array(2 * leaves);
  nodes[0] = leaves;
  const points = new Float32Array(8 * chosen.length);
  const split = (node: number, list: number[][]): void => {
    if (node >= leaves) {
      list.forEach((point, k) => points.set(point, 8 * ((node - leaves) * GUIDE_POINTS + k)));
      return;
    }
    const half = list.length / 2;
    // The longest axis whose middle parts the points. Many have the same place on another axis, such as those of a floor
    // below a light: of them a split can only send all to one side.
    const axes = [0, 1, 2].map((axis) => {
      const places = list.map((point) => point[axis] as number).sort((p, q) => p - q);
      const middle = places[half] as number;
      const [from, to] = [places.indexOf(middle), places.lastIndexOf(middle) + 1];
      const isAbove = half - from <= to - half;
      const place = isAbove ? middle : (middle + (places[to] ?? middle)) / 2;
      const lost = Math.min(half - from, to - half) / list.length;
      const extent = (places.at(-1) as number) - (places[0] as number);
      return { axis, place, rank: lost > MIXED ? -lost : extent };
    });
    const { axis, place } = axes.reduce((best, other) => (other.rank > best.rank ? other : best));
    list.sort((p, q) => (p[axis] as number) - (q[axis] as number));
    nodes.set([axis, place], 2 * node);
    split(2 * node, list.slice(0, half));
    split(2 * node + 1, list.slice(half));
  };
  split(1, chosen);
  return { leaves, nodes, points };
}
