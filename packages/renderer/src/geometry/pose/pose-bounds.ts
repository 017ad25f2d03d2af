import type { MeshPose, MeshRig } from '@glanz/scene';

/** Margin for rounding on the GPU, relative to the largest terms of a vertex. */
const MARGIN = 2 ** -16;

/** min xyz, max xyz. */
type Box = Float64Array;

const emptyBox = (): Box => Float64Array.of(Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity);

function enclose(box: Box, values: Float32Array, at: number): void {
  for (let k = 0; k < 3; k++) {
    const value = values[at + k] as number;
    if (value < (box[k] as number)) box[k] = value;
    if (value > (box[3 + k] as number)) box[3 + k] = value;
  }
}

/**
 * Bounds of a rig's poses, found without their vertices: a skinned vertex lies between where its joints take it. They
 * are never too small, and as large as the boxes of the joints make them.
 */
export class PoseBounds {
  /** Of the vertices that a joint moves; the last: of those that none moves. */
  readonly #joints: readonly Box[];
  readonly #targets: readonly Box[];

  constructor({ bind, skin, targets }: MeshRig) {
    const { positions } = bind;
    const vertices = positions.length / 3;
    const boxes = Array.from({ length: (skin?.jointCount ?? 0) + 1 }, emptyBox);
    const isMoved = new Uint8Array(vertices);
    skin?.joints.forEach((joint, i) => {
      if ((skin.weights[i] as number) === 0) return;
      const vertex = (i >> 2) % vertices;
      isMoved[vertex] = 1;
      enclose(boxes[joint] as Box, positions, 3 * vertex);
    });
    for (let v = 0; v < vertices; v++) if (isMoved[v] === 0) enclose(boxes.at(-1) as Box, positions, 3 * v);
    this.#joints = boxes;
    this.#targets = targets.map((target) => {
      const box = new Float64Array(6);
      for (let at = 0; target.positions && at < positions.length; at += 3) enclose(box, target.positions, at);
      return box;
    });
  }

  /** The box around a pose. */
  of({ joints, weights }: MeshPose): { readonly min: Float32Array; readonly max: Float32Array } {
    const added = new Float64Array(6);
    this.#targets.forEach((box, i) => {
      const weight = weights[i] as number;
      for (let k = 0; k < 3; k++) {
        const [low, high] = [weight * (box[k] as number), weight * (box[3 + k] as number)];
        added[k] = (added[k] as number) + Math.min(low, high);
        added[3 + k] = (added[3 + k] as number) + Math.max(low, high);
      }
    });
    const [min, max] = [new Float32Array(3).fill(Infinity), new Float32Array(3).fill(-Infinity)];
    this.#joints.forEach((box, joint) => {
      if ((box[0] as number) > (box[3] as number)) return;
      const isFree = joint === this.#joints.length - 1;
      for (let k = 0; k < 3; k++) {
        let [low, high, size] = [0, 0, 0];
        for (let column = 0; column < 4; column++) {
          const m = isFree ? (column === k ? 1 : 0) : (joints[16 * joint + 4 * column + k] as number);
          const [a, b] =
            column === 3
              ? [1, 1]
              : [
                  (box[column] as number) + (added[column] as number),
                  (box[3 + column] as number) + (added[3 + column] as number),
                ];
          low += Math.min(m * a, m * b);
          high += Math.max(m * a, m * b);
          // What targets move there and back rounds too.
          const reach =
            column === 3
              ? 1
              : Math.max(Math.abs(a), Math.abs(b), -(added[column] as number), added[3 + column] as number);
          size += Math.abs(m) * reach;
        }
        min[k] = Math.min(min[k] as number, low - MARGIN * size);
        max[k] = Math.max(max[k] as number, high + MARGIN * size);
      }
    });
    return { min, max };
  }
}
