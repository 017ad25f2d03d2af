import { describe, expect, it } from 'vitest';
import { layersOf, randomArchive } from '../src/denoise/networks';
import { onnxModel } from '../src/denoise/onnx';

/** Fields of a message of a protocol buffer. */
function fieldsOf(bytes: Uint8Array): (readonly [number: number, content: number | Uint8Array])[] {
  const fields: (readonly [number, number | Uint8Array])[] = [];
  let at = 0;
  const varint = () => {
    let value = 0;
    for (let factor = 1; ; factor *= 128) {
      const byte = bytes[at++]!;
      value += (byte & 127) * factor;
      if (byte < 128) return value;
    }
  };
  while (at < bytes.length) {
    const key = varint();
    const value = varint();
    if (key % 8 === 0) fields.push([key >> 3, value]);
    else {
      expect(key % 8).toBe(2);
      fields.push([key >> 3, bytes.subarray(at, (at += value))]);
    }
  }
  expect(at).toBe(bytes.length);
  return fields;
}

const all = (bytes: Uint8Array, number: number) =>
  fieldsOf(bytes).flatMap(([found, content]) => (found === number && content instanceof Uint8Array ? [content] : []));
const textOf = (bytes: Uint8Array) => new TextDecoder().decode(bytes);

describe.each(['small', 'base', 'large'] as const)('the network %s as an ONNX model', (size) => {
  const [graph] = all(onnxModel(size, randomArchive(size), 32, 48), 7) as [Uint8Array];
  const nodes = all(graph, 1).map((node) => ({
    op: textOf(all(node, 4)[0]!),
    inputs: all(node, 1).map(textOf),
    output: textOf(all(node, 2)[0]!),
  }));

  it('computes the channels and sizes that its layers have', () => {
    // Shapes by name: channels, and log2 of how many times smaller than the image.
    const shapes = new Map<string, readonly [channels: number, level: number]>([['input', [9, 0]]]);
    const weights = new Map(
      all(graph, 5).map((tensor) => [
        textOf(all(tensor, 8)[0]!),
        fieldsOf(tensor).flatMap(([number, content]) => (number === 1 ? [content as number] : [])),
      ]),
    );
    for (const { op, inputs, output } of nodes) {
      const [[channels, level], second] = [shapes.get(inputs[0]!)!, shapes.get(inputs[1]!)];
      if (op === 'Conv') {
        expect(weights.get(inputs[1]!)!.slice(1), output).toEqual([channels, 3, 3]);
        shapes.set(output, [weights.get(inputs[1]!)![0]!, level]);
      } else if (op === 'Concat') {
        expect(second![1], output).toBe(level);
        shapes.set(output, [channels + second![0], level]);
      } else shapes.set(output, [channels, level + (op === 'MaxPool' ? 1 : op === 'Resize' ? -1 : 0)]);
    }
    expect(shapes.get('output')).toEqual([3, 0]);
    for (const { name, level, out } of layersOf(size).slice(0, -1)) expect(shapes.get(name)).toEqual([out, level]);
  });

  it('has a convolution a layer, four poolings and four upsampled tensors that come before the skip', () => {
    const count = (op: string) => nodes.filter((node) => node.op === op).length;
    expect(count('Conv')).toBe(layersOf(size).length);
    expect([count('MaxPool'), count('Resize'), count('Concat')]).toEqual([4, 4, 4]);
    for (const { op, inputs } of nodes) if (op === 'Concat') expect(inputs[0]).toMatch(/\.up$/);
  });
});
