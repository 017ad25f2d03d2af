import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import {
  beginShaderModule,
  compose,
  createShaderModule,
  ShaderError,
  struct,
  wgslModule,
  type StructLayout,
  type WgslFieldType,
} from '../src';
import { randomSource, type RandomSource } from './random';

afterEach(() => expectNoGpuErrors());

/** How the test reads a scalar field in WGSL as a word, by its type: the GPU's own layout, not ours. */
const READERS: Record<string, (value: string) => string[]> = {
  f32: (v) => [`bitcast<u32>(${v})`],
  u32: (v) => [v],
  i32: (v) => [`bitcast<u32>(${v})`],
  vec2f: (v) => ['x', 'y'].map((c) => `bitcast<u32>(${v}.${c})`),
  vec3f: (v) => ['x', 'y', 'z'].map((c) => `bitcast<u32>(${v}.${c})`),
  vec4f: (v) => ['x', 'y', 'z', 'w'].map((c) => `bitcast<u32>(${v}.${c})`),
  vec2u: (v) => ['x', 'y'].map((c) => `${v}.${c}`),
  vec3u: (v) => ['x', 'y', 'z'].map((c) => `${v}.${c}`),
  vec4u: (v) => ['x', 'y', 'z', 'w'].map((c) => `${v}.${c}`),
  mat4x4f: (v) =>
    [0, 1, 2, 3].flatMap((column) => ['x', 'y', 'z', 'w'].map((c) => `bitcast<u32>(${v}[${column}].${c})`)),
};
const BASIC = Object.keys(READERS) as (keyof typeof READERS & string)[];

function randomType(random: RandomSource, depth: number): WgslFieldType {
  return depth > 0 && random.next() < 0.3
    ? [randomType(random, depth - 1), 1 + random.below(3)]
    : (random.pick(BASIC) as WgslFieldType);
}

const readersOf = (type: WgslFieldType, value: string): string[] =>
  typeof type === 'string'
    ? (READERS[type]?.(value) ?? [])
    : Array.from({ length: (type as readonly [WgslFieldType, number])[1] }, (_, i) =>
        readersOf((type as readonly [WgslFieldType, number])[0], `${value}[${i}]`),
      ).flat();
const scalarOf = (type: WgslFieldType): string =>
  typeof type === 'string' ? type : scalarOf((type as readonly [WgslFieldType, number])[0]);

describe('struct layouts on a GPU', () => {
  it.each([1, 2, 3, 4])('the shader reads what was written, in random structs of an array (seed %i)', async (seed) => {
    const random = randomSource(seed);
    const fields = Object.fromEntries(Array.from({ length: 10 }, (_, i) => [`f${i}`, randomType(random, 2)]));
    const layout: StructLayout = struct('Record', fields);
    const values = layout.allocate(3);
    const readers: string[] = [];
    const words: number[] = [];
    for (const [name, type] of Object.entries(fields)) {
      const reads = readersOf(type, `records[2].${name}`);
      const integer = /u/.test(scalarOf(type).replace('vec', '')) || scalarOf(type).endsWith('u');
      const numbers = reads.map(() =>
        integer
          ? random.below(2 ** 32)
          : scalarOf(type) === 'i32'
            ? random.below(2 ** 31) - 2 ** 30
            : Math.fround(random.next() * 1000 - 500),
      );
      layout.write(values, 2, { [name]: numbers.length === 1 ? (numbers[0] as number) : numbers });
      readers.push(...reads);
      words.push(
        ...numbers.map((n) =>
          integer || scalarOf(type) === 'i32' ? n >>> 0 : (new Uint32Array(new Float32Array([n]).buffer)[0] as number),
        ),
      );
    }
    const { code } = compose([
      wgslModule(
        'test',
        `@group(0) @binding(0) var<storage, read> records: array<Record>;
        @group(0) @binding(1) var<storage, read_write> words: array<u32>;
        @compute @workgroup_size(1) fn main() {\n${readers.map((read, i) => `words[${i}] = ${read};`).join('\n')}\n}`,
        [layout.module],
      ),
    ]);
    const result = new Uint32Array(
      await runCompute(await testDevice(), code, { inputs: [values], outputBytes: 4 * words.length }),
    );
    expect([...result]).toEqual(words);
  });

  it('the shader reads nested structs', async () => {
    const Inner = struct('Inner', { a: 'f32', b: 'vec2u' });
    const Outer = struct('Outer', { head: 'u32', one: Inner, many: [Inner, 3], tail: 'u32' });
    const inner = Inner.allocate(3);
    for (let i = 0; i < 3; i++) Inner.write(inner, i, { a: i, b: [10 + i, 20 + i] });
    const buffer = Outer.allocate(2);
    Outer.write(buffer, 1, { head: 1, one: inner.slice(Inner.size, 2 * Inner.size), many: inner, tail: 99 });
    const { code } = compose([
      wgslModule(
        'test',
        `@group(0) @binding(0) var<storage, read> outer: array<Outer>;
        @group(0) @binding(1) var<storage, read_write> words: array<u32>;
        @compute @workgroup_size(1) fn main() {
          let o = outer[1];
          words[0] = o.head; words[1] = u32(o.one.a); words[2] = o.one.b.y; words[3] = o.many[2].b.x; words[4] = o.many[2].b.y; words[5] = o.tail;
        }`,
        [Outer.module],
      ),
    ]);
    expect([
      ...new Uint32Array(await runCompute(await testDevice(), code, { inputs: [buffer], outputBytes: 24 })),
    ]).toEqual([1, 1, 21, 12, 22, 99]);
  });
});

