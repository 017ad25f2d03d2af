import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';
import { BaseSequencer, type TestSpecification } from 'vitest/node';
import { fastExports } from './tools/pipeline/fast-exports.mjs';
import { weslModules } from './tools/pipeline/wesl.mjs';

/** Files that take minutes begin first: alone at the end the last of them would not keep both cores busy. */
const LONG = [
  'reference/test/groundtruth',
  'reference/test/slope',
  'gpu/adaptive',
  'gpu/dispersion',
  'cli/test/recovery-gpu',
  'denoise/test/denoiser',
  'denoise/test/oracle',
  'openpbr/test/oracle',
  'docs/test/examples',
  'openpbr/test/gpu',
  'test/gpu/',
];

/**
 * Files that share processes stand together by project, since Vitest keeps a process only for the file that comes next
 * in the queue. These groups and all other files come with the longest first, and the others at the end: many short
 * ones keep both cores busy to the last.
 */
class LongestFirst extends BaseSequencer {
  override async sort(files: TestSpecification[]): Promise<TestSpecification[]> {
    const place = ({ moduleId }: TestSpecification) => [...LONG, ''].findIndex((part) => moduleId.includes(part));
    const groups = new Map<string, TestSpecification[]>();
    for (const file of await super.sort(files)) {
      const { name, isolate } = file.project.config;
      const key = isolate ? file.moduleId : `project ${name}`;
      groups.set(key, [...(groups.get(key) ?? []), file]);
    }
    return [...groups.values()]
      .map((group) => group.sort((a, b) => place(a) - place(b)))
      .sort(
        ([a], [b]) => place(a!) - place(b!) || Number(a!.project.config.isolate) - Number(b!.project.config.isolate),
      )
      .flat();
  }
}

// Packages are tested from their sources (condition "@glanz/source"), so tests need no build.
// Forks, not threads: the software Vulkan driver must be opened on a process's main thread.
const resolve = { conditions: ['@glanz/source', 'module', 'import', 'default'] };
// Files of a project share processes, their modules, and the test device with the programs that it has compiled: to load
// them again for each file took as much time as all the tests that are quick. Files that replace parts of their process
// (its output, its environment, its drivers) have one each: `isolated`.
const project = (
  name: string,
  dir: string,
  { isolated = false, include = ['test/**/*.test.ts'], exclude = [] as string[] } = {},
) => ({
  plugins: [weslModules(), fastExports()],
  resolve,
  // @aws-sdk has modules for bundlers under "module", which Node cannot load.
  ssr: {
    resolve: {
      conditions: ['@glanz/source', 'node', ...(['cli', 'farm'].includes(name) ? [] : ['module']), 'import', 'default'],
    },
  },
  test: {
    name,
    root: dir,
    include,
    exclude: ['**/node_modules/**', ...exclude],
    isolate: isolated,
    setupFiles: [fileURLToPath(new URL('tools/pipeline/test-times.ts', import.meta.url))],
    pool: 'forks' as const,
    testTimeout: 300_000,
    hookTimeout: 120_000,
  },
});

/**
 * Tests of the renderer that need no device, and those that compile much of the same and neither count that nor change
 * the device.
 */
const SHARED = [
  '*',
  '{camera,device,environment,film,geometry,guiding,integrator,lights,materials,schedule,storage}/**/*',
  ...[
    'adaptive',
    'aov-chains',
    'aovs',
    'area-lights',
    'biased-options',
    'camera',
    'catcher',
    'coat-silhouette',
    'corners',
    'delta-transmission',
    'dispersion',
    'film-state',
    'filter',
    'interiors',
    'layers',
    'light-eval',
    'light-groups',
    'light-profile',
    'light-tree',
    'motion',
    'path-tracer',
    'render-scale',
    'shadow-terminator',
    'smooth',
    'spot-light',
    'textured',
    'transparent',
  ].map((name) => `gpu/${name}`),
].map((name) => `test/${name}.test.ts`);

export default defineConfig({
  test: {
    projects: [
      ...[
        'wgsl',
        'scene',
        'bvh',
        'openpbr',
        'gltf',
        'formats',
        'cad',
        'tonemap',
        'denoise',
        'image',
        'cli',
        'farm',
        'viewer',
        'element',
        'react',
        'three',
        'denoise-weights',
        'create-glanz',
      ].map((name) => project(name, `packages/${name}`, { isolated: ['cli', 'denoise'].includes(name) })),
      project('renderer', 'packages/renderer', { isolated: true, exclude: SHARED }),
      project('renderer-shared', 'packages/renderer', { include: SHARED }),
      project('docs', 'apps/docs'),
      ...['models', 'gallery', 'bench', 'reference', 'gpu', 'operations', 'pipeline', 'redis'].map((name) =>
        project(`tools-${name}`, `tools/${name}`, { isolated: ['bench', 'pipeline'].includes(name) }),
      ),
      project('playground', 'apps/playground'),
    ],
    // Programs compile on one core and files load on one: three processes keep two cores busy.
    maxWorkers: 3,
    fileParallelism: true,
    sequence: { sequencer: LongestFirst },
  },
});
