import { wgslModule, type WgslModule } from '@glanz/wgsl/module';
import attributes from '../storage/paged/page_attributes.wesl';
import nodes from '../storage/paged/page_nodes.wesl';
import { pageShape } from '../storage/paged/pages';
import triangles from '../storage/paged/page_triangles.wesl';
import type { ShapeArray } from '../storage/shape-arrays';
import type { KernelParts } from './pipelines';

/** `fn page_‹array›(index: u32)`: what an element of each array is, where it lies in a texture. */
const READERS: Readonly<Record<ShapeArray, WgslModule>> = { nodes, triangles, attributes };

/** The modules of `storage/` that index the arrays. */
const ACCESSORS: ReadonlySet<string | undefined> = new Set(
  ['nodes', 'triangles', 'attribute-heap', 'compact-triangles', 'compact-vertices'].map((name) => `renderer/${name}`),
);

/**
 * A kernel that reads some arrays from textures: these are bound as textures, and where the accessors of `storage/`
 * index an array, the program calls its reader. All else of the text is that of other scenes. Loaded where a scene
 * needs it.
 *
 * @param pages The arrays.
 * @param parts What it has besides, with bindings in place of others.
 */
export function pagedKernel(device: GPUDevice, pages: readonly ShapeArray[], parts?: KernelParts): KernelParts {
  const { columns, layerBytes } = pageShape(device);
  const bits = { COLUMN: Math.log2(columns), LAYER: Math.log2(layerBytes / 16) };
  const shape = wgslModule(
    'renderer/page-shape',
    `const PAGE_COLUMN_BITS=${bits.COLUMN}u;const PAGE_LAYER_BITS=${bits.LAYER}u;`,
  );
  const indexed = new RegExp(`\\b(${pages.join('|')})\\[([^[\\]]*)\\]`, 'g');
  return {
    ...parts,
    bind: (groups) =>
      (parts?.bind?.(groups) ?? groups).map((group) => ({
        ...group,
        bindings: group.bindings.map((binding) => {
          const name = pages.find((page) => page === binding.name);
          return name
            ? {
                ...binding,
                type: 'texture_2d_array<u32>',
                space: 'unfilterable',
                entry: { texture: { sampleType: 'uint', viewDimension: '2d-array' } },
                deps: [...(binding.deps ?? []), shape, READERS[name]],
              }
            : binding;
        }),
      })),
    rewrite: ({ code, locate }) =>
      code
        .split('\n')
        // Elsewhere, variables of functions may have the same names.
        .map((line, i) => (ACCESSORS.has(locate(i + 1)?.module) ? line.replace(indexed, 'page_$1($2)') : line))
        .join('\n'),
  };
}
