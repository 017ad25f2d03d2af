import { quads } from './files';

const SWAP = [-1.2, 0, 0, 1.2, 0, 0];
const numbers = Float32Array.of(
  0,
  0.2,
  ...SWAP,
  ...SWAP.map((x) => 0 - x),
  0,
  1,
  ...[0, 1, 2, 3].flatMap(() => [0, 9, 0]),
);
/**
 * A GLB with a red square on the left and a green one on the right, which the animation "swap" exchanges within 0.2
 * seconds; "away" moves the vertices of the red one up by 9 m, by a morph target.
 */
export const animatedQuads: Buffer = quads(
  [
    { name: 'left', colour: [0.9, 0.02, 0.02], at: [-1.2, 0, 0] },
    { name: 'right', colour: [0.02, 0.8, 0.02], at: [1.2, 0, 0] },
  ],
  (json) => {
    const view = (first: number, count: number) =>
      (json['bufferViews'] as object[]).push({ buffer: 0, byteOffset: 72 + 4 * first, byteLength: 4 * count }) - 1;
    const accessor = (first: number, type: 'SCALAR' | 'VEC3', count: number) =>
      (json['accessors'] as object[]).push({
        bufferView: view(first, count * (type === 'VEC3' ? 3 : 1)),
        componentType: 5126,
        type,
        count,
        ...(first === 0 ? { min: [0], max: [0.2] } : first === 16 ? { min: [0, 9, 0], max: [0, 9, 0] } : {}),
      }) - 1;
    const times = accessor(0, 'SCALAR', 2);
    const [there, back] = [accessor(2, 'VEC3', 2), accessor(8, 'VEC3', 2)];
    const weights = accessor(14, 'SCALAR', 2);
    const [mesh] = json['meshes'] as { primitives: Record<string, unknown>[] }[];
    mesh!.primitives[0]!['targets'] = [{ POSITION: accessor(16, 'VEC3', 4) }];
    const channel = (node: number, path: string) => ({ sampler: node, target: { node, path } });
    json['animations'] = [
      {
        name: 'swap',
        samplers: [
          { input: times, output: there },
          { input: times, output: back },
        ],
        channels: [channel(0, 'translation'), channel(1, 'translation')],
      },
      { name: 'away', samplers: [{ input: times, output: weights }], channels: [channel(0, 'weights')] },
    ];
    (json['buffers'] as { byteLength: number }[])[0]!.byteLength += numbers.byteLength;
  },
  Buffer.from(numbers.buffer),
);
