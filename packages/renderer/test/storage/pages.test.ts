import { readdirSync, readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { compactKernel } from '../../src/integrator/compact-kernels';
import { pagedKernel } from '../../src/integrator/paged-kernels';
import { bindingsOf, KERNELS, kernelSource, type KernelFeatures } from '../../src/integrator/pipelines';
import { pageParts, pageShape } from '../../src/storage/paged/pages';
import type { ShapeArray } from '../../src/storage/shape-arrays';

/** WebGPU's default limits. */
const device = {
  limits: { maxTextureDimension2D: 8192, maxTextureArrayLayers: 256 },
} as unknown as GPUDevice;

describe('parts of a range of texels', () => {
  it('cover each texel once, in order, within layers and the rows that are allowed', () => {
    const columns = 8;
    const rows = 4;
    for (const maxRows of [1, 3, 4])
      for (let first = 0; first < 40; first += 3)
        for (let count = 0; count < 80; count += 1 + (count % 3)) {
          let next = 0;
          for (const { origin, size, first: begin } of pageParts(first, count, columns, rows, maxRows)) {
            const [x, y, layer] = origin;
            expect(begin).toBe(next);
            expect(x + columns * (y + rows * layer)).toBe(first + begin);
            expect(x + size[0]).toBeLessThanOrEqual(columns);
            expect(y + size[1]).toBeLessThanOrEqual(rows);
            // Only whole rows lie below each other.
            if (size[1] > 1) expect([x, size[0], size[1] <= maxRows]).toEqual([0, columns, true]);
            next += size[0] * size[1];
          }
          expect(next).toBe(count);
        }
  });
});

it('within default limits, a texture holds 16 GiB in layers of 64 MiB', () => {
  const { columns, layerBytes, layers } = pageShape(device);
  expect({ columns, layerBytes, bytes: layerBytes * layers }).toEqual({
    columns: 8192,
    layerBytes: 2 ** 26,
    bytes: 2 ** 34,
  });
  // Rows of the smallest texels, which are words.
  expect(layerBytes / columns / 4).toBeLessThanOrEqual(8192);
});

/** All flags that shaders name. */
const flags = new Set(
  ['renderer', 'openpbr', 'bvh'].flatMap((name) => {
    const src = new URL(`../../../${name}/src/`, import.meta.url);
    return readdirSync(src, { recursive: true, encoding: 'utf8' })
      .filter((file) => file.endsWith('.wesl'))
      .flatMap((file) =>
        [...readFileSync(new URL(file, src), 'utf8').matchAll(/@(?:if|elif)\(([^)]*)\)/g)].flatMap(([, condition]) =>
          condition!.match(/\w+/g)!,
        ),
      );
  }),
);
const features = (on: boolean): KernelFeatures => ({
  flags: Object.fromEntries([...flags].map((name) => [name, on])),
  samplings: [],
  textured: [],
  textureCount: 0,
  samplerCount: 0,
  lightPasses: 1,
});

/** Text that does not depend on the order of lines. */
const lines = (text: string) => text.split('\n').sort();

describe.each<{ pages: readonly ShapeArray[] }>([
  { pages: ['nodes'] },
  { pages: ['triangles'] },
  { pages: ['attributes'] },
  { pages: ['nodes', 'triangles', 'attributes'] },
])('programs that read $pages from textures', ({ pages }) => {
  it.each(KERNELS)('%s indexes none of them, and is otherwise the program of buffers', (kernel) => {
    for (const on of [false, true]) {
      const plain = kernelSource(kernel, features(on)).key;
      const paged = kernelSource(kernel, features(on), pagedKernel(device, pages)).key;
      const bound = bindingsOf(kernel, features(on)).flatMap(({ bindings }) => bindings.map(({ name }) => name));
      const used = pages.filter((name) => bound.includes(name));
      for (const name of used) expect(paged).toContain(`var ${name}: texture_2d_array<u32>;`);
      if (used.length === 0) {
        expect(paged).toBe(plain);
        continue;
      }
      for (const name of used) expect(paged).toMatch(new RegExp(`(?<!fn )page_${name}\\(`));
      // Back to indices, what is left are the functions that read texels.
      const back = paged
        .replace(/(?<!fn )\bpage_(nodes|triangles|attributes)\(([^()]*)\)/g, '$1[$2]')
        .replace(
          /var (nodes|triangles|attributes): texture_2d_array<u32>;/g,
          (_, name: string) => plain.match(new RegExp(`var<storage, read> ${name}: [^;]*;`))![0],
        );
      const left = new Set(lines(back));
      for (const line of lines(plain)) expect(left.has(line), line).toBe(true);
    }
  });
});

// GPUs may flush denormal floats to zero, which the words of places are.
it.each(['intersect', 'connect', 'shade', 'first'] as const)('%s loads compact shapes as words', (kernel) => {
  for (const on of [false, true]) {
    const words = kernelSource(kernel, features(on), compactKernel()).key;
    expect(words).toContain('triangles: array<vec4u>;');
    const paged = kernelSource(kernel, features(on), pagedKernel(device, ['triangles'], compactKernel())).key;
    expect(paged).toContain('triangles: texture_2d_array<u32>;');
    expect(paged).toMatch(/fn page_triangles\(.*\) *-> *vec4u/);
    for (const text of [words, paged]) {
      expect(text).toMatch(/bitcast<vec3f>\((page_)?triangles[[(]/);
      expect(text).not.toMatch(/bitcast<(u32|vec3u|vec4f)>\((page_triangles|triangles|textureLoad\(triangles)/);
    }
  }
});
