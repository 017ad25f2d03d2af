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
  // Most of their time passes in processes that they begin.
  'cli/test/farm.test',
  'cli/test/process',
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
      conditions: ['@glanz/source', 'node', ...(/^(cli|farm)/.test(name) ? [] : ['module']), 'import', 'default'],
    },
  },
  test: {
    name,
    root: dir,
    include,
    exclude: ['**/node_modules/**', ...exclude],
    isolate: isolated,
    setupFiles: ['test-times', 'typed-arrays'].map((name) =>
      fileURLToPath(new URL(`tools/pipeline/${name}.ts`, import.meta.url)),
    ),
    pool: 'forks' as const,
    testTimeout: 300_000,
    hookTimeout: 120_000,
  },
});

/** Two projects of one folder: `isolated` names the tests that have a process each, the others share some. */
const split = (name: string, dir: string, isolated: readonly string[]) => {
  const include = isolated.map((test) => `test/${test}.test.ts`);
  return [project(name, dir, { isolated: true, include }), project(`${name}-shared`, dir, { exclude: include })];
};

/**
 * They count operations, bytes or programs, wait for programs to compile, change the device or the process, or lose the
 * device.
 */
const RENDERER_ISOLATED = [
  'node/**/*',
  ...[
    'bvh-builder',
    'edits',
    'features',
    'first-light',
    'launches',
    'lost',
    'many-instances',
    'memory',
    'pages',
    'refusals',
    'release',
    'warm-up',
  ].map((name) => `gpu/${name}`),
];

/** They open GPUs of their own, replace modules or parts of the process, or begin processes. */
const CLI_ISOLATED = [
  'compressed-textures',
  'denoise',
  'e2e',
  'farm',
  'farm-schedulers',
  'farm-serve',
  'png',
  'process',
  'recovery-gpu',
  'video-e2e',
  'viewer-film',
];

/** They open GPUs, replace the process's output, count garbage, or begin processes. */
const BENCH_ISOLATED = [
  'benchmark',
  'bvh-brute',
  'denoise-quality',
  'faults/**/*',
  'gpu-clock',
  'motion/**/*',
  'peers/**/*',
  'products/run',
  'rays',
];

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
        'image',
        'farm',
        'viewer',
        'element',
        'react',
        'three',
        'denoise-weights',
        'create-glanz',
      ].map((name) => project(name, `packages/${name}`)),
      // It sets flags of V8.
      ...split('denoise', 'packages/denoise', ['wasm']),
      ...split('cli', 'packages/cli', CLI_ISOLATED),
      ...split('renderer', 'packages/renderer', RENDERER_ISOLATED),
      project('docs', 'apps/docs'),
      ...split('tools-bench', 'tools/bench', BENCH_ISOLATED),
      ...['models', 'gallery', 'reference', 'gpu', 'operations', 'pipeline', 'redis'].map((name) =>
        project(`tools-${name}`, `tools/${name}`),
      ),
      project('playground', 'apps/playground'),
    ],
    // Programs compile on one core and files load on one: three processes keep two cores busy.
    maxWorkers: 3,
    fileParallelism: true,
    sequence: { sequencer: LongestFirst },
  },
});
