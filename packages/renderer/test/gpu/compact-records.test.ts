import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { expect, it } from 'vitest';
import { encodeRecords, recordsPipeline } from '../../src/geometry/compact-records';
import { COMPACT_SHAPES } from '../../src/geometry/compact-shapes';
import { GpuMemory } from '../../src/storage/buffers';
import { readBuffer } from '../../src/storage/read-buffer';

const device = await testDevice();
expectNoGpuErrors();
const { COPY_DST, COPY_SRC, STORAGE } = GPUBufferUsage;

it('records of compact triangles made on the GPU are those that the CPU makes, in parts or at once', async () => {
  const triangles = 1000;
  const region = {
    firstNode: 0,
    nodes: 0,
    firstTriangle: 3,
    triangles,
    firstVertex: 1017,
    vertices: 0,
    firstWord: 0,
    words: 0,
  };
  const indices = Uint32Array.from({ length: 3 * triangles }, (_, i) => (i * 7919) % 501);
  const triangleIndices = Uint32Array.from({ length: triangles }, (_, i) => (i * 337) % triangles);
  const tree = { triangleIndices, nodes: new Float32Array(0) };
  const expected = new Uint32Array(4 * triangles);
  for (const { offset, data } of COMPACT_SHAPES.slices(
    { name: '', positions: new Float32Array(0), indices },
    tree,
    region,
  ))
    expected.set(data as Uint32Array, offset / 4 - 4 * region.firstTriangle);
  const memory = new GpuMemory(device);
  const upload = (data: Uint32Array<ArrayBuffer>) => {
    const buffer = memory.buffer('test', data.byteLength, STORAGE | COPY_DST);
    memory.write(buffer, data);
    return buffer;
  };
  const source = {
    order: upload(triangleIndices),
    indices: upload(indices),
    triangleCount: triangles,
    firstVertex: 1017,
  };
  const before = memory.bytes;
  for (const atOnce of [64, 448, 4096]) {
    const target = memory.buffer('target', expected.byteLength, COPY_DST | COPY_SRC);
    const encoder = device.createCommandEncoder();
    const copy = (from: GPUBuffer, offset: number, bytes: number) =>
      encoder.copyBufferToBuffer(from, 0, target, offset, bytes);
    const free = encodeRecords({ device, memory }, await recordsPipeline(device), encoder, source, copy, atOnce);
    device.queue.submit([encoder.finish()]);
    free();
    expect(new Uint32Array(await readBuffer(device, target, expected.byteLength))).toEqual(expected);
    memory.release(target);
    expect(memory.bytes).toBe(before);
  }
  memory.destroy();
});
