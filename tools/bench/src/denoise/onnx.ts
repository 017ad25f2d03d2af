import { parseTza } from '@glanz/denoise';
import { layersOf, type NetworkSize } from './networks';

/** A part of a protocol buffer, by number and content. */
type Field = readonly [number: number, content: number | string | Uint8Array | readonly Field[]];

function varint(value: number): number[] {
  const bytes: number[] = [];
  for (; value > 127; value = Math.floor(value / 128)) bytes.push((value % 128) | 128);
  return [...bytes, value];
}

/** Encodes a message: numbers as varints, all else with its length before it. */
function message(fields: readonly Field[]): Uint8Array<ArrayBuffer> {
  const parts = fields.map(([number, content]): readonly Uint8Array[] => {
    if (typeof content === 'number') return [Uint8Array.from([...varint(8 * number), ...varint(content)])];
    const bytes =
      typeof content === 'string'
        ? new TextEncoder().encode(content)
        : content instanceof Uint8Array
          ? content
          : message(content);
    return [Uint8Array.from([...varint(8 * number + 2), ...varint(bytes.length)]), bytes];
  });
  const flat = parts.flat();
  const whole = new Uint8Array(flat.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of flat) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

// Numbers of fields, as onnx.proto has them.
const FLOAT = 1;
const INTS = 7;

const ints = (name: string, values: readonly number[]): Field => [
  5,
  [[1, name], ...values.map((value): Field => [8, value]), [20, INTS]],
];
const text = (name: string, value: string): Field => [
  5,
  [
    [1, name],
    [4, value],
    [20, 3],
  ],
];

const node = (op: string, inputs: readonly string[], output: string, attributes: readonly Field[] = []): Field => [
  1,
  [...inputs.map((input): Field => [1, input]), [2, output], [4, op], ...attributes],
];

const tensor = (name: string, shape: readonly number[], data: Float32Array): Field => [
  5,
  [
    ...shape.map((size): Field => [1, size]),
    [2, FLOAT],
    [8, name],
    [9, new Uint8Array(data.buffer, data.byteOffset, data.byteLength)],
  ],
];

const value = (number: number, name: string, shape: readonly number[]): Field => {
  const dimensions: Field = [2, shape.map((size): Field => [1, [[1, size]]])];
  const type: Field = [1, [[1, FLOAT], dimensions]];
  return [
    number,
    [
      [1, name],
      [2, [type]],
    ],
  ];
};

/** What an upsampled tensor is joined with: the result of the pooling at a level, or the input. */
const SKIPS: Readonly<Record<string, string>> = {
  dec_conv4a: '3',
  dec_conv3a: '2',
  dec_conv2a: '1',
  dec_conv1a: 'input',
};

/**
 * A network of Open Image Denoise as an ONNX model in single precision, for images that are encoded already: input
 * `input` of [1, 9, height, width], output `output` of [1, 3, height, width]; both sizes are multiples of 16.
 */
export function onnxModel(
  size: NetworkSize,
  archive: Uint8Array<ArrayBuffer>,
  width: number,
  height: number,
): Uint8Array<ArrayBuffer> {
  const tensors = parseTza(archive);
  const layers = layersOf(size);
  const graph: Field[] = [];
  let current = 'input';
  for (const [i, { name, level, up, out }] of layers.entries()) {
    const skip = SKIPS[name];
    if (up > 0 && skip !== undefined) {
      graph.push(
        node('Resize', [current, '', 'twice'], `${name}.up`, [
          text('mode', 'nearest'),
          text('nearest_mode', 'floor'),
          text('coordinate_transformation_mode', 'asymmetric'),
        ]),
        node('Concat', [`${name}.up`, skip === 'input' ? skip : `pool${skip}`], `${name}.both`, [
          [
            5,
            [
              [1, 'axis'],
              [3, 1],
              [20, 2],
            ],
          ],
        ]),
      );
      current = `${name}.both`;
    }
    graph.push(
      node('Conv', [current, `${name}.weight`, `${name}.bias`], `${name}.sum`, [
        ints('kernel_shape', [3, 3]),
        ints('pads', [1, 1, 1, 1]),
      ]),
    );
    current = i === layers.length - 1 ? 'output' : name;
    graph.push(node('Relu', [`${name}.sum`], current));
    // The last layer of a level of the encoder is pooled.
    if (name.startsWith('enc') && layers[i + 1]!.level === level + 1) {
      graph.push(
        node('MaxPool', [current], `pool${level + 1}`, [ints('kernel_shape', [2, 2]), ints('strides', [2, 2])]),
      );
      current = `pool${level + 1}`;
    }
    for (const part of ['weight', 'bias'] as const) {
      const { data, shape } = tensors.get(`${name}.${part}`)!;
      if (shape[0] !== out) throw new RangeError(`${name}.${part} has ${shape[0]} outputs, not ${out}.`);
      graph.push(tensor(`${name}.${part}`, shape, Float32Array.from(data)));
    }
  }
  graph.push(tensor('twice', [4], Float32Array.of(1, 1, 2, 2)));
  const channels = tensors.get(`${layers[0]!.name}.weight`)!.shape[1]!;
  // Fields of a graph come in any order.
  graph.push([2, size], value(11, 'input', [1, channels, height, width]), value(12, 'output', [1, 3, height, width]));
  return message([
    [1, 8],
    [2, 'glanz'],
    [7, graph],
    [8, [[2, 17]]],
  ]);
}