describe('createShaderModule', () => {
  const library = wgslModule('lib/square', '// a comment\nfn square(x: f32) -> f32 {\n  return x * x;\n}');
  const entry = (body: string) =>
    wgslModule(
      'test/entry',
      `@group(0) @binding(0) var<storage, read_write> out: array<f32>;\n@compute @workgroup_size(1) fn main() {\n${body}\n}`,
      [library],
    );

  it('gives a module that runs', async () => {
    const device = await testDevice();
    const module = await createShaderModule(device, compose([entry('out[0] = square(3.0);')]), 'good');
    expect(
      await device.createComputePipelineAsync({ layout: 'auto', compute: { module, entryPoint: 'main' } }),
    ).toBeTruthy();
  });

  it('puts directives where the compiler requires them', async () => {
    const late = wgslModule('test/late', 'diagnostic(off, derivative_uniformity);', [entry('out[0] = square(3.0);')]);
    await expect(createShaderModule(await testDevice(), compose([late]), 'directive')).resolves.toBeTruthy();
  });

  it('throws one line with the module, its line and its text, and reports nothing twice', async () => {
    const broken = wgslModule('lib/broken', '//#if WRONG\nfn half(x: f32) -> f32 {\n  return x / 2u;\n}\n//#endif', [
      library,
    ]);
    const error: unknown = await createShaderModule(
      await testDevice(),
      compose([broken, entry('out[0] = 1.0;')], { flags: { WRONG: true } }),
      'bad',
    ).catch((e: unknown) => e);
    expect(error).toBeInstanceOf(ShaderError);
    const { code, message, location } = error as ShaderError;
    expect(code).toBe('wgsl/compile');
    expect(location).toEqual({ module: 'lib/broken', line: 3 });
    expect(message).toContain('Shader "bad" does not compile: lib/broken:3:');
    expect(message).toContain('"return x / 2u;"');
    expect(message).not.toContain('\n');
    // afterEach: the device has no uncaptured error.
  });

  it('pipelines may be asked for before the compiler has had its word, which is the error of both', async () => {
    const device = await testDevice();
    const good = beginShaderModule(device, compose([entry('out[0] = square(3.0);')]), 'good');
    const pipeline = device.createComputePipelineAsync({
      layout: 'auto',
      compute: { module: good.module, entryPoint: 'main' },
    });
    expect(await good.checked).toBe(good.module);
    expect(await pipeline).toBeTruthy();
    const bad = beginShaderModule(device, compose([entry('out[0] = missing();')]), 'bad');
    const none = device.createComputePipelineAsync({
      layout: 'auto',
      compute: { module: bad.module, entryPoint: 'main' },
    });
    const [word, nothing] = await Promise.allSettled([bad.checked, none]);
    expect(word).toMatchObject({
      status: 'rejected',
      reason: { code: 'wgsl/compile', location: { module: 'test/entry', line: 3 } },
    });
    expect(nothing.status).toBe('rejected');
  });
});
