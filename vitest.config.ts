import { defineConfig } from 'vitest/config';

// Packages are tested from their sources (condition "@glanz/source"), so tests need no build.
// Forks, not threads: the software Vulkan driver must be opened on a process's main thread.
const resolve = { conditions: ['@glanz/source', 'module', 'import', 'default'] };
const project = (name: string, dir: string) => ({
  resolve,
  ssr: { resolve: { conditions: ['@glanz/source', 'node', 'module', 'import', 'default'] } },
  test: {
    name,
    root: dir,
    include: ['test/**/*.test.ts'],
    pool: 'forks' as const,
    testTimeout: 300_000,
    hookTimeout: 120_000,
  },
});

export default defineConfig({
  test: {
    projects: [
      ...['wgsl', 'scene', 'bvh', 'openpbr', 'gltf', 'formats', 'cad', 'tonemap', 'image', 'renderer', 'cli', 'viewer', 'element', 'react', 'three'].map((name) => project(name, `packages/${name}`)),
      project('docs', 'apps/docs'),
      ...['models', 'bench', 'reference', 'gpu', 'pipeline'].map((name) => project(`tools-${name}`, `tools/${name}`)),
      project('playground', 'apps/playground'),
    ],
    // One GPU process at a time on two cores keeps the software driver from starving itself.
    maxWorkers: 2,
    fileParallelism: true,
  },
});
